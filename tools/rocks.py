#!/usr/bin/env python3
"""Calibrates every rock of data/rocks and writes what came of it (`make rocks`).

    python3 tools/rocks.py PROGRAM [--only NAME ...] [--effort quick] [--seeds 1] [--write-only]

data/rocks/plan.toml says what is run: seeds, efforts, predictions. Folders of results/rocks are resumed: what is finished and of the same
table, plan and program is not run again; of another program every calibration is gone through again, with the tests of its store where they are
the same. A changed rock.toml, table or plan of a rock begins its folder anew. Then come
data/rocks/NAME/card.json and calibrated.toml, data/rocks/forecasts.csv, docs/rocks.md, docs/boryeong.md and measured/rocks.csv. --effort and --seeds are for trials:
what they write lies in results/rocks/trial. --write-only runs nothing.
"""
import argparse
import concurrent.futures
import csv
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import tomllib

import measured
import rocks_pages
import rocks_record
from rocks_card import card_of, clean

ROOT = measured.ROOT
BASE = ROOT / "data/rocks"


def digest(*parts):
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def program_now():
    """What the results of this program hang on: its sources. The program itself also holds the cards, which are written here."""
    files = [p for p in sorted((ROOT / "src").rglob("*")) if p.suffix in (".cpp", ".hpp", ".def") and not p.name.endswith(".test.cpp")]
    return digest(*(p.read_text(encoding="utf-8") for p in files + sorted((ROOT / "data/maps").glob("*.csv"))))


