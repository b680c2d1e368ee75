"""Reads the subset of RON (Rusty Object Notation) that our scene files use.

Numbers, strings and booleans become Python's own. A named-field struct and a map become a `dict`, a
tuple and a list become a `list`. An enum variant becomes a `Variant`, whose `fields` are those of
its struct (variant newtypes are unwrapped), a list of its values, or an empty dict for a bare name.
`Some(x)` becomes x. Comments are `//` to the end of the line and `/* ... */`, which nest.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path


class RonError(ValueError):
    """The text is not in the subset; the message says where."""


@dataclass
class Variant:
    """One variant of an enum: `Sphere(radius: 1)` is Variant("Sphere", {"radius": 1})."""

    name: str
    fields: dict | list = field(default_factory=dict)


TOKEN = re.compile(
    r"""
    (?P<number>[-+]?(?:[0-9][0-9_]*\.?[0-9_]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)
  | (?P<name>[A-Za-z_][A-Za-z0-9_]*)
  | (?P<string>"(?:[^"\\]|\\.)*")
  | (?P<mark>[()\[\]{}:,])
    """,
    re.VERBOSE,
)
ESCAPES = {"n": "\n", "t": "\t", "r": "\r", '"': '"', "\\": "\\", "0": "\0"}
CLOSING = {"(": ")", "[": "]", "{": "}"}


def without_comments(text):
    """The text with every comment turned into blanks, so that positions stay."""
    out, i, depth, in_string = [], 0, 0, False
    while i < len(text):
        pair = text[i : i + 2]
        if in_string:
            step = 2 if text[i] == "\\" else 1
            in_string = text[i] != '"'
            out.append(text[i : i + step])
        elif pair == "/*":
            depth, step = depth + 1, 2
            out.append("  ")
        elif depth and pair == "*/":
            depth, step = depth - 1, 2
            out.append("  ")
        elif depth:
            step = 1
            out.append("\n" if text[i] == "\n" else " ")
        elif pair == "//":
            end = text.find("\n", i)
            step = (end if end >= 0 else len(text)) - i
            out.append(" " * step)
        else:
            in_string = text[i] == '"'
            step = 1
            out.append(text[i])
        i += step
    return "".join(out)


class Reader:
    """Recursive descent over the tokens of one text."""

    def __init__(self, text):
        self.text = without_comments(text)
        self.tokens = []
        at = 0
        while True:
            while at < len(self.text) and self.text[at].isspace():
                at += 1
            if at == len(self.text):
                break
            match = TOKEN.match(self.text, at)
            if match is None:
                raise RonError(f"{self.place(at)}: unexpected {self.text[at]!r}")
            self.tokens.append((match.lastgroup, match.group(), at))
            at = match.end()
        self.next = 0

    def place(self, at):
        line = self.text.count("\n", 0, at) + 1
        return f"line {line}, column {at - self.text.rfind(chr(10), 0, at)}"

    def peek(self, ahead=0):
        index = self.next + ahead
        return self.tokens[index] if index < len(self.tokens) else ("end", "end of file", len(self.text))

    def take(self, expected=None):
        kind, word, at = self.peek()
        if kind == "end" or (expected is not None and word != expected):
            raise RonError(f"{self.place(at)}: expected {expected or 'a value'}, found {word}")
        self.next += 1
        return kind, word, at

    def value(self):
        kind, word, at = self.take()
        if kind == "number":
            digits = word.replace("_", "")
            return int(digits) if re.fullmatch(r"[-+]?\d+", digits) else float(digits)
        if kind == "string":
            return re.sub(r"\\(.)", lambda m: ESCAPES.get(m.group(1), m.group(1)), word[1:-1])
        if kind == "name":
            return self.named(word)
        if word in CLOSING:
            return self.group(word)
        raise RonError(f"{self.place(at)}: unexpected {word}")

    def named(self, word):
        if word in ("true", "false"):
            return word == "true"
        if word == "None":
            return None
        if self.peek()[1] != "(":
            return Variant(word)
        self.take("(")
        fields = self.group("(")
        if word == "Some":
            return fields[0]
        if isinstance(fields, list) and len(fields) == 1 and isinstance(fields[0], dict):
            fields = fields[0]
        return Variant(word, fields)

    def group(self, opening):
        """What stands between `opening`, already taken, and its closing mark."""
        closing, entries, keyed = CLOSING[opening], [], opening == "{"
        if opening == "(":
            keyed = self.peek()[0] == "name" and self.peek(1)[1] == ":"
        while self.peek()[1] != closing:
            if keyed:
                key = self.take()[1] if opening == "(" else self.value()
                self.take(":")
                if key in (k for k, _ in entries):
                    raise RonError(f"{self.place(self.peek()[2])}: {key} is given twice")
                entries.append((key, self.value()))
            else:
                entries.append(self.value())
            if self.peek()[1] != closing:
                self.take(",")
        self.take(closing)
        return dict(entries) if keyed else entries


def loads(text):
    """The value written in `text`. Raises `RonError`."""
    reader = Reader(text)
    value = reader.value()
    kind, word, at = reader.peek()
    if kind != "end":
        raise RonError(f"{reader.place(at)}: {word} after the end of the value")
    return value


def load(path):
    """The value written in the file at `path`. Raises `RonError` and `OSError`."""
    return loads(Path(path).read_text(encoding="utf-8"))
