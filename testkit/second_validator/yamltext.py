"""Reading the YAML that 3.2.2 and 3.2.3 allow: block and flow collections, scalars, comments."""

from __future__ import annotations

import functools
import re
from typing import Any

from .jsontext import BYTE_ORDER_MARK, MAX_DEPTH, TextFault
from .yamlcursor import Cursor
from .yamlscalar import plain_value

FORBIDDEN = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x84\x86-\x9f\ufffe\uffff]")
LINE_ENDS_OF_11 = re.compile(r"[\x85\u2028\u2029]")
PLAIN = re.compile(r"(?:(?! +#| *\n| *:(?:[ \n\t]|\Z)| +\Z)[^\n\t])+")
PLAIN_IN_FLOW = re.compile(r"(?:(?! +#| *\n| *:(?:[ \n\t,\[\]{}]|\Z)| +[,\]}])[^\n\t,\[\]{}])+")
MAX_KEY = 1024


class Parser(Cursor):
    """A recursive parser. `floor` is the column that a value around has: inside is farther in."""

    def enter(self) -> None:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise TextFault("YML008")

    def document(self) -> Any:
        self.skip()
        if self.text.startswith("---", self.at) and self.marked():
            self.at += 3
            self.skip()
        if self.here() == "%" and self.column() == 0:
            self.fail()
        value = self.block(-1, True)
        self.skip()
        if self.text.startswith("...", self.at) and self.marked():
            self.at += 3
            self.skip()
        if self.at < len(self.text):
            self.fail()
        return value

    def block(self, floor: int, may_be_mapping: bool) -> Any:
        """A value of block style that begins here, farther in than `floor`."""
        if self.marked() or self.column() <= floor:
            return None
        if self.dashed("-"):
            if not may_be_mapping:
                self.fail()
            return self.sequence(self.column())
        if self.here() in ("|", ">"):
            return self.block_scalar(floor)
        start = self.at
        column = self.column()
        if may_be_mapping and self.dashed("?"):
            return self.mapping(column)
        value, plain = self.flow_or_scalar(floor, False)
        blanks = self.at
        while self.here() == " ":
            self.at += 1
        if self.dashed(":"):
            one_line = "\n" not in self.text[start : self.at] and self.at - start <= MAX_KEY
            if not may_be_mapping or not one_line:
                self.fail()
            self.at = start
            return self.mapping(column)
        self.at = blanks
        if not plain:
            return value
        return plain_value(self.more_lines(value, floor))

    def more_lines(self, text: str, floor: int) -> str:
        """The lines that continue a plain scalar, folded."""
        while True:
            before = self.at
            self.skip()
            between = self.text[before : self.at]
            goes_on = "\n" in between and "#" not in between and self.column() > floor
            if not goes_on or self.marked():
                self.at = before
                return text
            match = PLAIN.match(self.text, self.at)
            if not match:
                self.fail()
                return text
            self.at = match.end()
            if self.dashed(":"):
                self.fail()
            breaks = between.count("\n")
            text += (" " if breaks == 1 else "\n" * (breaks - 1)) + match[0]

    def sequence(self, column: int) -> list[Any]:
        self.enter()
        found = []
        while not self.marked() and self.column() == column and self.dashed("-"):
            self.at += 1
            self.skip()
            found.append(self.block(column, True))
            self.next_entry(column)
        self.depth -= 1
        return found

    def next_entry(self, column: int) -> None:
        """What follows an entry is on a line of its own, and not between two columns."""
        self.skip()
        ended = not self.text[self.at - self.column() : self.at].strip(" ")
        if not self.marked() and (not ended or self.column() > column):
            self.fail()

    def mapping(self, column: int) -> dict[str, Any]:
        self.enter()
        found: dict[str, Any] = {}
        while not self.marked() and self.column() == column:
            explicit = self.dashed("?")
            if explicit:
                self.at += 1
                self.skip()
            key = self.key(column)
            if key in found:
                raise TextFault("YML005")
            found[key] = None
            if explicit:
                self.next_entry(column)
                if self.column() != column or not self.dashed(":"):
                    continue
            while self.here() == " ":
                self.at += 1
            if not self.dashed(":"):
                self.fail()
            self.at += 1
            ended = self.skip() or explicit
            same_column = ended and self.column() == column and self.dashed("-")
            found[key] = self.block(column - 1 if same_column else column, ended)
            self.next_entry(column)
        self.depth -= 1
        return found

    def key(self, floor: int) -> str:
        """A key, which is a string to all readers (3.2.2)."""
        if self.here() in ("[", "{") or self.dashed(":"):
            self.fail()
        value, plain = self.flow_or_scalar(floor, False)
        return self.as_key(value, plain)

    def as_key(self, value: Any, plain: bool) -> str:
        if plain and value == "<<":
            raise TextFault("YML004")
        result = plain_value(value) if plain else value
        if not isinstance(result, str):
            self.fail()
        return result

    def flow_or_scalar(self, floor: int, in_flow: bool) -> tuple[Any, bool]:
        """A value, and whether it is a plain scalar, of which only the first line is read."""
        first = self.here()
        if first == "!":
            raise TextFault("YML002")
        if first in ("&", "*"):
            raise TextFault("YML003")
        if first == "[":
            return self.flow_list(floor), False
        if first == "{":
            return self.flow_object(floor), False
        if first == '"':
            return self.double_quoted(floor), False
        if first == "'":
            return self.single_quoted(floor), False
        after = self.text[self.at + 1 : self.at + 2]
        if first == "" or first in ",]}#|>@`%" or (first in "-?:" and after in ("", " ", "\n")):
            self.fail()
        if in_flow and first in "-?:" and after in ",[]{}":
            self.fail()
        match = (PLAIN_IN_FLOW if in_flow else PLAIN).match(self.text, self.at)
        if not match:
            self.fail()
            return "", True
        self.at = match.end()
        if in_flow and "?" in match[0]:
            raise TextFault("YML006")
        return match[0], True

    def flow_value(self, floor: int) -> tuple[Any, bool]:
        """A value between brackets; a plain scalar may go on in further lines."""
        value, plain = self.flow_or_scalar(floor, True)
        while plain:
            before = self.at
            ended = self.skip(floor)
            match = PLAIN_IN_FLOW.match(self.text, self.at) if ended else None
            if not match or "#" in self.text[before : self.at]:
                self.at = before
                break
            self.at = match.end()
            if "?" in match[0]:
                raise TextFault("YML006")
            breaks = self.text.count("\n", before, match.start())
            value += (" " if breaks == 1 else "\n" * (breaks - 1)) + match[0]
        return value, plain

    def flow_list(self, floor: int) -> list[Any]:
        self.enter()
        self.at += 1
        found: list[Any] = []
        self.skip(floor)
        while self.here() != "]":
            explicit = self.explicit_key(floor)
            start = self.at
            value, plain = self.flow_value(floor)
            self.skip(floor)
            start = self.at if explicit else start
            if self.here() == ":" or explicit:
                key = self.as_key(value, plain)
                found.append({key: self.pair_value(start, floor)})
            else:
                found.append(plain_value(value) if plain else value)
            self.comma("]", floor)
        self.at += 1
        self.depth -= 1
        return found

    def explicit_key(self, floor: int) -> bool:
        """Passes over the `?` of a key between brackets, if there is one."""
        found = self.dashed("?")
        if found:
            self.at += 1
            self.skip(floor)
        return found

    def pair_value(self, start: int, floor: int) -> Any:
        """The value of a key between brackets; null where there is none."""
        if self.here() != ":":
            return None
        if "\n" in self.text[start : self.at]:
            self.fail()  # PyYAML refuses a key and its colon on two lines
        self.at += 1
        self.skip(floor)
        if self.here() in (",", "]", "}"):
            return None
        value, plain = self.flow_value(floor)
        return plain_value(value) if plain else value

    def flow_object(self, floor: int) -> dict[str, Any]:
        self.enter()
        self.at += 1
        found: dict[str, Any] = {}
        self.skip(floor)
        while self.here() != "}":
            explicit = self.explicit_key(floor)
            start = self.at
            if self.here() in ("[", "{"):
                self.fail()
            key = self.as_key(*self.flow_value(floor))
            self.skip(floor)
            start = self.at if explicit else start
            if key in found:
                raise TextFault("YML005")
            found[key] = self.pair_value(start, floor)
            self.comma("}", floor)
        self.at += 1
        self.depth -= 1
        return found

    def comma(self, end: str, floor: int) -> None:
        self.skip(floor)
        if self.here() == ",":
            self.at += 1
            self.skip(floor)
        elif self.here() != end:
            self.fail()


def marks_outside_quotes(text: str) -> bool:
    """Whether a byte order mark stands outside of quotes (3.2.2)."""
    bare = re.sub(r'"(?:[^"\\]|\\.)*"|\'[^\']*\'', "", text)
    return "\ufeff" in bare


@functools.lru_cache(maxsize=4096)
def read_yaml(data: bytes) -> Any:
    """The document in a file. Raises TextFault with the code of the first fault."""
    if data.startswith(BYTE_ORDER_MARK):
        raise TextFault("YML001")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as fault:
        raise TextFault("YML001") from fault
    if FORBIDDEN.search(text) or marks_outside_quotes(text):
        raise TextFault("YML001")
    if LINE_ENDS_OF_11.search(text):
        raise TextFault("YML006")
    return Parser(text.replace("\r\n", "\n").replace("\r", "\n")).document()


def same(a: Any, b: Any) -> bool:
    """Whether two documents are the same (3.2.1)."""
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b))
    numbers = (int, float)
    if isinstance(a, bool) or isinstance(b, bool) or not isinstance(a, numbers):
        return isinstance(a, bool) == isinstance(b, bool) and a == b
    return isinstance(b, numbers) and float(a) == float(b)
