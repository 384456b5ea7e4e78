#!/usr/bin/env python3
"""What MuJoCo and Pinocchio do with what `urdd lint` finds in masses and inertias (evidence.md).

    python3 benches/evaluation/lint/inertia_peers.py target/release/urdd FOLDER [TRIED.jsonl]

FOLDER has a folder for each package, as for corpus.py. Needs mujoco, pin, trimesh and what prototype.py needs. A
finding is tried alone: every flagged inertia of the URDF is mended by the hull of the link's shapes, and this one is
put back as it is written. URDFs are written anew with inertias and joints only. Writes
benches/results/lint_inertia.json, and every trial as a JSON line if a file is named.
"""

from __future__ import annotations

import collections
import importlib.metadata
import itertools
import json
import random
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree
from mending import CONTROLS, PART, hull_of
from model import Robot
from peers import REFUSALS, UNSTABLE
from shapes import link_shapes
from trial import Trial

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import results

#: Rules that say that a simulator refuses.
BAD = {"SRC003", "SRC004", "SRC005", "LNT006", "LNT008"}
_COLUMNS = {
    "rules": "rule/tried/URDFs/packages/MuJoCo refuses/M is singular/grows when free/diverges with a PD/differs"
    "/no effect",
    "ratios": "rule/compared/to 0.1/to 0.8/to 1.25/to 2/to 10/more/condition 10 times worse",
    "groups": "URDFs/number/MuJoCo refuses/Pinocchio refuses/M is singular/least below 1e-6/unstable when free"
    "/energy grows when free/diverges with a PD",
    "refusals": "MuJoCo/URDFs/with SRC003 to 005, LNT006, LNT008/without/of these, SRC not run",
}
COLUMNS = {name: columns.split("/") for name, columns in _COLUMNS.items()}
PEERS = {"MuJoCo": "mujoco", "Pinocchio": "pin"}
PER_PACKAGE, PER_URDF = 8, 10  # URDFs of a rule and package, findings of a rule and URDF


def linted(program: str, corpus: Path) -> tuple[dict[Path, list[tuple[str, str | None, str]]], set[Path]]:
    """URDF -> what is found: rule, subject, message; and the URDFs in which the rules SRC were skipped."""
    skipped: set[Path] = set()
    found: dict[Path, list[tuple[str, str | None, str]]] = {}
    for package in sorted(path for path in corpus.iterdir() if path.is_dir()):
        command = [program, "lint", "--format", "json", "--select", ",".join(PART), str(package)]
        text = subprocess.run(command, capture_output=True, text=True).stdout
        for urdf in json.loads(text)["urdds"] if text else []:
            rows = found.setdefault(package / urdf["path"], [])
            if any(check["code"] == "SRC005" and check["status"] == "skipped" for check in urdf["checks"]):
                skipped.add(package / urdf["path"])
            for one in urdf["findings"]:
                rows += [(one["code"], p["subject"], p["message"] or one["message"]) for p in one["places"]]
    return found, skipped


def differs(row: dict[str, Any]) -> bool:
    """Whether a joint's apparent inertia at zero differs by a quarter, or gravity's largest torque by a fifth."""
    return not 0.8 <= row["ratio"] <= 1.25 or row["torque"] > 0.2


def controls(robot: Robot, rng: random.Random) -> list[tuple[str, str | None, str]]:
    """Up to three links with mass and shapes of their own, for each kind of control."""
    fit = [n for n, link in robot.links.items() if (link.mass or 0) > 0 and link.tensor is not None]
    fit = [n for n in rng.sample(fit, len(fit)) if link_shapes(robot)[n] and hull_of(robot, n, False)][:3]
    return [(rule, f"link `{name}`", "") for rule in CONTROLS for name in fit]


