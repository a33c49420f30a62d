#!/usr/bin/env python3
"""make fuzz: every reader of tests/fuzz under libFuzzer for as many minutes of CPU; ends with 1 where one has a finding.

usage: fuzz.py BUILD MINUTES [READER...]     (no READER: all)

What was found useful stays in BUILD/corpus/READER and is where the next call begins; inputs that break a reader lie in
BUILD/found. Minutes count the processor's time, so that a busy machine gives no shorter search."""
import os
import re
import resource
import subprocess
import sys

import measured

SLICE = 60  # s of the clock between two looks at the processor's
LIMITS = ["-timeout=20", "-len_control=0", "-rss_limit_mb=3072", "-malloc_limit_mb=1024", "-print_final_stats=1"]


def cpu_minutes():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (used.ru_utime + used.ru_stime) / 60


def fuzz(build, reader, minutes):
    """Runs one reader. (minutes, executions, inputs kept, ok)"""
    corpus, found = f"{build}/corpus/{reader}", f"{build}/found/{reader}-"
    os.makedirs(corpus, exist_ok=True)
    os.makedirs(os.path.dirname(found), exist_ok=True)
    begin, executions = cpu_minutes(), 0
    while cpu_minutes() - begin < minutes:
        left = max(1, min(SLICE, int(60 * (minutes - cpu_minutes() + begin))))
        with open(f"{build}/{reader}.log", "w", encoding="utf-8", errors="replace") as log:
            code = subprocess.call([f"{build}/fuzz", reader, f"-max_total_time={left}", f"-artifact_prefix={found}",
                                    *LIMITS, corpus, f"tests/fuzz/seeds/{reader}"], stdout=log, stderr=log)
        text = open(log.name, encoding="utf-8", errors="replace").read()
        units = re.search(r"stat::number_of_executed_units:\s*(\d+)", text)
        executions += int(units[1]) if units else 0
        if code != 0:
            print(text[-4000:])
            break
    else:
        code = 0
    return cpu_minutes() - begin, executions, len(os.listdir(corpus)), code == 0


def main():
    build, minutes = sys.argv[1], float(sys.argv[2])
    readers = sys.argv[3:] or subprocess.run([f"{build}/fuzz"], capture_output=True, text=True).stdout.split()
    broken, rows = [], []
    for reader in readers:
        used, executions, kept, ok = fuzz(build, reader, minutes)
        print(f"{reader:<12} {used:6.1f} min of CPU {executions:>10} inputs {kept:>6} kept  "
              f"{'nothing' if ok else 'FOUND: see ' + build + '/found'}", flush=True)
        rows.append(measured.row(f"fuzz, {reader}: inputs", executions, n=f"{used:.0f} min of CPU"))
        if not ok:
            broken.append(reader)
    measured.add("fuzz", rows, "make fuzz")
    if len(rows) > 12:  # all of them, not one that somebody looks at
        measured.add("robustness", [measured.row("fuzzing: open faults", len(broken), n=f"{len(rows)} readers")], "make fuzz")
    sys.exit(1 if broken else 0)


main()
