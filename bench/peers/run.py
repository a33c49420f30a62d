"""The paper's specimen in Phyllite and in Yade (Debian package `yade`): the same uniaxial test, one core each.

    python3 bench/peers/run.py build/release/phyllite [--recipe R] [--max-steps N] [--out FOLDER]

Prints steps, seconds of CPU, ns per contact and step and their ratios: a comparison of speed. The laws differ (yade_ucs.py), so do the
strengths; equal.py compares numbers. `make bench-peers`.
"""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tomllib

here = pathlib.Path(__file__).parent


def call(*words):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
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


def lanes(program, recipe, out):
    """Sixteen bond seeds side by side in single precision: seconds and UCS per specimen."""
    study = out / "lanes.toml"
    study.write_text(f'recipe = "{recipe.resolve()}"\nbond_seeds = {list(range(1, 17))}\n'
                     '[set]\n"engine.precision" = "float"\n')
    call(program, "--threads", 1, "study", study, "--out", out / "lanes")
    rows = list(csv.DictReader(open(out / "lanes" / "results.csv")))
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


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("--recipe", type=pathlib.Path, default=here / "peer.toml")
    arguments.add_argument("--max-steps", type=int, default=100000, help="of Yade")
    arguments.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/peers"))
    a = arguments.parse_args()
    if shutil.which("yade") is None:
        sys.exit("yade is not installed (Debian: apt install yade)")
    a.out.mkdir(parents=True, exist_ok=True)
    call(a.program, "specimen", a.recipe, "--out", a.out / "specimen")
    ours = press(a.program, a.recipe, a.out / "press")
    side = lanes(a.program, a.recipe, a.out)
    side["contacts"] = ours["contacts"]
    theirs = yade(a.out, ours, a.max_steps)
    rows = [("Phyllite, one specimen, double", ours), ("Phyllite, 16 in lanes, float", side), ("Yade JCFpm", theirs)]
    print(f"{'':32}{'steps':>9}{'CPU s':>10}{'ns/contact/step':>17}{'ratio':>8}")
    cost = [1e9 * r["seconds"] / (r["steps"] * r["contacts"]) for _, r in rows]
    for (name, r), ns in zip(rows, cost):
        print(f"{name:32}{r['steps']:9.0f}{r['seconds']:10.1f}{ns:17.2f}{cost[-1] / ns:8.1f}")
    if not theirs["ended"]:
        print(f"Yade was stopped at {theirs['strain']:.2e} of strain")


main()
