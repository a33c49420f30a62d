#!/usr/bin/env python3
"""Is every number of one calibration also in another, to the bit?   compare_calibrations.py BEFORE AFTER [--without PATTERN]

BEFORE and AFTER are files calibration.json, or folders that hold one. Numbers are matched by what they are: those of a
parameter by its key, those of a cell of the table by property, angle, confining stress and diameter, whatever their order.
Words are not compared, for they may be bettered, but those that name a choice or a result (CHOICES) are. The shape of the
file is known in one place, the three tables below: where it changes, the new name goes into RENAMED beside the old one.
What AFTER alone has is counted; a value that differs or is missing in AFTER is printed, and the exit code is 1.
"""
import argparse
import json
import pathlib
import re
import sys

# What an element of a list is known by; one that has none of these is known by its place.
IDENTITY = ("kind", "key", "property", "theta [deg]", "confining [Pa]", "diameter [m]", "of", "planes")
# Texts that are results and no words.
CHOICES = re.compile(r"(verdict\.status|method|effort|E_is|layers|matrix|rock|rests_on|unit)$")
# Names of an earlier shape -> names of the present one, as regular expressions of whole paths, applied in turn.
RENAMED = []
# Not a result: versions, and texts laid out as rows.
NO_RESULT = re.compile(r"format|program\.|tables\b|methods\b|verdict\.(sentence|lines)\b|.*\.text$")


def identity(element, place):
    if not isinstance(element, dict):
        return str(place)
    names = [f"{name} {element[name]:g}" if isinstance(element[name], (int, float)) else str(element[name])
             for name in IDENTITY if name in element]
    return ", ".join(names) or str(place)


def leaves(value, path=""):
    """Every value that is no list and no object, with what it is."""
    if isinstance(value, dict):
        for name, inner in value.items():
            if not (path.endswith("]") and name in IDENTITY):
                yield from leaves(inner, f"{path}.{name}" if path else name)
    elif isinstance(value, list):
        seen = {}
        for place, inner in enumerate(value):
            name = identity(inner, place)
            seen[name] = seen.get(name, 0) + 1
            yield from leaves(inner, f"{path}[{name}]" + (f"#{seen[name]}" if seen[name] > 1 else ""))
    else:
        yield path, value


def values_of(file):
    path = pathlib.Path(file)
    if path.is_dir():
        path /= "calibration.json"
    values = {}
    for name, value in leaves(json.loads(path.read_text())):
        for old, new in RENAMED:
            name = re.sub(f"^(?:{old})$", new, name)
        if not NO_RESULT.match(name) and (not isinstance(value, str) or CHOICES.search(name)):
            values[name] = value
    return values


def same(a, b):
    if isinstance(a, bool) or isinstance(b, bool) or not isinstance(a, (int, float)) or not isinstance(b, (int, float)):
        return type(a) is type(b) and a == b
    return float(a).hex() == float(b).hex()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--without", metavar="PATTERN", help="leave out values whose name matches this regular expression")
    args = parser.parse_args()
    try:
        before, after = values_of(args.before), values_of(args.after)
    except (OSError, ValueError) as error:
        sys.exit(f"compare_calibrations: {error}")
    wanted = [name for name in before if not (args.without and re.search(args.without, name))]
    if not wanted:
        sys.exit(f"compare_calibrations: {args.before} holds no value to compare")
    different = [f"{name}: {before[name]!r}, then {after[name]!r}" if name in after else f"{name}: {before[name]!r}, then missing"
                 for name in wanted if name not in after or not same(before[name], after[name])]
    print("\n".join(different + [f"{len(wanted)} values compared, {len(different)} differ; "
                                 f"{sum(name not in before for name in after)} in {args.after} alone"]))
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
