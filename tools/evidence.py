#!/usr/bin/env python3
"""Writes docs/evidence.md from the stores of the studies of examples/evidence (`make evidence`).

    python3 tools/evidence.py RESULTS docs

RESULTS holds a folder per study and the outputs of `phyllite verify` as V25.txt ... V30.txt. Every number of the page that is ours is read
from them, but for a few in its prose; what others published stands in THEIRS with where it is from. A study that is not finished counts as
far as it has come, and the page says how many packings that were.
"""
import collections
import csv
import io
import math
import pathlib
import random
import sqlite3
import sys
import zlib

import measured
from results_csv import number, table
from results_csv import rows_of as all_rows_of

# Student's t, two-sided 95 %, by degrees of freedom.
T95 = [math.nan, 12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131]
PEERS = pathlib.Path(__file__).parent.parent / "bench" / "peers" / "equal.csv"  # written by `make yade`, committed
THEIRS = {"E": (70.9, "second hand"), "UCS": (199.1, "second hand"), "BTS": (44.7, "from memory"), "phi": (29.5, "from memory")}
COHESION, MU, WIDTH, HEIGHT = 5.0, 0.4, 0.010, 0.043  # of the joint and its column: examples/evidence/joint.toml


def rows_of(folder):
    """Tests that ran to their end."""
    return [r for r in all_rows_of(folder) if r["status"] in ("peaked", "knee", "not peaked", "solved")]


def statistics(values):
    """Mean, half width of its 95 % interval, number."""
    n = len(values)
    mean = sum(values) / n if n else math.nan
    if n < 2:
        return mean, math.nan, n
    sd = math.sqrt(sum((v - mean) ** 2 for v in values) / (n - 1))
    return mean, T95[min(n - 1, len(T95) - 1)] * sd / math.sqrt(n), n


def shown(values, digits):
    mean, half, n = statistics([v for v in values if isinstance(v, float) and math.isfinite(v)])
    if n == 0:
        return "not run"
    return f"{mean:.{digits}f}" + (f" +- {half:.{digits}f}" if math.isfinite(half) else "")


def grouped(rows, *keys):
    groups = collections.defaultdict(list)
    for r in rows:
        groups[tuple(r[k] for k in keys)].append(r)
    return dict(sorted(groups.items()))


def column(rows, key, scale=1.0):
    return [r[key] * scale for r in rows if isinstance(r.get(key), float)]


# --- one joint against Jaeger


def jaeger(theta, cohesion, mu, sigma_3):
    """Jaeger 1960: sigma_1 at which the plane slips, all stresses in MPa; infinite where it cannot."""
    t = math.radians(theta)
    room = (1 - mu / math.tan(t)) * math.sin(2 * t)
    return sigma_3 + 2 * (cohesion + sigma_3 * mu) / room if room > 1e-12 else math.inf


def patches(results):
    """sum(A)/L by packing and angle."""
    return {(r["packing"], r["theta"]): r["overlap_ratio"] for r in rows_of(results / "joint-patches") if r["intact"] == 0.0}


def jacket_share(discs, theta):
    """What the jacket pushes the halves with, over sigma_3 W tan(theta): its rays press on the grains that they meet first, and where the
    plane comes out between grains decides how much higher a half stands on one side than on the other."""
    t, dy = math.radians(theta), 0.25 * min(r for _, _, r in discs)
    above = [math.cos(t) * (y - 0.5 * HEIGHT) > math.sin(t) * (x - 0.5 * WIDTH) for x, y, _ in discs]
    n, extra = round(HEIGHT / dy), 0
    for k in range(n):
        height = (k + 0.5) / n * HEIGHT
        met = [(x, math.sqrt(r * r - (height - y) ** 2), i) for i, (x, y, r) in enumerate(discs) if abs(height - y) < r]
        extra += above[min(met, key=lambda m: m[0] - m[1])[2]] - above[max(met, key=lambda m: m[0] + m[1])[2]]
    return abs(extra) * HEIGHT / n / (WIDTH * math.tan(t))


def jacket_shares(results):
    """By packing and angle; empty where `phyllite specimen` has not written the packings."""
    out = {}
    for folder in sorted(results.glob("joint-packing-*/")):
        lines = [line for line in open(folder / "discs.csv") if not line.startswith("#")][1:]
        discs = [tuple(map(float, line.split(","))) for line in lines]
        for theta in (30.0, 45.0, 60.0, 75.0):
            out[float(folder.name.split("-")[-1]), theta] = jacket_share(discs, theta)
    return out


def against_jaeger(rows, overlap, cohesion, *keys, jacket=None):
    """sigma_1 over Jaeger's, in lists by theta and `keys`; `jacket`: shares of sigma_3 that count."""
    ratios = collections.defaultdict(list)
    for r in rows:
        if r["intact"] == 1.0 or not isinstance(r["sigma_1"], float):
            continue
        place = (r["packing"], r["theta"])
        sigma_3 = r["sigma_3"] * 1e-6 * (jacket.get(place, math.nan) if jacket else 1.0)
        expected = jaeger(r["theta"], cohesion * overlap.get(place, math.nan), MU, sigma_3)
        if math.isfinite(expected):
            ratios[tuple(r[k] for k in keys) + (r["theta"],)].append(r["sigma_1"] * 1e-6 / expected)
    return dict(sorted(ratios.items()))


