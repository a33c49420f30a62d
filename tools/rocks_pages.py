"""docs/rocks.md, docs/boryeong.md and measured/rocks.csv, from the cards of data/rocks (tools/rocks.py)."""
import json
import math
import pathlib
import re
import statistics
import subprocess

import measured
from results_csv import table

CURVES = {"interpolated": "straight line", "parabola": "parabola", "cos_2": "a + b cos 2 theta", "cos_4": "a + b cos 2 theta + c cos 4 theta",
          "jaeger": "plane of weakness", "gaussian_process": "Gaussian process"}
COMPRESSION = ("UCS", "sigma_1")
SOUND = ("calibrated", "not decided")

ROCKS_HEAD = """# Measured rocks

Written by `make rocks` from the cards in `data/rocks`. This page lists the rocks that come with the program: what is measured of each, and what its
calibrated model is good for. None of them replaces tests on your own rock. Every number has its source and quality in the rock's folder.

```sh
phyllite rocks                        # this list
phyllite rocks boryeong-shale         # one card
phyllite run data/rocks/boryeong-shale/calibrated.toml --out results/boryeong
```

## Your rock, begun like one of these
`phyllite rock check` names the nearest rock of the list. Three commands calibrate your table with its grain size, spacing and model:

```sh
phyllite rock new mine --data mine.csv --like boryeong-shale
phyllite rock check mine.toml
phyllite calibrate mine.toml --out results/mine
```

## The list
Errors are root mean squares on packings that the fit has not seen: the median over the first packings of the card, and their range.
"Left out" is the error of values predicted without their own measurement, over the error of the best curve.

A rock's table "how the model fails" has two numbers for each angle: the share of cracks along the bedding, and the angle of the
[plane of failure](theory/failure-plane.md) in degrees. With "none", less than half of the specimens have a plane.

"""

BORYEONG_HEAD = """# Boryeong shale, the paper's rock

Written by `make rocks` from the card of [Boryeong shale](rocks.md). This page compares the paper's claim with the numbers of this program.

The paper verifies its method on this rock. Its abstract says: "The results were compared, demonstrating the accuracy and superiority of the calibration method."

"""


def per_cent(values):
    """Median and range of shares, in per cent."""
    values = [100 * v for v in values if v is not None]
    if not values:
        return "-"
    digits = 0 if abs(statistics.median(values)) >= 9.95 else 1
    middle = f"{statistics.median(values):.{digits}f} %"
    return middle if len(values) == 1 else f"{middle} ({min(values):.{digits}f} - {max(values):.{digits}f})"


def times(values):
    values = [v for v in values if v is not None]
    if not values:
        return "-"
    return f"{statistics.median(values):.2f}" + (f" ({min(values):.2f} - {max(values):.2f})" if len(values) > 1 else "")


def name_of(cell):
    stress = f" at {cell['confining [Pa]'] * 1e-6:g} MPa" if cell.get("confining [Pa]") else ""
    theta = cell["theta [deg]"]
    return cell["property"] + stress + ("" if theta is None else f" at {theta:g} degrees")


def cards_of(root, plan):
    paths = {n: root / "data/rocks" / n / "card.json" for n in plan["rock"]}
    return {n: json.loads(p.read_text(encoding="utf-8")) for n, p in paths.items() if p.exists()}


def measured_words(card):
    """"UCS, BTS at 7 angles"."""
    angles = card["measured"]["angles"]
    return ", ".join(card["measured"]["properties"]) + (f" at {angles} angles" if angles else "")


def slug(heading):
    """Anchor of a heading."""
    return re.sub(r"[^\w-]", "", heading.lower().replace(" ", "-"))


