#!/usr/bin/env python3
"""Asks programs what they make of each changed file, and writes or checks the table.

    python3 run.py --table TABLE.txt                    # singles and pairs, all programs
    python3 run.py --check TABLE.txt                    # asks again, and names what differs
    python3 run.py --programs mujoco,drake              # answers alone: SCRATCH/answers/PROGRAM.jsonl
    python3 run.py --programs mujoco --only mass --show # each answer as a line
    python3 run.py --stored mujoco --show               # the answers of an earlier run
    python3 run.py --programs none --table TABLE.txt    # a table of all answers that are there

`real.py` makes changes of real robots, for which --real names its list.
"""

from __future__ import annotations

import argparse
import collections
import hashlib
import json
import shutil
import sys
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import changes
import differ
import facts
import table
from change import BASE, Edit, apply
from driver import HERE, Answer, Driver, Program, programs


# What PyBullet takes from memory that it has not written, or overwrites while it goes round: another answer each time.
RANDOM = {
    ("pybullet", "all/shoulder.axis@xyz:attribute_upper"),
    ("pybullet", "all/shoulder.axis:repeated_empty_first"),
    ("pybullet", "small/tree:loop_of_two"),
}


@dataclass
class Case:
    """A changed file. `base_file` is the unchanged one beside it."""

    row: table.Row
    file: Path
    base_file: Path
    packages: str


def cases_of_bases(rows: list[table.Row], scratch: Path) -> list[Case]:
    """Writes each changed file into one folder with the base's meshes."""
    folder = scratch / "files"
    if not (folder / "packages").exists():
        changes.write([], folder)
    made = []
    for number, row in enumerate(rows):
        file = folder / f"{number:05}.urdf"
        content = apply((BASE / row.base).read_bytes(), row.edits)
        if not file.exists() or file.read_bytes() != content:  # another run may read it now
            file.write_bytes(content)
        made.append(Case(row, file, folder / row.base, str(folder / "packages")))
    return made


def cases_of_real(path: Path) -> list[Case]:
    """What real.py wrote, with the unchanged files."""
    made: list[Case] = []
    for line in path.read_text("utf-8").splitlines():
        read = json.loads(line)
        base_file, base = Path(read["base_file"]), read["base"]
        if not made or made[-1].row.base != base:
            unchanged = table.Row(f"{base}/unchanged", base, "none", (), {})
            made.append(Case(unchanged, base_file, base_file, read["packages"]))
        edits = tuple(Edit(start, end, text.encode("latin-1")) for start, end, text in read["edits"])
        row = table.Row(read["id"], base, read["kind"], edits, read["means"])
        made.append(Case(row, Path(read["file"]), base_file, read["packages"]))
    return made


def rows_now(with_pairs: bool, every: bool, only: str) -> list[table.Row]:
    made = []
    before = {base: facts.meant((BASE / base).read_bytes()) for base in changes.BASES}
    bases = [table.Row(f"{base.removesuffix('.urdf')}/unchanged", base, "none", (), {}) for base in changes.BASES]
    for change in [*changes.singles(every), *(changes.pairs() if with_pairs else [])]:
        if only in change.id:
            data = (BASE / change.base).read_bytes()
            means = change.means(data, before[change.base])
            literal = bool(change.meant) and change.meant == change.edits
            made.append(table.Row(change.id, change.base, change.kind, change.edits, means, literal))
    return bases + made


@dataclass
class Answers:
    """What a program said of each changed file, and of each unchanged one by its path."""

    by_id: dict[str, Answer]
    of_bases: dict[str, Answer]


def ask(program: Program, cases: list[Case], scratch: Path, seconds: float, earlier: Answers) -> Answers:
    """Asks for all cases that earlier answers do not have as they are; writes SCRATCH/answers/PROGRAM.jsonl."""
    found = Answers({}, {})

    def answer(driver: Driver, file: Path, was: Answer | None) -> Answer:
        content = hashlib.sha256(file.read_bytes()).hexdigest()[:16]
        return was if was and was.content == content else replace(driver.ask(file), content=content)

    path = scratch / "answers" / f"{program.name}.jsonl"
    path.parent.mkdir(parents=True, exist_ok=True)
    drivers: dict[str, Driver] = {}
    try:
        with path.open("w", encoding="utf-8") as out:
            for case in cases:
                driver = drivers.setdefault(case.packages, Driver(program, case.packages, seconds))
                base = str(case.base_file)
                if base not in found.of_bases:
                    found.of_bases[base] = answer(driver, case.base_file, earlier.of_bases.get(base))
                    out.write(json.dumps({"base": base} | asdict(found.of_bases[base])) + "\n")
                found.by_id[case.row.id] = answer(driver, case.file, earlier.by_id.get(case.row.id))
                out.write(json.dumps({"id": case.row.id} | asdict(found.by_id[case.row.id])) + "\n")
                out.flush()
    finally:
        for driver in drivers.values():
            driver.stop()
    return found


