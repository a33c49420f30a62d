#!/usr/bin/env python3
"""Writes docs/reliability-tables.md and rows of measured/robustness.csv from the studies of examples/reliability (make reliability).

Usage: reliability.py RESULTS PAGE.

A test with a strength is held against the same specimen pressed well: the slowest of its study that has one, everything else as in rock.toml. Where the rock itself
is another (packings, grain size) it is held against the mean of the same angle with the usual number of grains, or with the smallest grains.
"""
import collections
import math
import pathlib
import sys

import measured
from results_csv import rows_of, table

HEAD = """# Errors of tests made bad on purpose

Written by `tools/reliability.py` (`make reliability`). [Reliability](reliability.md) says what follows from it, and how the tests were made.
A cell has mean, root mean square and worst error in %, and in brackets the number of tests.

"""
INF = math.inf
# study: what its strength is called here and in results.csv
STRENGTHS = {"compression": ("UCS", "ucs"), "tension": ("DTS", "sigma_t"), "brazilian": ("BTS", "bts"), "confined": ("sigma_1", "sigma_1")}
MODULI = {"compression": ("E", "E_tangent"), "tension": ("E in tension", "E_tangent")}
KEYS = ("test.platen_speed", "engine.damping", "test.history_interval", "test.stop_at", "test.post_peak", "test.grip_thickness")
HAS_STRENGTH = ("peaked", "knee", "untrusted")
GRADES = ("good", "warning", "untrusted")


def place(row, *more):
    return (row["theta"], row["intact"]) + tuple(row[k] for k in more)


def usual(rows):
    """Value of each key at which most of its study was run."""
    return {k: collections.Counter(r[k] for r in rows).most_common(1)[0][0] for k in KEYS if k in rows[0]}


class Errors:
    """Tests of one study, each with the key that is not as usual and the error of its numbers in %."""

    def __init__(self, results, study):
        rows = rows_of(results / study)
        self.n_run, at = len(rows), usual(rows)
        rows = [r for r in rows if r["status"] in HAS_STRENGTH and isinstance(r[STRENGTHS[study][1]], float)]
        odd = lambda r: [k for k in at if r[k] != at[k]]
        well = {}
        for r in sorted(rows, key=lambda r: -r["test.platen_speed"]):
            if odd(r) in ([], ["test.platen_speed"]):
                well[place(r, "packing")] = r
        self.names = [STRENGTHS[study]] + ([MODULI[study]] if study in MODULI else [])
        self.tests = []
        for r in rows:
            reference = well[place(r, "packing")]
            if r is reference:
                continue
            errors = {label: 100.0 * (r[c] / reference[c] - 1.0) for label, c in self.names
                      if isinstance(r[c], float) and isinstance(reference[c], float)}
            if errors:
                self.tests.append((r, (odd(r) or [""])[0], errors))


def summary(values):
    """Mean, root mean square and worst of errors in %, and of how many."""
    if not values:
        return "-"
    rms = math.sqrt(sum(v * v for v in values) / len(values))
    return f"{sum(values) / len(values):+.1f}, {rms:.1f}, {max(values, key=abs):+.0f} ({len(values)})"


def bins_named(edges):
    return [(a, b, f"below {b:g}" if a == -INF else f"above {a:g}" if b == INF else f"{a:g} - {b:g}") for a, b in zip([-INF] + edges, edges + [INF])]


def by_measure(all_errors, measure, edges, varied, only=None):
    """A table of errors over a measure, of tests where one of `varied` is not as usual."""
    columns = [label for s, e in all_errors.items() if only is None or s in only for label, _ in e.names]
    rows = []
    for low, high, name in bins_named(edges):
        cells = []
        for s, e in all_errors.items():
            if only is None or s in only:
                inside = [errors for r, odd, errors in e.tests
                          if odd in varied and isinstance(r.get(measure), float) and low <= r[measure] < high]
                cells += [summary([x[label] for x in inside if label in x]) for label, _ in e.names]
        if any(c != "-" for c in cells):
            rows.append([name] + cells)
    return table([f"`{measure}`"] + columns, rows)


def by_key(all_errors, key, title, only):
    values = sorted({r[key] for s in only for r, odd, _ in all_errors[s].tests if odd == key}, reverse=True)
    rows = []
    for v in values:
        cells = []
        for s in only:
            inside = [errors for r, odd, errors in all_errors[s].tests if odd == key and r[key] == v]
            cells += [summary([x[label] for x in inside if label in x]) for label, _ in all_errors[s].names]
        rows.append([f"{v:g}"] + cells)
    return table([title] + [label for s in only for label, _ in all_errors[s].names], rows)


