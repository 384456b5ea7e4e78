"""Makes a URDD of every robot of some folders, and validates it: what we make has no finding.

    python3 tests/figures/robots/judge.py target/release/urdd LOG FOLDER... [--only REGEX] [--lanes N] [--options "--samples 100"]

Robots are URDFs, xacro files (with the program `xacro`), MJCFs, and USDs. A file that `generate` refuses is counted with its
reason and is no fault here: tests/figures/imports and tests/figures/programs hold what is read. Rules of the family SRC are
facts about the robot as its author wrote it, so their findings are counted and are no fault. LOG gets a line a robot; a run that
was ended goes on where it was, and what had a finding, or was ended, is tried again.
Exits with 1 where a URDD has another finding or `validate` ends otherwise, and where fewer than --least robots were judged.
"""

import argparse
import collections
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys
import tempfile

# Of the source, not of what we make of it (SPEC 6.1.7).
OF_THE_SOURCE = "SRC"
USD = {".usd", ".usda", ".usdc", ".usdz"}


def robots(folder, only):
    """The files of a folder that may describe a robot."""
    for path in sorted(folder.rglob("*")):
        if not path.is_file() or only is not None and not re.search(only, str(path)):
            continue
        end = path.suffix.lower()
        if end in {".urdf", ".xacro"} | USD or end == ".xml" and re.search(rb"<mujoco[\s>]", path.read_bytes()):
            yield path


def judge(program, path, seconds, options):
    """What became of a robot."""
    run = lambda *command: subprocess.run([program, *command], capture_output=True, text=True, timeout=seconds)
    with tempfile.TemporaryDirectory() as folder:
        try:
            made = run("generate", str(path), "-o", folder + "/urdd", "--threads", "1", *options)
            if made.returncode != 0:
                lines = [line for line in made.stderr.splitlines() if ": note: " not in line] or [f"status {made.returncode}"]
                # A crash is a fault of ours.
                return {"state": "refused" if made.returncode == 1 else "wrong", "why": " ".join(lines[:2])[:300]}
            found = run("validate", folder + "/urdd", "--fail-on", "info", "--format", "json")
        except subprocess.TimeoutExpired:
            return {"state": "ended", "why": f"after {seconds} s"}
    try:
        (report,) = json.loads(found.stdout)["urdds"]
    except (ValueError, KeyError):
        return {"state": "wrong", "why": f"status {found.returncode}: {found.stderr[:300]}"}
    codes, first = collections.Counter(), {}
    for finding in report["findings"]:
        codes[finding["code"]] += finding.get("count", 1)
        first.setdefault(finding["code"], finding["message"][:300])
    faults = {code: text for code, text in first.items() if not code.startswith(OF_THE_SOURCE)}
    known = found.returncode in (0, 1)
    return {"state": "right" if known and not faults else "wrong", "codes": codes, "why": faults}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("log", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    parser.add_argument("--only")
    parser.add_argument("--lanes", type=int, default=2)
    parser.add_argument("--seconds", type=int, default=600)
    parser.add_argument("--least", type=int, default=1)
    parser.add_argument("--options", type=str.split, default=[], help="of `generate`")
    given = parser.parse_args()

    known = {}
    for line in given.log.read_text().splitlines() if given.log.exists() else []:
        known[json.loads(line)["robot"]] = json.loads(line)
    paths = [path for folder in given.folders for path in robots(folder, given.only)]
    table = collections.Counter()
    with given.log.open("a") as log, concurrent.futures.ThreadPoolExecutor(given.lanes) as pool:

        def one(path):
            before = known.get(str(path), {"state": "new"})
            if before["state"] in ("right", "refused"):
                return before
            return {"robot": str(path), **judge(given.program, path, given.seconds, given.options)}

        for found in pool.map(one, paths):
            table[found["state"]] += 1
            if found is not known.get(found["robot"]):
                print(json.dumps(found), file=log, flush=True)
            if found["state"] in ("wrong", "ended"):
                print(f"{found['robot']}: {found['state']}: {found['why']}", flush=True)
    judged = table["right"] + table["wrong"]
    print(f"{judged} robots made and validated, {table['right']} without a finding; {table['refused']} refused, {table['ended']} ended")
    return 1 if table["wrong"] or table["ended"] or judged < given.least else 0


if __name__ == "__main__":
    sys.exit(main())
