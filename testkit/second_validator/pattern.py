"""Patterns of JavaScript in Unicode mode, as Python has them (11.1)."""

from __future__ import annotations

import functools
import re
import sys
import unicodedata

DIGITS = [(48, 57)]
WORD = [(48, 57), (65, 90), (95, 95), (97, 122)]
SPACE = [(9, 13), (32, 32), (160, 160), (5760, 5760), (8192, 8202), (8232, 8233), (8239, 8239)]
SPACE += [(8287, 8287), (12288, 12288), (65279, 65279)]
CLASSES = {"d": DIGITS, "w": WORD, "s": SPACE}
CONTROL = {"t": r"\t", "n": r"\n", "v": r"\v", "f": r"\f", "r": r"\r", "0": r"\x00"}
SYNTAX = "^$\\.*+?()[]{}|/"
HEX = re.compile(r"x([0-9a-fA-F]{2})|u([0-9a-fA-F]{4})|u\{0*([0-9a-fA-F]{1,6})\}")
PAIR = re.compile(r"u([dD][89abAB][0-9a-fA-F]{2})\\u([dD][c-fC-F][0-9a-fA-F]{2})")
PROPERTY = re.compile(r"[pP]\{(?:(?:General_Category|gc)=)?([A-Za-z_]+)\}")
COUNT = re.compile(r"\{[0-9]+(,[0-9]*)?\}")
GROUP = re.compile(r"\((?:\?:|\?<([A-Za-z_$][A-Za-z0-9_$]*)>)?")
NAMES = {"Letter": "L", "Number": "N", "Punctuation": "P", "Symbol": "S", "Separator": "Z"}
NAMES |= {"Uppercase_Letter": "Lu", "Lowercase_Letter": "Ll", "Decimal_Number": "Nd"}
CATEGORIES = set(
    [
        "L",
        "N",
        "P",
        "S",
        "Z",
        "M",
        "C",
        "Lu",
        "Ll",
        "Lt",
        "Lm",
        "Lo",
        "Nd",
        "Nl",
        "No",
        "Mn",
        "Mc",
        "Me",
    ]
)
CATEGORIES |= set(
    [
        "Pc",
        "Pd",
        "Ps",
        "Pe",
        "Pi",
        "Pf",
        "Po",
        "Sm",
        "Sc",
        "Sk",
        "So",
        "Zs",
        "Zl",
        "Zp",
        "Cc",
        "Cf",
        "Cs",
        "Co",
        "Cn",
    ]
)


class BadPattern(Exception):
    """A pattern that JavaScript, or 11.1, does not have."""


@functools.lru_cache(maxsize=64)
def category(name: str) -> list[tuple[int, int]]:
    """The ranges of all characters of a general category."""
    found: list[tuple[int, int]] = []
    for code in range(sys.maxunicode + 1):
        if unicodedata.category(chr(code)).startswith(name):
            first = found.pop()[0] if found and found[-1][1] == code - 1 else code
            found.append((first, code))
    return found


def inside_of(ranges: list[tuple[int, int]], negated: bool) -> str:
    """The inside of a class with all characters of some ranges, or with all others."""
    if negated:
        starts = [0, *(last + 1 for _, last in ranges)]
        ends = [*(first - 1 for first, _ in ranges), sys.maxunicode]
        ranges = [(first, last) for first, last in zip(starts, ends) if first <= last]
    return "".join(f"\\U{first:08x}-\\U{last:08x}" for first, last in ranges)


class Translator:
    """Rewrites a pattern, piece by piece."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0

    def escape(self, in_class: bool) -> str:
        """What stands after a backslash."""
        rest = self.text[self.at + 1 :]
        sign = rest[:1]
        pair = PAIR.match(rest)
        code = HEX.match(rest)
        named = PROPERTY.match(rest)
        if pair:
            self.at += 1 + pair.end()
            high, low = int(pair[1], 16), int(pair[2], 16)
            return f"\\U{0x10000 + ((high - 0xD800) << 10) + low - 0xDC00:08x}"
        if code:
            self.at += 1 + code.end()
            return f"\\U{int(code[1] or code[2] or code[3], 16):08x}"
        if named:
            self.at += 1 + named.end()
            name = NAMES.get(named[1], named[1])
            if name not in CATEGORIES:
                raise BadPattern
            inside = inside_of(category(name), sign == "P")
            return inside if in_class else f"[{inside}]"
        self.at += 2
        if sign.lower() in CLASSES:
            inside = inside_of(CLASSES[sign.lower()], sign.isupper())
            return inside if in_class else f"[{inside}]"
        if sign in CONTROL and not (sign == "0" and rest[1:2].isdigit()):
            return CONTROL[sign]
        if sign == "c" and re.match(r"[A-Za-z]", rest[1:]):
            self.at += 1
            return f"\\x{ord(rest[1]) % 32:02x}"
        if sign and (sign in SYNTAX or (in_class and sign == "-")):
            return "\\" + sign
        if in_class and sign == "b":
            return r"\x08"
        if not in_class and sign in ("b", "B"):
            return f"(?a:\\{sign})"
        raise BadPattern

    def set_of_characters(self) -> str:
        self.at += 1
        start = "["
        if self.text[self.at : self.at + 1] == "^":
            self.at += 1
            start = "[^"
        inside = ""
        while self.text[self.at : self.at + 1] != "]":
            one = self.text[self.at : self.at + 1]
            if not one:
                raise BadPattern
            if one == "\\":
                inside += self.escape(True)
            else:
                self.at += 1
                inside += "\\" + one if one in "[&~|" else one
        self.at += 1
        if not inside:
            return "(?!)" if start == "[" else r"[\s\S]"
        return f"{start}{inside}]"

    def translate(self) -> str:
        found = ""
        while self.at < len(self.text):
            one = self.text[self.at]
            group = GROUP.match(self.text, self.at)
            count = COUNT.match(self.text, self.at)
            if one == "\\":
                found += self.escape(False)
            elif one == "[":
                found += self.set_of_characters()
            elif group:
                if self.text.startswith("(?", self.at) and group.end() == self.at + 1:
                    raise BadPattern
                found += f"(?P<{group[1].replace('$', '_')}>" if group[1] else group[0]
                self.at = group.end()
            elif count:
                found += count[0]
                self.at = count.end()
                found += self.lazy()
            elif one in "]{}":
                raise BadPattern
            else:
                found += {"$": r"\Z", ".": r"[^\n\r\u2028\u2029]"}.get(one, one)
                self.at += 1
                if one in "*+?":
                    found += self.lazy()
        return found

    def lazy(self) -> str:
        """A `?` behind a repetition; another one would repeat the repetition."""
        sign = "?" if self.text[self.at : self.at + 1] == "?" else ""
        self.at += len(sign)
        if self.text[self.at : self.at + 1] in ("*", "+", "?", "{"):
            raise BadPattern
        return sign


@functools.lru_cache(maxsize=1024)
def compiled(text: str) -> re.Pattern[str]:
    """The pattern; raises BadPattern where it is none (11.1)."""
    try:
        return re.compile(Translator(text).translate())
    except (re.error, OverflowError) as fault:
        raise BadPattern from fault