def list_row(card):
    errors = card.get("errors", {})
    shown = "; ".join(f"{p} {sum(e) / len(e):.2f}" if p == "nu" else f"{p} {per_cent(e)}" for p, e in errors.items())
    left_out = "; ".join(f"{p} {times(y['ratio'])}" for p, y in card.get("left_out", {}).items())
    return [f"[{card['title']}](#{slug(card['title'])})", measured_words(card), card["verdict"]["status"], shown or "-", left_out or "-"]


def listed(head, items):
    """A head and its items, a line each."""
    return f"{head}\n" + "".join(f"- {i.rstrip('.')}\n" for i in items) if items else ""


def predicted_words(card):
    for p in card.get("predictions", []):
        if "rms" in p:
            yield f"Planned before it was run, {p['text']}: {per_cent(p['rms'])} (rms); {p['yardstick']} has {per_cent([p['yardstick_rms']])}."


def use_of(card):
    """What a consulting engineer may quote, of the findings of the verdict."""
    verdict = card["verdict"]
    if "cells" in card and "errors" not in card:
        return "\n".join(verdict["lines"] + list(predicted_words(card))) + "\n"
    if "errors" not in card:
        why = verdict["lines"][0].rstrip(".")
        return f"{why[0].upper()}{why[1:]}. The table serves for comparison alone.\n"
    status = f"The verdict on the model is \"{verdict['status']}\"."
    if not verdict["good_for"]:
        status += (" Too few specimens, or no stated scatter: the table shows no use. The errors say how near the model comes."
                   if verdict["status"] == "not decided" else " The table supports no use of the model.")
    parts = []
    for p, e in card["errors"].items():
        size = f"{sum(e) / len(e):.2f}" if p == "nu" else per_cent(e)
        parts.append(f"On unseen packings {p} is off by {size} (rms).")
    for p, y in card["left_out"].items():
        parts.append(f"Between the measured angles {p} is predicted within {per_cent(y['with_discrepancy'])}; "
                     + (f"the best curve, {CURVES.get(y['best'], y['best'])}, has {per_cent([y['best_error']])}." if y["best"] else "no curve compares."))
    parts += predicted_words(card)
    return (status + "\n\n" + listed("Good for:", verdict["good_for"]) + "\n" * bool(verdict["good_for"])
            + listed("Not good for, or not shown:", verdict["not_good_for"]) + "\n" + "\n".join(parts) + "\n")


def prediction_row(title, p):
    row = [title, p["text"], "yes" if p.get("blind") else "no"]
    if "rows" not in p:
        return row + ["not run", "", "", "", ""]
    return row + [per_cent(p["rms"]), per_cent(p["mean"]), f"{p['inside']} of {p['of']}", p["yardstick"], per_cent([p["yardstick_rms"]])]


PREDICTION_HEAD = ["rock", "predicted", "blind", "rms error", "mean error", "in the band", "yardstick", "its rms"]


def share_words(failure):
    """"16 %", or "-" of a model without planes."""
    return "-" if failure["bedding_share"] is None else f"{100 * failure['bedding_share']:.0f} %"


def plane_words(failure):
    """The plane that at least half of the tests have."""
    return str(round(failure["angle [deg]"])) if 2 * failure["planes"] >= failure["tests"] > 0 and failure["angle [deg]"] is not None else "none"


def failure_table(card):
    """A row per kind of test and stress; a cell per angle: share of cracks along the bedding, plane of failure."""
    cells = [c for c in card.get("cells", []) if "failure" in c and c["theta [deg]"] is not None]
    if all(c["failure"]["bedding_share"] is None and not c["failure"]["planes"] for c in cells):
        return ""
    kinds = list(dict.fromkeys(name_of(c | {"theta [deg]": None}) for c in cells))
    angles = sorted({c["theta [deg]"] for c in cells})
    rows = []
    for kind in kinds:
        of = {c["theta [deg]"]: c["failure"] for c in cells if name_of(c | {"theta [deg]": None}) == kind}
        rows.append([kind] + [f"{share_words(of[a])}, {plane_words(of[a])}" if a in of else "" for a in angles])
        if any("laboratory [deg]" in f for f in of.values()):
            rows.append(["laboratory"] + [f"{of[a]['laboratory [deg]']:g}" for a in angles])
    return ("[How the model fails](rocks.md#the-list), at each inclination:\n\n" + table(["test"] + [f"{a:g}" for a in angles], rows) + "\n")


