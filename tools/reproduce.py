#!/usr/bin/env python3
"""Runs the studies that a document is written from, then writes it:   reproduce.py paper|evidence|reliability PROGRAM

Results go to results/DOCUMENT and are resumed there. A study that holds a test without a peak ends with 1, which is a
finding; what ends with more stops here.
"""
import pathlib
import re
import subprocess
import sys

STUDIES = {
    "paper": "study study-no-jump study-small study-small-jump study-small-crossing study-crossing study-choices study-area "
             "elastic elastic-crossing elastic-area elastic-area-crossing",
    "evidence": "joint-patches joint-bonded joint-frictional joint-stiffness lac-du-bonnet-ucs lac-du-bonnet-bts "
                "lac-du-bonnet-jaws lac-du-bonnet-confined resolution-ucs resolution-ucs-large resolution-ucs-largest "
                "resolution-fast resolution-bts resolution-bts-large speed time-step",
    "reliability": "compression tension brazilian confined packing resolution shear poisson",
}
WHOLE_BODIES = ("V25", "V26", "V27", "V28", "V29", "V30")  # cases of `phyllite verify` in docs/evidence.md


def run(*command, may_find=False):
    code = subprocess.run([str(word) for word in command]).returncode
    if code > (1 if may_find else 0):
        sys.exit(f"reproduce: {' '.join(map(str, command))} ended with {code}")


def measure_bodies(program, results):
    joint = pathlib.Path("examples/evidence/joint.toml").read_text()
    for seed in range(1, 6):  # the same joint through other grains
        recipe = results / f"joint-packing-{seed}.toml"
        recipe.write_text(re.sub(r"^(n_grains.*)$", rf"\1\nseed = {seed}", joint, flags=re.MULTILINE))
        run(program, "specimen", recipe, "--out", recipe.with_suffix(""))
    for case in WHOLE_BODIES:
        (results / f"{case}.txt").write_text(subprocess.run([program, "verify", case], check=True, text=True,
                                                            capture_output=True).stdout)


def main():
    document, program = sys.argv[1:]
    results = pathlib.Path("results") / document
    for study in STUDIES[document].split():
        run(program, "study", f"examples/{document}/{study}.toml", "--out", results / study.removeprefix("study-"), may_find=True)
    if document == "evidence":
        measure_bodies(program, results)
    page = "docs/reliability-tables.md" if document == "reliability" else "docs"
    run(sys.executable, f"tools/{document}.py", results, page)


if __name__ == "__main__":
    main()