def ratio_table(ratios, name):
    """A row per first key, a column per angle."""
    angles = sorted({k[-1] for k in ratios})
    rows = [[f"{name(first)}"] + [shown(ratios.get((first, a), []), 3) for a in angles] for first in sorted({k[0] for k in ratios})]
    return table(["sigma_1 over Jaeger's"] + [f"{a:g} deg" for a in angles], rows)


def history_of(folder, row):
    """The history in the store, units cut off the head."""
    db = sqlite3.connect(folder / "study.sqlite")
    blob = db.execute("SELECT history FROM specimen WHERE key = ?", (row["key"],)).fetchone()[0]
    lines = csv.DictReader(io.StringIO(zlib.decompress(blob).decode()))
    return [{k.split(" [")[0]: float(v) for k, v in line.items()} for line in lines]


def early_slip(folder, row):
    """Work of friction over that of the boundary at half of the strength."""
    half = next(h for h in history_of(folder, row) if h["deviatoric_stress"] >= 0.5 * row["q_max"])
    return half["slip"] / half["boundary_work"]


def while_sliding(folder, rows):
    """The rows with sigma_1 replaced by the mean axial stress over the second half of the test's strain."""
    out = []
    for r in rows:
        history = history_of(folder, r)
        late = [h["axial_stress"] for h in history if h["axial_strain"] >= 0.5 * history[-1]["axial_strain"]]
        out.append({**r, "sigma_1": sum(late) / len(late), "sigma_3": r["test.confining_stress"]})
    return out


def sliding_joints(results):
    rows = [r for r in rows_of(results / "joint-frictional") if r["intact"] == 0.0 and r["theta"] > 15.0]
    return while_sliding(results / "joint-frictional", rows)


def held_by_friction(results):
    """Rows of the table at 15 degrees: strength over that of the intact rock of the same packing, and early friction."""
    folder = results / "joint-frictional"
    rows = rows_of(folder)
    intact = {(r["packing"], r["test.confining_stress"]): r for r in rows if r["intact"] == 1.0}
    out = []
    for (stress,), group in grouped([r for r in rows if r["theta"] == 15.0 and r["intact"] == 0.0], "test.confining_stress").items():
        ratios, slips, own = [], [], []
        for r in group:
            twin = intact.get((r["packing"], stress))
            if twin:
                ratios.append(r["sigma_1"] / twin["sigma_1"])
                own.append(early_slip(folder, twin))
            slips.append(early_slip(folder, r))
        out.append([f"{stress * 1e-6:g} MPa", shown(ratios, 3), shown(slips, 4), shown(own, 4)])
    return out


def joint_section(results):
    overlap, jacket = patches(results), jacket_shares(results)
    bonded, soft, sliding = rows_of(results / "joint-bonded"), rows_of(results / "joint-stiffness"), sliding_joints(results)
    none, key = dict.fromkeys(overlap, 0.0), "test.confining_stress"

    def rows(kind, tests, patch, cohesion):
        both = {"sigma_3": None, "sigma_3 as the halves get it": jacket}
        return "".join("\n" + ratio_table(against_jaeger(tests, patch, cohesion, key, jacket=share),
                                          lambda s, n=name: f"{kind}, {s * 1e-6:g} MPa, {n}") for name, share in both.items())

    text = JOINT + rows("bonded", bonded, overlap, COHESION) + rows("frictional, mean while it slides", sliding, none, 0.0)
    text += "\n" + ratio_table(against_jaeger(rows_of(results / "joint-frictional"), none, 0.0, key),
                               lambda s: f"frictional, {s * 1e-6:g} MPa, largest stress, sigma_3")
    intact = [r for r in bonded if r["intact"] == 1.0]
    text += JOINT_FRICTION.format(shown(list(jacket.values()), 3), f"{min(jacket.values(), default=math.nan):.2f}",
                                  f"{max(jacket.values(), default=math.nan):.2f}")
    text += JOINT_15.format(shown(column(intact, "sigma_1", 1e-6), 0), shown(list(overlap.values()), 3)) + table(
        ["confining stress", "sigma_1 at 15 deg over that of the intact rock", "friction over boundary work at half of the strength", "of the intact rock"],
        held_by_friction(results))
    softer = against_jaeger(soft, overlap, COHESION, "matrix.E_c", jacket=jacket)
    stiff = against_jaeger([r for r in bonded if r[key] == 1e7], overlap, COHESION, key, jacket=jacket)
    softer.update({(1e12,) + k[1:]: v for k, v in stiff.items()})
    table_1 = {k: v for k, v in softer.items() if k[0] == 38e9}
    return text + JOINT_SOFT.format(worst(table_1)) + ratio_table(softer, lambda E: f"E_c = E_b = {E * 1e-9:g} GPa, sigma_3 as the halves get it"), softer


# --- Lac du Bonnet granite


def readings(rows):
    """E [GPa] and nu of every way to read a test, in lists over packings: plane stress as the discs show them, plane strain as the body
    whose plane-strain test shows them (theory/transverse_isotropy.hpp): nu = nu_2D/(1 + nu_2D), E = E_2D (1 - nu^2)."""
    out = {}
    for place, suffix in (("platens", "_platen"), ("gauge", "")):
        for kind in ("secant", "tangent"):
            pairs = [(r["E_" + kind + suffix] * 1e-9, r["nu" + suffix]) for r in rows
                     if isinstance(r["E_" + kind + suffix], float) and isinstance(r["nu" + suffix], float)]
            out[place, kind, "plane stress"] = pairs
            out[place, kind, "plane strain"] = [(E * (1 - (n / (1 + n)) ** 2), n / (1 + n)) for E, n in pairs]
    return out


