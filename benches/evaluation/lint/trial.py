"""A URDF with its flagged inertias mended, and one finding at a time put back."""

from __future__ import annotations

import collections
import re
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from mending import Inertial, mended, part_of, written
from model import Robot
from peers import START, Model


class Finding(NamedTuple):
    rule: str
    links: tuple[str, ...]
    message: str


class Trial:
    """The flagged links of a URDF mended, and one finding at a time put back."""

    def __init__(self, path: Path, root: Path, found: list[tuple[str, str | None, str]]) -> None:
        self.robot = robot = Robot(path, root)
        if len(robot.roots) != 1 or len(robot.body_of()) != len(robot.links):
            raise ValueError("not a tree")
        self.light = {name for name, link in robot.links.items() if not link.mass or link.mass <= 0}
        self.root_body = {n for n, _ in robot.bodies()[robot.roots[0]]}
        self.findings = [Finding(rule, self.links_of(rule, subject), message) for rule, subject, message in found]
        self.mended: dict[tuple[str, ...], tuple[Inertial | None, bool]] = {}
        self.bases: dict[tuple[str, bool], tuple[Model, Any, Any]] = {}
        self.rules: dict[str, set[str]] = collections.defaultdict(set)
        for finding in self.findings:
            for name in finding.links:
                self.rules[name].add(finding.rule)

    def even(self, name: str, *rules: str) -> tuple[Inertial | None, bool]:
        """The mended inertial of a link, if these rules find something in it, and whether its geometry gave it."""
        key = (name, *rules)
        if key not in self.mended:
            self.mended[key] = mended(self.robot, name, set(rules), self.light)
        return self.mended[key]

    def without_mass(self, name: str) -> list[str]:
        """The rules of a link but LNT003, whose mended mass would hide what the others are about."""
        return sorted(self.rules.get(name, set()) - {"LNT003"})

    def links_of(self, rule: str, subject: str | None) -> tuple[str, ...]:
        named = re.search("`(.*)`", subject or "")
        if named is None:
            return tuple(self.robot.links)
        link = self.robot.links[named[1]]
        body = [name for name, _ in self.robot.bodies()[self.robot.body_of()[link.name]]]
        if rule == "LNT004":
            same = (link.mass, getattr(link, "raw", None))
            return tuple(n for n, one in self.robot.links.items() if (one.mass, getattr(one, "raw", None)) == same)
        if rule == "LNT003":
            return tuple(name for name in body if name not in self.light)
        return tuple(n for n in body if n in self.light) if rule in ("LNT006", "SRC003") else (link.name,)

    def model(self, back: tuple[str, ...], rule: str, floats: bool = False) -> Model:
        """The mended robot with the links `back` as they are written, in what the rule is about; `*`: in everything."""
        inertials = {}
        for name, link in self.robot.links.items():
            part, mass = part_of(rule), rule in ("LNT003", "*")
            flagged = name in back and rule == "LNT003"
            rules = sorted(self.rules.get(name, ())) if mass and not flagged else self.without_mass(name)
            parts = {part_of(one) for one in rules}
            if not rules or (name in back and not flagged and (part == "all" or parts == {part})):
                inertials[name] = written(link)
                continue
            new = self.even(name, *rules)[0]
            if name in back and not flagged and new is not None:
                old = {"tensor": new.tensor if link.tensor is None else link.tensor, "center": link.centre}
                new = new._replace(**{part: old[part]})
            inertials[name] = new.xml() if new is not None else ""
        return Model(self.robot, inertials, floats, set(back) if rule in ("LNT006", "*") else set())

    def base(self, rule: str, floats: bool) -> tuple[Model, Any, Any]:
        """The mended robot, its gains and its path with them."""
        if (rule, floats) not in self.bases:
            base = self.model((), rule, floats)
            gains = base.gains() if base.model is not None and base.model.nv else None
            self.bases[rule, floats] = (base, gains, gains is not None and (base.moved(), base.moved(gains)))
        return self.bases[rule, floats]

    def tried(self, finding: Finding) -> dict[str, Any]:
        """What changes when a finding is put back."""
        floats = set(finding.links) <= self.root_body
        mass = "LNT003" if finding.rule == "LNT003" else "LNT"
        (base, gains, paths), one = self.base(mass, floats), self.model(finding.links, finding.rule, floats)
        also = sorted(set().union(*(self.rules[name] for name in finding.links)) - {finding.rule})
        row: dict[str, Any] = {
            "rule": finding.rule,
            "also": also,
            "links": finding.links,
            "message": finding.message,
            "root": floats,
        }
        row |= {"mujoco": one.refused, "mended": base.refused, "pinocchio": one.pinocchio is not None}
        row["mended_pinocchio"] = base.pinocchio is not None
        rules_of = self.without_mass if mass == "LNT" else lambda name: sorted(self.rules[name])
        row["compared"] = all(self.even(name, *rules_of(name))[1] for name in finding.links)
        if one.pinocchio and base.pinocchio and len(base.pinocchio["diagonal"]):
            was, now = base.pinocchio, one.pinocchio
            row |= {"definite": now["definite"], "mended_definite": was["definite"], "least": now["diagonal"].min()}
            row |= {"condition": now["condition"], "mended_condition": was["condition"]}
            ratios = np.maximum(now["diagonal"], 0) / np.maximum(was["diagonal"], 1e-300)
            row["ratio"] = ratios[np.abs(np.log(np.maximum(ratios, 1e-300))).argmax()]
            change, most = (np.abs(x).max(axis=0) for x in (now["gravity"] - was["gravity"], was["gravity"]))
            row["torque"] = (change / np.maximum(most, 1e-3)).max()
        if one.model is not None and gains is not None:
            (free, _), (pd, path) = one.moved(), one.moved(gains)
            row |= {"free": free, "mended_free": paths[0][0], "pd": pd, "mended_pd": paths[1][0]}
            if path is not None and paths[1][1] is not None and path.size:
                row["motion"] = np.abs(path - paths[1][1]).max() / START
        return row