def section(card):
    text = f"## {card['title']}\n**What may I use it for?** {use_of(card)}\n"
    if any(card.get("missed", [])):
        text += "Missed values: " + "; ".join(sorted({name_of(c) for c in card["missed"][0]})) + ".\n\n" if card["missed"][0] else ""
    text += "".join(f"- {c}\n" for c in card["cautions"]) + "\n" + failure_table(card)
    if "errors" in card:
        held, effort = card["intervals"], card["asked"]["effort"]
        if held["of"]:
            text += f"Of {held['of']} values left out, {held['hold']} lie in their 95 % interval. "
        text += (f"Layers: {card['layers']}. Effort: {effort}. First packings: {', '.join(map(str, card['seeds']))}. Verdicts: {'; '.join(card['statuses'])}. "
                 f"Tests of the press: {card['tests']}. CPU: {card['cpu_s'] / 60:.1f} min, predictions included. Program: {card['program']}.\n\n")
    return text + "Sources:\n\n" + "".join(f"- `{s['key']}`: {s['cite']}. {s['licence'][0].upper() + s['licence'][1:]}.\n" for s in card["sources"]) + "\n"


def rocks_page(cards):
    text = ROCKS_HEAD + table(["rock", "measured", "verdict", "error", "left out, over the best curve"], [list_row(c) for c in cards.values()])
    predictions = [(c["title"], p) for c in cards.values() for p in c.get("predictions", [])]
    if predictions:
        text += ("\n## Predicted first\nSeeds, model and yardstick of each prediction stand in `data/rocks/plan.toml` since before its run. "
                 "Blind: nothing was run before with the predicted values. Of the others, earlier versions of the program were tried on the same "
                 "tables with other packings. The band is the smallest to the largest of twenty draws, or of the packings of a study. "
                 "Of a strength that the table has it counts what the model misses there.\n\n"
                 + table(PREDICTION_HEAD, [prediction_row(*p) for p in predictions]))
    return (text + "\n" + "".join(section(c) for c in cards.values())).rstrip() + "\n"


# --- the paper's rock


def paper_cell(cell):
    error = f"{100 * cell['error']:+.1f}"
    jaeger = f"{cell['jaeger'] * 1e-6:.1f}" if cell.get("jaeger") else "-"
    left_out = f"{statistics.fmean(cell['left_out']) * 1e-6:.1f}" if cell.get("left_out") else "-"
    return [f"{cell['theta [deg]']:g}", f"{cell['laboratory'] * 1e-6:.1f}", f"{statistics.fmean(cell['model']) * 1e-6:.1f}", error, left_out, jaeger]


