#!/usr/bin/env python3
"""Writes docs/reach-tables.md from data/maps (make maps).   Usage: maps.py DATA PAGE"""
import csv
import math
import pathlib
import statistics
import sys

from results_csv import table

HEAD = """# Tables of the maps

Written by `tools/maps.py` from `data/maps` (`make maps`). [What models of rock reach](theory/reach.md) explains them.

"""
ANGLES = (0, 15, 30, 45, 60, 75, 90)
DENSE = 1321
ISOTROPIC = {"parallel-bond": "parallel bonds", "flat-joint": "flat joints"}
LAYERED = {"parallel-bond-crossing": "parallel bonds, crossing", "parallel-bond-zone": "parallel bonds, zone",
           "parallel-bond-directions": "parallel bonds with directions",
           "parallel-bond-directions-crossing": "parallel bonds with directions of strength, crossing",
           "parallel-bond-bridges-crossing": "parallel bonds, bridges, crossing",
           "flat-joint-crossing": "flat joints, crossing", "flat-joint-zone": "flat joints, zone"}


def rows_of(file):
    with open(file, newline="") as text:
        return [{k: float(v) if v else math.nan for k, v in row.items()} for row in csv.DictReader(text)]


def sensible(row, angles):
    at = lambda stem: [row[f"{stem}({a})"] for a in angles] if angles else [row[stem]]
    return all(v < 0.2 for v in at("broken")) and all(v < 0.6 for v in at("nu50")) and all(v > 0.3 for v in at("sigma_ci/UCS"))


def spread(values, digits=2):
    """5 %, median and 95 % of the finite ones."""
    values = sorted(v for v in values if math.isfinite(v))
    if not values:
        return "-"
    at = lambda p: values[min(len(values) - 1, int(p * len(values)))]
    return " / ".join(f"{at(p):.{digits}f}" for p in (0.05, 0.5, 0.95))


def confined(row):
    """Friction angle [deg] by a line through three strengths, and m_i of Hoek & Brown through the same."""
    ucs = row["UCS/sigma_c"]
    points = [(0.0, ucs)] + [(row[f"sigma_3/sigma_c #{i}"], row[f"q/sigma_c #{i}"] + row[f"sigma_3/sigma_c #{i}"]) for i in (1, 2)]
    if not all(math.isfinite(s) for p in points for s in p):
        return math.nan, math.nan
    mean3, mean1 = (statistics.mean(p[i] for p in points) for i in (0, 1))
    slope = sum((a - mean3) * (b - mean1) for a, b in points) / sum((a - mean3) ** 2 for a, _ in points)
    phi = math.degrees(math.asin((slope - 1) / (slope + 1))) if slope > 0 else math.nan
    m = sum(((b - a) ** 2 - ucs ** 2) * ucs * a for a, b in points) / sum((ucs * a) ** 2 for a, _ in points)
    return phi, m


def mean_over_packings(rows):
    """One row per point and density: means over its packings of what they answered."""
    points = {}
    for row in rows:
        points.setdefault((row["point"], row["n_grains"]), []).append(row)
    means = []
    for some in points.values():
        mean = {}
        for key in some[0]:
            values = [r[key] for r in some if math.isfinite(r[key])]
            mean[key] = statistics.mean(values) if values else math.nan
        means.append(mean)
    return means


def isotropic_lines(name, label, rows):
    points = [r for r in mean_over_packings(rows) if math.isfinite(r["DTS/sigma_c"])]
    for r in points:
        r["phi"], r["m_i"] = confined(r)
    cells = []
    for dense in (True, False):
        some = [r for r in points if (r["n_grains"] == DENSE) == dense]
        good = [r for r in some if sensible(r, ())]
        of = lambda f, digits=2: spread([f(r) for r in good], digits)
        cells.append([f"{label}, {'dense' if dense else 'loose'}", f"{len(good)} of {len(some)}",
                      of(lambda r: r["UCS/sigma_c"] / r["DTS/sigma_c"], 1), of(lambda r: r["UCS/sigma_c"] / r["BTS/sigma_c"], 1),
                      of(lambda r: r["central"]), of(lambda r: r["sigma_ci/UCS"]), of(lambda r: r["E50/E_c"] / r["E_small/E_c"]),
                      of(lambda r: r["nu50"]), of(lambda r: r["E_t/E_c"] / r["E_small/E_c"]), of(lambda r: r["broken"]),
                      of(lambda r: r["phi"], 0), of(lambda r: r["m_i"], 0)])
    return cells


def ratio_by_lever(rows, lever, edges, label):
    good = [r for r in mean_over_packings(rows) if sensible(r, ()) and r["n_grains"] == DENSE and math.isfinite(r["DTS/sigma_c"])]
    lines = []
    for low, high in zip(edges, edges[1:]):
        some = [r for r in good if low <= r[lever] < high or r[lever] == high == edges[-1]]
        lines.append([f"{label}, {lever} {low:g} - {high:g}", str(len(some)), spread([r["UCS/sigma_c"] / r["DTS/sigma_c"] for r in some], 1),
                      spread([r["UCS/sigma_c"] / r["BTS/sigma_c"] for r in some], 1)])
    return lines


