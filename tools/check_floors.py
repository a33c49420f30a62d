#!/usr/bin/env python3
"""Checks that the floors hold: every include in src/ points to the same floor or a lower one.

Also: theory never meets a room that makes results, analysis never meets engine, report meets no room that makes results
(it reads records), a study prints nothing, calibration drives no engine, a law never meets another law nor a laboratory test
another test, rooms do not include each other in circles, every room has a namespace of its own, files are opened by
io/file.hpp alone, which waits for no pipe, what is no portable C++ is in the room of the system, and no line is longer than 110 characters. Prints every violation with file and line; exit 1 if any.
"""
import pathlib
import re
import sys

FLOORS = {
    "base": 0, "system": 0,
    "records": 1, "theory": 1, "laws": 1,
    "contact": 2,
    "engine": 3, "analysis": 3, "events": 3, "io": 3,
    "genesis": 4, "lab": 4, "statics": 4, "rock": 4,
    "study": 5, "report": 5,
    "survey": 6, "maps": 6, "calibrate": 6, "design": 6, "verdict": 6, "verification": 6,
    "jobs": 7,
    "cli": 8, "gui": 8, "python": 8,
}
MAKES_RESULTS = {"laws", "contact", "engine", "analysis", "genesis", "lab", "statics"}
NEVER = {("analysis", "engine"), ("analysis", "genesis"), ("events", "engine")}
NEVER |= {(room, "theory") for room in MAKES_RESULTS} | {("theory", room) for room in MAKES_RESULTS}
NEVER |= {("report", room) for room in MAKES_RESULTS | {"study"}}  # it reads records, whoever made them
NEVER |= {("study", "report"), ("maps", "calibrate"), ("maps", "survey"), ("survey", "calibrate"), ("calibrate", "engine"), ("calibrate", "contact"), ("calibrate", "report")}
LONERS = {"laws": "a law", "lab": "a laboratory test"}  # each in a folder of its own
COMMON = {"base", "records"}  # the vocabulary of all rooms: in phy itself, not in phy::<room>
OPENS_FILES = {"system/process_posix.cpp"}  # of the system: in /proc they have no size
# What is not portable C++: the room "system" alone includes it, and its headers for all do not.
OF_A_SYSTEM = re.compile(r"\s*#\s*include <(sys/|net/|netinet/|arpa/|linux/|(unistd|spawn|fcntl|poll|signal|csignal|sched|pthread|dirent|dlfcn|glob|netdb|"
                         r"pwd|termios|utime|windows|winsock2|io|process)(\.h)?>)|.*::(getpid|isatty|usleep|clock_gettime)\(")
MAX_LINE = 110
root = pathlib.Path(__file__).resolve().parent.parent / "src"
problems = []
edges = {}


def room_of(path):
    return path.parts[0]


def check_include(file, number, target):
    room, other = room_of(file), target.split("/")[0]
    where = f"src/{file}:{number}"
    if other not in FLOORS:
        return
    if FLOORS[other] > FLOORS[room]:
        problems.append(f"{where}: {room} (floor {FLOORS[room]}) includes {target} (floor {FLOORS[other]})")
    if (room, other) in NEVER:
        problems.append(f"{where}: {room} must never meet {other} ({target})")
    if room == other and room in LONERS and len(file.parts) == 3 and ".test." not in file.name:
        if target.count("/") == 2 and target.split("/")[1] != file.parts[1]:
            problems.append(f"{where}: {LONERS[room]} must never meet another ({target})")
    if room != other and ".test." not in file.name:
        edges.setdefault(room, {}).setdefault(other, where)


def check_namespace(file, number, line):
    room = room_of(file)
    home = "phy" if room in COMMON else f"phy::{room}"
    opened = re.match(r"(?:inline )?namespace (phy(?:::\w+)*)", line)
    if opened:
        name = opened.group(1)
        second = (name.split("::") + [""])[1]
        if not (name + "::").startswith(home + "::") or (room in COMMON and second in FLOORS):
            problems.append(f"src/{file}:{number}: opens namespace {name}; what {room} declares lives in {home}")
    if line.startswith("using namespace"):
        problems.append(f"src/{file}:{number}: a using-directive for the whole file; write the room before the name")


def check_opening(file, number, line):
    if str(file) in OPENS_FILES or re.search(r"\.test\.|_fixture\.", file.name):
        return
    if re.search(r"\bstd::[io]?fstream\b|\bfopen\(", line):
        problems.append(f"src/{file}:{number}: opens a file by itself; use io/file.hpp, which waits for no pipe")


def check_system(file, number, line):
    own = room_of(file) == "system" and (file.suffix == ".cpp" or file.name.endswith("_windows.hpp"))
    of_a_system = OF_A_SYSTEM.match(line) or "_windows.hpp\"" in line
    if not own and not re.search(r"\.test\.|_fixture\.", file.name) and of_a_system:
        problems.append(f"src/{file}:{number}: is not portable; what needs a header of the system belongs to src/system/*.cpp")


def check_circles():
    def visit(room, path):
        for other in edges.get(room, {}):
            if other in path:
                circle = path[path.index(other):] + [other]
                problems.append("rooms include each other in a circle: " + " -> ".join(circle))
                return
            visit(other, path + [other])

    for room in edges:
        visit(room, [room])


for file in sorted(root.rglob("*.[ch]pp")):
    relative = file.relative_to(root)
    if room_of(relative) not in FLOORS:
        problems.append(f"src/{relative}: room {room_of(relative)} has no floor; add it to tools/check_floors.py")
        continue
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if len(line) > MAX_LINE:
            problems.append(f"src/{relative}:{number}: {len(line)} characters, at most {MAX_LINE}")
        check_namespace(relative, number, line)
        check_opening(relative, number, line)
        check_system(relative, number, line)
        include = re.match(r'\s*#include "([^"]+)"', line)
        if include:
            check_include(relative, number, include.group(1))
check_circles()
print("\n".join(sorted(set(problems))) or "floors hold")
sys.exit(1 if problems else 0)