def by_grade(all_errors):
    """Without other grips, which hold other planes: another specimen."""
    rows = []
    for e in all_errors.values():
        for label, _ in e.names:
            cells = []
            for grade in GRADES:
                values = [x[label] for r, odd, x in e.tests if r["quality"] == grade and label in x and odd != "test.grip_thickness"]
                beyond = sorted(abs(v) for v in values)
                cells.append(summary(values))
                cells.append(f"{beyond[math.ceil(0.95 * len(beyond)) - 1]:.1f}" if beyond else "-")
            rows.append([label] + cells)
    return table(["error"] + [h for g in GRADES for h in (g, "95 % within")], rows)


def against_mean(rows, column, is_usual):
    """(row, error in %) against the mean of the same angle over the rows that are as usual."""
    means = collections.defaultdict(list)
    for r in rows:
        if is_usual(r) and isinstance(r[column], float):
            means[place(r)].append(r[column])
    mean = {k: sum(v) / len(v) for k, v in means.items()}
    return [(r, 100.0 * (r[column] / mean[place(r)] - 1.0)) for r in rows if isinstance(r[column], float) and place(r) in mean]


def packings(results):
    rows = rows_of(results / "packing")
    both = [("UCS", against_mean(rows, "ucs", lambda r: r["packing.n_grains"] == 254)),
            ("E", against_mean(rows, "E_tangent", lambda r: r["packing.n_grains"] == 254))]
    text = ""
    for measure, edges in (("porosity", [-0.2, 0.0, 0.05, 0.1, 0.15, 0.2]), ("overlap", [0.2, 0.35, 0.5, 0.7, 1.0]), ("rattlers", [0.02, 0.05, 0.1, 0.2, 0.25])):
        lines = []
        for low, high, name in bins_named(edges):
            cells = [summary([e for r, e in tests if low <= r[measure] < high]) for _, tests in both]
            lines += [[name] + cells] if any(c != "-" for c in cells) else []
        text += table([f"`{measure}`"] + [label for label, _ in both], lines) + "\n"
    return text


def resolution(results):
    rows = rows_of(results / "resolution")
    smallest = max(r["packing.n_grains"] for r in rows)
    sets = [(label, against_mean([r for r in rows if r["test.kind"] == kind], column, lambda r: r["packing.n_grains"] == smallest))
            for label, kind, column in (("UCS", "uniaxial", "ucs"), ("E", "uniaxial", "E_tangent"), ("DTS", "direct_tension", "sigma_t"), ("BTS", "brazilian", "bts"))]
    lines = []
    for n in sorted({r["packing.n_grains"] for r in rows}):
        of = [r for r in rows if r["packing.n_grains"] == n]
        mean = lambda m: sum(r[m] for r in of if isinstance(r[m], float)) / max(1, sum(isinstance(r[m], float) for r in of))
        lines.append([f"{n:g}", f"{mean('grains_across'):.1f}", f"{mean('grains_per_spacing'):.1f}"] +
                     [summary([e for r, e in tests if r["packing.n_grains"] == n]) for _, tests in sets])
    return table(["discs", "`grains_across`", "`grains_per_spacing`"] + [label for label, _ in sets], lines)


def against_slowest(rows, column, keys):
    """(row, row of the slowest test of the same specimen) where both have the number."""
    rows = [r for r in rows if r["status"] in HAS_STRENGTH and isinstance(r[column], float)]
    slowest = {place(r, *keys): r for r in sorted(rows, key=lambda r: -r["test.platen_speed"])}
    return [(r, slowest[place(r, *keys)]) for r in rows if r is not slowest[place(r, *keys)]]


def shear(results):
    pairs = against_slowest(rows_of(results / "shear"), "tau_peak", ["packing"])
    lines = []
    for low, high, name in bins_named([0.05, 0.1, 0.3, 1, 2]):
        lines.append([name, summary([100.0 * (r["tau_peak"] / slow["tau_peak"] - 1.0) for r, slow in pairs if low <= r["sigma_n_error_rms"] < high])])
    return table(["`sigma_n_error_rms`", "tau_peak"], lines)


