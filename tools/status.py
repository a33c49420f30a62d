#!/usr/bin/env python3
"""Writes docs/status.md from measured/*.csv (make docs): what is claimed, the goal, the latest value, whether it holds, where its history is.

Usage: status.py [--check]. `--check` compares instead, and ends with 1 where the page is not what these tables say.

measured/claims.csv lists claims in the order of the page: section, claim, goal, file, page. measured/FILE.csv has a row per measurement:
claim, value, unit, interval, n, machine, commit, date, command. The latest row with a value counts, the lower one of a day. A goal is
`<= 3 %`, `>= 8 of 10`, `88 - 100 %` or a word such as `equal`; whether it holds is computed here.
"""
import csv
import re
import sys

from measured import COLUMNS, ROOT, rows_of

HEAD = """# Status: goals and measurements

Written by `tools/status.py` from the tables in `measured`. Each row links to its file, which has machine, date, command and every earlier value.
A value is the latest one. The interval behind it is a range over runs, or the 95 % interval where it has a sign.
Synthetic means: this program made the table from known parameters. Measured rocks have a [page](rocks.md) of their own.
One run is not a measurement: other packings and bond seeds scatter by a few per cent.

**{n_met} of {n_goals} goals are met.** Rows without a goal are measurements that somebody may ask for.

"""


def number(text):
    found = re.match(r"[-+]?[\d.]+(?:e[-+]?\d+)?", text)
    return float(found[0]) if found else None


def holds(goal, value, unit):
    """"yes", "no", "open" where nobody has run it, or "" where there is no goal. A signed value counts by its size against an upper limit."""
    if not goal:
        return ""
    if value == "not run":
        return "open"
    if limit := re.fullmatch(r"(<=|>=) ([\d.]+)(?: (.*))?", goal):
        if not (limit[3] or "").startswith("of ") and (limit[3] or "") != unit:
            raise ValueError(f"the goal {goal} and a value in {unit or '1'}")
        measured = number(value)
        return "yes" if (abs(measured) <= float(limit[2]) if limit[1] == "<=" else measured >= float(limit[2])) else "no"
    if limits := re.fullmatch(r"([\d.]+) - ([\d.]+)(?: %)?", goal):
        return "yes" if float(limits[1]) <= number(value) <= float(limits[2]) else "no"
    return "yes" if value == goal else "no"


def page():
    claims, text, section, met = rows_of("claims"), [], None, []
    tables = {name: rows_of(name) for name in {c["file"] for c in claims}}
    for c in claims:
        measured = [r for r in tables[c["file"]] if r["claim"] == c["claim"] and r["value"]]
        if not measured:
            raise ValueError(f"measured/{c['file']}.csv: nothing was measured of \"{c['claim']}\"")
        last = max(enumerate(measured), key=lambda r: (r[1]["date"], r[0]))[1]
        if c["section"] != section:
            section = c["section"]
            text.append(f"\n## {section}\n\n| claim | goal | value | holds | data | more |\n|---|---|---|---|---|---|\n")
        unit = "" if last["unit"] == "%" and last["value"].endswith("%") else last["unit"]
        value = f"{last['value']} {unit}".strip()
        if last["interval"]:
            value += f" ({last['interval']})"
        more = f"[page]({c['page']})" if c["page"] else ""
        met.append(holds(c["goal"], last["value"], last["unit"]))
        text.append(f"| {c['claim']} | {c['goal']} | {value} | {met[-1]} "
                    f"| [{c['file']}](../measured/{c['file']}.csv) | {more} |\n")
    head = HEAD.format(n_met=met.count("yes"), n_goals=len(met) - met.count(""))
    return (head + "".join(text)).replace("\n\n\n", "\n\n")


def faults():
    """What is wrong with the tables themselves."""
    known = {(c["file"], c["claim"]) for c in rows_of("claims")}
    if len(known) != len(rows_of("claims")):
        yield "measured/claims.csv: a claim stands there twice"
    for path in sorted((ROOT / "measured").glob("*.csv")):
        if path.stem == "claims":
            continue
        with open(path, encoding="utf-8", newline="") as file:
            head, *rows = csv.reader(file)
        if head != COLUMNS:
            yield f"{path.name}: expected the columns {', '.join(COLUMNS)}"
        for line, row in enumerate(rows, 2):
            if len(row) != len(COLUMNS):
                yield f"{path.name}:{line}: {len(row)} cells instead of {len(COLUMNS)}"
            elif not re.fullmatch(r"20\d\d-\d\d-\d\d", row[7]) or not (row[1] or row[3]):
                yield f"{path.name}:{line}: expected a date, and a value or an interval"


def main(arguments):
    found = list(faults())
    target = ROOT / "docs/status.md"
    if not found and "--check" in arguments and target.read_text(encoding="utf-8") != page():
        found.append("docs/status.md is not what measured/*.csv say; tools/status.py writes it")
    for text in found:
        print(text)
    if not found and "--check" not in arguments:
        target.write_text(page(), encoding="utf-8")
    return len(found) > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
