#!/usr/bin/env python3
"""Holds the documents, comments of examples, and texts of the program to the rules of CONTRIBUTING, "Words": short sentences, few numbers,
small cells, sound tables, live links, files that there are, few lines.

Usage: check_docs.py [--list] [PAGE...]. Without pages: every page and source of the repository. `--list` prints a line per page: sentences,
median length, share above 30 words. Exit code 1 if a rule is broken. `make lint` runs it.
"""
import pathlib
import re
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
WORDS, NUMBERS, CELL = 30, 3, 20  # at most, in a sentence, in a sentence, in a cell of a table
STATUS_CELL = 8
MEDIAN = 15  # words, of the pages that a user reads from the beginning to the end
READ_THROUGH = ("README.md", "docs/calibration.md", "docs/tutorials/")
LINES = 3500  # of the pages in docs that people write
WRITTEN = re.compile(r"^Written by `", re.M)  # marks a page that a command writes: its lines do not count
# Sentences and cells of these are texts of the program, which are read where they stand.
WORDED = re.compile(r"^Written by `(?:phyllite|make rocks)", re.M)
# Not held to the rules of sentences: decisions, with the measurements of their day; the map of the code.
RECORDS = ("CHANGELOG.md",)
EVASIONS = re.compile(r"\b(?:that|those) of\b|\bthe (?:latter|former) of\b", re.I)
ROOMS = "|".join(sorted(p.name for p in (ROOT / "src").iterdir() if p.is_dir()))
PLACE = re.compile(rf"`((?:src|tests|tools|examples|data|bench|measured|packaging|docs|{ROOMS})/[\w./-]+)`")
MONTHS = "January|February|March|April|May|June|July|August|September|October|November|December"
DATE = re.compile(rf"\b\d{{1,2}} (?:{MONTHS})\b|\b20\d\d-\d\d-\d\d\b")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")
ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|etc|cf|vs|al|Fig|Figs|Eq|Eqs|Sec|Vol|No|pp|J|C|Geol|Mag|Int|Min|Sci|Dr)\.")


class Page:
    """A Markdown file in pieces: paragraphs (a list item is one), tables, headings and links, each with its line."""
    written = worded = False

    def __init__(self, path):
        self.path = path
        self.name = path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else path.name
        self.paragraphs, self.tables, self.headings, self.links, self.anchors = [], [], [], [], set()
        self.places = []  # of the repository, named in code
        paragraph, table, fence, sources = [], [], None, False
        text = path.read_text(encoding="utf-8")
        lines, self.written, self.worded = text.split("\n"), bool(WRITTEN.search(text)), bool(WORDED.search(text))
        for number, line in enumerate(lines + [""], 1):
            text = line.strip()
            if fence:
                fence = None if text.startswith(fence) else fence
                continue
            if text.startswith("```"):
                fence, text = "```", ""
            elif line.startswith("    ") and not paragraph and not re.match(r"\s*([-*]|\d+\.) ", line) and not self.in_list(lines, number):
                text = ""  # code
            elif text.startswith("<!--") or text.startswith("<") and text.endswith(">"):
                self.anchors.update(re.findall(r'id="([^"]+)"', text))
                text = ""
            elif text.startswith("#"):
                self.headings.append((number, text))
                sources, text = "sources" in text.lower(), ""
            if text.startswith("|"):
                table.append((number, text))
                text = ""
            elif table:
                self.tables.append(table)
                table = []
            begins = re.match(r"([-*]|\d+\.) ", text) or line.startswith(": ")
            if paragraph and (not text or begins):
                self.paragraphs.append((paragraph[0][0], " ".join(t for _, t in paragraph)))
                paragraph = []
            if text and not sources:  # a list of references is no prose
                paragraph.append((number, re.sub(r"^([-*]|\d+\.|:) +", "", text)))
            if not fence:
                self.places += [(number, place) for place in PLACE.findall(line)]
                self.links += [(number, target) for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line))]
        self.anchors.update(slug(text) for _, text in self.headings)

    @staticmethod
    def in_list(lines, number):
        for line in reversed(lines[max(0, number - 12):number - 1]):
            if re.match(r"\s*([-*]|\d+\.) ", line):
                return True
            if line and not line.startswith(" "):
                return False
        return False