def size_lines(label, rows):
    """Means over packings and the standard error of each, over sigma_c, by number of grains."""
    lines = []
    for n in sorted({r["n_grains"] for r in rows}):
        some = [r for r in rows if r["n_grains"] == n]
        cells = [label, f"{n:.0f}", f"{16 / 0.665 * math.sqrt(n / DENSE):.0f}"]
        for column in ("UCS/sigma_c", "DTS/sigma_c", "BTS/sigma_c"):
            values = [r[column] for r in some if math.isfinite(r[column])]
            cells.append(f"{statistics.mean(values):.3f} +- {statistics.stdev(values) / math.sqrt(len(values)):.3f}" if len(values) > 1 else "-")
        central = [r["central"] for r in some if math.isfinite(r["central"])]
        lines.append([*cells, f"{statistics.mean(central):.1f}" if central else "-"])
    return lines


def density_line(label, rows):
    points = mean_over_packings(rows)
    dense = {r["point"]: r["UCS/sigma_c"] for r in points if r["n_grains"] == DENSE}
    loose = {r["point"]: r["UCS/sigma_c"] for r in points if r["n_grains"] != DENSE}
    return f"{label}: {spread([dense[p] / loose[p] for p in dense if p in loose])}"


def lowest(row):
    ucs = {a: row[f"UCS/sigma_c({a})"] for a in ANGLES}
    return (math.nan, math.nan) if any(math.isnan(v) for v in ucs.values()) else (min(ucs, key=ucs.get), min(ucs.values()) / min(ucs[0], ucs[90]))


def extent(values):
    values = [v for v in values if math.isfinite(v)]
    return f"{min(values):.2f} - {max(values):.2f} ({len(values)})" if values else "none"


def layered_line(label, rows):
    good = [r for r in rows if sensible(r, ANGLES)]
    E = lambda r: r["E50/E_c(90)"] / r["E50/E_c(0)"]
    U = lambda r: r["UCS/sigma_c(0)"] / r["UCS/sigma_c(90)"]
    least = [lowest(r) for r in good]
    place = ", ".join(f"{a}: {sum(1 for p, _ in least if p == a)}" for a in ANGLES if any(p == a for p, _ in least))
    depth = lambda angles: extent([d for p, d in least if p in angles])
    return [label, f"{len(good)} of {len(rows)}", extent([E(r) for r in good]), extent([U(r) for r in good]),
            extent([U(r) for r in good if 1.3 <= E(r) <= 1.5]), extent([U(r) for r in good if 2.2 <= E(r) <= 2.8]), place,
            depth((30, 45)), depth((60,))] + [extent([r[f"UCS/sigma_c({a})"] / r[f"BTS/sigma_c({a})"] for r in good]) for a in (0, 45, 90)]


def page_tables(data):
    text = "## Isotropic rock\nSensible points; 5 % / median / 95 % of means over five packings.\n\n"
    lines, by_lever, densities, sizes = [], [], [], []
    for name, label in ISOTROPIC.items():
        rows = rows_of(data / f"{name}.csv")
        lines += isotropic_lines(name, label, rows)
        densities.append(density_line(label, rows))
        sizes += size_lines(label, rows_of(data / f"{name}-sizes.csv"))
        by_lever += ratio_by_lever(rows, "tau_c/sigma_c", (0.8, 1.5, 2.5, 5.0), label)
        if name == "parallel-bond":
            by_lever += ratio_by_lever(rows, "moment contribution", (0.0, 0.15, 0.4, 1.0), label)
            by_lever += ratio_by_lever(rows, "phi [deg]", (0.0, 15.0, 30.0, 45.0), label)
    text += table(["", "sensible", "UCS/DTS", "UCS/BTS", "first crack in the central third", "sigma_ci/UCS", "E50/E", "nu50", "E_t/E",
                   "broken before the peak", "friction angle [deg]", "m_i"], lines)
    text += "\nUCS over tension of sensible points of the dense packing, by one parameter at a time:\n\n"
    text += table(["", "points", "UCS/DTS", "UCS/BTS"], by_lever)
    text += "\nUCS of the dense packing over UCS of the loose one, the same micro-parameters, 5 % / median / 95 %:\n\n" + "".join(f"- {d}\n" for d in densities)
    text += "\nThe base recipe (tau_c = sigma_c = 50 MPa with 10 %, moment contribution 1) in grains of other sizes, the same specimen. Means of five packings and their standard errors.\n\n"
    text += table(["", "discs", "grains across", "UCS/sigma_c", "DTS/sigma_c", "BTS/sigma_c", "first crack in the central third"], sizes)
    text += "\n## Layered rock\nExtent over sensible points (how many), every point on one of five packings.\n\n"
    lines = []
    for name, label in LAYERED.items():
        rows = rows_of(data / f"{name}.csv")
        as_in_paper = lambda r: r["phi [deg]"] == 0.0 and r.get("moment contribution") == 1.0
        lines.append(layered_line(label, [r for r in rows if not as_in_paper(r)]))
        if base := [r for r in rows if as_in_paper(r)]:
            lines.append(layered_line(label + ", bonds as in the paper", base))
    text += table(["", "sensible", "E(90)/E(0)", "UCS(0)/UCS(90)", "the same at E(90)/E(0) 1.3 - 1.5", "at 2.2 - 2.8", "least UCS at [deg]: points",
                   "least over lower end, at 30 or 45", "at 60", "UCS/BTS(0)", "UCS/BTS(45)", "UCS/BTS(90)"], lines)
    return text


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    pathlib.Path(sys.argv[2]).write_text(HEAD + page_tables(pathlib.Path(sys.argv[1])))


main()
