#!/usr/bin/env python3
"""Checks what one can read in one go: functions of at most 40 lines and 5 parameters, units that form no circle, findings
that tests hold by kind and number instead of by English, comments that say why.

A table of texts may be longer. A unit is a header with its body. Words are pinned by the tests of words alone (PINS_WORDS),
messages about the user's input wherever they are made. The share of comments is one of code lines in bodies, trailing
comments too, room by room. Prints every violation with file and line.
"""
import collections
import pathlib
import re
import sys

import cpp_text

REPORTED = {"comments per line of code in bodies"}  # not every room has its share yet: a warning; all else fails
MAX_LINES = 40
MAX_PARAMETERS = 5
MIN_COMMENTS = 0.12
FINDS = {"calibrate", "maps", "survey", "verdict", "report"}  # rooms whose results are data
# Tests of words, and of texts in the language of another program.
PINS_WORDS = re.compile(r"((calibration_)?(tables|files|summary)|words\w*|methods|pfc_\w+|yade\w*|figures|terminal_plot|gnuplot\w*|page)\.test\.cpp$")
ASSERTS = re.compile(r"\b(?:HasSubstr|StartsWith|EndsWith|ContainsRegex|MatchesRegex|contains|find|rfind|starts_with|ends_with"
                     r"|StrEq|Eq|EXPECT_EQ|ASSERT_EQ|EXPECT_NE|npos)\b")
SENTENCE = re.compile(r'"(?:\\.|[^"\\\n])*?\b[a-z]{2,},? [a-z]{2,}\b(?:\\.|[^"\\\n])*"')
OF_INPUT = re.compile(r"what\(\)|InputError|problem|message|SCOPED_TRACE|<<")
source = pathlib.Path(__file__).resolve().parent.parent / "src"


def is_test(path):
    return ".test." in path.name


def check_functions(path, text, say):
    given = "namespace std {" in text  # the library says what its functions take
    for f in cpp_text.functions(text):
        if f.length() > MAX_LINES and not f.is_table_of_text():
            say(path, f.line, f"{f.name}: {f.length()} lines, at most {MAX_LINES}")
        if f.parameters > MAX_PARAMETERS and not given:
            say(path, f.line, f"{f.name}: {f.parameters} parameters, at most {MAX_PARAMETERS}, or a struct")


def check_english(path, text, say):
    if not is_test(path) or path.parts[0] not in FINDS or PINS_WORDS.search(path.name):
        return
    start = 0
    code = cpp_text.code_of(text)
    for end in [m.start() for m in re.finditer("[;{}]", code)] + [len(code)]:
        statement = text[start:end]
        sentence = SENTENCE.search(statement)
        if sentence and ASSERTS.search(statement) and not OF_INPUT.search(statement):
            say(path, text.count("\n", 0, start + sentence.start()) + 1, f"asserts English: {sentence.group(0)}")
        start = end + 1


def unit(path):
    return re.sub(r"\.[ch]pp$", "", str(path))


def check_circles(includes, say):
    """Tarjan's strongly connected components of the units."""
    index, low, stack = {}, {}, []

    def visit(u):
        index[u] = low[u] = len(index)
        stack.append(u)
        for v in sorted(includes[u]):
            if v not in index:
                visit(v)
            low[u] = min(low[u], low[v]) if v in stack else low[u]
        if low[u] == index[u]:
            circle = stack[stack.index(u):]
            del stack[stack.index(u):]
            if len(circle) > 1:
                say(pathlib.Path(u + ".hpp"), 1, "units include each other in a circle: " + ", ".join(sorted(circle)))

    for u in list(includes):
        if u not in index:
            visit(u)


def read_tree():
    for path in sorted(source.rglob("*.[ch]pp")):
        yield path.relative_to(source), path.read_text()


def main():
    sys.setrecursionlimit(10000)
    problems = collections.defaultdict(list)
    includes, comments, code = collections.defaultdict(set), collections.Counter(), collections.Counter()

    def sayer(kind):
        return lambda path, line, text: problems[kind].append(f"src/{path}:{line}: {text}")

    for path, text in read_tree():
        check_english(path, text, sayer("assertions of English"))
        if is_test(path):
            continue
        check_functions(path, text, sayer("functions"))
        includes[unit(path)] |= {unit(target) for target in re.findall(r'^\s*#include "([^"]+)"', text, re.M)} - {unit(path)}
        if path.suffix == ".cpp":
            comments[path.parts[0]] += len(cpp_text.comment_lines(text))
            code[path.parts[0]] += sum(bool(line.strip()) for line in cpp_text.SKIP.sub(without_comments, text).splitlines())
    check_circles(includes, sayer("circles of units"))
    for room in sorted(code):
        share = comments[room] / code[room]
        if share < MIN_COMMENTS:
            problems["comments per line of code in bodies"].append(f"src/{room}: {share:.3f}, at least {MIN_COMMENTS}")
    for kind, found in problems.items():
        print("\n".join(found))
    print("functions, units, words, comments: " +
          ("; ".join(f"{len(found)} {kind}" for kind, found in problems.items()) or "as they should be") +
          f"; {sum(comments.values()) / sum(code.values()):.3f} comments per line of code in bodies")
    return 1 if set(problems) - REPORTED else 0


def without_comments(found):
    piece = found.group(0)
    return cpp_text.blank(piece) if piece.startswith(("//", "/*")) else piece


if __name__ == "__main__":
    sys.exit(main())
