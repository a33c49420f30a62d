#!/usr/bin/env python3
"""Writes docs/paper.md from the stores of the paper's studies (`make paper`; `make pictures` draws the figures).

    python3 tools/paper.py RESULTS docs

RESULTS holds the folders study, no-jump, small, small-jump, small-crossing, crossing, choices, area and, by the direct solution, elastic,
elastic-crossing, elastic-area, elastic-area-crossing (`phyllite study`). Every number of the page is read from them; nothing is fitted here but straight lines.
"""
import csv
import io
import math
import pathlib
import sqlite3
import sys
import tomllib
import zlib

import measured
from results_csv import table

ANGLES = [0, 15, 30, 45, 60, 75, 90]
PARAMETERS = [("bedding.k_n", "k_n"), ("bedding.k_s", "k_s"), ("bedding.mu", "mu"), ("bedding.sigma_n", "sigma_n"),
              ("bedding.cohesion", "C"), ("bedding.zone_thickness", "d")]
STRENGTH = PARAMETERS[2:5]
EQ2 = {}  # of the study's regressions: slope, intercept [GPa/m], R2
STIFFNESSES = [("bedding.k_n", "K_n"), ("bedding.k_s", "K_s")]


class Results:
    """responses.csv of a study: mean and half width of the 95 % interval, by number, specimen and point."""

    def __init__(self, folder):
        self.folder = folder
        self.values, self.points = {}, {}
        for row in csv.DictReader(open(folder / "responses.csv")):
            point = int(row["point"])
            keys = {name.split(" [")[0]: cell for name, cell in row.items() if name.split(" [")[0].count(".") == 1}
            self.points[point] = {k: float(v) if v.replace(".", "").replace("e", "").replace("-", "").replace("+", "")
                                  .isdigit() else v for k, v in keys.items()}
            if row["mean"]:
                half = float(row["half width of 95 %"]) if row["half width of 95 %"] else None
                self.values[row["number"], row["specimen"], point] = (float(row["mean"]), half, int(row["replicates"]))

    def mean(self, number, specimen, point=0):
        return self.values.get((number, specimen, point), (math.nan, None, 0))[0]

    def at_angle(self, number, theta, point=0, reference=""):
        name = f"theta = {theta} deg" if theta != "intact" else "intact"
        return self.mean(number, name + reference, point)

    def interval(self, number, specimen, scale, digits, point=0):
        mean, half, _ = self.values.get((number, specimen, point), (math.nan, None, 0))
        text = f"{mean * scale:.{digits}f}" if math.isfinite(mean) else "-"
        return text + (f" +- {half * scale:.{digits}f}" if half is not None else "")

    def curve(self, key):
        """Points of a one-at-a-time study along one parameter: [(factor, point)], the base among them."""
        base = self.points[0]
        found = [(p[key] / base[key], n) for n, p in self.points.items()
                 if all(p[k] == base[k] for k in p if k != key)]
        return sorted(found)

    def K(self, which, point, reference="reference intact"):
        return self.mean(which, f"all angles, {reference}", point) * 1e-9


def line(x, y):
    """Slope, intercept, R2."""
    n, mx, my = len(x), sum(x) / len(x), sum(y) / len(y)
    sxx = sum((a - mx) ** 2 for a in x)
    slope = sum((a - mx) * (b - my) for a, b in zip(x, y)) / sxx
    cut = my - slope * mx
    rest = sum((b - cut - slope * a) ** 2 for a, b in zip(x, y))
    total = sum((b - my) ** 2 for b in y)
    return slope, cut, 1 - rest / total if n > 2 else math.nan


# --- what broke before half of the strength


def rows_of(blob):
    """A compressed table of the store, its units cut off the head."""
    for row in csv.DictReader(io.StringIO(zlib.decompress(blob).decode())):
        yield {name.split(" [")[0]: cell for name, cell in row.items()}