def friction_angles(ucs, confined):
    """Mohr-Coulomb through UCS and the strength at 10 MPa of the same packing [deg]."""
    base = {r["packing"]: r["ucs"] for r in ucs}
    out = []
    for r in confined:
        if r["packing"] in base:
            slope = (r["sigma_1"] - base[r["packing"]]) / r["sigma_3"]
            out.append(math.degrees(math.asin((slope - 1) / (slope + 1))))
    return out


def granite_numbers(results):
    """By bond gap: rows of UCS, BTS and confined tests."""
    out = {}
    for kind in ("ucs", "bts", "jaws", "confined"):
        for (gap,), rows in grouped(rows_of(results / f"lac-du-bonnet-{kind}"), "matrix.bond_gap").items():
            out.setdefault(gap, {})[kind] = rows
    return dict(sorted(out.items(), reverse=True))


def gap_text(gap):
    """A bond gap [m]; without one discs have to touch."""
    return f"{gap * 1e6:g} um" if gap > 0 else "0: touching"


def theirs(name):
    value, source = THEIRS[name]
    return f"{value} ({source})"


def within(value, values):
    mean, half, _ = statistics(values)
    return abs(value - mean) <= half


def matches(numbers):
    """How many readings have their E within the interval, by plane; at which gaps of the bonds UCS has; which readings have both."""
    hits, all_, gaps, both = collections.Counter(), collections.Counter(), [], []
    for gap, tests in numbers.items():
        rows = tests.get("ucs", [])
        strong = within(THEIRS["UCS"][0], column(rows, "ucs", 1e-6))
        gaps += [gap_text(gap)] * strong
        for reading, pairs in readings(rows).items():
            hit = within(THEIRS["E"][0], [p[0] for p in pairs])
            all_[reading[2]] += 1
            hits[reading[2]] += hit
            both += [" ".join(reading)] * (hit and strong)
    return GRANITE_MATCH.format(hits["plane strain"], all_["plane strain"], hits["plane stress"], all_["plane stress"],
                                ", ".join(gaps) or "none", "; ".join(both) or "no reading")


def granite_section(results):
    numbers = granite_numbers(results)
    rows = []
    for gap, tests in numbers.items():
        for (place, kind, plane), pairs in readings(tests.get("ucs", [])).items():
            rows.append([gap_text(gap), place, kind, plane, shown([p[0] for p in pairs], 1), shown([p[1] for p in pairs], 3), len(pairs)])
    text = GRANITE + table(["bonds at gaps up to", "strains of", "E", "plane", "E [GPa]", "nu", "packings"], rows)
    text += f"\nTheirs: E {THEIRS['E'][0]} GPa ({THEIRS['E'][1]}).\n\n"
    rows = []
    for gap, tests in numbers.items():
        ucs, bts, jaws, confined = (tests.get(k, []) for k in ("ucs", "bts", "jaws", "confined"))
        rows.append([gap_text(gap), shown(column(ucs, "ucs", 1e-6), 1), shown(column(ucs, "sigma_ci", 1e-6), 1), shown(column(bts, "bts", 1e-6), 1),
                     shown(column(jaws, "bts", 1e-6), 1), shown(friction_angles(ucs, confined), 1),
                     f"{len(ucs)}, {len(bts)}, {len(jaws)}, {len(confined)}"])
    rows.append(["theirs", theirs("UCS"), "not known here", theirs("BTS"), theirs("BTS"), theirs("phi"), ""])
    return text + table(["bonds at gaps up to", "UCS [MPa]", "sigma_ci [MPa]", "BTS, flat platens [MPa]", "BTS, jaws of 10 deg [MPa]",
                         "friction angle 0 - 10 MPa [deg]", "packings: UCS, BTS, jaws, confined"], rows) + matches(numbers) + GRANITE_END, numbers


# --- convergence


EXACT = 1e-7  # relative; scatter below it is rounding
ORDERS = [0.25 + 0.05 * k for k in range(76)]


def extrapolated(points):
    """y = y_0 + c h^p by weighted least squares, p one of ORDERS: y_0, c, p and the sum of squares. points: [(h, y, standard error)]."""
    best = None
    for p in ORDERS:
        w, x, y = [e ** -2 for *_, e in points], [h ** p for h, *_ in points], [v for _, v, _ in points]
        total = sum(w)
        mx, my = sum(a * b for a, b in zip(w, x)) / total, sum(a * b for a, b in zip(w, y)) / total
        c = sum(k * (a - mx) * (b - my) for k, a, b in zip(w, x, y)) / sum(k * (a - mx) ** 2 for k, a in zip(w, x))
        rest = sum(k * (b - my - c * (a - mx)) ** 2 for k, a, b in zip(w, x, y))
        if best is None or rest < best[3]:
            best = (my - c * mx, c, p, rest)
    return best


def constant(points):
    """Weighted mean, its standard error and the sum of squares."""
    total = sum(e ** -2 for *_, e in points)
    mean = sum(v * e ** -2 for _, v, e in points) / total
    return mean, total ** -0.5, sum(((v - mean) / e) ** 2 for _, v, e in points)