def sampled(found: dict[Path, list[Any]], corpus: Path) -> tuple[list[Path], list[Path]]:
    """URDFs with findings, up to 8 for each rule and package, and as many without from the same packages."""
    rng = random.Random(1)
    chosen: set[Path] = set()
    plain: list[Path] = []
    packages = collections.defaultdict(list)
    for path in sorted(found):
        packages[path.relative_to(corpus).parts[0]].append(path)
    for files in packages.values():
        before = len(chosen)
        for rule in PART:
            having = [path for path in files if any(one[0] == rule for one in found[path])]
            chosen |= set(rng.sample(having, min(PER_PACKAGE, len(having))))
        others = [path for path in files if not found[path] and b"<mass" in path.read_bytes()]
        plain += rng.sample(others, min(len(chosen) - before, len(others)))
    return sorted(chosen), plain


def share(values: list[bool | None]) -> str:
    """How many are true, of those that are known."""
    known = [value for value in values if value is not None]
    return f"{sum(known):,} of {len(known):,}"


def trials(found: dict[Path, list[Any]], corpus: Path) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """What was tried: a row for each finding, and a row for each URDF as a whole."""
    chosen, plain = sampled(found, corpus)
    rng, rows, whole = random.Random(1), [], []
    for path in [*chosen, *plain]:
        parts = path.relative_to(corpus).parts
        about = {"package": parts[0], "file": "/".join(parts)}
        try:
            trial = Trial(path, corpus / parts[0], found[path])
            if not found[path]:
                trial = Trial(path, corpus / parts[0], controls(trial.robot, rng))
            (base, gains, _), every = trial.base("*", False), trial.model(tuple(trial.robot.links), "*")
            whole.append({**about, "group": "written" if found[path] else "plain", **every.said(gains)})
            if found[path]:
                whole.append({**about, "group": "mended", **base.said()})
            for rule in [*PART, *CONTROLS]:
                having = [finding for finding in trial.findings if finding.rule == rule]
                rows += [{**about, **trial.tried(one)} for one in rng.sample(having, min(PER_URDF, len(having)))]
        except (ValueError, KeyError, etree.XMLSyntaxError) as error:
            whole.append({**about, "group": "not tried", "why": str(error).split(chr(10))[0]})
        print(len(whole), "/".join(parts), file=sys.stderr, flush=True)
    return rows, whole


def refusals(found: dict[Path, list[Any]], skipped: set[Path], corpus: Path) -> list[dict[str, Any]]:
    """Every URDF as it is written: whether MuJoCo refuses it, and what the rules say."""
    rows = []
    for path in sorted(found):
        parts, rules = path.relative_to(corpus).parts, sorted({one[0] for one in found[path]})
        row = {"file": "/".join(parts), "group": "all", "rules": rules, "skipped": path in skipped}
        try:
            trial = Trial(path, corpus / parts[0], found[path])
            rows.append({**row, "mujoco": trial.model(tuple(trial.robot.links), "*").refused})
        except (ValueError, KeyError, etree.XMLSyntaxError):
            rows.append({**row, "mujoco": "other: not a tree, or not read"})
    return rows


def new(row: dict[str, Any], kind: str) -> bool | None:
    """Whether a motion goes wrong that does not with the mended inertia; None where it cannot be told."""
    return None if row.get(f"mended_{kind}", "?") else bool(row[kind])


def idle(row: dict[str, Any]) -> bool | None:
    """Whether no peer shows anything of a finding; None where it cannot be told."""
    if "ratio" not in row or not row["compared"] or row["mended"]:
        return None
    fine = row["definite"] and not row["mujoco"] and not differs(row) and row.get("motion", 0) <= 0.2
    return bool(fine and not new(row, "free") and not new(row, "pd"))