class Comments(Page):
    """The comments of a TOML file: lines in a row are a paragraph, an indented line is a table or a command."""

    def __init__(self, path):
        self.path, self.name = path, path.relative_to(ROOT).as_posix()
        self.paragraphs, self.tables, self.links, self.places = [], [], [], []
        paragraph = []
        for number, line in enumerate(path.read_text(encoding="utf-8").split("\n") + [""], 1):
            whole, behind = re.match(r"# ?(\S.*)", line), re.search(r"\s#\s+(\S.*)", line)
            if paragraph and (not whole or whole[1].startswith("- ")):
                self.paragraphs.append((paragraph[0][0], " ".join(t for _, t in paragraph)))
                paragraph = []
            if whole:
                paragraph.append((number, whole[1]))
            elif behind and not line.startswith("#"):
                self.paragraphs.append((number, behind[1]))


class Texts(Page):
    """Texts of the program: literals of six words or more, neighbours joined; a text with braces, brackets or semicolons in
    lines of its own is a script."""

    LITERALS = re.compile(r'"""(.*?)"""|R"(?:\w*)\((.*?)\)\w*"|((?:"(?:\\.|[^"\\\n])*"\s*)+)', re.S)

    def __init__(self, path):
        self.path, self.name = path, path.relative_to(ROOT).as_posix()
        self.paragraphs, self.tables, self.links, self.places = [], [], [], []
        code = re.sub(r"(?<!:)//[^\n]*", "", path.read_text(encoding="utf-8"))
        if path.suffix == ".ts":  # texts with numbers in them
            code = re.sub(r"`((?:\\.|[^`\\])*)`", lambda m: '"' + re.sub(r"\$\{[^}]*\}", "x", m[1]).replace('"', "'").replace("\n", "\\n") + '"', code)
        for found in self.LITERALS.finditer(code):
            text = next(t for t in found.groups() if t is not None)
            if found[3]:
                text = "".join(re.findall(r'"((?:\\.|[^"\\\n])*)"', text)).replace("\\n", "\n").replace('\\"', '"')
            if re.search(r"[;{})\]]\n|^[#;|] |^SELECT ", text, re.M):
                continue
            line = code[:found.start()].count("\n") + 1
            self.paragraphs += [(line, " ".join(p.split())) for p in re.split(r"\n\n|\n(?= *\w+: )", text) if len(p.split()) > 5]


def slug(heading):
    text = re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", r"\1", heading.lstrip("#").strip()).lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def plain(text):
    """Words as they are read: code is one word, a link its text."""
    text = re.sub(r"`[^`]*`", "CODE", text)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"\*+|(?<!\w)_+(?=\w)|(?<=\w)_+(?!\w)", "", text)


def sentences(paragraph):
    text = ABBREVIATIONS.sub(r"\1", plain(paragraph))
    return [s for s in re.split(r"(?<=[.!?])[\")]*\s+(?=[\"(]?[A-Z]|\d|[a-z]+_|(?:nu|mu|phi|theta|beta)\b)", text) if words(s)]


def numbers(sentence):
    """Numbers that a reader has to take in: not the angle of UCS(60), not the number of an equation, not an exponent, an index or a year."""
    text = re.sub(r"\b[A-Za-z_]\w*\([^()]*\)|\b(?:Eq|Eqs|Fig|Table|Tables|decision) [\d, and-]+|\^\S+|\b\d(?=D\b)|\(?\b(?:19|20)\d\d\b\)?", "x", sentence)
    text = re.sub(r"([\d.]+) x [\d.]+(?: x [\d.]+)?", r"\1", text)  # 38 x 76 mm is one size
    return len(NUMBER.findall(text))


def words(text):
    return len([w for w in text.split() if re.search(r"\w", w)])


def cells(row):
    text = re.sub(r"`[^`]*`", lambda m: m[0].replace("|", "/"), row.replace("\\|", "/"))
    return [c.strip() for c in text.strip().strip("|").split("|")] if text.strip() != "|" else []


