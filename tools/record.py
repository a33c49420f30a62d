#!/usr/bin/env python3
"""Writes the numbers of tests/recorded.txt anew, as the tests of a build get them, and the reason into CHANGELOG.md.

Usage: record.py BUILD "REASON" (make record REASON="why the numbers change").
"""
import os
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
TESTS = [("test_lab", "LaboratoryTests.*"), ("test_genesis", "Packing.BitsDoNot*"), ("test_x_determinism", "GoldenHashes.AreTheRecordedOnes")]


def values(text):
    return dict(line.split() for line in text.splitlines() if line.strip())


def main():
    if len(sys.argv) != 3 or len(sys.argv[2].split()) < 3:
        sys.exit('record: say why in a few words: make record REASON="the order of sums over contacts"')
    build, reason = pathlib.Path(sys.argv[1]), sys.argv[2].strip()
    with tempfile.TemporaryDirectory() as folder:
        noted = pathlib.Path(folder) / "noted"
        for test, which in TESTS:
            subprocess.run([build / test, "--gtest_filter=" + which], check=True, stdout=subprocess.DEVNULL,
                           env=os.environ | {"PHY_RECORD": str(noted)})
        now = values(noted.read_text())
    file = root / "tests/recorded.txt"
    before = values(file.read_text())
    changed = sorted(name for name in before.keys() | now.keys() if before.get(name) != now.get(name))
    if not changed:
        print("record: every number is as recorded")
        return
    file.write_text("".join(f"{name} {value}\n" for name, value in sorted(now.items())))
    groups = [f"{name} ({sum(c.startswith(name) for c in changed)})" for name in sorted({c.split("/")[0] + "/" for c in changed})]
    log = root / "CHANGELOG.md"
    head, numbers, rest = log.read_text().partition("### Changes numbers\n")  # of the first section
    entries, gap, others = rest.partition("\n###")
    line = f"- Recorded numbers ({', '.join(groups)}): {reason}\n"
    log.write_text(head + numbers + entries + line + gap + others)
    print("record: " + ", ".join(changed) + "; the reason stands in CHANGELOG.md")


main()