def trend(points, default, digits, paired):
    """Cells: order, limit, the default over the limit, each with its 95 % interval from 400 draws of the means. A trend is one that lowers the
    sum of squares by more than 5.99 (chi-square, two numbers more, 5 %). Without one the limit is the mean of all, and none of ratios; with a p at
    its bound there is none."""
    if not points:
        return ["-", "-", "-"]
    y, c, p, rest = extrapolated(points)
    mean, error, all_rest = constant(points)
    if all_rest - rest <= 5.99:
        return ["none seen", "-" if paired else f"{mean:.{digits}f} +- {1.96 * error:.{digits}f}", "-"]
    if p in (ORDERS[0], ORDERS[-1]):
        return [f"{p:g}, a bound", "not found", "-"]
    chance = random.Random(1)
    draws = [extrapolated([(h, chance.gauss(v, e), e) for h, v, e in points]) for _ in range(400)]
    far = lambda fit: 100 * fit[1] * default ** fit[2] / fit[0]
    span = lambda values: (sorted(values)[10], sorted(values)[-11])
    order, limit, off = span([f[2] for f in draws]), span([f[0] for f in draws]), span([far(f) for f in draws])
    fine = 2 if paired else 1
    return [f"{p:.1f} ({order[0]:.1f} to {order[1]:.1f})", f"{y:.{digits}f} ({limit[0]:.{digits}f} to {limit[1]:.{digits}f})",
            f"{far((y, c, p)):+.{fine}f} ({off[0]:+.{fine}f} to {off[1]:+.{fine}f}) %"]


def line(points):
    """Intercept and slope by weighted least squares. points: [(x, y, weight)]."""
    total = sum(w for *_, w in points)
    mx, my = sum(w * x for x, _, w in points) / total, sum(w * y for _, y, w in points) / total
    slope = sum(w * (x - mx) * (y - my) for x, y, w in points) / sum(w * (x - mx) ** 2 for x, _, w in points)
    return my - slope * mx, slope


def spread(values):
    """Standard deviation over packings, over their mean."""
    mean = sum(values) / len(values)
    return math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1)) / mean


def scatter_law(groups, quantity, h):
    """SD over mean = a h^q through the settings that show a scatter over three packings or more, each with the weight of its degrees of freedom:
    log a, q. None where these settings are less than three."""
    known = [(math.log(h(k[0])), math.log(spread(v)), len(v) - 1.0) for k, g in groups.items()
             if len(v := column(g, quantity)) > 2 and spread(v) > EXACT]
    return line(known) if len(known) > 2 else None


def means(groups, quantity, scale, h):
    """[(h, mean, standard error)]; the scatter is that of the law, which knows it where there are few packings. The finest of ratios is exact."""
    law, points = scatter_law(groups, quantity, h), []
    for k, g in groups.items() if law else ():
        v = column(g, quantity, scale)
        mean = sum(v) / len(v)
        exact = len(v) > 2 and spread(v) <= EXACT
        points.append((h(k[0]), mean, mean * (EXACT if exact else math.exp(law[0]) * h(k[0]) ** law[1] / math.sqrt(len(v)))))
    return points


def over_finest(rows, key, quantities):
    """The rows with every quantity over that of the same packing at the finest setting, as far as there is one."""
    finest = {r["packing"]: r for r in rows if r[key] == min(q[key] for q in rows)}
    names = [q[0] for q in quantities]
    return [{**r, **{n: r[n] / finest[r["packing"]][n] for n in names if isinstance(r[n], float)}} for r in rows if r["packing"] in finest]


def convergence(folders, key, h, quantities, name, default, paired=False):
    """Table of studies over one parameter: means over packings, fitted order, limit, and how far the default lies from it. Paired: over the
    value of the same packing at the finest setting."""
    rows = [r for f in folders for r in rows_of(f)]
    if paired and rows:
        rows = over_finest(rows, key, quantities)
        quantities = [(n, 1.0, 4, "of the finest") for n, *_ in quantities]
    groups = grouped(rows, key)
    if not groups:
        return "not run\n"
    rows = []
    for quantity, scale, digits, unit in quantities:
        cells = [shown(column(g, quantity, scale), digits) for g in groups.values()]
        rows.append([f"{quantity} [{unit}]"] + cells + trend(means(groups, quantity, scale, h), h(default), digits, paired))
    rows.append(["packings"] + [len(g) for g in groups.values()] + ["", "", ""])
    return table(["over " + name] + [f"{k[0]:g}" for k in groups] + ["order", "limit", "default over limit"], rows)


def scatter_table(folders, quantities):
    """Standard deviation over packings in per cent, by number of grains, and the power of that number by which it falls."""
    groups = grouped([r for f in folders for r in rows_of(f)], "packing.n_grains")
    groups = {k: g for k, g in groups.items() if len(g) > 2}
    rows = []
    for quantity, *_ in quantities:
        row = [quantity] + [f"{100 * spread(column(g, quantity)):.1f}" for g in groups.values()]
        law = scatter_law(groups, quantity, float)
        rows.append(row + [f"N^{law[1]:.2f}" if law else "-"])
    return table(["SD over packings [%]"] + [f"{k[0]:g} grains" for k in groups] + ["falls as"], rows) if groups else "not run\n"


UNIAXIAL = [("E_tangent", 1e-9, 1, "GPa"), ("ucs", 1e-6, 1, "MPa"), ("sigma_ci", 1e-6, 1, "MPa")]
BRAZILIAN = [("bts", 1e-6, 2, "MPa")]


def fast_table(results):
    """The large specimens at the strain rate of the small ones, over themselves at 0.057 m/s; packing 1."""
    slow = {r["packing.n_grains"]: r for name in ("resolution-ucs-large", "resolution-ucs-largest") for r in rows_of(results / name) if r["packing"] == 1.0}
    rows = [(r, slow[r["packing.n_grains"]]) for r in rows_of(results / "resolution-fast") if r["packing.n_grains"] in slow]
    return table(["grains", "platen speed [m/s]"] + [f"{q[0]} over that at 0.057 m/s" for q in UNIAXIAL],
                 [[f"{r['packing.n_grains']:g}", f"{r['test.platen_speed']:g}"] + [f"{100 * (r[q[0]] / s[q[0]] - 1):+.1f} %" for q in UNIAXIAL] for r, s in rows])