def paper_page(card, picture):
    if "errors" not in card:
        return BORYEONG_HEAD + "Not run yet.\n\n" + "".join(f"- {c}\n" for c in card["cautions"])
    cells = [c for c in card["cells"] if c["property"] == "UCS"]
    worst = max(cells, key=lambda c: abs(c["error"]))
    text = BORYEONG_HEAD + f"**{card['verdict']['sentence']}**\n\n" + "".join(f"- {line}\n" for line in card["verdict"]["lines"])
    text += "\n## UCS over the inclination\n" + (f"![UCS: laboratory, model, 95 % intervals, left-out values, plane of weakness]({picture})\n\n" if picture else "\n")
    text += table(["theta [deg]", "laboratory [MPa]", "model, unseen packings [MPa]", "error [%]", "left out [MPa]", "plane of weakness, left out [MPa]"],
                  [paper_cell(c) for c in cells])
    text += "\nModel and left-out values are means over the first packings. The plane of weakness is Jaeger's, fitted without the value.\n\n"
    y, e = card["left_out"]["UCS"], card["errors"]["UCS"]
    rows = [["UCS, unseen packings, rms", per_cent(e)], [f"worst angle, {worst['theta [deg]']:g} degrees", per_cent([worst["error"]])],
            ["left out, with discrepancy", per_cent(y["with_discrepancy"])], ["left out, model alone", per_cent(y["model"])],
            [f"left out, best curve ({CURVES.get(y['best'], y['best'])})", per_cent([y["best_error"]])],
            ["left out, over the best curve", times(y["ratio"])]]
    text += "## In numbers\n" + table(["what", "value (range over first packings)"], rows)
    text += "\nThe paper's sequence begins with E. The table has none, so that `--method sequence` cannot be compared here.\n"
    text += "\n" + failure_table(card)
    text += "## Where it misses, and why\n" + f"The largest error is at {worst['theta [deg]']:g} degrees: {100 * worst['error']:+.1f} %.\n\n"
    text += weak_plane_words({c["theta [deg]"]: c["laboratory"] for c in cells}) + tried_tables()
    text += "".join(f"{c}\n" for c in card["verdict"]["causes"]) + "\n" + "".join(f"- {c}\n" for c in card["cautions"])
    return text.rstrip() + "\n"


def slip(theta, mu):
    """UCS of a weak plane over twice its cohesion: 1/(sin 2 theta (1 - mu/tan theta)) (Jaeger 1960)."""
    a = math.radians(theta)
    return 1 / (math.sin(2 * a) * (1 - mu / math.tan(a)))


def weak_plane_words(values):
    """What a single plane makes of the values at 45, 60 and 75 degrees, which slip along bedding decides, if any."""
    steep = (45, 60, 75)
    grid = [0.005 * k for k in range(190)]
    friction = min(grid, key=lambda mu: abs(slip(45, mu) / slip(60, mu) - values[45] / values[60]))

    def errors(mu):
        logs = [math.log(slip(t, mu) / values[t]) for t in steep]
        return [v - statistics.fmean(logs) for v in logs]

    nearest = min((errors(mu) for mu in grid), key=lambda e: sum(v * v for v in e))
    return (f"No single plane has the values at 45, 60 and 75 degrees:\n\n"
            f"- UCS at 45 over 60 degrees is {values[45] / values[60]:.2f}. A plane with a friction of {friction:.2f} has that.\n"
            f"- UCS at 75 over 60 degrees is {values[75] / values[60]:.2f}. That plane has {slip(75, friction) / slip(60, friction):.2f}, "
            f"a plane without friction {slip(75, 0) / slip(60, 0):.2f}.\n"
            f"- The plane nearest to the three is off by {100 * (math.exp(nearest[1]) - 1):+.0f} % at 60 degrees.\n")


TRIED = """
Bonded bedding of the model has a cohesion and no friction, so that it slips easiest at 45 degrees. With friction the error moves from 60 to 75
degrees. [Measured](../measured/boryeong.csv) on 684 discs, each model calibrated anew:

"""
KEPT = """
One number changed, all others kept. Nothing lowers UCS(60) alone; [other stiffnesses](decisions/0023-stiffness-without-moduli.md) do not either.

"""


def tried_tables():
    """Of measured/boryeong.csv: a row per model that was calibrated, and a row per number that was changed alone."""
    models = {True: {}, False: {}}
    for r in measured.rows_of("boryeong"):
        model, what = r["claim"].removeprefix("Boryeong shale, ").split(": ")
        name = model.removeprefix("all else kept, ")
        models[name != model].setdefault(name, {})[what] = f"{r['value']} {r['unit']}"
    rows = lambda kept, columns: [[m] + [of[c] for c in columns] for m, of in models[kept].items()]
    angles = ["UCS(45)", "UCS(60)", "UCS(75)"]
    return (TRIED + table(["model", "UCS, rms", "UCS(60)", "UCS(75)", "left out, model alone"],
                          rows(False, ["UCS, unseen packings", "UCS(60)", "UCS(75)", "left out"]))
            + KEPT + table(["change"] + angles, rows(True, angles)))


