"""Imports MJCF models and compares what comes out with MuJoCo's compiled model.

    pip install mujoco==4.0.0 numpy trimesh
    python3 tests/figures/imports/mjcf.py target/debug/urdd FOLDER --log LOG [--only REGEX] [--write FILE]

Every MJCF below FOLDER/PACKAGE/… that MuJoCo compiles is imported, and compared:

- poses of all bodies in 100 random configurations, by an FK of our own (kinematics.py): 1e-9 m and rad
- masses, centres, inertias: 1e-9 of the body's own; 1e-5 where a mesh gives them (MuJoCo keeps 32-bit vertices)
- limits, forces and gains, named poses, pairs that never collide
- shapes: kinds, sizes, poses; of meshes the box around all vertices (1e-5 of it)

LOG gets a line for each model. A run that was ended goes on where it was; what was refused or wrong is tried again. `--write`
writes a table by package. Exits with 1 if something is wrong.
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
import tomllib
import xml.etree.ElementTree as ET

HERE = pathlib.Path(__file__).resolve().parent
SECONDS = 300
CONFIGURATIONS = 100


def one(program, path, options):
    """What became of a model: its state, and what is wrong."""
    import warnings

    warnings.filterwarnings("ignore")
    import mujoco

    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except Exception as error:
        return {"state": "not compiled", "why": str(error).splitlines()[0][:200]}
    if model.nbody == 1:
        return {"state": "not compiled", "why": "there is no body in it"}
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "import", str(path), "-o", folder + "/out", *options]
        run = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS)
        if run.returncode != 0:
            text = (run.stderr or run.stdout).strip().splitlines()
            return {"state": "refused", "why": " ".join(text[:2])[:300]}
        from compare import compare

        try:
            wrong, facts = compare(model, pathlib.Path(folder) / "out")
        except Exception as error:
            import traceback

            return {"state": "wrong", "why": ["the comparison failed: " + repr(error) + traceback.format_exc()[-300:]]}
        return {"state": "wrong" if wrong else "right", "why": wrong[:6], **facts}


def models(folder, only):
    for path in sorted(folder.rglob("*.xml")):
        text = path.read_text(errors="replace")
        if re.search(r"<mujoco[\s>]", text) and (only is None or re.search(only, str(path))):
            yield path


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only")
    parser.add_argument("--log", type=pathlib.Path)
    parser.add_argument("--one", action="store_true")
    parser.add_argument("--write", type=pathlib.Path)
    parser.add_argument("--lanes", type=int, default=2)
    parser.add_argument("rest", nargs="*")
    given = parser.parse_args()
    if given.one:
        sys.path.insert(0, str(HERE))
        print(json.dumps(one(given.program, given.folder, given.rest)))
        return 0

    known = {}
    for line in given.log.read_text().splitlines() if given.log and given.log.exists() else []:
        known[json.loads(line)["model"]] = json.loads(line)
    log = given.log.open("a") if given.log else sys.stdout

    def run(path):
        before = known.get(str(path.relative_to(given.folder)), {"state": "new"})
        if before["state"] in ("right", "not compiled"):
            return before
        command = [sys.executable, __file__, given.program, str(path), "--one"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS)
            return json.loads(done.stdout.splitlines()[-1])
        except subprocess.TimeoutExpired:
            return {"state": "not compiled", "why": "MuJoCo takes too long"}
        except (IndexError, json.JSONDecodeError):
            return {"state": "not compiled", "why": f"MuJoCo ends with {done.returncode}"}

    paths = list(models(given.folder, given.only))
    table = collections.defaultdict(lambda: collections.Counter())
    reasons = collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(given.lanes) as pool:
        for path, found in zip(paths, pool.map(run, paths)):
            package = path.relative_to(given.folder).parts[0]
            table[package]["models"] += 1
            table[package][found["state"]] += 1
            if found["state"] == "refused":
                reasons[re.sub(r"^.*?: ", "", found["why"])[:120]] += 1
            if found is not known.get(str(path.relative_to(given.folder))):
                print(json.dumps({"model": str(path.relative_to(given.folder)), **found}), file=log, flush=True)
    rows = ["| package | models | MuJoCo compiles | imported | right | wrong | refused |", "|---|---|---|---|---|---|---|"]
    total = collections.Counter()
    for package, of in sorted(table.items()):
        total.update(of)
        rows.append(row(package, of))
    rows.append(row("all", total))
    print("\n".join(rows))
    if given.write:
        why = [f"- {count}: {text}" for text, count in reasons.most_common()]
        given.write.write_text("\n".join(rows + ["", "Refused:", "", *why, ""]))
    return 1 if total["wrong"] else 0


def row(name, of):
    compiled = of["models"] - of["not compiled"]
    imported = compiled - of["refused"]
    return f"| {name} | {of['models']} | {compiled} | {imported} | {of['right']} | {of['wrong']} | {of['refused']} |"


if __name__ == "__main__":
    sys.exit(main())
