"""Reads C++ as a careful reader of braces does: enough to say where functions are, how long, and with how many parameters.

No compiler is asked, so that a check of the whole tree takes a second. `code_of` blanks comments, texts and directives and
keeps every line where it was; `functions` walks the braces of what is left.
"""
import dataclasses
import re

SKIP = re.compile(
    r'//(?:\\\n|[^\n])*'  # a comment of one line
    r'|/\*.*?\*/'
    r'|(?:u8|[uUL])?R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"'  # a raw text, with its own end
    r'|(?:\b(?:u8|[uUL]))?"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'",  # a character, but not the mark between digits
    re.DOTALL)
DIRECTIVE = re.compile(r'^[ \t]*#(?:\\\n|[^\n])*', re.MULTILINE)


def blank(text):
    return re.sub(r'[^\n]', ' ', text)


def code_of(text):
    """The code alone: texts become "" filled with _, comments and directives become blanks."""
    def left(found):
        piece = found.group(0)
        if piece.startswith(('//', '/*')):
            return blank(piece)
        inner = re.sub(r'[^\n]', '_', piece)
        return '"' + inner[1:-1] + '"' if len(inner) > 1 else inner
    return DIRECTIVE.sub(lambda found: blank(found.group(0)), SKIP.sub(left, text))


def comment_lines(text):
    """Numbers of lines that hold a comment, trailing ones too."""
    lines = set()
    for found in SKIP.finditer(text):
        if found.group(0).startswith(('//', '/*')):
            first = text.count('\n', 0, found.start())
            lines.update(range(first, first + found.group(0).count('\n') + 1))
    return lines


@dataclasses.dataclass
class Function:
    name: str
    line: int  # of the name
    last: int
    parameters: int
    body: str  # code without texts
    comments: int  # lines that are nothing else

    def length(self):
        """Lines of code: a comment that says why makes no function too long."""
        return self.last - self.line + 1 - self.comments

    def is_table_of_text(self):
        """A body that only lists texts, entry by entry: no decision, a text in most statements and in 2 of 5 lines; or one that
        writes a script: a text in 7 of 10 lines."""
        lines = [line for line in self.body.splitlines() if line.strip(' {};')]
        texts = sum('"' in line for line in lines)
        entries = statements(self.body)
        listed = (not re.search(r'\b(?:if|for|while|switch|do)\b|\?', self.body)
                  and 5 * texts >= 2 * len(lines) > 0 and 2 * sum('"' in e for e in entries) >= len(entries))
        return listed or (len(lines) > 20 and 10 * texts >= 7 * len(lines))


def statements(body):
    """What the outermost semicolons of a body end."""
    depth, start, found = 0, 0, []
    for i, c in enumerate(body):
        depth += {'{': 1, '(': 1, '}': -1, ')': -1}.get(c, 0)
        if c == ';' and depth == 1:
            found.append(body[start:i])
            start = i + 1
    return found


NO_FUNCTION = {'void', 'bool', 'int', 'double', 'if', 'for', 'while', 'switch', 'catch', 'return', 'sizeof', 'alignof', 'decltype', 'noexcept', 'requires',
               'alignas', 'static_assert', 'explicit', '__attribute__', 'throw', 'new', 'delete', 'defined',
               'operator'}  # what follows it is its name


def parameter_count(text):
    if text.strip() in ('', 'void'):
        return 0
    depth = angle = 0
    count = 1
    for i, c in enumerate(text):
        if c in '([{':
            depth += 1
        elif c in ')]}':
            depth -= 1
        elif c == '<' and depth == 0:
            angle += 1
        elif c == '>' and depth == 0 and angle and text[i - 1] != '-':
            angle -= 1
        elif c == ',' and depth == 0 and angle == 0:
            count += 1
    return count


