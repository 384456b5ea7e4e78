"""Reading JSON as strictly as 3.1.1 asks."""

from __future__ import annotations

import functools
import math
import re
from typing import Any

MAX_DEPTH = 100  # 3.1.1
BYTE_ORDER_MARK = b"\xef\xbb\xbf"
BLANK = re.compile(r"[ \t\n\r]*")
NUMBER = re.compile(r"-?(?:0|[1-9][0-9]*)(\.[0-9]+)?([eE][+-]?[0-9]+)?")
NOT_FINITE = re.compile(r"[+-]?(?:nan|infinity|inf)(?![0-9A-Za-z_])", re.IGNORECASE)
STRING = re.compile(r'"((?:[^"\\\x00-\x1f]|\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4}))*)"')
ESCAPE = re.compile(r'\\(?:u([0-9a-fA-F]{4})|(["\\/bfnrt]))')
SIMPLE = {'"': '"', "\\": "\\", "/": "/", "b": "\b", "f": "\f", "n": "\n", "r": "\r", "t": "\t"}
WORDS = {"true": True, "false": False, "null": None}
WORD = re.compile(r"(?:true|false|null)(?![0-9A-Za-z_])")


class TextFault(Exception):
    """A text that a clause of section 3 forbids; the message is the code."""


def unescape(text: str) -> str:
    """The value of a string's inside. Half of a surrogate pair is not JSON here (3.1.1)."""

    def one(match: re.Match[str]) -> str:
        return chr(int(match[1], 16)) if match[1] else SIMPLE[match[2]]

    try:
        raw = ESCAPE.sub(one, text)
        return raw.encode("utf-16", "surrogatepass").decode("utf-16")
    except UnicodeDecodeError as fault:
        raise TextFault("JSN001") from fault


class Reader:
    """A parser that stops at the first fault of 3.1.1, and remembers keys that stand twice."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.repeated = False

    def skip(self) -> str:
        """Passes over white space, and gives the next character."""
        match = BLANK.match(self.text, self.at)
        self.at = match.end() if match else self.at
        return self.text[self.at : self.at + 1]

    def string(self) -> str:
        match = STRING.match(self.text, self.at)
        if not match:
            raise TextFault("JSN001")
        self.at = match.end()
        return unescape(match[1])

    def value(self, depth: int) -> Any:
        first = self.skip()
        if first == '"':
            return self.string()
        if first in ("{", "["):
            if depth == MAX_DEPTH:
                raise TextFault("JSN006")
            return self.object(depth + 1) if first == "{" else self.list(depth + 1)
        if NOT_FINITE.match(self.text, self.at):
            raise TextFault("JSN005")
        word = WORD.match(self.text, self.at)
        if word:
            self.at = word.end()
            return WORDS[word[0]]
        number = NUMBER.match(self.text, self.at)
        if not number:
            raise TextFault("JSN001")
        self.at = number.end()
        if not math.isfinite(float(number[0])):
            raise TextFault("JSN005")
        return float(number[0]) if number[1] or number[2] else int(number[0])

    def list(self, depth: int) -> list[Any]:
        self.at += 1
        found: list[Any] = []
        if self.skip() == "]":
            self.at += 1
            return found
        while True:
            found.append(self.value(depth))
            if self.more("]"):
                return found

    def object(self, depth: int) -> dict[str, Any]:
        self.at += 1
        found: dict[str, Any] = {}
        if self.skip() == "}":
            self.at += 1
            return found
        while True:
            self.skip()
            key = self.string()
            if self.skip() != ":":
                raise TextFault("JSN001")
            self.at += 1
            self.repeated = self.repeated or key in found
            found[key] = self.value(depth)
            if self.more("}"):
                return found

    def more(self, end: str) -> bool:
        """Passes over a comma or the end of a list or object; says whether it was the end."""
        after = self.skip()
        if after not in (",", end) or not after:
            raise TextFault("JSN001")
        self.at += 1
        return after == end


@functools.lru_cache(maxsize=4096)
def read_json(data: bytes, keys_may_repeat: bool = False) -> Any:
    """The document in a file. Raises TextFault with the code of the first fault (3.1.1)."""
    if data.startswith(BYTE_ORDER_MARK):
        raise TextFault("JSN004")
    decoded = len(data)
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as fault:
        decoded = fault.start
        text = data[:decoded].decode("utf-8")
    reader = Reader(text)
    try:
        document = reader.value(0)
        if reader.skip():
            raise TextFault("JSN001")
    except TextFault:
        if decoded < len(data) and (not reader.skip() or reader.text[reader.at] == '"'):
            raise TextFault("JSN003") from None
        raise
    if decoded < len(data):
        raise TextFault("JSN003")
    if reader.repeated and not keys_may_repeat:
        raise TextFault("JSN002")
    return document