def rows_without(text, prediction):
    """A table without the rows and columns that are predicted."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    for column, value in prediction.get("without_rows", {}).items():
        rows = [r for r in rows if r[column] != value]
    names = [n for n in rows[0] if n not in prediction.get("without_columns", [])]
    return "\n".join([",".join(names)] + [",".join(r[n] for n in names) for r in rows]) + "\n"


class Run:
    """One calibration: the files of its rock, its folder, its command."""

    def __init__(self, folder, name, seed, options, prediction=None):
        self.folder, self.seed, self.options = folder, seed, options
        self.result = folder / "calibration/calibration.json"
        rock = (BASE / name / "rock.toml").read_text(encoding="utf-8")
        source = BASE / name / re.search(r'^data = "(.*)"', rock, re.M)[1]
        self.table = source.read_text(encoding="utf-8")
        if prediction:
            self.table = rows_without(self.table, prediction)
        rock = re.sub(r'^data = ".*"', f'data = "table.csv"\nfirst_packing = {seed}', rock, flags=re.M)
        if prediction and prediction["model"] != "choose":
            rock = re.sub(r"^(name = .*)$", rf'\1\nlayers = "{prediction["model"]}"', rock, flags=re.M)
        self.rock = rock

    def command(self, program):
        out = self.folder / "calibration"
        words = [program, "--threads", "1", "calibrate", self.folder / "rock.toml", "--out", out, *self.options]
        return words + (["--resume"] if (out / "request.toml").exists() else [])

    def prepare(self):
        if begin(self.folder, digest(self.rock, self.table, *self.options)):
            (self.folder / "rock.toml").write_text(self.rock, encoding="utf-8")
            (self.folder / "table.csv").write_text(self.table, encoding="utf-8")

    def perform(self, program, now):
        self.prepare()
        command = self.command(program)
        code = timed(command, self.folder, self.result, now)
        if code == 2 and "--resume" in command:  # begun by a program that asked another question
            shutil.rmtree(self.folder)
            self.prepare()
            timed(self.command(program), self.folder, self.result, now)


class Study:
    """One study of a model that is set by hand: its tests as a table."""

    def __init__(self, folder, name, file):
        self.folder, self.options = folder, []
        self.source = BASE / name / file
        self.result = folder / "specimens.csv"

    def perform(self, program, now):
        recipe = re.search(r'^recipe = "(.*)"', self.source.read_text(encoding="utf-8"), re.M)[1]
        begin(self.folder, digest(*(p.read_text(encoding="utf-8") for p in (self.source, self.source.parent / recipe))))
        out = self.folder / "study"
        timed([program, "--threads", "1", "study", self.source, "--out", out], self.folder, out / "results.csv", now)
        subprocess.run([program, "study", "export", out, "--csv", self.result], check=True, cwd=ROOT)


def begin(folder, asked):
    """What lies there stays where the same was asked, table and plan or study; else the folder begins anew. Was it begun?"""
    stamp = folder / "asked"
    if stamp.exists() and stamp.read_text() == asked:
        return False
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    stamp.write_text(asked)
    return True


def timed(command, folder, result, now):
    """Runs a command, once for what the program is now: its output in folder/log, its seconds of CPU in folder/cpu. Exit code."""
    mark, seconds, before = folder / "done", folder / "cpu", time.time()
    if mark.exists() and mark.read_text().startswith(now):
        return int(mark.read_text().split()[1])
    with open(folder / "log", "a", encoding="utf-8") as log:
        child = subprocess.Popen([str(word) for word in command], cwd=ROOT, stdout=log, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    spent = float(seconds.read_text()) if seconds.exists() else 0.0
    seconds.write_text(f"{spent + usage.ru_utime + usage.ru_stime:.1f}\n")
    # 1 is a finding such as "out of reach" where the result was written, else a stop; 2: nothing can be made of the input.
    written = result.exists() and result.stat().st_mtime >= before - 1
    if child.returncode in (0, 2) or child.returncode == 1 and written:
        mark.write_text(f"{now} {child.returncode}")
    return child.returncode


def test_of(prediction, sigma_3):
    test = {"kind": f'"{prediction["test"]}"', "n_frames": "0", "n_snapshots": "0"}
    if prediction["test"] == "biaxial":
        return test | {"confining_stress": f'"{sigma_3} MPa"', "pre_strain": "0"}
    return test | {"platen_speed": '"0.01 m/s"'}  # tension ends at a fraction of the strain


def predict(prediction, run, program, now):
    """The tests of a prediction on every draw of a calibration; the folders of their bands by confining stress."""
    found = {}
    for sigma_3 in prediction.get("confining", [0]):
        folder = run.folder / f"{prediction['name']}-{sigma_3}"
        (folder / "draws").mkdir(parents=True, exist_ok=True)
        shutil.copytree(run.folder / "calibration/ensemble", folder / "draws/ensemble", dirs_exist_ok=True)
        shutil.copy(run.folder / "calibration/calibration.json", folder / "draws")  # what the model misses of the table
        recipe = (run.folder / "calibration/calibrated.toml").read_text(encoding="utf-8")
        before, rest = recipe.split("\n[test]\n", 1)
        for key, value in test_of(prediction, sigma_3).items():
            rest = re.sub(rf"^{key} = .*$", f"{key} = {value}", rest, count=1, flags=re.M)
        (folder / "draws/calibrated.toml").write_text(f"{before}\n[test]\n{rest}", encoding="utf-8")
        timed([program, "--threads", "1", "run", folder / "draws/calibrated.toml", "--ensemble", "--out", folder / "out"],
              folder, folder / "out/band.csv", now)
        found[sigma_3] = folder
    return found


def options_of(plan, name, effort):
    rock = plan["rock"][name]
    if rock.get("elastic"):
        return ["--elastic"]
    return ["--effort", effort or rock.get("effort", plan["effort"])]


class Work:
    """Everything that the plan asks for, by rock: calibrations by seed, then predictions."""

    def __init__(self, plan, names, seeds, effort, results):
        self.results = results
        seeds_of = lambda entry: seeds or entry.get("seeds", plan["seeds"])
        calibrations = lambda n: [Run(results / n / str(s), n, s, options_of(plan, n, effort)) for s in seeds_of(plan["rock"][n])]
        study = lambda n: plan["rock"][n].get("study")
        self.runs = {n: [Study(results / n / "study", n, study(n))] if study(n) else calibrations(n) for n in names}
        self.predictions = []
        for p in plan["prediction"]:
            if p["rock"] not in names:
                continue
            if p["model"] == "study":
                self.predictions.append((p, []))  # read off the study itself
                continue
            own = not (p.keys() & {"without_rows", "without_columns"}) and p["model"] == "choose"
            runs = self.runs[p["rock"]] if own else [
                Run(results / p["name"] / str(s), p["rock"], s, options_of(plan, p["rock"], effort), p) for s in seeds_of(p)]
            self.predictions.append((p, runs))

    def calibrations(self):
        """Longest first: the last ones of a pool should be short."""
        all_runs = [r for runs in self.runs.values() for r in runs]
        all_runs += [r for _, runs in self.predictions for r in runs if r not in all_runs]
        return sorted(all_runs, key=lambda r: ("normal" not in r.options, "quick" not in r.options))

    def do(self, program, workers):
        now = program_now()
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            try:
                self.finish({pool.submit(r.perform, program, now): r.folder for r in self.calibrations()}, "calibrations")
                self.finish({pool.submit(predict, p, r, program, now): r.folder for p, runs in self.predictions for r in runs
                             if r.result.exists()}, "predictions")
            except KeyboardInterrupt:
                pool.shutdown(cancel_futures=True)  # what runs has had its Ctrl-C
                sys.exit("rocks: stopped; `make rocks` goes on")

    def finish(self, tasks, what):
        for n, task in enumerate(concurrent.futures.as_completed(tasks), 1):
            task.result()
            print(f"rocks: {n} of {len(tasks)} {what}; {tasks[task].relative_to(self.results)}", flush=True)


def write_rock(folder, card, run):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "card.json").write_text(json.dumps(clean(card), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    model = run.folder / "calibration/calibrated.toml"
    if model.exists():
        shutil.copyfile(model, folder / "calibrated.toml")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--effort", default="")
    parser.add_argument("--seeds", type=int, nargs="+", default=[])
    parser.add_argument("--workers", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--write-only", action="store_true")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "results/rocks")
    args = parser.parse_args()
    results = args.results.resolve()
    plan = tomllib.loads((BASE / "plan.toml").read_text(encoding="utf-8"))
    if unknown := set(args.only) - plan["rock"].keys():
        sys.exit(f"rocks: not in data/rocks/plan.toml: {', '.join(sorted(unknown))}")
    names = [n for n in plan["rock"] if not args.only or n in args.only]
    work = Work(plan, names, args.seeds, args.effort, results)
    if not args.write_only:
        work.do(args.program, args.workers)
    target = results / "trial" if args.effort or args.seeds else ROOT
    for name in names:
        card = card_of(BASE / name, work.runs[name], [x for x in work.predictions if x[0]["rock"] == name])
        write_rock(target / "data/rocks" / name, card, work.runs[name][0])
    rocks_record.write(target / "data/rocks/forecasts.csv", work.runs)
    rocks_pages.write(target, plan, args.program, results)


if __name__ == "__main__":
    main()