def tables(rows: list[Any], whole: list[Any], every: list[Any], names: dict[str, str]) -> dict[str, Any]:
    """The items of the results."""
    rules, ratios, groups, refused, unnoticed = [], [], [], [], ""
    for rule in [*PART, *CONTROLS]:
        of = [row for row in rows if row["rule"] == rule]
        alone = [row for row in of if rule in BAD or not BAD & set(row["also"])]
        known = [row for row in of if row["compared"] and "ratio" in row]
        solvable = [row for row in alone if row["mended_pinocchio"] and row.get("mended_definite", True)]
        told: list[list[bool | None]] = [
            [bool(row["mujoco"]) for row in alone if not row["mended"]],
            [not row.get("definite") for row in solvable],
            *([new(row, kind) for row in of] for kind in ("free", "pd")),
            [differs(row) for row in known],
            [idle(row) for row in of],
        ]
        counts = [len(of), *(len({row[key] for row in of}) for key in ("file", "package"))]
        rules.append([names.get(rule, rule), *map(str, counts), *map(share, told)])
        bounds = (-1, 0.1, 0.8, 1.25, 2, 10, np.inf)
        within = [sum(low < row["ratio"] <= high for row in known) for low, high in itertools.pairwise(bounds)]
        worse = [row["condition"] > 10 * row["mended_condition"] for row in alone if "condition" in row]
        ratios.append([names.get(rule, rule), f"{len(known)}", *map(str, within), share(worse)])
        if rule == "LNT001":
            unnoticed = share([0.8 <= row["ratio"] <= 1.25 for row in known if row in alone])
    for group, name in {"written": "with findings", "mended": "the same, mended", "plain": "without findings"}.items():
        of = [row for row in whole if row["group"] == group]
        moving = [row for row in of if "free" in row]
        told = [
            [bool(row["mujoco"]) for row in of],
            [not row["pinocchio"] for row in of],
            [not row["definite"] for row in of if "definite" in row],
            [row["least"] < 1e-6 for row in of if "least" in row],
            [row["free"] == UNSTABLE for row in moving],
            [bool(row["free"]) for row in moving],
            [bool(row["pd"]) for row in moving],
        ]
        groups.append([name, f"{len(of)}", *map(share, told)])
    for kind in ["", *REFUSALS.values(), "other"]:
        of = [row for row in every if row["mujoco"].partition(":")[0] == kind]
        silent = [row for row in of if not BAD & set(row["rules"])]
        counts = [len(of), len(of) - len(silent), len(silent), sum(row["skipped"] for row in silent)]
        refused.append([kind or "loads", *(f"{count:,}" for count in counts)])
    lists = {"rules": rules, "ratios": ratios, "groups": groups, "refusals": refused}
    items: dict[str, Any] = {name: {"columns": COLUMNS[name], "rows": rows} for name, rows in lists.items()}
    findings = sum(not row["rule"].startswith("control") for row in rows)
    texts = {"findings": f"{findings:,}", "corpus": f"{len(every):,} URDFs", "unnoticed": unnoticed}
    return items | texts


def main() -> None:
    program, corpus = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).resolve()
    explained = [subprocess.check_output([program, "explain", kind, "--format", "json"]) for kind in ("LNT", "SRC")]
    names = {one["code"]: f"{one['code']} {one['name']}" for text in explained for one in json.loads(text)}
    found, skipped = linted(program, corpus)
    rows, whole = trials(found, corpus)
    every = refusals(found, skipped, corpus)
    if len(sys.argv) > 3:
        plain = lambda value: value.item() if hasattr(value, "item") else str(value)  # noqa: E731
        lines = ({**row, "idle": idle(row)} if "rule" in row else row for row in [*rows, *whole, *every])
        Path(sys.argv[3]).write_text("".join(json.dumps(line, default=plain) + "\n" for line in lines))
    versions = [f"{name} {importlib.metadata.version(package)}" for name, package in PEERS.items()]
    ours = "urdd " + subprocess.check_output([program, "--version"], text=True).split()[-1]
    results.write("lint_inertia", tables(rows, whole, every, names), ours, *versions)


if __name__ == "__main__":
    main()
