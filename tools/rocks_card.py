"""The card of a rock: what its calibrations, one per first packing, came to; SI units."""
import csv
import json
import math
import re
import statistics
import tomllib

MODULI = ("E", "nu")
PROPERTIES = (*MODULI, "UCS", "BTS", "DTS", "sigma_1")
MISSED = ("value_missed", "fit_missed")


def clean(value):
    """Six digits, and null for what is no number: JSON has none."""
    if isinstance(value, dict):
        return {k: clean(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [clean(v) for v in value]
    if isinstance(value, float):
        return float(f"{value:.6g}") if math.isfinite(value) else None
    return value


def rms(values):
    values = [v for v in values if v is not None and math.isfinite(v)]
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan


def error(row):
    """Of the model against the laboratory: a difference for nu, else relative."""
    model, truth = row["model"], row["laboratory"]["mean"]
    return math.nan if model is None else model - truth if row["property"] == "nu" else model / truth - 1


def place(row):
    return row["property"], row["theta [deg]"], row.get("confining [Pa]", 0.0), row.get("diameter [m]", 0.0)


def mean_direction(angles, weights):
    """Of directions in degrees, the same half a turn on, by doubled angles as src/analysis/failure_plane.cpp; -90 < angle <= 90."""
    x = sum(w * math.cos(math.radians(2 * a)) for a, w in zip(angles, weights))
    y = sum(w * math.sin(math.radians(2 * a)) for a, w in zip(angles, weights))
    angle = math.degrees(math.atan2(y, x)) / 2
    return angle + 180 if angle <= -90 else angle


def failure_of(modes):
    """Of all calibrations: share of cracks along bedding, angle of the plane of failure, tests in which one was seen, all tests."""
    modes = [m for m in modes if m and m["n_tests"]]
    if not modes:
        return None
    shares = [m for m in modes if m["bedding_share"] is not None]
    planes = [m for m in modes if m["n_planes"] and m["angle [deg]"] is not None]
    tests = sum(m["n_tests"] for m in shares)
    return {"bedding_share": sum(m["bedding_share"] * m["n_tests"] for m in shares) / tests if shares else None,
            "angle [deg]": mean_direction([m["angle [deg]"] for m in planes], [m["n_planes"] for m in planes]) if planes else None,
            "planes": sum(m["n_planes"] for m in planes), "tests": sum(m["n_tests"] for m in modes)}


def cells_of(found):
    """Every value of the table beside the model on unseen packings, a number per calibration."""
    left_out = [{place(r): r for r in d["left_out"]} for d in found]
    cells = []
    for k, row in enumerate(found[0]["verification"]):
        same = [d["verification"][k] for d in found]
        cell = {"property": row["property"], "theta [deg]": row["theta [deg]"], "confining [Pa]": row.get("confining [Pa]", 0.0),
                "laboratory": row["laboratory"]["mean"], "n": row["laboratory"]["n"], "model": [r["model"] for r in same],
                "error": statistics.fmean(error(r) for r in same)}
        if failure := failure_of([r.get("failure") for r in same]):
            cell["failure"] = failure
        if row["property"] not in MODULI:
            outside = [d.get(place(row)) for d in left_out]
            cell["left_out"] = [r.get("with_discrepancy") or r["model"] for r in outside if r]
            cell["jaeger"] = next((r.get("jaeger") for r in outside if r), None)
        cells.append(cell)
    return cells


def errors_of(found):
    """Root mean squares on unseen packings by property, a number per calibration."""
    rows = [next(e for e in d["errors"] if "unseen packings" in e["of"]) for d in found]
    return {p: [r[p] for r in rows] for p in rows[0] if p != "of"}


def left_out_of(found):
    """By property: the model with its discrepancy and alone per calibration, the best curve, and their ratio."""
    out = {}
    for k, y in enumerate(found[0].get("yardsticks", [])):
        same = [d["yardsticks"][k] for d in found]
        ratios = [s["with_discrepancy"] / s["best_error"] for s in same if s["best_error"]]
        out[y["property"]] = {"values": y["cells"], "model": [s["model"] for s in same],
                              "with_discrepancy": [s["with_discrepancy"] for s in same], "best": y["best"],
                              "best_error": y["best_error"], "ratio": ratios}
    return out


def held(found):
    """Values left out that lie in their interval, and all of them."""
    rows = [r for d in found for r in d["left_out"] if r.get("low") is not None and r.get("high") is not None]
    return sum(r["low"] <= r["laboratory"]["mean"] <= r["high"] for r in rows), len(rows)


def missed(found):
    return [[{k: c[k] for k in ("property", "theta [deg]")} | {"text": f["text"]} for f in d["verdict"]["findings"]
             if f["kind"] in MISSED for c in f["cells"]] for d in found]


def seconds(folder):
    return float((folder / "cpu").read_text()) if (folder / "cpu").exists() else 0.0


# --- predictions


def truth_of(folder, prediction):
    """Measured values by (confining stress in MPa, angle): means of the table, or of the envelope's c and phi."""
    with open(folder / prediction["truth"], encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    values = {}
    for r in rows:
        theta = float(r["theta [deg]"])
        if "c [MPa]" in r:
            phi = math.radians(float(r["phi [deg]"]))
            N = math.tan(math.pi / 4 + phi / 2) ** 2
            for s in prediction["confining"]:
                values[s, theta] = [2 * float(r["c [MPa]"]) * math.sqrt(N) + N * s]
            continue
        column, stress = f"{prediction['property']} [MPa]", r.get("confining [MPa]") or 0
        if r[column] and int(stress) in prediction.get("confining", [0]) and theta in prediction.get("predicted", [theta]):
            values.setdefault((int(stress), theta), []).append(float(r[column]))
    return {k: statistics.fmean(v) for k, v in values.items()}


def yardstick_of(folder, prediction, place):
    """What a rule without a model makes of the values that the model is fitted to."""
    sigma_3, theta = place
    with open(folder / "table.csv", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    rows = [r for r in table if float(r["theta [deg]"]) == theta]
    if prediction["property"] == "DTS":
        across, along = (statistics.fmean(float(r["DTS [MPa]"]) for r in table if float(r["theta [deg]"]) == t) for t in (0, 90))
        return min(across / math.cos(math.radians(theta)) ** 2, along)
    if prediction["property"] == "BTS":
        return statistics.fmean(float(r["UCS [MPa]"]) for r in rows if r["UCS [MPa]"]) / 10
    begin = prediction["from_confining"]
    column = "UCS [MPa]" if begin == 0 else "sigma_1 [MPa]"
    known = [float(r[column]) for r in rows if r[column] and int(r.get("confining [MPa]") or 0) == begin]
    N = math.tan(math.pi / 4 + math.radians(prediction["phi"]) / 2) ** 2
    return statistics.fmean(known) + N * (sigma_3 - begin)


def bands_of(run, prediction):
    """(confining stress, angle) -> median, low, high [MPa] of the rock: of the draws, with what they miss of the table where
    the table has such a strength."""
    number, bands = {"BTS": "bts"}.get(prediction["property"], "sigma_1"), {}
    for sigma_3 in prediction.get("confining", [0]):
        path = run.folder / f"{prediction['name']}-{sigma_3}" / "out/band.csv"
        if path.exists():
            with open(path, encoding="utf-8") as file:
                for r in csv.DictReader(file):
                    if r["number"] == number and r["theta [deg]"]:
                        known = bool(r.get("rock"))
                        of = ("rock", "rock_low", "rock_high") if known else ("median", "low", "high")
                        bands[sigma_3, float(r["theta [deg]"])] = [float(r[k]) * 1e-6 for k in of]
    return bands


def prediction_card(folder, prediction, bands):
    """`bands`: a median, low and high by place per calibration."""
    bands = [b for b in bands if b]
    card = {k: prediction[k] for k in ("name", "text", "yardstick", "model", "property")}
    card |= {"blind": prediction.get("blind", False), "calibrations": len(bands)}
    if not bands:
        return card
    rows = []
    for at, value in sorted(truth_of(folder, prediction).items()):
        rows.append({"confining [MPa]": at[0], "theta [deg]": at[1], "laboratory [MPa]": value,
                     "yardstick [MPa]": yardstick_of(folder, prediction, at), "model [MPa]": [b[at][0] for b in bands if at in b],
                     "low [MPa]": [b[at][1] for b in bands if at in b], "high [MPa]": [b[at][2] for b in bands if at in b]})
    truth = [r["laboratory [MPa]"] for r in rows]
    errors = [[b[r["confining [MPa]"], r["theta [deg]"]][0] / r["laboratory [MPa]"] - 1 for r in rows
               if (r["confining [MPa]"], r["theta [deg]"]) in b] for b in bands]
    rule = [r["yardstick [MPa]"] / t - 1 for r, t in zip(rows, truth)]
    inside = [low <= r["laboratory [MPa]"] <= high for r in rows for low, high in zip(r["low [MPa]"], r["high [MPa]"])]
    return card | {"rms": [rms(e) for e in errors], "mean": [statistics.fmean(e) for e in errors], "inside": sum(inside),
                   "of": len(inside), "yardstick_rms": rms(rule), "yardstick_mean": statistics.fmean(rule), "rows": rows}


# --- a study in place of a calibration


def tests_of(folder, rock, number):
    """Tests of a study that have a strength, by angle, and what the table says of the same angle."""
    with open(folder / "specimens.csv", encoding="utf-8") as file:
        tests = [r for r in csv.DictReader(file) if r[number]]
    with open(rock / "table.csv", encoding="utf-8") as file:
        table = {float(r["theta [deg]"]): r for r in csv.DictReader(file)}
    return {theta: (row, [t for t in tests if float(t["theta [deg]"]) == theta]) for theta, row in table.items()}


def mode_of(tests):
    """As a calibration has it."""
    planes = [float(t["failure_angle [deg]"]) for t in tests if t["failure_angle [deg]"]]
    return {"n_tests": len(tests), "n_planes": len(planes), "bedding_share": statistics.fmean(float(t["bedding_share [1]"]) for t in tests),
            "angle [deg]": mean_direction(planes, [1] * len(planes)) if planes else None}


def is_along(angle, theta, within):
    """Does a plane follow the bedding? Directions are the same half a turn on."""
    return angle is not None and abs((angle - theta + 90) % 180 - 90) <= within


def study_card(card, folder, rock, predictions):
    """Of a rock whose table no calibration can begin with, and whose model is set by hand: study.toml and model.toml say how."""
    cells, bands = [], {}
    plan = predictions[0][0]
    for theta, (row, tests) in tests_of(folder, rock, "sigma_t [Pa]").items():
        strengths, failure = [float(t["sigma_t [Pa]"]) for t in tests], failure_of([mode_of(tests)])
        value = 1e6 * float(row["DTS [MPa]"])
        failure["laboratory [deg]"] = float(row["failure plane [deg]"])
        failure |= {k: is_along(failure[a], theta, plan["along_within"]) for k, a in (("along", "angle [deg]"), ("laboratory_along", "laboratory [deg]"))}
        cells.append({"property": "DTS", "theta [deg]": theta, "confining [Pa]": 0.0, "laboratory": value, "n": 1, "model": strengths,
                      "error": statistics.fmean(strengths) / value - 1, "failure": failure})
        bands[0, theta] = [1e-6 * f(strengths) for f in (statistics.median, min, max)]
    agree = [c["failure"]["along"] == c["failure"]["laboratory_along"] for c in cells]
    lines = ["The table has direct tension alone. A calibration begins with E, or with a strength in compression.",
             "Two strengths of the model are set by two values of the table (model.toml). The others are predicted.",
             f"The plane of failure follows the bedding, or crosses it, as in the laboratory at {sum(agree)} of {len(agree)} angles."]
    return card | {"layers": "planes", "matrix": "parallel_bond", "verdict": {"status": "tension alone", "lines": lines}, "cells": cells,
                   "predictions": [prediction_card(rock, p, [bands]) for p, _ in predictions],
                   "tests": sum(len(c["model"]) for c in cells), "cpu_s": seconds(folder)}


# --- the card


def measured_of(folder, rock):
    """What the table holds: properties, number of angles."""
    text = (folder / rock["data"]).read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in text if not line.startswith("#")))
    heads = {h: h.split(" [")[0].removesuffix("_GPa").removesuffix("_MPa") for h in rows[0]}
    angle = next((h for h in heads if heads[h] in ("theta", "theta_deg")), None)
    properties = [p for h, p in heads.items() if p in PROPERTIES and any(r[h] for r in rows)]
    return {"properties": properties, "angles": len({float(r[angle]) for r in rows}) if angle and rock.get("bedded", True) else 0}


def about_of(folder):
    about = tomllib.loads((folder / "about.toml").read_text(encoding="utf-8"))
    rock = tomllib.loads((folder / "rock.toml").read_text(encoding="utf-8"))
    return {"format": 1, "name": folder.name, "title": rock["name"], "kind": about["kind"], "cautions": about["cautions"],
            "measured": measured_of(folder, rock), "sources": about["source"]}


def why_not(run):
    """Of a table that nothing can be fitted to: the last line of the program."""
    lines = [line for line in (run.folder / "log").read_text(encoding="utf-8").splitlines() if line.strip()]
    return re.sub(r"^.*: table: ", "", lines[-1]).split(";")[0] if lines else "not run"


def read(run):
    path = run.folder / "calibration/calibration.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def card_of(folder, runs, predictions):
    card = about_of(folder)
    if runs and (runs[0].folder / "specimens.csv").exists():
        return study_card(card, runs[0].folder, folder, predictions)
    done = [(r, d) for r in runs if (d := read(r)) is not None]
    if not done:
        why = why_not(runs[0]) if (runs[0].folder / "log").exists() else "not run"
        return card | {"verdict": {"status": "nothing to fit" if why != "not run" else why, "lines": [why if why == "not run" else f"Nothing to fit: {why}."]}}
    found = [d for _, d in done]
    first = found[0]
    inside, of = held(found)
    card |= {"program": first["program"]["version"], "asked": first["asked"], "seeds": [r.seed for r, _ in done],
             "layers": first["layers"], "matrix": first["matrix"], "E_is": first["E_is"],
             "verdict": {k: first["verdict"][k] for k in ("status", "sentence", "lines")}
             | {"good_for": [f["text"] for f in first["verdict"]["good_for"]],
                "not_good_for": [f["text"] for f in first["verdict"]["not_good_for"]],
                "causes": [f["text"] for f in first["verdict"]["causes"]]},
             "statuses": [d["verdict"]["status"] for d in found], "models": [d["layers"] for d in found],
             "missed": missed(found), "errors": errors_of(found), "left_out": left_out_of(found),
             "intervals": {"hold": inside, "of": of}, "cells": cells_of(found)}
    card["predictions"] = [prediction_card(folder, p, [bands_of(r, p) for r in rs]) for p, rs in predictions]
    own = {r.folder for r in runs} | {r.folder for _, rs in predictions for r in rs}
    card |= {"tests": sum(d["runs"]["strength_tests"] for d in found), "cpu_s": sum(seconds(f) + sum(
        seconds(p) for p in f.iterdir() if p.is_dir()) for f in own)}
    return card
