#!/usr/bin/env python3
"""What the readers of `urdd lint` say, and what the programs do, on real URDFs (corpus.md).

    python3 programs.py READERS CORPUS LINTED ANSWERS.jsonl [SECONDS]

READERS is the output of `URDD_TRIALS=5 cargo test -p urdd-programs --test programs -- --nocapture`: what readers say of the
changed files of tests/figures/programs. LINTED has `urdd lint --format json CORPUS/PACKAGE` as PACKAGE.json. Up to 4 URDFs a package are drawn (seed 1), and each program is asked by its driver until SECONDS are over; answers that are in
ANSWERS.jsonl are kept. DRIVERS, PEERS and VENVS say where drivers, Python and venvs are, as `run.py` there has it. Packages are
found where lint finds them, so drive_drake.py must take each folder in PACKAGES as a package (`package_map().Add`), not only
those with a package.xml. Leave MuJoCo 3.3 out: it looks for meshes beside the URDF, where packages do not have them. Writes benches/results/lint_programs.json.
"""

from __future__ import annotations

import collections
import hashlib
import json
import os
import random
import re
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path += [str(HERE.parents[1]), str(ROOT / "tests/figures/programs")]
import driver  # noqa: E402
import results  # noqa: E402

PROGRAMS = {
    "urdfdom6": "ROS lyrical, rolling (urdfdom)",
    "urdfdom4": "ROS jazzy, kilted (urdfdom)",
    "urdfdom3": "ROS noetic, humble, iron (urdfdom)",
    "sdformat": "Gazebo Fortress (libsdformat)",
    "mujoco": "MuJoCo 4",
    "mujoco33": "MuJoCo 3.3",
    "pinocchio": "Pinocchio",
    "drake": "Drake",
    "pybullet": "PyBullet",
    "usd": "Isaac and Newton (urdf-usd-converter)",
    "urdf_loader": "three.js (urdf-loader)",
}
SCORE = re.compile(r"^(\w+): [\d.]+ % of (\d+) verdicts, ([\d.]+) % of (\d+) losses named, (\d+) of (\d+) claims not so$", re.M)
VERDICTS = re.compile(r"^(\w+): ([\d.]+) % of", re.M)
REFERENCE = re.compile(r"(?:package|model)://([^/\"'<>\s]+)/([^\"'<>]+)")


def drawn(corpus: Path) -> list[str]:
    """Up to 4 URDFs a package, one a round."""
    generator, by_package = random.Random(1), []
    for package in sorted(corpus.iterdir()):
        urdfs = sorted(str(file.relative_to(corpus)) for file in package.rglob("*") if file.suffix.lower() == ".urdf" and file.is_file())
        generator.shuffle(urdfs)
        by_package.append(urdfs)
    return [urdfs[turn] for turn in range(4) for urdfs in by_package if turn < len(urdfs)]


def packages(corpus: Path, urdf: Path, scratch: Path) -> str | None:
    """A folder with a link to each package that the URDF names: of those with its name, the one with most of the files.

    None if one is not in the corpus: "loads" supposes that packages are found.
    """
    top = corpus / urdf.relative_to(corpus).parts[0]
    above = [folder for folder in urdf.parents if folder.is_relative_to(top)]
    files: dict[str, set[str]] = collections.defaultdict(set)
    for name, rest in REFERENCE.findall(urdf.read_text("utf-8", "replace")):
        files[name].add(rest)
    found = {}
    for name, rests in sorted(files.items()):
        places = [place for folder in above for place in (folder, folder / name) if place.name == name and place.is_dir()]
        for manifest in sorted(top.rglob("package.xml")):
            if re.search(rf"<name>\s*{re.escape(name)}\s*</name>", manifest.read_text("utf-8", "replace")):
                places.append(manifest.parent)
        if not places:
            return None
        found[name] = max(places, key=lambda place: sum((place / rest).exists() for rest in rests))
    folder = scratch / hashlib.sha1(repr(found).encode()).hexdigest()[:12]
    if found and not folder.exists():
        folder.mkdir()
        for name, place in found.items():
            (folder / name).symlink_to(place)
    return str(folder) if found else ""


def ask(corpus: Path, answers: Path, seconds: float) -> list[dict[str, str]]:
    """Who loads what."""
    place = lambda name: Path(os.environ.get(name, HERE))
    known = driver.programs(place("DRIVERS"), place("PEERS"), place("VENVS"))
    rows = [json.loads(line) for line in answers.read_text("utf-8").splitlines()] if answers.exists() else []
    done = {(row["urdf"], row["program"]) for row in rows}
    end = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as scratch, answers.open("a", encoding="utf-8") as out:
        for urdf in drawn(corpus) if seconds else []:
            of_urdf = packages(corpus, corpus / urdf, Path(scratch))
            for program in known.values():
                if of_urdf is None or (urdf, program.name) in done or time.monotonic() > end:
                    continue
                with driver.Driver(program, of_urdf, 45) as asked:
                    answer = asked.ask(corpus / urdf)
                rows.append({"urdf": urdf, "program": program.name, "verdict": answer.verdict, "why": answer.why[:300]})
                out.write(json.dumps(rows[-1]) + "\n")
    return rows


def main() -> None:
    readers, corpus, linted, answers = (Path(argument).resolve() for argument in sys.argv[1:5])
    text = readers.read_text("utf-8")
    scores = {score[1]: score for score in SCORE.finditer(text)}
    shares = dict(VERDICTS.findall(text))
    said = {}
    for report in sorted(linted.glob("*.json")):
        for urdf in json.loads(report.read_text("utf-8") or '{"urdds": []}')["urdds"]:
            for program in urdf["programs"]:
                said[f"{report.stem}/{urdf['path']}", program["program"]] = program["does"] not in ("refuses", "crashes")
    same: dict[str, collections.Counter[bool]] = collections.defaultdict(collections.Counter)
    urdfs = set()
    for row in ask(corpus, answers, float(sys.argv[5]) if len(sys.argv) > 5 else 0.0):
        key = (row["urdf"], row["program"])
        # A program that takes longer than the time allowed says nothing.
        if key in said and row["verdict"] != "hangs":
            is_same = said[key] == (row["verdict"] == "loads")
            same[row["program"]][is_same] += 1
            urdfs.add(row["urdf"])
            if not is_same:
                print(*key, row["verdict"], row["why"], sep=" | ")
    versions = {program.name: program.version for program in driver.programs(HERE, HERE, HERE).values()}
    rows = []
    for name, shown in PROGRAMS.items():
        score, real = scores[name], same[name]
        rows.append([
            shown,
            versions[name],
            f"{int(score[2]):,}",
            f"{shares[name]} %",
            f"{score[3]} % of {int(score[4]):,}",
            f"{real[True]} of {real.total()}" if real else "not compared",
        ])
    columns = ["program", "version", "changes tried", "verdicts equal", "losses named", "real URDFs, verdicts equal"]
    count = len({urdf.split("/")[0] for urdf in urdfs})
    results.write("lint_programs", {"programs": {"columns": columns, "rows": rows}, "real": f"{len(urdfs)} URDFs of {count} packages"})


if __name__ == "__main__":
    main()