def convergence_section(results):
    root = lambda n: n ** -0.5
    study = lambda *names: [results / n for n in names]
    ucs, bts = study("resolution-ucs", "resolution-ucs-large", "resolution-ucs-largest"), study("resolution-bts", "resolution-bts-large")
    text = CONVERGENCE + convergence(ucs, "packing.n_grains", root, UNIAXIAL, "grains", 7481.0)
    text += "\n" + scatter_table(ucs, UNIAXIAL)
    text += "\n" + fast_table(results)
    text += "\n" + convergence(bts, "packing.n_grains", root, BRAZILIAN, "grains of the square", 3740.0)
    text += "\n" + scatter_table(bts, BRAZILIAN)
    text += "\n" + convergence(study("speed"), "test.platen_speed", float, UNIAXIAL, "platen speed [m/s]", 0.02, paired=True)
    text += "\n" + convergence(study("time-step"), "engine.step_safety", float, UNIAXIAL, "step over the stable one", 0.92, paired=True)
    return text + CONVERGENCE_END


# --- closed forms of whole bodies


def verified(results, case):
    """[(what, expected, measured)] of an output of `phyllite verify`."""
    out = []
    for line in (results / f"{case}.txt").read_text().splitlines():
        words = line.split()
        if "expected" in words and "measured" in words:
            what = line.split("tolerance", 1)[1].split(None, 1)[1]
            out.append((what, float(words[words.index("expected") + 1]), float(words[words.index("measured") + 1])))
    return out


def bodies_rows(results):
    disc = verified(results, "V25")
    part = lambda word: [m for what, _, m in disc if word in what]
    span = lambda v: f"{100 * (min(v) - 1):+.1f} to {100 * (max(v) - 1):+.1f} %"
    shear = max(abs(m) for what, e, m in disc if e == 0.0)
    packings = verified(results, "V29")
    mean = lambda word: [m for what, _, m in packings if word in what and "mean of" in what and "half" not in what]
    half = lambda word: max(m for what, _, m in packings if word in what and "half" in what)
    number_of = packings[0][0].split("mean of ")[1].split()[0]
    energy = [m / e for _, e, m in verified(results, "V26")]
    column_ = [m / e for _, e, m in verified(results, "V27")]
    waves = verified(results, "V28")
    wave = lambda word: "; ".join(f"{what.split('wavelength ')[1].split(':')[0]}: {100 * (m / e - 1):+.2f} %" for what, e, m in waves if word in what)
    return [
        ["layered disc, five angles: tension across the load in the middle", "closed form, series after Lekhnitskii", "0", span(part("tension")),
         "goal 3 %", "verify V25"],
        ["the same: compression; shear over compression", "the same", "0; 0", f"{span(part('compression along'))}; {shear:.4f}", "goal 3 %", "verify V25"],
        [f"random bedded packings, the same angles: tension, mean of {number_of} packings", "the same", "0", span(mean("tension")),
         f"+- {100 * half('tension'):.1f} % at most; goal 3 %", "verify V29"],
        ["the same: compression; shear over compression", "the same", "0; 0",
         f"{span(mean('compression along'))}; {max(map(abs, mean('shear'))):.3f}",
         f"+- {100 * half('compression along'):.1f} %; +- {half('shear'):.3f} at most", "verify V29"],
        ["cracked plate: dU/da over K_I^2/E, three lengths", "Irwin 1957", "1", span(energy), "goal 3 %", "verify V26"],
        ["bonded joint at 45, 60 deg, 5 MPa, one packing of 730 discs (short form of the joint)", "Jaeger 1960", "1", span(column_), "goal 5 %",
         "verify V27"],
        ["wave across the layers", "long-wave limit", "0", wave("across"), "goal 1 %", "verify V28"],
        ["wave along the layers", "long-wave limit", "0", wave("along"), "goal 1 %", "verify V28"]]


# --- Yade


def yade_ratios(recorded):
    """Yade over Phyllite - 1, lists over bond seeds, by (case, variant) and quantity; from bench/peers/equal.csv."""
    rows = [{k: number(v) for k, v in row.items()} for row in csv.DictReader(open(recorded))] if recorded.exists() else []
    ours = {(r["case"], r["bond_seed"]): r for r in rows if r["program"] == "Phyllite"}
    out = {}
    for r in rows:
        mine = ours.get((r["case"], r["bond_seed"]))
        if r["program"] == "Phyllite" or mine is None:
            continue
        group = out.setdefault((r["case"], r["program"].removeprefix("Yade ")), collections.defaultdict(list))
        for quantity in YADE_QUANTITIES:
            group[quantity].append(r[quantity] / mine[quantity] - 1)
    return out


YADE_QUANTITIES = ["E_secant [GPa]", "first crack [MPa]", "UCS [MPa]", "peak strain [%]"]
YADE_WORDS = {"equal": "equal laws", "no_turning": "joints that do not feel how grains turn, as Yade has them",
              "no_new_joints": "pairs of two layers that meet later as ordinary contacts, as Yade has them",
              "one_spring": "JCFpm as it comes: one spring, its friction from the start, no moments",
              "no_bending": "bonds without bending stiffness", "friction": "bonds whose shear strength grows with friction"}


