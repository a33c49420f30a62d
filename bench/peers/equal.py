"""Yade (Debian package `yade`) with the laws of Phyllite, contact by contact (yade_equal.py), on the same discs, bonds and platens.

    python3 bench/peers/equal.py build/release/phyllite [--out FOLDER] [--table bench/peers/equal.csv] [--seeds 5]

Writes a row per test into the table, both programs read by the same code; tests that are in it already are not run again. `make yade`.
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
HEAD = ["case", "program", "bond_seed", "E_secant [GPa]", "first crack [MPa]", "UCS [MPa]", "peak strain [%]", "cracks to peak"]
# What is taken away or added in Yade, one thing at a time; "equal" comes first.
VARIANTS = {"matrix": ["equal", "one_spring", "no_bending", "friction"], "bedded": ["equal", "no_turning", "no_new_joints"]}


def call(*words):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode > 1:
        sys.exit(f"{' '.join(map(str, words))} failed:\n{done.stdout}{done.stderr}")


def curve_of(path):
    with open(path) as lines:
        return [tuple(float(row[k]) for k in ("axial_strain [1]", "axial_stress [Pa]", "n_cracks [1]")) for row in csv.DictReader(lines)]


def readings(curve):
    """Secant modulus at half of the strength, stress at the first crack, strength, strain there, cracks up to there."""
    top = max(range(len(curve)), key=lambda i: curve[i][1])
    strain, stress, cracks = curve[top]
    i = next(i for i in range(1, top + 1) if curve[i][1] >= 0.5 * stress)
    (e0, s0, _), (e1, s1, _) = curve[i - 1], curve[i]
    half = e0 + (0.5 * stress - s0) / (s1 - s0) * (e1 - e0)
    first = next(s for _, s, n in curve if n > 0)
    return [f"{v:.6g}" for v in (0.5 * stress / half * 1e-9, first * 1e-6, stress * 1e-6, 100 * strain, cracks)]


def settings_of(folder, result, variant):
    """peer.json of yade_equal.py, SI."""
    recipe = tomllib.loads(result["recipe"])
    si = {"mm": 1e-3, "m/s": 1.0, "kg/m^3": 1.0, "GPa": 1e9, "MPa": 1e6, "GPa/m": 1e9, "deg": 1.0}

    def value(text):
        number, unit = text.split()
        return float(number) * si[unit]

    matrix, test = recipe["matrix"], recipe["test"]
    bedding = [{k: value(v) if isinstance(v, str) and v[0].isdigit() else v for k, v in b.items()} for b in recipe.get("bedding", [])]
    joint = bedding[0] if bedding else dict.fromkeys(["mu", "k_n", "k_s", "sigma_n", "cohesion", "theta", "spacing", "offset"], 0.0)
    radii = [float(line.split(",")[2]) for line in open(folder / "discs.csv") if line[0].isdigit()]
    return {"variant": variant, "density": value(matrix["density"]), "mu": matrix["mu"], "E_c": value(matrix["E_c"]), "ratio": matrix["ks_over_kn"],
            "joint_mu": joint["mu"], "joint_kn": joint["k_n"], "joint_ks": joint["k_s"], "joint_tension": joint["sigma_n"],
            "joint_cohesion": joint["cohesion"],
            "theta": joint["theta"], "spacing": joint["spacing"], "offset": joint["offset"], "width": value(recipe["specimen"]["width"]), "height": value(recipe["specimen"]["height"]),
            "r_min": min(radii), "damping": recipe["engine"]["damping"], "speed": value(test["platen_speed"]), "ramp_strain": test["ramp_strain"],
            "stop_at": test["stop_at"], "post_peak": test["post_peak"], "max_strain": test["max_strain"], "dt": result["run"]["dt [s]"]}


def compare(program, case, seed, variants, out):
    """Yields (program, readings) of Phyllite and of each variant of Yade."""
    folder = out / f"{case}-{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    recipe = folder / "recipe.toml"
    recipe.write_text((here / f"equal-{case}.toml").read_text().replace("moment_contribution = 0", f"moment_contribution = 0\nbond_seed = {seed}"))
    call(program, "specimen", recipe, "--out", folder)
    call(program, "--threads", 1, "run", recipe, "--out", folder / "run", "--replace")
    yield "Phyllite", readings(curve_of(next((folder / "run").glob("*/history.csv"))))
    result = json.load(open(next((folder / "run").glob("*/result.json"))))
    for variant in variants:
        (folder / "peer.json").write_text(json.dumps(settings_of(folder, result, variant)))
        call("yade", "-n", "-x", "-j1", here / "yade_equal.py", folder)
        yield f"Yade, {variant}", readings(curve_of(folder / f"yade-{variant}.csv"))


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/yade"))
    arguments.add_argument("--table", type=pathlib.Path, default=here / "equal.csv")
    arguments.add_argument("--seeds", type=int, default=5)
    arguments.add_argument("--case", choices=list(VARIANTS), help="only this one")
    a = arguments.parse_args()
    if shutil.which("yade") is None:
        sys.exit("yade is not installed (Debian: apt install yade)")
    done = {tuple(row[:3]) for row in csv.reader(open(a.table))} if a.table.exists() else set()
    with open(a.table, "a") as table:
        if not done:
            print(",".join(HEAD), file=table, flush=True)
        # The whole list of "equal" first: what is most wanted is there first.
        for first in (True, False):
            for case, variants in VARIANTS.items():
                if a.case not in (None, case):
                    continue
                for seed in range(1, a.seeds + 1):
                    wanted = [v for v in variants if (v == "equal") == first and (case, f"Yade {v}", str(seed)) not in done]
                    for program, numbers in compare(a.program, case, seed, wanted, a.out) if wanted else ():
                        row = (case, program.replace(",", ""), str(seed))
                        if row not in done:
                            done.add(row)
                            print(",".join([*row, *numbers]), file=table, flush=True)


main()
