"""The table of changes and what each program makes of them, as text (README.md describes the form)."""

from __future__ import annotations

import collections
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

import facts
from change import BASE, Edit, apply
from driver import Program

VERDICTS = {"+": "loads", "-": "refuses", "!": "crashes", "?": "hangs"}
# Means of literal changes are written up to so many characters.
SHORT = 80


@dataclass
class Row:
    """A change, and for each program's letter its verdict and the facts that differ from what is meant."""

    id: str
    base: str
    kind: str
    edits: tuple[Edit, ...]
    means: dict[str, str | None]
    # Whether the changed file means what it says.
    literal: bool = False
    verdicts: dict[str, str] = field(default_factory=dict)
    differences: dict[str, list[str]] = field(default_factory=dict)


def escaped(text: str | bytes) -> str:
    """Bytes that are no printable ASCII, and the backslash, as \\xNN."""
    data = text.encode("utf-8", "surrogateescape") if isinstance(text, str) else text
    return "".join(chr(byte) if 0x20 <= byte < 0x7F and byte != 0x5C else f"\\x{byte:02x}" for byte in data)


def unescaped(text: str) -> bytes:
    parts = text.split("\\x")
    return parts[0].encode() + b"".join(bytes([int(part[:2], 16)]) + part[2:].encode() for part in parts[1:])


def lines(row: Row) -> Iterable[str]:
    edits = [f"{edit.start}-{edit.end}:{escaped(edit.text)}" for edit in row.edits]
    yield "\t".join([f"* {escaped(row.id)}", row.base, row.kind.split(" ")[0], *edits])
    if row.literal and sum(len(key) + len(value or "") for key, value in row.means.items()) > SHORT:
        yield "~ ."
    elif row.means:
        yield "\t".join(["~", *(fact(key, value) for key, value in row.means.items())])
    by_verdict: dict[str, str] = collections.defaultdict(str)
    for letter, verdict in sorted(row.verdicts.items()):
        by_verdict[verdict] += letter
    yield " ".join(sign + by_verdict[verdict] for sign, verdict in VERDICTS.items() if by_verdict[verdict])
    alike: dict[tuple[str, ...], str] = collections.defaultdict(str)
    for letter, found in sorted(row.differences.items()):
        if found:
            alike[tuple(found)] += letter
    for found, letters in sorted(alike.items(), key=lambda item: item[1]):
        yield "\t".join([f"= {letters}", *(escaped(text) for text in found)])


def fact(key: str, value: str | None) -> str:
    return f"-{escaped(key)}" if value is None else f"{escaped(key)}={escaped(value)}"


def write(path: Path, programs: Iterable[Program], rows: Iterable[Row]) -> None:
    rows = [
        replace(row, id=f"{row.base.removesuffix('.urdf')}/pair_{i}") if row.kind == "pair" else row
        for i, row in enumerate(rows)
    ]
    head = ["urdd programs 1", *(f"@ {program.letter}\t{program.name}\t{program.version}" for program in programs)]
    path.write_text("\n".join([*head, *(line for row in rows for line in lines(row))]) + "\n", encoding="ascii")


def read(path: Path) -> list[Row]:
    rows: list[Row] = []
    for line in path.read_text("ascii").splitlines()[1:]:
        if line.startswith("* "):
            name, base, kind, *edits = line[2:].split("\t")
            made = []
            for edit in edits:
                places, text = edit.split(":", 1)
                start, end = places.split("-")
                made.append(Edit(int(start), int(end), unescaped(text)))
            rows.append(Row(unescaped(name).decode(), base, kind, tuple(made), {}))
        elif line == "~ .":
            rows[-1].literal = True
            data = (BASE / rows[-1].base).read_bytes()
            rows[-1].means = facts.otherwise(facts.meant(data), facts.meant(apply(data, rows[-1].edits)))
        elif line.startswith("~"):
            for text in line.split("\t")[1:]:
                key, is_set, value = text.partition("=")
                rows[-1].means[plain(key if is_set else key[1:])] = plain(value) if is_set else None
        elif line.startswith("= "):
            letters, *found = line[2:].split("\t")
            for letter in letters:
                rows[-1].differences[letter] = [plain(text) for text in found]
        elif line[:1] in VERDICTS:
            for word in line.split(" "):
                for letter in word[1:]:
                    rows[-1].verdicts[letter] = VERDICTS[word[0]]
    return rows


def plain(text: str) -> str:
    return unescaped(text).decode("utf-8", "surrogateescape")
