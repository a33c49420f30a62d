#!/usr/bin/env python3
"""Runs the program for browsers in node, beside the one of this machine, by the checks of windows_check.py.

Usage: browser_check.py [CHECK...]. Without names: every check. `make browser-check` runs it.
"""
import subprocess
import sys
import tempfile
import pathlib

import windows_check

ROOT = windows_check.ROOT
CHECKS = ("hash", "run", "tables", "calibrate", "speed")


class Bench(windows_check.Bench):
    isas, slowest = ("sse2",), 1.3

    def begin(self, *words, where=None, isa=None, **more):  # it knows no other than SSE2
        words = ["node", str(ROOT / "packaging/browser/command.cjs"), str(self.build), *words]
        return subprocess.Popen(words, cwd=where or self.folder, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, encoding="utf-8", **more)


def main():
    with tempfile.TemporaryDirectory(prefix="phyllite-browser-") as folder:
        bench = Bench(ROOT / "build/browser", ROOT / "build/release/phyllite", pathlib.Path(folder), short=False)
        return windows_check.run_checks(bench, sys.argv[1:] or CHECKS, "browser-check")


if __name__ == "__main__":
    sys.exit(main())
