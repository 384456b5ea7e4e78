"""Misreads a sentence of `SPEC.md` at a time, and asks whether the suite notices.

    python3 testkit/second_validator/misreadings.py [SUITE] [--jobs 2] [--only 7.8] [--seconds 60]

Without a suite it looks whether each text of `misreadings.txt` is still in its module, once.
"""

from __future__ import annotations

import argparse
import ast
import multiprocessing
import os
import re
import sys
from collections.abc import Callable
from typing import Any

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from instrument import Instrument, Loaded, load_package  # noqa: E402
from mutants import load_cases, remember_trees, run_baseline, try_mutant  # noqa: E402

HEAD = re.compile(r"([0-9.]+) (\w+): (.*)")


class Misreading:
    """A sentence that is misread: a mutant (`mutation.py`) by a change of the text of a module."""

    def __init__(self, block: str) -> None:
        head, *lines = block.strip("\n").split("\n")
        match = HEAD.fullmatch(head)
        assert match, head
        self.clause, self.module, self.kind = match.groups()
        self.same = ""
        self.changes: list[tuple[str, str]] = []
        sides: list[list[str]] = [[], []]
        for line in [*lines, "-"]:
            if line[0] == "-" and sides[1]:
                self.changes.append(("\n".join(sides[0]), "\n".join(sides[1])))
                sides = [[], []]
            if line[0] == "=":
                self.same = line[1:].strip()
            else:
                sides["-+".index(line[0])].append(line[1:])
        self.line = 0
        self.blocks: set[int] = set()

    def faults(self, source: str) -> list[str]:
        return [right for right, _ in self.changes if source.count(right) != 1]

    def read(self, own: Loaded) -> None:
        """Finds which functions it changes: nothing else has to run again."""
        self.line = own.source[: own.source.index(self.changes[0][0])].count("\n") + 1
        text = own.source
        for right, wrong in self.changes:
            text = text.replace(right, wrong)
        instrument = Instrument(1)
        self.tree = ast.fix_missing_locations(instrument.visit(ast.parse(text)))
        for place in range(len(self.changes)):
            first = own.source[: own.source.index(self.changes[place][0])].count("\n") + 1
            last = first + self.changes[place][0].count("\n")
            for node in ast.walk(own.tree):
                if isinstance(node, ast.FunctionDef):
                    if node.lineno <= last and first <= (node.end_lineno or 0):
                        inside = {id(one) for part in node.body for one in ast.walk(part)}
                        self.blocks |= {own.block_of[one] for one in inside if one in own.block_of}
        self.own = own

    def change(self) -> Callable[[], None]:
        before, self.own.tree = self.own.tree, self.tree
        return lambda: setattr(self.own, "tree", before)


def read_misreadings() -> list[Misreading]:
    with open(os.path.join(HERE, "misreadings.txt"), encoding="utf-8") as file:
        blocks = re.split(r"\n\n+", file.read())
    return [Misreading(block) for block in blocks if not block.startswith("#")]


def worker(share: int, jobs: int, misreadings: Any, cases: Any, loaded: Any, most: float) -> None:
    for number, one in enumerate(misreadings):
        if number % jobs == share:
            result = try_mutant(one, cases, loaded, most)
            mark = "" if result.startswith("killed") else "  <--"
            if one.same:
                mark = "  <-- said to be the same" if not mark else "  the same: " + one.same
            print(f"{one.clause} {one.module}: {one.kind}: {result}{mark}", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("suite", nargs="?")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="clauses that begin so, by commas")
    parser.add_argument("--cases", default="", help="cases whose names begin so, by commas")
    parser.add_argument("--seconds", type=float, default=60, help="for each misreading")
    arguments = parser.parse_args()
    misreadings = read_misreadings()
    loaded = load_package()
    stale = [
        f"{one.clause} {one.module}: {one.kind}"
        for one in misreadings
        if one.module not in loaded or one.faults(loaded[one.module].source)
    ]
    print(f"{len(misreadings)} misreadings", *stale, sep="\n", flush=True)
    if stale or not arguments.suite:
        return len(stale)
    chosen = [one for one in misreadings if one.clause.startswith(tuple(arguments.only.split(",")))]
    for one in chosen:
        one.read(loaded[one.module])
    remember_trees(loaded)
    cases = load_cases(arguments.suite, tuple(arguments.cases.split(",")))
    run_baseline(cases, loaded)
    for case in [case for case in cases if not case.is_as_the_suite_has_it()]:
        print(f"{case.name}: left out, as this validator says {case.says}")
        cases.remove(case)
    shares = [
        multiprocessing.get_context("fork").Process(
            target=worker,
            args=(n, arguments.jobs, chosen, cases, loaded, arguments.seconds),
        )
        for n in range(arguments.jobs)
    ]
    for share in shares:
        share.start()
    for share in shares:
        share.join()
    return 0


if __name__ == "__main__":
    sys.exit(main())
