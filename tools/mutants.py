# SPDX-License-Identifier: Apache-2.0
"""Mutants of C++ sources, and what is known of those that no test kills: shared by tools/mutate and tools/make_results.

A mutant is a source file with one small change. Which changes are made follows from the layout that tools/check_format checks: binary
operators have spaces on both sides, so that angle brackets, references and pointers are not taken for them. Comments, strings,
preprocessor lines, contracts, exceptions, indices and the heads of `for` loops are left as they are."""
import dataclasses
import json
import re

TOKEN = re.compile(r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#(?:\\\n|[^\n])*)
  | (?P<string>R"(?P<mark>[^(]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
  | (?P<number>\.?\d(?:[eEpP][+-]|'?[\w.])*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<operator><=>|<<=|>>=|->\*|->|::|\+\+|--|<<|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[^\s])
""", re.VERBOSE | re.DOTALL | re.MULTILINE)

BOUNDARIES = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
NEGATIONS = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}
PAIRS = {"min": "max", "max": "min", "min_element": "max_element", "max_element": "min_element"}
OPPOSITES = {"&&": "||", "||": "&&", "+": "-", "-": "+"}
BINARY = {"+", "-", "*", "/", "<", "<=", ">", ">=", "==", "!=", "&&", "||", "?", ":", "%"}
CLOSING = {"(": ")", "[": "]", "{": "}"}
# Names of what is added for safety, or allowed.
MARGIN = re.compile(r"(?i)margin|slack|rounding|reserve|toleranc|allow|error|deviation|epsilon|limit|backoff|clearance|sagitta|underflow|reach")
ROUNDED = {"rounded_up", "rounded_down"}  # to float, in a direction
KINDS = ("boundary", "negate", "condition", "logic", "min-max", "plus-minus", "drop", "halve", "double", "factor", "rounding")


class Failure(Exception):
    """One sentence for the user."""


@dataclasses.dataclass(frozen=True)
class Mutant:
    """One change of one file: text[begin:end] becomes `text`."""
    file: str    # relative to the root of the sources
    line: int    # of the change, from 1
    kind: str    # one of KINDS
    before: str  # the lines that change, spaces collapsed
    after: str   # what becomes of them
    begin: int
    end: int
    text: str

    def applied_to(self, text):
        """The text of the file with the change."""
        return text[:self.begin] + self.text + text[self.end:]

    @property
    def key(self):
        """What a record of results knows a mutant by, wherever its lines have moved."""
        return self.file, self.before, self.after


@dataclasses.dataclass
class Token:
    """A token of the code, and whether there is space around it."""
    kind: str
    text: str
    begin: int
    end: int
    spaced: bool = False  # on both sides
    frozen: bool = False  # in a contract, the head of a loop, an index


class Source:
    """The tokens of a file, and which brackets belong together."""

    def __init__(self, text):
        self.text = text
        found = [Token(m.lastgroup if m.lastgroup != "mark" else "string", m[0], m.start(), m.end()) for m in TOKEN.finditer(text)]
        self.tokens = [t for t in found if t.kind not in ("comment", "directive")]
        self.other = [-1] * len(self.tokens)
        stack = []
        for i, token in enumerate(self.tokens):
            token.spaced = text[token.begin - 1:token.begin].isspace() and text[token.end:token.end + 1].isspace()
            if token.text in CLOSING and token.kind == "operator":
                stack.append(i)
            elif stack and token.kind == "operator" and token.text == CLOSING[self.tokens[stack[-1]].text]:
                self.other[i] = stack.pop()
                self.other[self.other[i]] = i
        self._freeze()

    def _freeze(self):
        """Marks what is not to be changed."""
        begin = 0
        for i, token in enumerate(self.tokens):
            closing = self.other[i + 1] if i + 1 < len(self.tokens) and self.is_operator(i + 1, "(") else -1
            if closing > i and (re.match(r"DISMANTLE_(EXPECT|ENSURE|VALIDATE)|static_assert$", token.text) or token.text in ("for", "requires")):
                self._freeze_range(i, closing)
            if self.is_operator(i, "[") and self.other[i] > i:
                self._freeze_range(i, self.other[i])
            if token.text in (";", "{", "}"):
                words = self.tokens[begin:i]
                if any(t.kind == "string" or t.text in ("throw", "static_assert", "operator", "requires") for t in words):
                    self._freeze_range(begin, i)
                begin = i + 1

    def _freeze_range(self, first, last):
        for token in self.tokens[first:last + 1]:
            token.frozen = True

    def is_operator(self, i, text):
        """True if token i is this operator."""
        return 0 <= i < len(self.tokens) and self.tokens[i].kind == "operator" and self.tokens[i].text == text

    def text_at(self, i):
        """The text of token i; empty beyond the ends."""
        return self.tokens[i].text if 0 <= i < len(self.tokens) else ""

    def is_binary(self, i):
        """True if token i is an operator between two operands."""
        return 0 < i < len(self.tokens) and self.tokens[i].spaced and self.tokens[i].text in BINARY

    def operand_end(self, i):
        """The last token of the operand that begins with token i (a name, a number or a bracket), or -1."""
        if self.is_operator(i, "("):
            i = self.other[i]
        elif i >= len(self.tokens) or self.tokens[i].kind not in ("name", "number"):
            return -1
        while 0 <= i:
            if self.text_at(i + 1) in ("(", "["):
                i = self.other[i + 1]
            elif self.text_at(i + 1) in (".", "->", "::") and i + 2 < len(self.tokens) and self.tokens[i + 2].kind == "name":
                i += 2
            else:
                break
        return i

    def operand_begin(self, i):
        """The first token of the operand that has the name at token i in it, or -1."""
        while self.text_at(i - 1) in (".", "->", "::"):
            i -= 2
            if i >= 0 and self.text_at(i) in (")", "]"):
                i = self.other[i] - 1
            if i < 0 or self.tokens[i].kind != "name":
                return -1
        return i

    def term_end(self, i):
        """The last token of the product that begins with token i, or -1."""
        end = self.operand_end(i)
        while end >= 0 and self.is_binary(end + 1) and self.text_at(end + 1) in ("*", "/"):
            end = self.operand_end(end + 2)
        return end


class _Maker:
    """Collects the mutants of one file."""

    def __init__(self, file, text):
        self.file, self.text, self.source, self.mutants = file, text, Source(text), []

    def add(self, kind, first, last, text):
        """Tokens first to last become `text`."""
        tokens = self.source.tokens
        begin, end = tokens[first].begin, tokens[last].end
        if text == "":  # together with the space before
            begin = tokens[first - 1].end
        low, high = self.text.rfind("\n", 0, begin) + 1, self.text.find("\n", end)
        high = high if high >= 0 else len(self.text)
        before, after = self.text[low:high], self.text[low:begin] + text + self.text[end:high]
        line = self.text.count("\n", 0, begin) + 1
        text += "\n" * (self.text.count("\n", begin, end) - text.count("\n"))  # what follows keeps its line
        self.mutants.append(Mutant(self.file, line, kind, " ".join(before.split()), " ".join(after.split()), begin, end, text))

    def range_text(self, first, last):
        return self.text[self.source.tokens[first].begin:self.source.tokens[last].end]

    def make(self):
        for i, token in enumerate(self.source.tokens):
            if token.frozen:
                continue
            if token.kind == "operator":
                self._operator(i, token)
            elif token.kind == "name":
                self._name(i, token)
            elif token.kind == "number":
                self._factor(i)
        return self.mutants

    def _operator(self, i, token):
        if token.text == "!":
            if self.source.operand_end(i + 1) >= 0:
                self.add("negate", i, i, " ")
            return
        if not self.source.is_binary(i):
            return
        if token.text in BOUNDARIES:
            self.add("boundary", i, i, BOUNDARIES[token.text])
        if token.text in NEGATIONS:
            self.add("negate", i, i, NEGATIONS[token.text])
        if token.text in ("&&", "||"):
            self.add("logic", i, i, OPPOSITES[token.text])
        if token.text in ("+", "-"):
            self.add("plus-minus", i, i, OPPOSITES[token.text])
            end = self.source.term_end(i + 1)
            if end >= 0 and any(t.kind == "name" and MARGIN.search(t.text) for t in self.source.tokens[i:end + 1]):
                self.add("drop", i, end, "")

    def _name(self, i, token):
        before, following = self.source.text_at(i - 1), self.source.text_at(i + 1)
        if token.text == "if" and following == "(":
            self._condition(i + 1)
        elif token.text in PAIRS and following == "(":
            if before in ("(", ",", "=", "return", "?", ":", "{") or self.source.is_binary(i - 1) or (before, self.source.text_at(i - 2)) == ("::", "std"):
                self.add("min-max", i, i, PAIRS[token.text])
        elif token.text in ROUNDED and following == "(":
            if self.source.tokens[i - 1].kind != "name" or before == "return":
                self.add("rounding", i, i, "static_cast<float>")
        elif token.text == "constexpr" and following in ("double", "float") and self.source.text_at(i + 3) == "=":
            self._constant(i + 4)
        elif MARGIN.search(token.text):
            self._margin(i)

    def _condition(self, opening):
        closing = self.source.other[opening]
        inner = self.source.tokens[opening + 1:closing]
        if closing > opening + 1 and not any(t.text in (";", "=") for t in inner):
            self.add("condition", opening + 1, closing - 1, "false")
            self.add("condition", opening + 1, closing - 1, "true")

    def _constant(self, first):
        last = first
        while last + 1 < len(self.source.tokens) and self.source.text_at(last + 1) not in (";", ","):
            last += 1
        self.add("halve", first, last, f"0.5 * ({self.range_text(first, last)})")
        self.add("double", first, last, f"2 * ({self.range_text(first, last)})")

    def _margin(self, i):
        first, last = self.source.operand_begin(i), self.source.operand_end(i)
        if first < 1 or last < 0 or any(MARGIN.search(t.text) for t in self.source.tokens[first:i]):
            return
        before, following = self.source.text_at(first - 1), self.source.text_at(last + 1)
        if following in ("==", "!=", "<", ">", "<=", ">=") and self.source.text_at(last + 2) == "0":
            return  # of the same sign
        value = before in ("(", ",", "return", "=", "+=", "-=", "-") or self.source.is_binary(first - 1)
        if value and (following in (")", ",", ";") or self.source.is_binary(last + 1)) and self.source.text_at(first - 2) not in ("if", "!"):
            operand = self.range_text(first, last)
            self.add("halve", first, last, f"(0.5 * {operand})")
            self.add("double", first, last, f"(2 * {operand})")

    def _factor(self, i):
        if self.source.is_operator(i + 1, "*") and self.source.is_binary(i + 1) and self.source.text_at(i - 1) != "/":
            self.add("factor", i, i + 1, " ")
        elif self.source.is_operator(i - 1, "*") and self.source.is_binary(i - 1):
            self.add("factor", i - 1, i, "")


def mutants_of(file, text):
    """The mutants of a source file, in the order of their places."""
    found = {}
    for mutant in sorted(_Maker(file, text).make(), key=lambda m: (m.begin, m.kind, m.text)):
        found.setdefault((mutant.line, mutant.after), mutant)
    return list(found.values())


# What a person found out about a mutant that no test kills.
VERDICTS = {
    "equivalent": "no input tells it from the original",
    "stricter": "it is only slower, or stops earlier: nothing gets through that should not",
    "killed since": "a test that was written after the record kills it",
    "open": "no test tells it from the original, and it may matter",
}


def read_verdicts(path):
    """Key of a mutant -> (verdict, reason). The file has paragraphs of four lines: the source file, `- ` and `+ ` with the lines before
    and after the change, and `VERDICT: reason`, which may go on in further lines. Lines with # are comments. Raises Failure."""
    verdicts = {}
    if not path.exists():
        return verdicts
    text = re.sub(r"^#.*\n", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    for block in filter(None, re.split(r"\n\s*\n", text.strip())):
        lines = block.split("\n")
        verdict, _, reason = " ".join(line.strip() for line in lines[3:]).partition(": ")
        if len(lines) < 4 or lines[1][:2] != "- " or lines[2][:2] != "+ " or verdict not in VERDICTS or not reason:
            raise Failure(f"{path.name} has a paragraph that is no verdict (it begins \"{lines[0]}\"); see its first lines")
        verdicts[lines[0], lines[1][2:], lines[2][2:]] = verdict, reason
    return verdicts


def read_record(path):
    """File, line, before and after -> the result of a mutant. Raises Failure."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    try:
        return {(r["file"], r["line"], r["before"], r["after"]): r for r in map(json.loads, lines)}
    except (ValueError, KeyError) as error:
        raise Failure(f"{path} is no record of mutants ({error}); give another file as --out") from error


def write_record(path, record):
    """Writes what read_record() reads."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [json.dumps(entry, ensure_ascii=False) for _, entry in sorted(record.items())]
    temporary = path.with_name(path.name + ".new")
    temporary.write_text("".join(line + "\n" for line in lines), encoding="utf-8")
    temporary.replace(path)