def early_cracks(folder, point_values):
    """Joints broken in tension, in shear and matrix bonds broken before 50 % of UCS, by angle, at these values: means over packings."""
    db = sqlite3.connect(folder / "study.sqlite")
    keys = {}
    for row in csv.DictReader(open(folder / "results.csv")):
        values = {n.split(" [")[0]: c for n, c in row.items()}
        if row["intact"] == "0" and all(abs(float(values[k]) / v - 1) < 1e-9 for k, v in point_values.items()):
            keys[row["key"]] = float(row["theta [deg]"])
    found = {theta: [] for theta in keys.values()}
    for name, theta in keys.items():
        history, cracks = (list(rows_of(blob)) for blob in
                           db.execute("SELECT history, cracks FROM specimen WHERE key = ?", (name,)).fetchone())
        stress = [float(r["axial_stress"]) for r in history]
        half = 0.5 * max(stress)
        step = next(float(r["step"]) for r, s in zip(history, stress) if s >= half) if stress else 0
        early = [c for c in cracks if float(c["step"]) <= step]
        joints = [c["mode"] for c in early if c["place"] == "bedding"]
        found[theta].append((joints.count("tension"), joints.count("shear"), len(early) - len(joints)))
    return {theta: [round(sum(n) / len(n)) for n in zip(*counts)] for theta, counts in found.items()}


# --- the page


def eq2_rows(results, times_k_n, label):
    rows = []
    for key, K in STIFFNESSES:
        base = results.points[0][key] * 1e-9
        for reference in ("reference intact", "reference E(90)", "reference free"):
            ps = [(f * base, results.K(K, p, reference)) for f, p in results.curve(key) if f <= times_k_n]
            ps = [p for p in ps if math.isfinite(p[1])]
            if len(ps) < 3:
                continue
            slope, cut, R2 = line(*zip(*ps))
            rows.append([label, f"{K}({key[8:]})", reference[10:], f"{slope:.3f}", f"{cut:.0f}", f"{R2:.5f}"])
    return rows


def direct_lines(results, reference, low, high):
    rows = []
    for key, K in STIFFNESSES:
        base = results.points[0][key] * 1e-9
        ps = [(f * base, results.K(K, p, f"reference {reference}")) for f, p in results.curve(key) if low <= f <= high]
        ps = [p for p in ps if math.isfinite(p[1])]
        rows.append(line(*zip(*ps)) if len(ps) > 2 else (math.nan,) * 3)
    return rows


def shape(E):
    """Curve type of tested moduli: a shoulder has its least E well inside, at least 1 % below E(0)."""
    least = min(range(len(E)), key=lambda i: E[i])
    return (f"shoulder, least at {ANGLES[least]} deg" if least > 0 and E[least] < 0.99 * E[0] else "incremental")


def switch_rows(study, rule="zone"):
    rows = []
    for key, name in PARAMETERS[:2]:
        for f, p in study.curve(key):
            K_n, K_s = study.K("K_n", p, "reference E(90)"), study.K("K_s", p, "reference E(90)")
            predicted = "incremental"
            if K_n > 2 * K_s:
                angle = math.degrees(math.acos(math.sqrt(K_n / (2 * (K_n - K_s)))))
                predicted = f"shoulder, least at {angle:.0f} deg"
            tested = shape([study.at_angle("E_tangent", t, p) for t in ANGLES])
            rows.append([f"{rule}, {name} x {f:g}", f"{K_n:.0f}", f"{K_s:.0f}", f"{K_n / K_s:.2f}", predicted, tested,
                         "yes" if predicted.split(",")[0] == tested.split(",")[0] else "no"])
    return rows


def change(study, number, key, specimen):
    curve = study.curve(key)
    first, last = (study.mean(number, specimen, p) for p in (curve[0][1], curve[-1][1]))
    return 100 * (last / first - 1)


def spread(study, number, key, specimen):
    """Largest over smallest value along a parameter, minus 1 [%]."""
    ys = [study.mean(number, specimen, p) for _, p in study.curve(key)]
    ys = [y for y in ys if math.isfinite(y)]
    return 100 * (max(ys) / min(ys) - 1)


