"""One change of a base file, and how many of them are taken."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import facts

HERE = Path(__file__).resolve().parent
BASE = HERE / "base"


@dataclass(frozen=True)
class Edit:
    """`text` stands in place of the bytes from `start` to `end`."""

    start: int
    end: int
    text: bytes


@dataclass(frozen=True)
class Change:
    """What is done to a file, and the edits that would write what a person means by it."""

    id: str
    base: str
    kind: str
    edits: tuple[Edit, ...]
    meant: tuple[Edit, ...] = ()

    def apply(self, data: bytes) -> bytes:
        return apply(data, self.edits)

    def means(self, data: bytes, before: dict[str, str]) -> dict[str, str | None]:
        """Facts that are otherwise than in the base, None for one that is gone."""
        if not self.meant:
            return {}
        return facts.otherwise(before, facts.meant(apply(data, self.meant)))


def apply(data: bytes, edits: Iterable[Edit]) -> bytes:
    parts, at = [], 0
    for edit in sorted(edits, key=lambda edit: (edit.start, edit.end)):
        if edit.start < at:
            raise ValueError(f"two edits overlap at byte {edit.start}")
        parts += [data[at : edit.start], edit.text]
        at = edit.end
    return b"".join([*parts, data[at:]])


def overlap(first: Sequence[Edit], second: Sequence[Edit]) -> bool:
    """Whether two lists of edits touch one place."""
    return any(a.start <= b.end and b.start <= a.end for a in first for b in second)


def mix(text: str) -> int:
    """A number of 64 bits that depends on every letter: FNV-1a, then SplitMix64's last steps."""
    value = 0xCBF29CE484222325
    for byte in text.encode():
        value = (value ^ byte) * 0x100000001B3 % 2**64
    value = (value ^ value >> 30) * 0xBF58476D1CE4E5B9 % 2**64
    value = (value ^ value >> 27) * 0x94D049BB133111EB % 2**64
    return value ^ value >> 31


def chosen(text: str, percent: float) -> bool:
    return mix(text) % 10_000 < percent * 100