def moduli(results):
    """nu, also where it is not given, is 1 - area_change. By the larger measure of both tests: neither is the right one."""
    rows = rows_of(results / "poisson")
    keys = [k for k in rows[0] if k.startswith(("matrix.", "bedding."))]
    pairs, text = against_slowest(rows, "area_change", keys), ""
    for measure, edges in (("nu_spread", [0.01, 0.03, 0.05, 0.08, 0.2]), ("cracks_in_window", [0.001, 0.05, 0.1, 0.2, 0.3])):
        lines = []
        for low, high, name in bins_named(edges):
            inside = [p for p in pairs if all(isinstance(r[measure], float) for r in p) and low <= max(r[measure] for r in p) < high]
            nu = [abs(r["area_change"] - slow["area_change"]) for r, slow in inside]
            E = [100.0 * (r["E_tangent"] / slow["E_tangent"] - 1.0) for r, slow in inside if all(isinstance(x["E_tangent"], float) for x in (r, slow))]
            lines.append([name, f"{sum(nu) / len(nu):.3f}, {max(nu):.2f} ({len(nu)})" if nu else "-", summary(E)])
        text += table([f"`{measure}`", "nu: mean and worst difference", "E"], lines) + "\n"
    return text


def slip(all_errors, height, radius):
    """What bounds the slip of a joint at the strength: how far the platens have come together, over the smallest radius."""
    lines = []
    for s in ("compression", "confined"):
        ways = sorted(abs(r["peak_strain"]) * height / radius for r, _, _ in all_errors[s].tests if isinstance(r["peak_strain"], float))
        lines.append([STRENGTHS[s][0], f"{ways[len(ways) // 2]:.2f}", f"{ways[-1]:.2f}"])
    return table(["strength", "median", "most"], lines)


def good_tests(results):
    """Rows of measured/robustness.csv: the worst error of tests that are called good."""
    for s in STRENGTHS:
        e = Errors(results, s)
        for label, _ in e.names:
            values = [x[label] for r, odd, x in e.tests if r["quality"] == "good" and label in x and odd != "test.grip_thickness"]
            if values and label != "E in tension":
                rms = math.sqrt(sum(v * v for v in values) / len(values))
                yield measured.row(f"good tests, bad on purpose: {label}", f"{max(map(abs, values)):.0f}", "%", f"{rms:.1f} rms", len(values))


def page(results):
    e = {s: Errors(results, s) for s in STRENGTHS}
    motion = ("", "test.platen_speed", "engine.damping")
    n = sum(x.n_run for x in e.values()) + len(rows_of(results / "packing")) + sum(len(rows_of(results / s)) for s in ("resolution", "shear", "poisson"))
    return "\n".join([
        f"{n:,} tests. First by the grade of the test:\n", by_grade(e),
        "By `wave_transits`, platens of all speeds:\n",
        by_measure(e, "wave_transits", [2, 5, 10, 20, 30, 50, 100, 200], ("", "test.platen_speed")),
        "By the difference of opposite platens and by the kinetic energy, platens of all speeds and dampings:\n",
        by_measure(e, "platen_difference_95", [0.003, 0.01, 0.03, 0.1, 0.3], motion),
        by_measure(e, "kinetic_ratio", [0.001, 0.003, 0.01, 0.03, 0.1], motion),
        "By damping, and by the energy error that comes with it:\n",
        by_key(e, "engine.damping", "`engine.damping`", list(e)),
        by_measure(e, "energy_error", [0.001, 0.003, 0.01, 0.03], ("engine.damping",)),
        "By rows of the history up to the peak (`test.history_interval`):\n",
        by_measure(e, "rows_to_peak", [2, 5, 10, 20, 50], ("test.history_interval",), ("compression", "tension", "brazilian")),
        "By what was seen behind the peak (`test.stop_at`, `test.post_peak`):\n",
        by_measure(e, "peak_confirmed", [0.25, 0.5, 0.75, 1.0], ("test.stop_at", "test.post_peak"), ("compression",)),
        "By the share of cracks at the grips (`test.grip_thickness`):\n",
        by_measure(e, "failure_at_grip", [0.1, 0.25, 0.5, 0.75], ("", "test.grip_thickness"), ("tension",)),
        "Packings of 206 to 400 discs in the same box, against the mean of 254. Another porosity is another rock, so this is no error of a test:\n", packings(results),
        "Grains of another size in the same box with the same planes, single specimens against the mean of the smallest grains. Scatter and the "
        "size of the grains are in it together:\n", resolution(results),
        "Peak strength in direct shear, by the deviation of the normal stress from 5 MPa:\n", shear(results),
        "E and nu of 24 rocks at two speeds against a slow one, by the larger measure of both tests:\n", moduli(results),
        "Slip beyond a grain. A joint keeps the area that it was given, which is wrong once it has slipped by more than a radius.\n"
        "At the strength the platens have come together by, in smallest radii:\n", slip(e, 76.0, 1.36)])


def main():
    results, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    target.write_text(HEAD + page(results).rstrip() + "\n", encoding="utf-8")
    measured.add("robustness", good_tests(results), "make reliability")


main()