def per_cent(values):
    mean, half, _ = statistics([100 * v for v in values])
    return f"{mean:+.2f}" + (f" +- {half:.2f} %" if math.isfinite(half) else " %")


def yade_section(recorded):
    ratios = yade_ratios(recorded)
    head = ["specimen", "Yade with"] + [q.split(" [")[0].replace("E_secant", "E") for q in YADE_QUANTITIES] + ["bond seeds"]
    rows = [[case, YADE_WORDS[variant]] + [per_cent(group[q]) for q in YADE_QUANTITIES] + [len(group["UCS [MPa]"])]
            for (case, variant), group in ratios.items()]
    return YADE + table(head, rows) + YADE_END


def yade_rows(recorded):
    rows = []
    for case, name in (("matrix", "the same discs and bonds in Yade, laws made equal, no bedding"), ("bedded", "the same with smooth joints at 60 deg")):
        group = yade_ratios(recorded).get((case, "equal"))
        if group:
            rows.append([f"{name}: E; first crack; UCS", "Yade 2023.02a, run here", "0; 0; 0", "; ".join(per_cent(group[q]) for q in YADE_QUANTITIES[:3]),
                         f"{len(group['UCS [MPa]'])} bond seeds; goal 1; 3; 5 %", "make yade"])
    return rows


# --- the page


def worst(ratios):
    means = [statistics(v)[0] for v in ratios.values() if v]
    return f"{100 * (min(means) - 1):+.1f} to {100 * (max(means) - 1):+.1f} %" if means else "not run"


def widest(ratios):
    halves = [statistics(v)[1] for v in ratios.values() if len(v) > 1]
    return f"+- {100 * max(halves):.1f} % at most, {max(len(v) for v in ratios.values())} packings" if halves else "-"


def summary(results, numbers, softer):
    overlap = patches(results)
    jacket, key, none = jacket_shares(results), "test.confining_stress", dict.fromkeys(overlap, 0.0)
    tests, sliding = rows_of(results / "joint-bonded"), sliding_joints(results)
    bonded, bonded_got = (against_jaeger(tests, overlap, COHESION, key, jacket=j) for j in (None, jacket))
    frictional, frictional_got = (against_jaeger(sliding, none, 0.0, key, jacket=j) for j in (None, jacket))
    base = {k: v for k, v in softer.items() if k[0] == 38e9}
    rows = [["bonded joint through stiff rock, 30 - 75 deg, 0, 5, 10 MPa", "Jaeger 1960", "0", worst(bonded), widest(bonded), "study joint-bonded"],
            ["the same, with sigma_3 as the halves get it", "Jaeger 1960", "0", worst(bonded_got), widest(bonded_got), "study joint-bonded"],
            ["frictional joint while it slides, 30 - 75 deg, 5, 10 MPa", "Jaeger 1960", "0", worst(frictional), widest(frictional), "study joint-frictional"],
            ["the same, with sigma_3 as the halves get it", "Jaeger 1960", "0", worst(frictional_got), widest(frictional_got), "study joint-frictional"],
            ["bonded joint through rock of Table 1, 10 MPa, with sigma_3 as the halves get it", "Jaeger 1960", "0", worst(base), widest(base), "study joint-stiffness"]]
    near = numbers.get(1e-3, {})
    body = readings(near.get("ucs", []))
    pairs = body["platens", "secant", "plane strain"]
    source = "Potyondy & Cundall 2004, PFC2D"
    tests = {kind: near.get(kind, []) for kind in ("ucs", "bts", "jaws", "confined")}
    granite = lambda claim, number, ours, kind: [claim, source, number, ours, f"{len(tests[kind])} packings", f"study lac-du-bonnet-{kind}"]
    rows += [granite("Lac du Bonnet granite: E [GPa], platens, secant, plane strain, near contacts bonded", theirs("E"),
                     shown([p[0] for p in pairs], 1), "ucs"),
             granite("the same: nu", "not known here", shown([p[1] for p in pairs], 3), "ucs"),
             granite("the same: UCS [MPa]", theirs("UCS"), shown(column(tests["ucs"], "ucs", 1e-6), 1), "ucs"),
             granite("the same: BTS between flat platens [MPa]", theirs("BTS"), shown(column(tests["bts"], "bts", 1e-6), 1), "bts"),
             granite("the same: BTS between jaws of 10 deg [MPa]", theirs("BTS"), shown(column(tests["jaws"], "bts", 1e-6), 1), "jaws"),
             granite("the same: friction angle [deg]", theirs("phi"), shown(friction_angles(tests["ucs"], tests["confined"]), 1), "confined")]
    short = verified(results, "V30")
    rows.append(["the same at half its size, two packings (short form): E [GPa]; UCS [MPa]", source, f"{theirs('E')}; {theirs('UCS')}",
                 f"{short[0][2] * 1e-9:.1f}; {short[1][2] * 1e-6:.0f}", "goal 4; 12 %, two standard errors", "verify V30"])
    return table(["claim", "source", "theirs", "ours (deviation where theirs is 0 or 1)", "interval", "repeat"], rows + bodies_rows(results) + yade_rows(PEERS))


