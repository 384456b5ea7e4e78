"""Where a parser of YAML is in its text, and the scalars in quotes and blocks (3.2.2)."""

from __future__ import annotations

import re

from .jsontext import TextFault

LINE = re.compile(r"[^\n]*")
QUOTED_PART = re.compile(r'[^"\\\n]+')
ESCAPES = {
    "0": "\0", "a": "\a", "b": "\b", "t": "\t", "\t": "\t", "n": "\n", "v": "\v", "f": "\f",
    "r": "\r", "e": "\x1b", " ": " ", '"': '"', "/": "/", "\\": "\\", "N": "\x85",
    "_": "\xa0", "L": "\u2028", "P": "\u2029",
}  # fmt: skip
WIDTHS = {"x": 2, "u": 4, "U": 8}
HEADER = re.compile(r"[|>](?:([1-9])([-+])?|([-+])?([1-9])?)(?: +#[^\n]*| *)(?=\n|$)")
MARKER = re.compile(r"(?:---|\.\.\.)(?=[ \n]|$)")
SINGLE_PART = re.compile(r"[^'\n]+")


class Cursor:
    """A place in a text. `floor` is the column that a value around has: inside is farther in."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.depth = 0

    def fail(self) -> None:
        raise TextFault("YML001")

    def here(self) -> str:
        return self.text[self.at : self.at + 1]

    def column(self, at: int | None = None) -> int:
        place = self.at if at is None else at
        return place - (self.text.rfind("\n", 0, place) + 1)

    def skip(self, floor: int = -1) -> bool:
        """Passes over spaces, line ends and comments; says whether a line ended (3.2.2)."""
        ended = False
        while True:
            while self.here() == " ":
                self.at += 1
            if self.here() == "#" and (self.at == 0 or self.text[self.at - 1] in " \n"):
                match = LINE.match(self.text, self.at)
                self.at = match.end() if match else self.at
            if self.here() != "\n":
                break
            self.at += 1
            ended = True
        if self.column() <= floor:
            self.fail()
        return ended

    def dashed(self, sign: str) -> bool:
        """Whether `-`, `?` or `:` stands here as a sign of its own."""
        return self.here() == sign and self.text[self.at + 1 : self.at + 2] in ("", " ", "\n")

    def marked(self) -> bool:
        """Whether a document's mark stands here, or the text ends."""
        at_mark = self.column() == 0 and MARKER.match(self.text, self.at) is not None
        return at_mark or self.at >= len(self.text)

    def double_quoted(self, floor: int) -> str:
        self.at += 1
        found = ""
        while True:
            part = QUOTED_PART.match(self.text, self.at)
            if part:
                found += part[0]
                self.at = part.end()
            here = self.here()
            if here == '"':
                self.at += 1
                return found
            if here == "\n":
                found = found.rstrip(" \t") + self.fold(floor)
            elif here == "\\":
                found += self.escape(floor)
            else:
                self.fail()

    def escape(self, floor: int) -> str:
        sign = self.text[self.at + 1 : self.at + 2]
        self.at += 2
        if sign == "\n":
            self.at -= 1
            return self.fold(floor).removeprefix(" ")
        if sign in ESCAPES and sign:
            return ESCAPES[sign]
        digits = self.text[self.at : self.at + WIDTHS.get(sign, 0)]
        if not re.fullmatch(r"[0-9a-fA-F]{2,8}", digits) or len(digits) != WIDTHS[sign]:
            self.fail()
        code = int(digits, 16)
        if 0xD800 <= code <= 0xDFFF or code > 0x10FFFF:
            self.fail()  # 3.2.2: half of a surrogate pair
        self.at += len(digits)
        return chr(code)

    def single_quoted(self, floor: int) -> str:
        self.at += 1
        found = ""
        while True:
            part = SINGLE_PART.match(self.text, self.at)
            if part:
                found += part[0]
                self.at = part.end()
            if self.text.startswith("''", self.at):
                found += "'"
                self.at += 2
            elif self.here() == "'":
                self.at += 1
                return found
            elif self.here() == "\n":
                found = found.rstrip(" \t") + self.fold(floor)
            else:
                self.fail()

    def fold(self, floor: int) -> str:
        """Line ends within quotes: what follows is indented more than the value around."""
        breaks = 0
        while self.here() in ("\n", " ", "\t") and self.here():
            breaks += self.here() == "\n"
            self.at += 1
        if self.column() <= floor or self.marked():
            self.fail()
        return " " if breaks == 1 else "\n" * (breaks - 1)

    def block_scalar(self, floor: int) -> str:
        header = HEADER.match(self.text, self.at)
        if not header:
            self.fail()
            return ""
        folded = self.here() == ">"
        chomp = header[2] or header[3] or ""
        given = header[1] or header[4]
        self.at = min(header.end() + 1, len(self.text))
        indent = max(floor, 0) + int(given) if given else 0
        lines: list[str] = []
        while self.at < len(self.text):
            match = LINE.match(self.text, self.at)
            line = match[0] if match else ""
            inner = len(line) - len(line.lstrip(" "))
            if line.strip(" ") and not indent:
                if any(inner < len(blank) for blank in lines if inner > floor):
                    self.fail()  # an empty line that is farther in than the first other one
                indent = max(inner, floor + 1)
                lines = [""] * len(lines)
            if line.strip(" ") and inner < indent:
                break
            if "\t" in line:
                self.fail()
            lines.append(line[indent:] if indent else line)
            self.at += len(line) + 1
        if not indent:
            lines = [""] * len(lines)
        if self.at > len(self.text):
            self.at = len(self.text)
            return LastText(chomped(lines, folded, chomp))
        return chomped(lines, folded, chomp)


class LastText(str):
    """A text that ends with the file, without a line break: readers differ about its end (3.2)."""

    def __eq__(self, other: object) -> bool:
        return str.__eq__(self, other) or str.__eq__(self.removesuffix("\n"), other)

    def __hash__(self) -> int:
        return str.__hash__(self)


def fold_lines(lines: list[str]) -> str:
    """Lines joined by spaces, but for empty lines, and lines that are farther in."""
    text = ""
    before = "-"
    breaks = 0
    for line in lines:
        if line:
            folds = text and not before.startswith(" ") and not line.startswith(" ")
            text += (" " if breaks == 1 else "\n" * (breaks - 1)) if folds else "\n" * breaks
            text += line
            before, breaks = line, 0
        breaks += 1
    return text


def chomped(lines: list[str], folded: bool, chomp: str) -> str:
    """The text of a block scalar's lines."""
    kept = list(lines)
    while kept and not kept[-1]:
        kept.pop()
    text = fold_lines(kept) if folded else "\n".join(kept)
    if chomp == "-":
        return text
    if chomp == "+":
        return text + "\n" * (len(lines) - len(kept) + bool(kept))
    return text + "\n" if kept else ""