def store_line(folder):
    db = sqlite3.connect(folder / "study.sqlite")
    n, seconds, steps = db.execute("SELECT count(*), sum(seconds), sum(n_steps) FROM specimen").fetchone()
    bad = db.execute("SELECT name, reason FROM specimen WHERE status <> 'peaked'").fetchall()
    program = db.execute("SELECT DISTINCT program FROM specimen").fetchone()[0]
    return n, seconds, steps, bad, program


def tests(folder, column):
    """{test: value} of a study, a test by specimen, point, packing and bond seed; the intact rock is the same at every point."""
    found = {}
    for row in csv.DictReader(open(folder / "results.csv")):
        if row["intact"] == "1" and row["point"] != "0":
            continue
        name = "intact" if row["intact"] == "1" else f"theta = {float(row['theta [deg]']):g} deg"
        if row[column] and row["status"] == "peaked":
            found[name, int(row["point"]), row["packing"], row["bond_seed"]] = float(row[column])
    return found


def jump_section(pairs):
    rows = []
    for name, study, calm in pairs:
        for number, column in (("E_tangent", "E_tangent [Pa]"), ("ucs", "ucs [Pa]")):
            with_jump, without = tests(study.folder, column), tests(calm.folder, column)
            differences = [(100 * (value / without[key] - 1), *key) for key, value in with_jump.items() if key in without]
            values = sorted(abs(d[0]) for d in differences)
            mean = sum(d[0] for d in differences) / len(differences)
            worst = max(differences, key=lambda d: abs(d[0]))
            rows.append([name, number, len(values), f"{mean:+.2f} %", f"{values[len(values) // 2]:.2f} %",
                         f"{values[int(0.95 * len(values))]:.2f} %", f"{worst[0]:+.1f} % ({worst[1]}, point {worst[2]})"])
    return table(["specimen", "number", "tests", "mean", "median of magnitudes", "95 % below", "largest"], rows)


def page(results, docs):
    study, calm, small, jumped, small_crossing, crossing, choices, area = (
        Results(results / n) for n in ("study", "no-jump", "small", "small-jump", "small-crossing", "crossing", "choices", "area"))
    direct = {(recipe, rule): Results(results / folder) for recipe, rule, folder in (
        ("dense packing", "zone", "elastic"), ("dense packing", "crossing", "elastic-crossing"),
        ("area packing", "zone", "elastic-area"), ("area packing", "crossing", "elastic-area-crossing"))}
    for found in tomllib.loads((results / "elastic" / "regressions.toml").read_text())["line"]:
        EQ2[found["number"]] = found["slope"], float(found["intercept"].split()[0]) * 1e-9, found["R2"]
    out = [HEAD.format(*run_numbers(results)), jump_section([("paper's", study, calm), ("quarter", jumped, small)])]
    out += ["\n## Table 3: E tested and fitted\n", TABLE_3, table3(study, choices), EQ1_NOTE.format(
        study.interval("R2_eq1", "all angles, reference intact", 1, 3),
        study.interval("R2_eq1", "all angles, reference E(90)", 1, 4))]
    out += ["\n## Eq. 2: K_n(k_n) and K_s(k_s)\n", EQ2_TEXT, eq2_table(study, crossing, direct)]
    out += ["\n## Fig. 4: which parameter moves K_n and K_s\n", "[Macro stiffnesses over six parameters](gallery.md#studies), on a quarter of the specimen.\n\n", fig4_table(study, small),
            fig4_by_rule(small, small_crossing), broken_text(results, study)]
    out += ["\n## Fig. 5: curve types and their switch at K_n = 2 K_s\n", "[E over the inclination for five k_n and five k_s](gallery.md#studies), on a quarter of the specimen.\n\n", FIG5_TEXT,
            table(["setting", "K_n [GPa/m]", "K_s [GPa/m]", "K_n/K_s", "Eq. 1 says", "tested", "same type"],
                  switch_rows(study) + switch_rows(crossing, "crossing")), fig5_verdict(study, crossing)]
    out += ["\n## Fig. 6: UCS\n", "[UCS over the inclination for six parameters](gallery.md#studies), on a quarter of the specimen.\n\n", FIG6_TEXT, fig6_table(study)]
    out += ["\n## What the paper leaves open\n", OPEN_TEXT, open_table(choices, area), RANGE_TEXT, range_table(direct)]
    out += ["\n## Point by point\n", verdict_table(study, crossing, small)]
    (docs / "paper.md").write_text("".join(out))