def stored(program: Program, scratch: Path) -> Answers:
    """Those of an earlier run."""
    path, found = scratch / "answers" / f"{program.name}.jsonl", Answers({}, {})
    for line in path.read_text("utf-8").splitlines() if path.exists() else []:
        one = json.loads(line)
        name, base = one.pop("id", None), one.pop("base", None)
        if name is not None:
            found.by_id[name] = Answer(**one)
        else:
            found.of_bases[base] = Answer(**one)
    return found


def fill(cases: list[Case], program: Program, answers: Answers, show: bool) -> None:
    """Writes into each row what the program said of it."""
    kinds = {differ.kind(key) for of_base in answers.of_bases.values() for key in of_base.facts}
    meant: dict[Path, dict[str, str]] = {}
    verdicts: collections.Counter[str] = collections.Counter()
    otherwise = 0
    for case in cases:
        got, row = answers.by_id.get(case.row.id), case.row
        if got is None:
            continue
        verdicts[got.verdict] += 1
        row.verdicts[program.letter] = got.verdict
        base = answers.of_bases[str(case.base_file)]
        if got.verdict == "loads" == base.verdict:
            if case.base_file not in meant:
                meant[case.base_file] = facts.meant(case.base_file.read_bytes())
            found = differ.differences(base.facts, meant[case.base_file], row.means, kinds, got.facts)
            # The place of the files is not the program's.
            folder = str(case.file.parent)
            found = [fact.replace(f"{folder}/", "").replace(folder, ".") for fact in found]
            row.differences[program.letter] = found
            otherwise += bool(found)
        if show:
            differs = " ".join(row.differences.get(program.letter, []))
            print(f"{got.verdict:8} {row.id}  {got.why[:150]}  {differs[:300]}", flush=True)
    text = ", ".join(f"{count:,} {verdict}" for verdict, count in verdicts.most_common())
    print(f"{program.name}: {text or 'not asked'}; {otherwise:,} otherwise than meant", flush=True)


def compare(before: list[table.Row], now: dict[str, table.Row], asked: list[Program]) -> int:
    """Prints what differs; how many do."""
    count = 0
    for row in before:
        for program in asked:
            letter, other = program.letter, now[row.id]
            if letter not in row.verdicts or letter not in other.verdicts or (program.name, row.id) in RANDOM:
                continue
            was = row.verdicts[letter], row.differences.get(letter, [])
            is_now = other.verdicts[letter], other.differences.get(letter, [])
            if was != is_now:
                count += 1
                print(f"{program.name}\t{row.id}\t{was[0]} {' '.join(was[1])}\t{is_now[0]} {' '.join(is_now[1])}")
    return count


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--drivers", type=Path, default=HERE)
    parser.add_argument("--peers", type=Path, default=Path(sys.executable))
    parser.add_argument("--venvs", type=Path, default=HERE)
    parser.add_argument("--scratch", type=Path, default=Path("/tmp/urdd_programs"))
    parser.add_argument("--programs", default="")
    parser.add_argument("--stored", default="", help="programs whose answers are there already")
    parser.add_argument("--update", action="store_true", help="keep answers of files that are as they were")
    parser.add_argument("--only", default="")
    parser.add_argument("--every", action="store_true")
    parser.add_argument("--singles", action="store_true", help="no pairs")
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--seconds", type=float, default=30)
    parser.add_argument("--real", type=Path)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--check", type=Path)
    options = parser.parse_args()
    known = programs(options.drivers, options.peers, options.venvs)
    usual = [name for name, program in known.items() if not program.by_hand or shutil.which(program.command[0])]
    named = options.programs.split(",") if options.programs else [] if options.stored else usual
    named = [] if named == ["none"] else named
    asked = [known[name] for name in named]
    if options.real:
        cases = [case for case in cases_of_real(options.real) if options.only in case.row.id]
        rows = [case.row for case in cases]
    elif options.check:
        before = table.read(options.check)
        rows = [replace(row, verdicts={}, differences={}) for row in before]
        cases = cases_of_bases(rows, options.scratch)
    else:
        rows = rows_now(not options.singles, options.every, options.only)
        cases = cases_of_bases(rows, options.scratch)
    for program in known.values():
        if program in asked:
            earlier = stored(program, options.scratch) if options.update else Answers({}, {})
            fill(cases, program, ask(program, cases, options.scratch, options.seconds, earlier), options.show)
        elif options.table or program.name in options.stored.split(","):
            fill(cases, program, stored(program, options.scratch), options.show)
    if options.table:
        table.write(options.table, known.values(), rows)
    if options.check:
        sys.exit(1 if compare(before, {row.id: row for row in rows}, asked) else 0)


if __name__ == "__main__":
    main()
