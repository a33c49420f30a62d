#!/usr/bin/env python3
"""Runs the program for 64-bit ARM under qemu, beside the one of this machine, by the checks of windows_check.py.

Usage: aarch64_check.py [CHECK...]. Without names: every check. `make aarch64-check` runs it.
"""
import pathlib
import sys
import tempfile

import windows_check

ROOT = windows_check.ROOT
CHECKS = ("hash", "run", "tables", "calibrate")


class Bench(windows_check.Bench):
    isas = ("portable",)  # vectors of 16 bytes, as the compiler has them

    def command(self):
        return ["qemu-aarch64", self.build / "phyllite"]


def main():
    with tempfile.TemporaryDirectory(prefix="phyllite-aarch64-") as folder:
        bench = Bench(ROOT / "build/aarch64", ROOT / "build/release/phyllite", pathlib.Path(folder), short=True)
        return windows_check.run_checks(bench, sys.argv[1:] or CHECKS, "aarch64-check")


if __name__ == "__main__":
    sys.exit(main())