HEAD = """# The paper, again

Written by `make paper` from the stores of the studies in `examples/paper`; every number below is read from them.
Sections 3 and 4 of "Parametric study of smooth joint parameters on the mechanical behavior of transversely isotropic rocks
and research on calibration method", run with Phyllite. The text of the paper that we have ends with the caption of
Fig. 6. Its Table 3, Table 4 and the curves of its figures are not in it, so we compare with its words.

Specimen: 38 x 76 mm, 7,481 discs, Tables 1 and 2; `examples/paper/press.toml` states what the paper leaves open. Press:
{0} m/s per platen, single precision, affine pre-strain to strain {1}. Five factors, 0.25 to 2, of each of six parameters, one
at a time, seven angles, three packings. With the intact rock {2} tests, {3:.2f} million cycles, {4:.0f} s of CPU.
{5}
+- is the 95 % interval of the mean over packings (one packing where there is none); other numbers are means over them.

The affine pre-strain, against the same tests loaded from zero, as far as both are in the stores (E is the tangent at 40-60 % of
UCS). A test whose joints would break during the pre-strain is loaded from zero in both and differs by nothing:

"""
TABLE_3 = """
Tables 1 and 2; Eq. 1 fitted to the seven moduli, E fixed at the intact rock's or at E(90). Below it a quarter of the specimen
(19 x 38 mm, 1,870 discs) on three packings, which shows how much of the last digits is chance.

"""
EQ1_NOTE = """
R2 of Eq. 1 is {0} with E of the intact rock. With E(90) it is {1}.
A third of the zone's joints do not cross their plane. At 90 degrees
they carry the load by k_s alone and soften the specimen. Eq. 1 is made for planes without thickness, and does not know this. The
numbers of the paper's Table 3 are not in our text.

"""
EQ2_TEXT = """
Under the press (E tangent), and by the direct elastic solution (five packings; mean of K over them, line through the means;
all readings in [eq2.md](theory/eq2.md)). The paper does not say which E its fit refers to. The paper's slopes belong
to contacts that cross the plane; its text describes a zone. No reading meets both its slopes and its intercepts.

"""
FIG5_TEXT = """
Goodman's law turns from incremental (E grows from 0 to 90 degrees) to shoulder (least E in between) where K_n passes 2 K_s.
K_n and K_s come from the fit with E(90). A tested curve counts as a shoulder if its least E is 1 % below E(0).

"""
FIG6_TEXT = """
The paper's text on Fig. 6 is cut off after its first sentence, so there is nothing to agree with. Change of UCS from 0.25 to 2
times the base [%]:

"""
OPEN_TEXT = """
Small runs: a quarter of the paper's specimen (19 x 38 mm, 1,870 discs), three packings, Tables 1 and 2, one choice changed at
a time. K_n and K_s in GPa/m by Eq. 1 on E at 50 % with E of the intact rock, moduli in GPa, UCS in MPa.

"""
RANGE_TEXT = """
Table 4, the ranges of the parameters, is not in our text. The range decides which part of a slightly curved K(k) the line of
Eq. 2 sees (direct solution, five packings, E of the intact rock):

"""


