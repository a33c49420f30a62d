"""Names that are asked for: whatever their capitals, and with the nearest where there is none."""
import difflib
from typing import Any, Dict, Iterable


def known(name: str, names: Iterable[str], what: str) -> str:
    """The one of the names that is meant; KeyError where none is."""
    all_names = list(names)
    if name in all_names:
        return name
    same = [other for other in all_names if other.lower() == str(name).lower()]
    if len(same) == 1:
        return same[0]
    near = same or difflib.get_close_matches(str(name), all_names, 3, 0.5)
    if near:
        raise KeyError(f"no {what} is called {name!r}; did you mean {' or '.join(map(repr, near))}?")
    shown = ", ".join(all_names[:12]) + (f" and {len(all_names) - 12} more" if len(all_names) > 12 else "")
    raise KeyError(f"no {what} is called {name!r}; there are {shown or 'none'}")


class Numbers(Dict[str, Any]):
    """Numbers of a test by name."""

    def __missing__(self, name: str) -> Any:
        return self[known(name, self, "number")]
