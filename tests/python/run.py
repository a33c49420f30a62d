"""Runs all tests of this folder. Skipped ones are told as the other tests tell them (.ci/run reads it), and count as
failures where PHY_ALL_TOOLS says that every tool is there."""
import os
import pathlib
import sys
import tempfile
import unittest


def main():
    here = pathlib.Path(__file__).resolve().parent
    sys.path.insert(0, str(here))
    with tempfile.TemporaryDirectory() as folder:
        os.environ.setdefault("XDG_CACHE_HOME", folder)
        os.environ["MPLCONFIGDIR"] = folder
        os.chdir(folder)
        tests = unittest.defaultTestLoader.discover(str(here), pattern="test_*.py" if len(sys.argv) < 2 else sys.argv[1])
        result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(tests)
        os.chdir(here)
    for test, reason in result.skipped:
        print(f"{test.id()}: Skipped\n{reason}\n[  SKIPPED ] {test.id()} (0 ms)")
    sys.exit(0 if result.wasSuccessful() and not (result.skipped and os.environ.get("PHY_ALL_TOOLS")) else 1)


if __name__ == "__main__":  # a test starts another process, which reads this file again
    main()
