#!/usr/bin/env python3
"""make coverage: share of lines that the tests run, room by room; ends with 1 where a room of AT_LEAST has less.

usage: coverage.py BUILD     (a build with --coverage, after its tests)"""
import collections
import json
import subprocess
import sys

import measured

AT_LEAST = {room: 90.0 for room in ("base", "laws", "contact", "theory", "analysis", "io", "calibrate")}


def main():
    build = sys.argv[1]
    report = f"{build}/coverage.json"
    # Lines that only the tests have, and the branches that exceptions add, say nothing of the program. Counters without
    # locks lose a count now and then where threads meet, and what gcov derives from them may be negative.
    subprocess.run(["gcovr", "--root", ".", "--object-directory", build, "--filter", "src/", "--exclude", r".*\.test\.cpp",
                    "--exclude", r".*_fixture\.hpp", "--gcov-ignore-parse-errors", "--json-summary", report, build], check=True)
    rooms, files = collections.defaultdict(lambda: [0, 0]), json.load(open(report, encoding="utf-8"))["files"]
    for file in files:
        room = rooms[file["filename"].split("/")[1]]
        room[0] += file["line_covered"]
        room[1] += file["line_total"]
    short, least = [], 100.0
    for name, (covered, total) in sorted(rooms.items()):
        share = 100.0 * covered / total
        least = min(least, share)
        print(f"{name:<14}{covered:>7} of {total:>6} lines  {share:5.1f} %")
        if share < AT_LEAST.get(name, 0.0):
            short.append(name)
    for name in short:
        print(f"{name}: below {AT_LEAST[name]:g} %; least in")
        worst = sorted((f for f in files if f["filename"].split("/")[1] == name and f["line_total"]),
                       key=lambda f: f["line_covered"] - f["line_total"])[:8]
        for file in worst:
            print(f"  {file['filename']}: {file['line_total'] - file['line_covered']} lines never run")
    measured.add("builds", [measured.row("lines that tests run, least room", f"{least:.2f}", "%")], "make coverage")
    sys.exit(1 if short else 0)


main()