def run_numbers(results):
    n, seconds, steps, bad, _ = store_line(results / "study")
    recipe = (results / "study" / "recipe.toml").read_text()

    def key(*names):  # the last ones are those of earlier versions
        return next(x.split("=")[1].split("#")[0].strip().strip('"') for x in recipe.splitlines()
                    if x.startswith(tuple(name + " " for name in names)))

    failures = "All peaked." if not bad else (
        f"{len(bad)} without a peak, stored as such: " + "; ".join(f"{name} ({reason})" for name, reason in bad) + ".")
    return key("platen_speed").split()[0], key("pre_strain", "jump_strain"), n, steps * 1e-6, seconds, failures


def table3(study, choices):
    specimens = [f"theta = {t} deg" for t in ANGLES]
    rows = [["E tested [GPa]"] + [study.interval("E_tangent", s, 1e-9, 1) for s in specimens + ["intact"]]]
    for reference, name in (("reference intact", "E fitted, E intact"), ("reference E(90)", "E fitted, E(90)")):
        rows.append([name] + [study.interval("E_eq1", f"{s}, {reference}", 1e-9, 1) for s in specimens] + [""])
    rows.append(["UCS [MPa]"] + [study.interval("ucs", s, 1e-6, 1) for s in specimens + ["intact"]])
    rows.append(["quarter: E tested"] + [choices.interval("E_tangent", s, 1e-9, 1) for s in specimens + ["intact"]])
    rows.append(["quarter: UCS"] + [choices.interval("ucs", s, 1e-6, 0) for s in specimens + ["intact"]])
    text = table(["theta [deg]"] + [str(t) for t in ANGLES] + ["intact"], rows) + "\n"
    rows = [[r[10:]] + [results.interval(K, f"all angles, {r}", 1e-9, 0) for results in (study, choices) for K in ("K_n", "K_s")]
            for r in ("reference intact", "reference E(90)", "reference free")]
    return text + table(["E of the fit", "K_n [GPa/m]", "K_s [GPa/m]", "quarter: K_n", "quarter: K_s"], rows)


def eq2_table(study, crossing, direct):
    rows = [["**paper**", f"{K}(k_{K[2]})", "not said", f"{s:.4f}", f"{c:.1f}", f"{R:.5f}"] for K, (s, c, R) in EQ2.items()]
    rows += eq2_rows(study, 2.0, "press, zone rule, 0.25-2")
    rows += eq2_rows(crossing, 1.5, "press, crossing rule, 0.25-1.5")
    for (recipe, rule), folder in direct.items():
        for reference in ("intact", "E(90)"):
            lines = direct_lines(folder, reference, 0.25, 2.0)
            for K, (slope, cut, R2) in zip(("K_n", "K_s"), lines):
                rows.append([f"direct, {recipe}, {rule}, 0.25-2", f"{K}(k_{K[2]})", reference, f"{slope:.3f}", f"{cut:.0f}",
                             f"{R2:.5f}"])
    return table(["source", "line", "E of the fit", "slope", "intercept [GPa/m]", "R2"], rows)


def fig4_rows(parts, parameters):
    """Rows of K_n and K_s by parameter; `parts`: (results, reference) from left to right."""
    rows = []
    for key, name in parameters:
        row = [name]
        for results, reference in parts:
            for K in ("K_n", "K_s"):
                value = spread(results, K, key, f"all angles, {reference}") if any(
                    math.isfinite(results.K(K, p, reference)) for _, p in results.curve(key)) else math.nan
                row.append(f"{value:.1f}" if math.isfinite(value) else "-")
        rows.append(row)
    return rows


def fig4_table(study, small):
    rows = fig4_rows(((study, "reference intact"), (small, "reference intact (E_small)")), PARAMETERS)
    return ("Largest over smallest value along each parameter, minus 1 [%]. E at 50 % of UCS as in the laboratory, and E at small "
            "strain, before anything breaks (a quarter of the specimen, without affine pre-strain):\n\n" +
            table(["parameter", "K_n, E at 50 %", "K_s, E at 50 %", "K_n, small strain", "K_s, small strain"], rows))


