"""The findings of a validation, and what ends it early."""

from __future__ import annotations


class Unreadable(Exception):
    """The input cannot be opened as a URDD, so it is neither accepted nor rejected (2.2, 2.14)."""


class Report:
    """Errors as (code, file, pointer), in the order in which the rules find them."""

    def __init__(self) -> None:
        self.errors: list[tuple[str, str, str]] = []

    def error(self, code: str, file: str = "", pointer: str = "") -> None:
        """Adds an error."""
        self.errors.append((code, file, pointer))

    def codes(self) -> set[str]:
        """The codes of all errors."""
        return {code for code, _, _ in self.errors}

    def clean(self, *families: str) -> bool:
        """Whether no error of these families was found: what builds on them can be judged."""
        return not any(code.startswith(families) for code, _, _ in self.errors)