def measured_rows(numbers):
    """Rows of measured/laboratory.csv: the granite, by the reading at the top of the page."""
    near = numbers[1e-3]
    E = [p[0] for p in readings(near["ucs"])["platens", "secant", "plane strain"]]
    for claim, values, unit in (("E, paper 70.9 GPa", E, "GPa"), ("UCS, paper 199.1 MPa", column(near["ucs"], "ucs", 1e-6), "MPa"),
                                ("BTS, paper 44.7 MPa", column(near["jaws"], "bts", 1e-6), "MPa"),
                                ("friction angle, paper 29.5 deg", friction_angles(near["ucs"], near["confined"]), "deg")):
        value, _, interval = shown(values, 1).partition(" +- ")
        yield measured.row(f"Lac du Bonnet: {claim}", value, unit, f"+- {interval}" if interval else "", f"{len(values)} packings")


def page(results, docs):
    joint, softer = joint_section(results)
    granite, numbers = granite_section(results)
    measured.add("laboratory", measured_rows(numbers), "make evidence")
    (docs / "evidence.md").write_text(HEAD + summary(results, numbers, softer) + joint + granite + BODIES + yade_section(PEERS) + convergence_section(results) + OPEN)


HEAD = """# Evidence

Written by `make evidence` from the stores of the studies in `examples/evidence` (an hour of CPU, resumed where they are). Numbers that nobody
here made stand beside ours: exact solutions of whole bodies, and published results. A single study is
`phyllite study examples/evidence/NAME.toml --out results/evidence/NAME`. "verify V25" is `phyllite verify V25`, seconds, and a test.
+- is the 95 % interval of the mean over packings (Student's t).

Two marks stand where the paper's own table has not been read. **Second hand**: as somebody else quotes it (who, below). **From memory**: do
not cite it from here. Not run at all: PFC2D itself, and a published 50 x 100 mm specimen (see the end).

"""
JOINT = """
## One joint through a column: Jaeger's plane of weakness

A column of 10 x 43 mm, 1,120 discs, has a single plane through its centre that meets no platen. It has the crossing rule, and
smooth joints with k_n, k_s and mu of the paper's Table 2, c = 5 MPa and tan(phi) = mu. Its sides lie in a jacket, so that the halves may slide. Jaeger's
c_w is c sum(A)/L of each specimen (`joint-patches`), nothing fitted. Mas Ivars et al. 2011 (IJRMMS 48:219-244) compare single smooth joints
with the same theory, as cited elsewhere. Their numbers were looked for and not found.

Jaeger takes the plane to fail everywhere at once. Bonded joints do not: each carries what its grains bring, and the first to break sheds its cohesion
on the others. So the rock here is 26 times as stiff as in Table 1, and all joints carry nearly the same stress. Below is softer rock.
Double precision: in single precision the rounding of forces makes local damping drag the sliding halves, by up to 5 % of the strength.

"""
JOINT_FRICTION = """
Goal: 5 %. The bonded joint misses it at 75 degrees and 10 MPa, by -6.0 %. The frictional one misses it at 45 and 75 degrees, by -5.6 %. A miss that grows with sigma_3 has a measured cause: the jacket presses on grains.
A half stands higher on one side than on the other, by less than W tan(theta): {0} of it in the mean. One column of 15 grains has {1} to {2}. This was counted on the discs, before any test.

A joint without bonds does not break, it sticks and slips: its stress swings about a level. The level is the strength; the program calls the largest stress of a swing the peak.
With the right sigma_3 the sliding level lies 0 to 5 % above Jaeger's. The reason was not traced; local damping of halves that slide by fits and starts is suspected.
"""
JOINT_15 = """
The intact stiff rock fails at {0} MPa, so Jaeger lies well below it at every angle here. The mean sum(A)/L over angles and
packings is {1}. At 15 degrees tan(theta) < mu: the joint must hold by friction, and only the rock can fail. Without bonds, in the rock of Table 1:

"""
JOINT_SOFT = """
The work of friction at half of the strength belongs to the grains' contacts beside their bonds, no more than in the intact rock: the joint does not
slip. In rock of Table 1 the joints break one after the other, and the strength is off Jaeger's by {}. It comes to Jaeger's as
the grains stop to yield. The bonded joint at 10 MPa by the stiffness of the rock, k_s d/(E_c + E_b), d being the mean diameter:

"""
GRANITE = """
## Lac du Bonnet granite (Potyondy & Cundall 2004, IJRMMS 41:1329-1364)

Looked up: the paper's abstract (micro-parameters, and two- and three-dimensional biaxial, triaxial and Brazilian tests) and quotations by
others. Its tables could not be opened. E 70.9 GPa and UCS 199.1 MPa are **second hand**: a benchmark of the code DIRT
(github.com/SueHeir/dirt, its bench_potyondy_cundall_bpm) quotes them as PFC2D's of the paper's Table 2. All else is **from memory**:

| | |
|---|---|
| specimen | 31.7 x 63.4 mm, mean diameter 0.72 mm, radius ratio 1.66, porosity 0.16, 0.1 MPa isotropic |
| stiffness | E_c = E_b = 62 GPa, k_n/k_s = 2.5, mu = 0.5 |
| strengths | sigma_c = tau_c = 157 +- 36 MPa |
| results | BTS 44.7 MPa, friction angle 29.5 degrees |

Ours: some 4,040 discs, single precision, 0.05 m/s per platen, affine pre-strain to 5e-4.

All readings of the same tests. Plane strain: the body whose plane-strain test shows E_2D and nu_2D.

"""
GRANITE_MATCH = """
E lies within the interval of {} of {} readings in plane strain. In plane stress it lies in {} of {}. UCS lies within the interval of bonds at gaps up to {}. Both have: {}.
"""
GRANITE_END = """So the numbers tell plane strain from plane stress, near contacts bonded from touching ones alone, and with these secant from tangent, but not platens from
gauges. The reading at the top of this page was chosen with the numbers of earlier packings known; ten leave it where it was. One reading
fits both numbers; this does not show that the paper took it. The friction angle agrees with the remembered one. BTS does not: between flat platens a few grains
at the rim break first, and the test ends with the first fall by a fifth. Between jaws it is nearer. Why PFC2D had more is not known here: its jaws, bonds and
stop were not found.
"""
BODIES = """
## Whole elastic bodies

The layered body is a hexagonal lattice with a smooth joint after every second row, or a random packing with joints of Table 2 across planes
two mean diameters apart. Its compliance is measured on the body itself by uniform gradients,
so that the field is compared and not a modulus. The disc of lattice is 75 grains across and is pressed in five directions; stress
is the mean over the middle D/8. Theory: `src/theory/anisotropic_disc.hpp`, a series derived anew. It agrees with Hondros where it is isotropic, and
within 6 % with the approximation in the abstract of Claesson & Bohloli (2002), once its lost minus sign is put back.

The disc of whole grains has an area 1.2 % smaller than the circle that it was cut by, which is 1.2 % of the stress. The random packings turn the layers and keep the load.
In a single one the tension has a standard deviation of 1 to 3 %. With planes 2 mm and 4 mm apart the means lay within 3 %. These are not among the checks,
as a homogeneous disc has no spacing.

The plate (90 x 100 grains) is pulled, its crack cut through the bonds. K_I is read from the movements around its end, G from the energies of cracks that are eight grain radii apart.
Waves stand in free columns with a joint after every fourth row. A beam in bending is V5. Numbers: the table at the top, or docs/verification.md.
"""
YADE = """
## Yade with the same laws

400 discs of the paper's rock, bonds without moment contribution, fast platens. They are intact, or have smooth joints at 60
degrees (zone rule, tan(phi) = mu). Yade (Debian, 2023.02a) gets the same discs, masses, bonds with their strengths, joints, platens,
ramp, time step and local damping, contact by contact.

It has no law like ours, only its parts. A disc is a clump of two spheres of
one centre. One has the springs and Coulomb's friction of JCFpm, the other the bond of CohFrict and its bending stiffness. A joint is JCFpm's. That joint does not
feel that its grains turn, and pairs of two layers that meet during the test are ordinary contacts to it. Python adds both
(`bench/peers/yade_equal.py`). One code reads both curves every 100 steps: E is the secant at half of the strength. Yade over
Phyllite - 1, mean over bond seeds, each against itself (`bench/peers/equal.csv`, written by `make yade`):

"""
YADE_END = """
The goals are met in the mean: E 1 %, first crack 3 %, strength 5 %. With bedding the interval of the first crack reaches to -3.9 %. A single specimen is off by up to 2.6 %, after the first cracks.
Rows of one bond seed take one thing away and show its weight; they are no part of the comparison. Two things still differ by design.
A bond that breaks in shear is taken away up to four steps late, and joints of pairs that meet later are laid every 16 steps.
"""
CONVERGENCE = """
## Convergence

The paper's rock without bedding: the grains stay as they are, the specimen grows from 7.6 x 15.2 to 152 x 304 mm. Compression runs at one strain rate up
to 9,576 discs, above that at 0.057 m/s per platen. At the strain rate of the small ones large specimens ring, as the third table shows. The Brazilian test
runs at 0.02 m/s.

The fit is y = y_0 + c h^p by least squares over the means, each weighted by its standard error.
Here p lies between 0.25 and 4, and h is grains^-1/2, speed or step.
Standard errors come from the power law of the scatter, as one packing has none of its own. In
brackets: 95 % of 400 draws of the means. "None seen": the trend lowers the sum of squares by no more than chance would (chi-square, 5 %); the limit is then
the mean of all. Where p ends at a bound no limit is found. Speed and step compare each packing with itself at the finest. The default of resolution is the default recipe's, 7,481 discs.

"""
CONVERGENCE_END = """
E and UCS show no trend from 299 to 119,700 discs; small specimens lack certainty only. sigma_ci, read at 1 % of the cracks of the peak, comes down to a
limit from which the default recipe is less than 2 % away. BTS falls with the size of the disc, from 36 to 23 MPa, and shows no end: a BTS of this
rock belongs to the size of its disc. Platens that keep the strain rate of small specimens raise E, UCS and sigma_ci of large ones. Whether
0.057 m/s is slow enough for the two largest was not tested; their sigma_ci lies above the two before. The step moves one strength of five: packing 2
takes another path at the usual step, with 6 % more UCS. The others move by up to 1.5 % over all four steps. Platens at 0.16 m/s add 4 +- 7 % to UCS.
"""
OPEN = """
## What is open

- **PFC2D itself**: not run. `phyllite export pfc2d` writes the files (docs/formats.md). Whoever has the program is asked to run them.
- **Bu 2021** (Sci. Rep., `10.1038/s41598-021-03910-8`): looked for by DOI, subject and number of discs, and not found. Without
  its parameters there is no order check. From memory it has 16,884 discs in 50 x 100 mm.
- nu and sigma_ci of the granite, and its BTS and friction angle beyond memory: the tables of the paper could not be opened.
- Mas Ivars et al. 2011: their single joints beside Jaeger's plane were not found.
- The default `elastic_reading` (plane stress) does not follow from one match. E of the granite fits plane strain, its nu is not known here, and a convention
  is no finding.
"""

if __name__ == "__main__":
    page(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
