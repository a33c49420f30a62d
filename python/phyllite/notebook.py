"""What a notebook shows: tables in HTML, and a bar for long work."""
import html
import sys
from typing import Any, Iterable, Sequence


def shown(value: Any) -> str:
    """A cell: numbers to four digits, as many as a laboratory's have."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return "" if value != value else f"{value:.4g}"
    return "" if value is None else html.escape(str(value))


def table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """An HTML table."""
    def line(cells: Iterable[str], kind: str) -> str:
        return "<tr>" + "".join(f"<{kind}>{cell}</{kind}>" for cell in cells) + "</tr>"

    body = "".join(line(map(shown, row), "td") for row in rows)
    return f"<table><thead>{line(map(html.escape, head), 'th')}</thead><tbody>{body}</tbody></table>"


def paragraphs(lines: Iterable[str]) -> str:
    """A paragraph each."""
    return "".join(f"<p>{html.escape(line)}</p>" for line in lines)


def folded(title: str, text: str) -> str:
    """A text that opens on a click."""
    return f"<details><summary>{html.escape(title)}</summary><pre>{html.escape(text)}</pre></details>"


class Bar:
    """progress="bar": one bar that moves, in a notebook or on a terminal."""

    def __init__(self) -> None:
        self._handle: Any = None
        self._done, self._total = 0, 0

    def __call__(self, text: str, done: int, total: int) -> None:
        if total > 0:
            self._done, self._total = done, total
        if "ipykernel" in sys.modules:
            self._in_notebook(text)
        else:
            print(f"\r{self._done:5d} of {self._total}  {text:60.60}", end="", file=sys.stderr, flush=True)
            if 0 < self._total == self._done:
                print(file=sys.stderr)

    def _in_notebook(self, text: str) -> None:
        from IPython.display import HTML, display

        bar = HTML(f'<progress value="{self._done}" max="{max(1, self._total)}"></progress> '
                   f"{self._done} of {self._total} &nbsp; {html.escape(text)}")
        if self._handle is None:
            self._handle = display(bar, display_id=True)
        else:
            self._handle.update(bar)