def draw(program, root, results, card):
    """The figure of the first calibration; the page goes without where gnuplot or the folder is missing."""
    folder, picture = results / f"boryeong-shale/{card.get('seeds', [1])[0]}/calibration", root / "docs/pictures/boryeong.png"
    if (folder / "calibration.json").exists():
        picture.unlink(missing_ok=True)
        subprocess.run([program, "figure", folder, "--kind", "anisotropy", "--format", "png", "--out", picture], check=False, cwd=measured.ROOT)
    return f"pictures/{picture.name}" if picture.exists() else ""


# --- measurements


def compression(card):
    return next((p for p in COMPRESSION if p in card.get("errors", {})), None)


def rows_of(cards):
    strengths = {n: c for n, c in cards.items() if compression(c)}
    errors = [statistics.median(c["errors"][compression(c)]) for c in strengths.values()]
    ratios = [statistics.median(y["ratio"]) for c in strengths.values() for y in c["left_out"].values() if y["ratio"]]
    if errors:
        yield measured.row("measured rocks: strength in compression, median error", f"{100 * statistics.median(errors):.1f}", "%",
                           f"{100 * min(errors):.1f} - {100 * max(errors):.1f}", f"{len(errors)} rocks")
        sound = [n for n, c in strengths.items() if c["verdict"]["status"] in SOUND]
        yield measured.row("measured rocks: calibrated or not decided", len(sound), "", "", f"of {len(strengths)} with strengths")
    if ratios:
        yield measured.row("measured rocks: left out over best curve", f"{statistics.median(ratios):.2f}", "times",
                           f"{min(ratios):.2f} - {max(ratios):.2f}", f"{len(ratios)} tables")
    if (card := cards.get("boryeong-shale", {})).get("errors"):
        yield from paper_rows(card)
    for p in (p for c in cards.values() for p in c.get("predictions", []) if "rms" in p):
        yield measured.row(f"planned first, {p['name']}: rms", f"{100 * statistics.median(p['rms']):.1f}", "%",
                           f"yardstick {100 * p['yardstick_rms']:.1f}", f"{p['calibrations']} calibrations")
        yield measured.row(f"planned first, {p['name']}: in the band", f"{100 * p['inside'] / p['of']:.0f}", "%", "", f"{p['of']} values")


def paper_rows(card):
    worst = max(abs(c["error"]) for c in card["cells"])
    n = f"{len(card['seeds'])} calibrations"
    yield measured.row("Boryeong shale: UCS, unseen packings", f"{100 * statistics.median(card['errors']['UCS']):.1f}", "%",
                       " - ".join(f"{100 * f(card['errors']['UCS']):.1f}" for f in (min, max)), n)
    yield measured.row("Boryeong shale: worst angle", f"{100 * worst:.1f}", "%", "", n)
    yield measured.row("Boryeong shale: left out over best curve", times(card["left_out"]["UCS"]["ratio"]).split(" ")[0], "times", "", n)


def write(root: pathlib.Path, plan, program, results):
    cards = cards_of(root, plan)
    (root / "docs/pictures").mkdir(parents=True, exist_ok=True)
    (root / "docs/rocks.md").write_text(rocks_page(cards), encoding="utf-8")
    paper = next((n for n, r in plan["rock"].items() if r.get("paper")), None)
    if paper in cards:
        (root / plan["rock"][paper]["paper"]).write_text(paper_page(cards[paper], draw(program, root, results, cards[paper])), encoding="utf-8")
    if root == measured.ROOT:
        measured.add("rocks", rows_of(cards), "make rocks")