def problems_of_text(page):
    if page.name.startswith(RECORDS):
        return
    for line, paragraph in page.paragraphs:
        if DATE.search(plain(paragraph)):
            yield line, f"a date: {DATE.search(plain(paragraph))[0]}"
        for s in sentences(paragraph):
            if words(s) > WORDS:
                yield line, f"{words(s)} words: {s[:90]}"
            if numbers(s) > NUMBERS and not isinstance(page, Texts):
                yield line, f"{numbers(s)} numbers: {s[:90]}"
            if found := EVASIONS.search(s):
                yield line, f'"{found[0]}": {s[max(0, found.start() - 40):found.end() + 40]}'
            if not isinstance(page, Texts) and re.match(r"\W*What (?:is|was|it|they|the|a|no|does|has) [^:?]*\.$", s) and words(s) > 5:  # "What it is." heads a paragraph
                yield line, f"a clause in place of a noun: {s[:90]}"


def problems_of_tables(page):
    limit = STATUS_CELL if page.name == "docs/status.md" else CELL
    for table in page.tables:
        if len(table) < 2 or not re.fullmatch(r"[\s|:-]+", table[1][1]):
            yield table[0][0], "a table without a head"
            continue
        columns = len(cells(table[0][1]))
        for line, row in table:
            if len(cells(row)) != columns:
                yield line, f"{len(cells(row))} cells in a table of {columns} columns"
            if page.name.startswith(RECORDS) or page.worded:
                continue
            for cell in cells(row):
                if words(plain(cell)) > limit:
                    yield line, f"a cell of {words(plain(cell))} words: {plain(cell)[:90]}"


def problems_of_places(page):
    """A file or folder that code names; a stem stands for its header and source."""
    if page.name.startswith("CHANGELOG"):
        return
    for line, place in page.places:
        if "NAME" not in place and not any(p.exists() or any(p.parent.glob(p.name + ".*")) for p in (ROOT / place, ROOT / "src" / place)):
            yield line, f"no such file: {place}"


def problems_of_links(page, pages):
    for line, target in page.links:
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.path.parent / path).resolve() if path else page.path
        if not file.exists():
            yield line, f"a link to nowhere: {target}"
        elif anchor and file.suffix == ".md" and anchor not in (pages.get(file) or Page(file)).anchors:
            yield line, f"no such heading: {target}"


def main(arguments):
    listed, names = "--list" in arguments, [a for a in arguments if not a.startswith("-")]
    if not names:
        listing = subprocess.run(["git", "ls-files", "*.md", "examples/*.toml", "src/*.cpp", "src/*.hpp", "python/*.py", "web/src/*.ts"],
                                 cwd=ROOT, capture_output=True, text=True, check=True)
        names = [n for n in listing.stdout.split() if not re.search(r"\.test\.|_fixture", n)]
    readers = {".md": Page, ".toml": Comments}
    pages = {p: readers.get(p.suffix, Texts)(p) for p in ((ROOT / n).resolve() for n in names) if p.exists()}
    n_problems = 0
    for page in pages.values():
        found = [*problems_of_tables(page), *problems_of_links(page, pages), *problems_of_places(page)]
        lengths = [words(s) for _, p in page.paragraphs for s in sentences(p)] or [0]
        if not page.worded:
            found += problems_of_text(page)
            if page.name.startswith(READ_THROUGH) and statistics.median(lengths) > MEDIAN:
                found.append((1, f"median of {statistics.median(lengths):g} words a sentence, at most {MEDIAN}"))
        if listed:
            long = 100.0 * sum(n > WORDS for n in lengths) / len(lengths)
            print(f"{len(lengths):5} {statistics.median(lengths):5g} {long:5.1f} % {len(found):4}  {page.name}")
        else:
            for line, text in sorted(found):
                print(f"{page.name}:{line}: {text}")
        n_problems += len(found)
    n_lines = sum(len(p.read_text(encoding="utf-8").splitlines()) for p, page in pages.items() if page.name.startswith("docs/") and not page.written)
    if n_lines > LINES:
        print(f"docs: {n_lines} lines without the pages that a command writes, at most {LINES}")
        n_problems += 1
    print(f"documents: {len(pages)} pages, {n_lines} lines in docs written by hand, {n_problems} problem(s)")
    return n_problems > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
