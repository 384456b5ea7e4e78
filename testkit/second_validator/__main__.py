"""`python3 -m second_validator DIR`, or `--batch`: see the package."""

from __future__ import annotations

import os
import sys

if not __package__:
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    __package__ = "second_validator"

from second_validator.report import Report, Unreadable
from second_validator.validator import validate

ACCEPTS, UNREADABLE, REJECTS = 0, 2, 3


def judge(place: str) -> tuple[int, list[str]]:
    """The exit status for a URDD, and a line for each finding."""
    try:
        report: Report = validate(place)
    except Unreadable as reason:
        return UNREADABLE, [f"unreadable: {reason}"]
    lines = [
        f"{code} {file}{'#' if pointer else ''}{pointer}" for code, file, pointer in report.errors
    ]
    return (REJECTS if lines else ACCEPTS), lines


def main(arguments: list[str]) -> int:
    if arguments == ["--batch"]:
        for line in sys.stdin:
            status, findings = judge(line.rstrip("\n"))
            print(status, "; ".join(findings), flush=True)
        return 0
    if len(arguments) != 1:
        print("usage: second_validator DIR | --batch", file=sys.stderr)
        return UNREADABLE
    status, findings = judge(arguments[0])
    print("\n".join(findings))
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
