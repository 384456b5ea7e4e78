"""Switches off each check of the second validator in turn, and asks whether the suite notices.

    urdd conformance export SUITE
    python3 testkit/second_validator/mutants.py SUITE [--jobs 2] [--only MODULE] [--out FILE]

A mutant changes one comparison, condition, constant, operator or report. It is killed where the
verdict of a case differs from that of the validator as it is, or a case to be rejected loses its
code, or a near miss gets it, or judging it crashes or takes too long. A mutant runs on the cases
that execute the changed block, those of the codes of its module first. What is pure is remembered
with the blocks that it executed, and computed again where the mutant is among them.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import signal
import sys
import time
import types
from typing import Any

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from instrument import CHANGED, HITS, Entry, Loaded, by_identity, load_package  # noqa: E402
from mutation import Mutant, mutants_of  # noqa: E402

SKIPPED = ("LRN010", "LRN011")  # this validator leaves them open
LEAST_SECONDS = 3.0
TIMES_SLOWER = 10


class TooSlow(BaseException):
    """A case that takes too long."""


class Case:
    """A case of the suite in memory, and what the validator says of it."""

    def __init__(self, entry: dict[str, Any], place: str) -> None:
        self.name = entry["id"]
        self.code = entry["code"]
        self.verdict = entry["verdict"]
        self.place = place
        self.says: Any = None
        self.own = self.all = 0
        self.asked: tuple[Entry, ...] = ()
        self.seconds = 0.0

    def may_differ(self) -> bool:
        """Whether the mutant changes what judging the case executes, or what that asks."""
        if self.own & CHANGED.mask:
            return True
        return not all(entry.still_holds() for entry in self.asked)

    def is_as_the_suite_has_it(self) -> bool:
        if self.verdict == "unreadable":
            return self.says == "Unreadable"
        rejects = self.verdict == "reject" and self.code not in SKIPPED
        return self.code in SKIPPED or self.says == (rejects, rejects)


def load_cases(suite: str, names: tuple[str, ...]) -> list[Case]:
    """All cases but legacy ones."""
    with open(os.path.join(suite, "suite-1.1.json"), encoding="utf-8") as file:
        entries = json.load(file)["cases"]
    return [
        Case(entry, os.path.join(suite, entry["folder"]))
        for entry in entries
        if entry["profile"] != "legacy" and entry["id"].startswith(names)
    ]


def remember_trees(loaded: dict[str, Loaded]) -> None:
    """Cases are read once, where the mutant does not change how; equal files are one object."""
    validator = loaded["validator"].module
    open_tree = validator.open_tree
    known: dict[bytes, bytes] = {}

    def open_case(place: str) -> Any:
        tree = open_tree(place)
        tree.files = {path: known.setdefault(data, data) for path, data in tree.files.items()}
        return tree

    validator.open_tree = by_identity(open_case)
    validator.open_tree.function = open_tree  # what a mutant changes


def says_of(case: Case, loaded: dict[str, Loaded], seconds: float) -> Any:
    """What the validator says: whether it rejects, and whether with the case's code.

    Of a mutant, only where that may differ from what the validator says as it is.
    """

    def stop(*_: object) -> None:
        raise TooSlow

    signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)  # of this process: others may be busy
    try:
        try:
            if CHANGED.mask and not case.may_differ():
                return case.says
            codes = loaded["validator"].module.validate(case.place).codes()
            return bool(codes), case.code in codes
        finally:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    except TooSlow:
        return "too slow"
    except Exception as fault:
        return type(fault).__name__


def run_baseline(cases: list[Case], loaded: dict[str, Loaded]) -> None:
    """Judges all cases with the validator as it is."""
    for case in cases:
        HITS.start()
        start = time.process_time()
        case.says = says_of(case, loaded, 600)
        case.seconds = time.process_time() - start
        case.asked = tuple(HITS.asked.values())
        case.own = case.all = HITS.mask()
        for entry in case.asked:
            case.all |= entry.all
        # Where all of it runs again, however much other cases had asked before.
        case.seconds = max(case.seconds, sum(entry.seconds for entry in case.asked))


def functions_of(module: types.ModuleType) -> dict[str, Any]:
    """The functions of a module by qualified name, as they are under what remembers."""
    found: dict[str, Any] = {}
    scopes: list[Any] = [module]
    while scopes:
        for value in vars(scopes.pop()).values():
            function = getattr(value, "function", value)
            if isinstance(value, type) and value.__module__ == module.__name__:
                scopes.append(value)
            elif isinstance(function, types.FunctionType):
                if function.__module__ == module.__name__:
                    found[function.__qualname__] = function
    return found


def codes_in(code: types.CodeType) -> dict[str, types.CodeType]:
    """All code objects of a module by qualified name."""
    found = {}
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            found[constant.co_qualname] = constant
            found |= codes_in(constant)
    return found


class Patch:
    """A mutant in the place of what it changes."""

    def __init__(self, mutant: Mutant, loaded: dict[str, Loaded]) -> None:
        self.undo: list[Any] = []
        self.blocks = set(mutant.blocks)
        own = loaded[mutant.module]
        restore = mutant.change()
        try:
            code = own.code()
        finally:
            restore()
        if self.blocks:
            codes = codes_in(code)
            for name, function in functions_of(own.module).items():
                if function.__code__.co_code and name in codes:
                    self.undo.append((function, function.__code__))
                    function.__code__ = codes[name]
        else:
            self.change_names(own, code, loaded)

    def change_defaults(self, own: Loaded, fresh: types.ModuleType) -> None:
        """The default of a parameter, which is made where the module is read."""
        changed = functions_of(fresh)
        for name, function in functions_of(own.module).items():
            if function.__defaults__ != changed[name].__defaults__:
                self.undo.append((function, "__defaults__", function.__defaults__))
                function.__defaults__ = changed[name].__defaults__
                self.blocks |= own.blocks_of_function(name)

    def change_names(self, own: Loaded, code: types.CodeType, loaded: dict[str, Loaded]) -> None:
        """A constant of a module: it changes wherever it was imported."""
        fresh = types.ModuleType(own.module.__name__)
        fresh.__dict__.update(__file__=own.path, __package__=own.module.__package__, _hits=HITS)
        exec(code, fresh.__dict__)
        self.change_defaults(own, fresh)
        for name in own.constants:
            old, new = own.module.__dict__[name], fresh.__dict__[name]
            if old == new:
                continue
            for other in loaded.values():
                if other.module.__dict__.get(name) is old:
                    self.undo.append((other.module, name, old))
                    setattr(other.module, name, new)
                    self.blocks |= other.blocks_of_name.get(name, set())

    def revert(self) -> None:
        for entry in reversed(self.undo):
            if len(entry) == 2:
                entry[0].__code__ = entry[1]
            else:
                setattr(*entry)


def nearness(mutant: Mutant, loaded: dict[str, Loaded]) -> dict[str, int]:
    """Which codes are near a mutant: of its function, its module, or what imports its module."""
    near: dict[str, int] = {}
    for other in loaded.values():
        if f"from .{mutant.module} import" in other.source:
            near |= dict.fromkeys(other.codes_near(0), 2)
    return near | loaded[mutant.module].codes_near(mutant.line)


def try_mutant(mutant: Mutant, cases: list[Case], loaded: dict[str, Loaded], most: float) -> str:
    """The case that kills a mutant, or how many cases it survives."""
    try:
        patch = Patch(mutant, loaded)
    except Exception as fault:
        return f"killed: {type(fault).__name__} where the module is read"
    ran, spent = 0, time.process_time()
    CHANGED.begin(patch.blocks)
    try:
        near = nearness(mutant, loaded)
        chosen = [case for case in cases if case.all & CHANGED.mask]
        recent = RECENT.setdefault(mutant.module, [])
        chosen.sort(key=lambda case: (case not in recent, near.get(case.code, 3), case.seconds))
        for case in chosen:
            if time.process_time() - spent + case.seconds > most:
                break
            ran += 1
            seconds = max(LEAST_SECONDS, TIMES_SLOWER * case.seconds)
            says = says_of(case, loaded, seconds)
            if says != case.says:
                RECENT[mutant.module] = [case, *recent[:7]] if case not in recent else recent
                return f"killed: {case.name}"
        return f"survived: {ran} of {len(chosen)} cases"
    finally:
        patch.revert()
        CHANGED.end()


RECENT: dict[str, list[Case]] = {}


def line_of(mutant: Mutant, loaded: dict[str, Loaded]) -> str:
    return loaded[mutant.module].source.split("\n")[mutant.line - 1].strip()


def worker(
    share: int, jobs: int, mutants: Any, cases: Any, loaded: Any, most: float, out: str
) -> None:
    with open(f"{out}.{share}", "w", encoding="utf-8") as file:
        for number, mutant in enumerate(mutants):
            if number % jobs != share:
                continue
            result = try_mutant(mutant, cases, loaded, most)
            row = [number, mutant.module, mutant.line, mutant.kind, result, line_of(mutant, loaded)]
            file.write(json.dumps(row) + "\n")
            file.flush()


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("suite", nargs="?")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="modules whose names begin so, by commas")
    parser.add_argument("--cases", default="", help="cases whose names begin so, by commas")
    parser.add_argument("--without", default="", help="no cases whose names begin so, by commas")
    parser.add_argument("--seconds", type=float, default=60, help="for each mutant")
    parser.add_argument("--again", default="", help="results of which the survivors alone run")
    parser.add_argument("--every", type=int, default=1, help="each n-th mutant alone")
    parser.add_argument("--out", default="mutants.jsonl")
    parser.add_argument("--count", default="", help="counts these results again, and runs nothing")
    arguments = parser.parse_args()
    if arguments.count:
        with open(arguments.count, encoding="utf-8") as file:
            count([json.loads(line) for line in file])
        return 0
    loaded = load_package()
    remember_trees(loaded)
    cases = load_cases(arguments.suite, tuple(arguments.cases.split(",")))
    without = tuple(name for name in arguments.without.split(",") if name)
    cases = [case for case in cases if not case.name.startswith(without)]
    print(f"{len(cases)} cases", flush=True)
    run_baseline(cases, loaded)
    for case in [case for case in cases if not case.is_as_the_suite_has_it()]:
        print(f"{case.name}: left out, as this validator says {case.says}")
        cases.remove(case)
    print(f"judged in {sum(case.seconds for case in cases):.0f} s", flush=True)
    names = tuple(arguments.only.split(","))
    mutants = [m for one in loaded.values() if one.name.startswith(names) for m in mutants_of(one)]
    mutants = mutants[:: arguments.every]
    mutants = mutants[::2] + mutants[1::2]  # a run that is stopped is a sample
    if arguments.again:
        with open(arguments.again, encoding="utf-8") as file:
            rows = [json.loads(line) for line in file]
        left = {(row[1], row[3], row[5]) for row in rows if row[4].startswith("survived")}
        mutants = [m for m in mutants if (m.module, m.kind, line_of(m, loaded)) in left]
    print(f"{len(mutants)} mutants", flush=True)
    shares = [
        multiprocessing.get_context("fork").Process(
            target=worker,
            args=(n, arguments.jobs, mutants, cases, loaded, arguments.seconds, arguments.out),
        )
        for n in range(arguments.jobs)
    ]
    for share in shares:
        share.start()
    for share in shares:
        share.join()
    report(arguments.out, arguments.jobs)
    return 0


def said_to_be_same() -> set[tuple[str, str, str]]:
    """The mutants that `equivalent.txt` names: module, kind and line."""
    found = set()
    with open(os.path.join(HERE, "equivalent.txt"), encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                module, kinds, text = (part.strip() for part in line.split("|", 2))
                found |= {(module, kind.strip(), text) for kind in kinds.split(",")}
    return found


def report(out: str, jobs: int) -> None:
    """Puts the shares together, names the survivors, and counts by module."""
    rows = []
    for share in range(jobs):
        with open(f"{out}.{share}", encoding="utf-8") as file:
            rows += [json.loads(line) for line in file]
        os.remove(f"{out}.{share}")
    rows.sort()
    with open(out, "w", encoding="utf-8") as file:
        file.writelines(json.dumps(row) + "\n" for row in rows)
    count(rows)


def count(rows: list[Any]) -> None:
    same = said_to_be_same()
    counts: dict[str, list[int]] = {}
    survivors = set()
    for _, module, line, kind, result, text in rows:
        one = counts.setdefault(module, [0, 0, 0])
        if result.startswith("killed"):
            one[0] += 1
            continue
        survivors.add((module, kind, text))
        is_same = (module, kind, text) in same
        one[1 if is_same else 2] += 1
        if not is_same:
            print(f"{module}.py:{line}: {kind}: {text} ({result})")
    for module, kind, text in sorted(same - survivors):
        if module in counts:
            print(f"{module}: {kind}: {text}: said to be the same, and killed, or not there")
    counts["all"] = [sum(one[n] for one in counts.values()) for n in range(3)]
    for module, (killed, equal, left) in counts.items():
        print(f"{module}: {killed} killed, {equal} the same, {left} survived")


if __name__ == "__main__":
    sys.exit(main())