NAME = re.compile(r'((?:[A-Za-z_~][\w]*(?:<[^<>()]*>)?::)*(?:operator\s*(?:\(\)|\[\]|[^\s\w(]+|[\w:]+)|~?[A-Za-z_]\w*))\s*$')


def head_of_function(code, start, brace):
    """Name, its place and the parameter list, if what is between `start` and the brace heads a function; else None."""
    i = code.find('(', start, brace)
    while i >= 0:  # the first list of parentheses at the outermost level that follows a name
        before, close = code[start:i], closing(code, i)
        name = NAME.search(before)
        word = name.group(1).split('::')[-1] if name else ''
        if word == 'operator()' or (name and word not in NO_FUNCTION and not before.rstrip().endswith('=')):
            if re.search(r'(?<![=!<>+\-*/|&^%])=(?!=)', re.sub(r'operator\s*[^\s\w(]+', '', without_angles(before))):
                return None  # an initialiser
            return name.group(1), start + name.start(1), code[i + 1:close]
        i = code.find('(', close + 1, brace)
    return None


def without_angles(text):
    while True:
        shorter = re.sub(r'<[^<>]*>', '', text)
        if shorter == text:
            return text
        text = shorter


MACRO = re.compile(r'^[A-Z][A-Z0-9_]*\([^(){};]*\)$', re.MULTILINE)  # a line of its own, without an end that could be seen
SCOPE = re.compile(r'\b(?:namespace|class|struct|union|enum)\b(?![^<]*>[^{]*\()|\bextern\s*""')


def functions(text):
    """Every function with a body, wherever it stands: in namespaces, classes, local classes of functions are part of these."""
    code = MACRO.sub(lambda call: blank(call.group(0)), code_of(text))
    found = []
    lines = code.split('\n')
    alone = {line for line in comment_lines(text) if not lines[line].strip()}
    start = i = 0
    n = len(code)
    scopes = []
    while i < n:
        c = code[i]
        if c == ';':
            start = i + 1
        elif c == '}':
            if scopes:
                scopes.pop()
            start = i + 1
        elif c in '([':  # a default, a subscript, a list of parameters: no brace in it opens a scope
            i = closing(code, i)
        elif c == '{':
            head = code[start:i]
            function = head_of_function(code, start, i)
            plain = re.sub(r'template\s*<[^{;]*?>\s*(?=\w)', '', head)
            if function and not re.match(r'\s*(?:inline\s+)?namespace\b|\s*(?:enum)\b', plain):
                end, body_start = body_end(code, i, head)
                name, place, parameters = function
                first, last = code.count('\n', 0, place), code.count('\n', 0, end)
                found.append(Function(name, first + 1, last + 1, parameter_count(parameters), code[body_start:end + 1],
                                      sum(first <= line <= last for line in alone)))
                i = end
                start = i + 1
            elif SCOPE.search(plain) and not re.search(r'(?<![=!<>])=(?!=)', without_angles(plain)):
                scopes.append('{')
                start = i + 1
            else:  # an initialiser: passed over, the statement goes on
                i = closing(code, i)
        elif c == ':' and re.search(r'\b(?:public|private|protected)\s*$', code[start:i]):
            start = i + 1
        i += 1
    return found


def closing(code, i):
    depth = 0
    while i < len(code):
        if code[i] in '([{':
            depth += 1
        elif code[i] in ')]}':
            depth -= 1
            if depth == 0:
                return i
        i += 1
    return len(code) - 1


def body_end(code, brace, head):
    """End of the body, behind the braces of a constructor's initialisers: `A() : a{1}, b{2} {}`."""
    i = brace
    while True:
        end = closing(code, i)
        following = re.match(r'\s*(?:\.\.\.)?\s*(,[^{};]*\{|\{|catch\s*\([^)]*\)\s*\{)', code[end + 1:])
        if not following or not (re.search(r'\)\s*(?:noexcept\s*)?:(?!:)', head) or re.search(r'\btry\b', head)):
            return end, i
        i = end + following.end()
