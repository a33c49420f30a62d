"""Charts by Matplotlib, from what the program says of a figure (src/report/figure.hpp): the same series, colours and
intervals as in its files and on its pages."""
import json
import math
import re
from typing import Any, Dict, List, Optional, Tuple

_dashes = [(0, ()), (0, (5, 2)), (0, (1, 2)), (0, (5, 2, 1, 2)), (0, (10, 2)), (0, (3, 3)), (0, (7, 2, 1, 2, 1, 2)),
           (0, (1, 4))]
_symbols = "os^vDp*"
_second = {"theory", "bare", "others", "bedding"}  # dashed: not the rock and not the model


def _numbers(values: List[Optional[float]], n: int) -> List[float]:
    return [math.nan if v is None else v for v in values] or [math.nan] * n


def _symbol(series: Dict[str, Any]) -> Dict[str, Any]:
    if series["role"] == "laboratory":
        return {"marker": "D", "markerfacecolor": "white", "markersize": 6}
    if series["role"] == "left_out":
        return {"marker": "x", "markersize": 7, "markeredgewidth": 1.6}
    told = series["role"] in ("ordered", "listed", "level")
    return {"marker": _symbols[series["number"] % len(_symbols)] if told else "o", "markersize": 4.5}


def _draw_series(axes: Any, s: Dict[str, Any], label: str) -> None:
    x, n = s["x"], len(s["x"])
    y, low, high = (_numbers(s[name], n) for name in ("y", "low", "high"))
    look = {"color": s["color"], "label": _typeset(label)}
    if s["mark"] == "line":
        dash = _dashes[1] if s["role"] in _second else _dashes[s["number"] % len(_dashes)] if s["role"] == "ordered" else "-"
        axes.plot(x, y, linewidth=2.2 if s["strong"] else 1.4, linestyle=dash, **look)
    elif s["mark"] == "points":
        bars = None
        if not all(map(math.isnan, high)):
            bars = [[0 if math.isnan(b) else max(0, sign * (b - v)) for b, v in zip(ends, y)]
                    for sign, ends in ((-1, low), (1, high))]
        axes.errorbar(x, y, yerr=bars, linestyle="none", elinewidth=1.2, **_symbol(s), **look)
    elif s["mark"] == "dots":
        axes.plot(x, y, ".", markersize=3, **look)
    elif s["mark"] == "text":
        for place in zip(x, y, s["text"]):
            axes.annotate(place[2], place[:2], xytext=(0, 4), textcoords="offset points", ha="center", color=s["color"],
                          fontsize="small")
    elif s["mark"] == "band":
        axes.fill_between(x, low, high, linewidth=0, zorder=0.5, **look)
    elif s["mark"] == "boxes":
        axes.bar(x, [b - a for a, b in zip(low, high)], s["width"], low, zorder=0.8, **look)
    else:
        axes.fill(x, y, linewidth=0, **look)


def _typeset(text: str) -> str:
    """σ_ci as a symbol with an index."""
    return re.sub(r"\b(\w)_(\w+)", r"$\1_{\2}$", text)


def _label(axis: Dict[str, Any]) -> str:
    return _typeset(f"{axis['quantity']} [{axis['unit']}]" if axis["unit"] else axis["quantity"])


def _set_axis(axes: Any, which: str, axis: Dict[str, Any]) -> None:
    getattr(axes, f"set_{which}label")(_label(axis))
    if axis["logarithmic"]:
        getattr(axes, f"set_{which}scale")("log")
    getattr(axes, f"set_{which}lim")(axis["low"], axis["high"])
    if axis["names"]:
        getattr(axes, f"set_{which}ticks")(range(len(axis["names"])), axis["names"])
    elif axis["step"]:
        first, last = math.ceil(axis["low"] / axis["step"]), math.floor(axis["high"] / axis["step"])
        getattr(axes, f"set_{which}ticks")([i * axis["step"] for i in range(first, last + 1)])


def _draw_panel(axes: Any, panel: Dict[str, Any], named: Dict[str, Tuple[Any, str]]) -> None:
    right = axes.twinx() if panel["right"] else None
    for s in panel["series"]:
        new = s["name"] if _typeset(s["name"]) not in named else ""
        _draw_series(right if s["right"] else axes, s, new or "_")
    for side in filter(None, (axes, right)):
        for handle, label in zip(*side.get_legend_handles_labels()):
            named.setdefault(label, (handle, label))
    if panel["framed"]:
        _set_axis(axes, "x", panel["x"]), _set_axis(axes, "y", panel["y"])
        if right:
            _set_axis(right, "y", panel["right"])
    else:
        axes.set(xlim=(panel["x"]["low"], panel["x"]["high"]), ylim=(panel["y"]["low"], panel["y"]["high"]), aspect="equal")
        axes.set_axis_off()
    axes.set_title(panel["title"], fontsize="medium")


def draw(figure: str, ax: Any = None) -> Any:
    """A Matplotlib figure of a figure's JSON; into `ax` where it has one panel."""
    import matplotlib.pyplot as plt

    panels = json.loads(figure)["panels"]
    if ax is not None and len(panels) != 1:
        raise ValueError(f"ax: expected none, as this figure has {len(panels)} panels")
    columns = min(len(panels), 2 if len(panels) == 4 else 3)
    rows = -(-len(panels) // columns)
    if ax is not None:
        drawn, places = ax.figure, [ax]
    else:
        drawn, grid = plt.subplots(rows, columns, figsize=(max(5.0, 3.6 * columns), 3.4 * rows), squeeze=False,
                                   layout="constrained")
        places = list(grid.flat)
    named: Dict[str, Tuple[Any, str]] = {}
    for axes, panel in zip(places, panels):
        _draw_panel(axes, panel, named)
    for unused in places[len(panels):]:
        unused.remove()
    if named and ax is None:
        widest = 0.5 + 0.08 * max(map(len, named))  # [inch] of an entry
        per_line = max(1, min(len(named), int(drawn.get_figwidth() / widest)))
        head = 0.25 * -(-len(named) // per_line) / drawn.get_figheight()
        drawn.get_layout_engine().set(rect=(0.0, 0.0, 1.0, 1.0 - head))
        drawn.legend(*zip(*named.values()), loc="upper center", ncols=per_line, fontsize="small", frameon=False)
    elif named:
        ax.legend(*zip(*named.values()), fontsize="small", frameon=False)
    if ax is None:
        plt.close(drawn)  # a notebook shows what is returned, and would show an open one again
    return drawn
