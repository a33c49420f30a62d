#!/usr/bin/env python3
"""Runs the program for browsers in node, beside the one of this machine, by the checks of windows_check.py.

Usage: browser_check.py [CHECK...]. Without names: every check. `make browser-check` runs it.
"""
import sys
import tempfile
import pathlib

import windows_check

ROOT = windows_check.ROOT
CHECKS = ("hash", "run", "tables", "calibrate", "speed")


class Bench(windows_check.Bench):
    isas, slowest = ("sse2",), 1.3  # it knows no other instruction set

    def command(self):
        return ["node", ROOT / "packaging/browser/command.cjs", self.build]


def main():
    with tempfile.TemporaryDirectory(prefix="phyllite-browser-") as folder:
        bench = Bench(ROOT / "build/browser", ROOT / "build/release/phyllite", pathlib.Path(folder), short=False)
        return windows_check.run_checks(bench, sys.argv[1:] or CHECKS, "browser-check")


if __name__ == "__main__":
    sys.exit(main())
