"""Rows of measured/NAME.csv: one per measurement, with what it was made on and by. Commands that measure add theirs here."""
import csv
import datetime
import os
import pathlib
import platform
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
COLUMNS = ["claim", "value", "unit", "interval", "n", "machine", "commit", "date", "command"]


def rows_of(name):
    with open(ROOT / "measured" / f"{name}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def row(claim, value, unit="", interval="", n=""):
    return {"claim": claim, "value": str(value), "unit": unit, "interval": interval, "n": str(n)}


def machine():
    """Processor and number of its cores that this process may use."""
    found = re.search(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M)
    return f"{found[1] if found else platform.machine()}, {len(os.sched_getaffinity(0))} cores"


def commit():
    done = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip()


def add(name, rows, command):
    """Appends rows that were measured now. A value that is already the last one of its claim is not written again."""
    last = {r["claim"]: r for r in rows_of(name)}
    now = {"machine": machine(), "commit": commit(), "date": datetime.date.today().isoformat(), "command": command}
    new = [{**r, **now} for r in rows]
    new = [r for r in new if any(r[k] != last.get(r["claim"], {}).get(k) for k in ("value", "unit", "interval", "n"))]
    with open(ROOT / "measured" / f"{name}.csv", "a", encoding="utf-8", newline="") as file:
        csv.DictWriter(file, COLUMNS, lineterminator="\n").writerows(new)
    return len(new)
