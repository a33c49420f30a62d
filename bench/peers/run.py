"""The paper's specimen in Phyllite and in Yade (Debian package `yade`): the same uniaxial test, one core each.

    python3 bench/peers/run.py build/release/phyllite [--out FOLDER]

Prints steps, seconds of CPU, ns per contact and step and their ratios, and adds rows to measured/peers.csv: a comparison of speed. The laws
differ (yade_ucs.py), so do the strengths; equal.py compares numbers. `make bench-peers`.
"""
import argparse
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tomllib

here = pathlib.Path(__file__).parent
sys.path.insert(0, str(here.parents[1] / "tools"))
import measured  # noqa: E402

# Discs, what is changed in peer.toml, and where Yade is stopped: the whole specimen would take it the better part of an hour.
SPECIMENS = {"1,870 discs": ({"38 mm": "19 mm", "76 mm": "38 mm", "7481": "1870"}, 100000), "7,481 discs": ({}, 1200)}


def call(*words, **environment):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, env={**os.environ, **environment})
    if done.returncode > 1:
        sys.exit(f"{' '.join(map(str, words))} failed:\n{done.stdout}{done.stderr}")
    return done.stdout


def result_of(folder):
    return json.load(open(next(folder.glob("*/result.json"))))


def press(program, recipe, out):
    call(program, "--threads", 1, "run", recipe, "--out", out)
    r = result_of(out)
    run = r["run"]
    return {"steps": run["n_steps"], "seconds": run["cpu_seconds"], "contacts": run["n_contacts"], "dt": run["dt [s]"],
            "ucs": r["numbers"]["ucs"]["value"], "recipe": r["recipe"]}


def lanes(program, recipe, out, isa):
    """Sixteen bond seeds in single precision, as many side by side as a register holds: seconds and UCS per specimen."""
    study = out / "lanes.toml"
    study.write_text(f'recipe = "{recipe.resolve()}"\nbond_seeds = {list(range(1, 17))}\n'
                     '[set]\n"engine.precision" = "float"\n')
    folder = out / f"lanes-{isa}"
    call(program, "--threads", 1, "study", study, "--out", folder, PHYLLITE_ISA=isa)
    rows = list(csv.DictReader(open(folder / "results.csv")))
    n = len(rows)
    return {"steps": sum(int(r["n_steps"]) for r in rows) / n, "seconds": sum(float(r["cpu [s]"]) for r in rows) / n,
            "ucs": sum(float(r["ucs [Pa]"]) for r in rows) / n}


def yade(out, ours, max_steps):
    recipe = tomllib.loads(ours["recipe"])
    si = {"mm": 1e-3, "m/s": 1.0, "kg/m^3": 1.0, "GPa": 1e9, "MPa": 1e6}

    def value(text):
        number, unit = text.split()
        return float(number) * si[unit]

    E_c, ratio = value(recipe["matrix"]["E_c"]), recipe["matrix"]["ks_over_kn"]
    discs = [line.split(",") for line in open(out / "specimen" / "discs.csv") if line[0].isdigit()]
    settings = {
        "density": value(recipe["matrix"]["density"]), "mu": recipe["matrix"]["mu"], "joint_mu": recipe["bedding"][0]["mu"],
        "joint_tension": value(recipe["bedding"][0]["sigma_n"]), "joint_cohesion": value(recipe["bedding"][0]["cohesion"]),
        "width": value(recipe["specimen"]["width"]), "height": value(recipe["specimen"]["height"]),
        "r_min": min(float(d[2]) for d in discs), "damping": recipe["engine"]["damping"],
        "speed": value(recipe["test"]["platen_speed"]), "stop_at": recipe["test"]["stop_at"],
        "dt": ours["dt"], "max_steps": max_steps, "wall_kn": 2.0 * E_c, "wall_ks": 2.0 * ratio * E_c,
    }
    (out / "specimen" / "peer.json").write_text(json.dumps(settings))
    text = call("yade", "-n", "-x", "-j1", here / "yade_ucs.py", out / "specimen")
    line = next((x for x in text.splitlines() if x.startswith("RESULT ")), None)
    if line is None:
        sys.exit("yade gave no result:\n" + text[-2000:])
    return json.loads(line[7:])


def compare(program, discs, out):
    """Rows (who, steps, seconds, contacts) of a specimen; Yade's is the last."""
    changes, max_steps = SPECIMENS[discs]
    out.mkdir(parents=True)
    text = (here / "peer.toml").read_text()
    for old, new in changes.items():
        text = text.replace(old, new)
    recipe = out / "recipe.toml"
    recipe.write_text(text)
    call(program, "specimen", recipe, "--out", out / "specimen")
    ours = press(program, recipe, out / "press")
    rows = [("Phyllite, double, one alone", ours)]
    for isa, n in (("avx2", 8), ("avx512", 16)):
        if isa in open("/proc/cpuinfo").read():
            rows.append((f"Phyllite, float, {n} lanes", {**lanes(program, recipe, out, isa), "contacts": ours["contacts"]}))
    rows.append(("Yade JCFpm", yade(out, ours, max_steps)))
    return rows


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/peers"))
    a = arguments.parse_args()
    if shutil.which("yade") is None:
        sys.exit("yade is not installed (Debian: apt install yade)")
    shutil.rmtree(a.out, ignore_errors=True)
    found = []
    for discs in SPECIMENS:
        rows = compare(a.program, discs, a.out / discs.split()[0].replace(",", ""))
        cost = [1e9 * r["seconds"] / (r["steps"] * r["contacts"]) for _, r in rows]
        print(f"{discs:32}{'steps':>9}{'CPU s':>10}{'ns/contact/step':>17}{'ratio':>8}")
        for (who, r), ns in zip(rows, cost):
            print(f"{who:32}{r['steps']:9.0f}{r['seconds']:10.1f}{ns:17.2f}{cost[-1] / ns:8.1f}")
            found.append(measured.row(f"{discs}: {who}", f"{ns:.3g}", "ns/contact/step", n="1 core"))
        if not rows[-1][1]["ended"]:
            print(f"Yade was stopped at {rows[-1][1]['strain']:.2e} of strain")
    measured.add("peers", found, "make bench-peers")


main()