def fig4_by_rule(small, small_crossing):
    parts = [(results, reference) for results in (small, small_crossing) for reference in ("reference intact", "reference intact (E_small)")]
    head = [f"{K}, {rule}, {E}" for rule in ("zone", "crossing") for E in ("E at 50 %", "small strain") for K in ("K_n", "K_s")]
    rows = fig4_rows(parts, PARAMETERS[:-1])
    measured.add("laboratory", [measured.row("Fig. 4: other stiffness moves", f"{others(rows, 5):.0f}", "%")], "make paper")
    return ("\nThe same by both rules of bedding, a quarter of the specimen, one packing, without affine pre-strain [%]:\n\n" +
            table(["parameter", *head], rows) + "\n" +
            BY_RULE.format(*(f"{others(rows, first):.1f}" for first in (5, 7, 1, 3))))


def others(rows, first):
    """What moves K_n and K_s most, of columns `first` and the next, but the joints' own k_n and k_s."""
    return max(float(row[first + k]) for row in rows for k, own in ((0, "k_n"), (1, "k_s")) if row[0] != own)


BY_RULE = """K_n follows k_n and K_s follows k_s by hundreds of per cent. Other parameters move either, by crossing, by at most {} % at half of UCS (C, on K_s) and {} % at small
strain. By zone they move it by {} % (C, on K_s) and {} %: there bonded bridges break before half of UCS. The paper finds k_n and k_s alone, which is nearest to the crossing rule, or to small strain.
"""


def broken_text(results, study):
    text = ""
    for key, name in STRENGTH:
        worst = max(spread(study, K, key, "all angles, reference intact") for K in ("K_n", "K_s"))
        if worst <= 5.0:
            text += f"\n{name}: no more than {worst:.1f} %, as the paper says.\n"
            continue
        curve = study.curve(key)
        rows = []
        for f, p in curve:
            early = early_cracks(results / "study", study.points[p])
            rows.append([f"{name} x {f:g}"] + ["{} + {}, {}".format(*early.get(float(t), "---")) for t in ANGLES])
        text += (f"\n{name}: up to {worst:.0f} %, more than the paper's \"little effect\". Joints that broke before 50 % of UCS, "
                 "in tension + in shear, and bonds of the matrix, by angle (means over packings):\n\n" + table(["setting"] + [f"{t} deg" for t in ANGLES], rows))
    return text


def fig5_verdict(study, crossing):
    rows = switch_rows(study) + switch_rows(crossing)
    n = sum(r[-1] == "yes" for r in rows)

    def shift(key, t):
        curve = study.curve(key)
        return 100 * (study.at_angle("E_tangent", t, curve[-1][1]) / study.at_angle("E_tangent", t, curve[0][1]) - 1)

    changes = [[f"`{key}`"] + [f"{shift(key, t):+.0f} %" for t in (0, 45, 90)] for key in ("bedding.k_n", "bedding.k_s")]
    return (f"\n{n} of {len(rows)} curves are of the type that K_n/K_s foresees. E by the zone rule, from 0.25 to 2 times:\n\n"
            + table(["key", "0 deg", "45 deg", "90 deg"], changes))


def fig6_table(study):
    rows = [[name] + [f"{change(study, 'ucs', key, f'theta = {t} deg'):+.0f}" for t in ANGLES] for key, name in PARAMETERS]
    return table(["parameter"] + [f"{t} deg" for t in ANGLES], rows)


def open_table(choices, area):
    rows = []

    def add(name, results, point):
        rows.append([name] + [results.interval(K, "all angles, reference intact", 1e-9, 0, point) for K in ("K_n", "K_s")] +
                    [results.interval("E_tangent", "intact", 1e-9, 1, point)] +
                    [results.interval("ucs", f"theta = {t} deg" if t != "intact" else t, 1e-6, 0, point)
                     for t in (0, 30, 60, 90, "intact")])

    add("base: zone, 5 mm, dense", choices, 0)
    for p, values in choices.points.items():
        if p == 0:
            continue
        changed = next(k for k in values if values[k] != choices.points[0][k])
        value = values[changed]
        add(f"{changed[8:]} {value * 1e3:g} mm" if isinstance(value, float) else f"{value} rule", choices, p)
    add("packing by area, porosity 0.156", area, 0)
    return table(["choice", "K_n", "K_s", "E intact", "UCS 0 deg", "UCS 30 deg", "UCS 60 deg", "UCS 90 deg", "UCS intact"], rows)


def range_table(direct):
    rows = []
    for low, high in ((0.25, 1.0), (0.5, 2.0), (0.25, 2.0), (0.25, 4.0)):
        for rule in ("zone", "crossing"):
            n, s = direct_lines(direct["dense packing", rule], "intact", low, high)
            rows.append([f"{low:g} - {high:g}", rule] + [f"{n[0]:.3f}", f"{n[1]:.0f}", f"{n[2]:.5f}"] +
                        [f"{s[0]:.3f}", f"{s[1]:.0f}", f"{s[2]:.5f}"])
    return table(["factors", "rule", "K_n/k_n", "intercept", "R2", "K_s/k_s", "intercept", "R2"], rows)


def verdict_table(study, crossing, small):
    zone = {r[1][:3]: r for r in reversed(eq2_rows(study, 2.0, "")) if r[2] == "intact"}
    cross = {r[1][:3]: r for r in reversed(eq2_rows(crossing, 1.5, "")) if r[2] == "intact"}
    rows = []
    for K in ("K_n", "K_s"):
        slope, _, R2 = EQ2[K]
        mine, other = (100 * (float(r[K][3]) / slope - 1) for r in (zone, cross))
        rows.append([f"Eq. 2: {K} = {slope} k_{K[2]} + {EQ2[K][1]}, R2 {R2:.5f}",
                     "; ".join(f"{r[K][3]} k {float(r[K][4]):+.0f}, R2 {r[K][5]} ({rule})"
                               for rule, r in (("zone", zone), ("crossing", cross))), f"slope {mine:+.0f} % (zone), {other:+.0f} % (crossing)"])
    for key, name in STRENGTH:
        K_n, K_s = (spread(study, K, key, "all angles, reference intact") for K in ("K_n", "K_s"))
        early = max(spread(small, K, key, "all angles, reference intact (E_small)") for K in ("K_n", "K_s"))
        rows.append([f"{name} has little effect on K_n and K_s",
                     f"E at 50 %: K_n {K_n:.1f} %, K_s {K_s:.1f} %; small strain: {early:.1f} %",
                     "agrees" if max(K_n, K_s) <= 5 else "agrees at small strain; at 50 % of UCS joints and bridges have broken"
                     if early <= 5 else "does not agree"])
    for key, other in (("bedding.k_n", "K_s"), ("bedding.k_s", "K_n")):
        value = spread(study, other, key, "all angles, reference intact")
        rows.append([f"{other} does not depend on {key[8:]}", f"{value:.1f} % from 0.25 to 2",
                     "agrees" if value <= 5 else "agrees roughly" if value <= 10 else "does not agree"])
    cross_k_n = [r for r in switch_rows(crossing) if " k_n " in r[0]]
    zone_k_s = [r for r in switch_rows(study) if " k_s " in r[0]]
    turned = cross_k_n[0][5] == "incremental" and cross_k_n[-1][5] != "incremental"
    rows.append(["more k_n turns E(theta) from incremental to shoulder", f"crossing: {cross_k_n[0][5]} -> {cross_k_n[-1][5]}",
                 "agrees" if turned else "does not agree"])
    rows.append(["more k_s turns it from shoulder to incremental",
                 f"zone: {zone_k_s[0][5]} -> {zone_k_s[-1][5]}; K_n/K_s {zone_k_s[0][3]} -> {zone_k_s[-1][3]}, 2 at the turn",
                 "agrees" if zone_k_s[-1][5] == "incremental" else "the least E moves towards 0 degrees; the turn itself lies "
                 "just beyond twice the base"])
    return table(["the paper", "here", ""], rows)


if __name__ == "__main__":
    page(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
