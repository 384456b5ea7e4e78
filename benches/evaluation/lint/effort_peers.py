#!/usr/bin/env python3
"""Holds LNT062 to Pinocchio's gravity torques (evidence.md).

    python3 benches/evaluation/lint/effort_peers.py target/release/urdd FOLDER...

FOLDER has URDFs at any depth. Needs pin and lxml. Of each URDF that Pinocchio reads, the torque of each joint in the default
configuration is computed by computeGeneralizedGravity; that of a joint that mimics another counts for the other. Then:
- as written: each joint whose torque is above its effort must be found, unless gravity pushes it against a stop that is within
  0.01 rad or m, or Gazebo has no gravity for links beyond it; and no other;
- with efforts of 0.9 times the torque, the same joints must be found; with 1.1 times the torque, none.
Prints each finding of URDFs as they are, with Pinocchio's number, and the counts.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
from lxml import etree

STOP = 0.01


def number(element: Any, name: str) -> float | None:
    text = None if element is None else element.get(name)
    return None if text is None else float(text)


class Robot:
    """The joints of one DOF of a URDF, and what Pinocchio says that each must give."""

    def __init__(self, path: Path) -> None:
        self.root = etree.fromstring(path.read_bytes(), etree.XMLParser(remove_comments=True))
        self.joints = {
            joint.get("name"): joint
            for joint in self.root.findall("joint")
            if joint.get("type") in ("revolute", "continuous", "prismatic")
        }
        model = pin.buildModelFromXML(etree.tostring(self.kinematics(), encoding="unicode"))
        q = pin.neutral(model)
        for name, joint in self.joints.items():
            at = model.joints[model.getJointId(name)]
            position = self.default(name)
            q[at.idx_q : at.idx_q + at.nq] = position if at.nq == 1 else [np.cos(position), np.sin(position)]
        torques = pin.computeGeneralizedGravity(model, model.createData(), q)
        self.needed = dict.fromkeys(self.joints, 0.0)
        for name in self.joints:
            driver, factor, _ = self.driver(name)
            self.needed[driver] += factor * torques[model.joints[model.getJointId(name)].idx_v]

    def kinematics(self) -> Any:
        """Links without shapes; without links' masses that have no weight in Gazebo."""
        weightless = {
            gazebo.get("reference")
            for gazebo in self.root.findall("gazebo")
            if (gazebo.findtext("turnGravityOff") or "").strip() in ("true", "True", "1")
        }
        root = etree.fromstring(etree.tostring(self.root))
        for element in list(root):
            if element.tag not in ("link", "joint"):
                root.remove(element)
        for link in root.findall("link"):
            for part in list(link):
                if part.tag != "inertial" or link.get("name") in weightless:
                    link.remove(part)
        for joint in root.findall("joint"):
            for mimic in joint.findall("mimic"):
                joint.remove(mimic)
            # Pinocchio refuses joints without all limits.
            limit = joint.find("limit")
            limit = etree.SubElement(joint, "limit") if limit is None else limit
            for name in ("lower", "upper", "effort", "velocity"):
                limit.set(name, limit.get(name) or "0")
                if float(limit.get(name)) < 0 and name in ("effort", "velocity"):
                    limit.set(name, "0")
        return root

    def driver(self, name: str) -> tuple[str, float, float]:
        mimic = self.joints[name].find("mimic")
        if mimic is None:
            return name, 1.0, 0.0
        driver, factor, offset = self.driver(mimic.get("joint"))
        own, shift = float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
        return driver, own * factor, own * offset + shift

    def limits(self, name: str) -> tuple[float, float] | None:
        limit = self.joints[name].find("limit")
        ends = number(limit, "lower"), number(limit, "upper")
        if self.joints[name].get("type") == "continuous" or ends == (None, None):
            return None
        return ends[0] or 0.0, ends[1] or 0.0

    def default(self, name: str) -> float:
        driver, factor, offset = self.driver(name)
        ends = self.limits(driver)
        position = 0.0 if ends is None else min(max(0.0, min(ends)), max(ends))
        return factor * position + offset

    def expected(self) -> dict[str, tuple[float, float]]:
        """What must be found: torque and effort."""
        found = {}
        for name, joint in self.joints.items():
            effort, needed = number(joint.find("limit"), "effort"), self.needed[name]
            if effort is None or effort <= 0 or joint.find("mimic") is not None or abs(needed) <= effort:
                continue
            ends, at = self.limits(name), self.default(name)
            if ends is None or (at - ends[0] if needed > 0 else ends[1] - at) > STOP:
                found[name] = needed, effort
        return found


def found_by(program: str, files: list[Path]) -> dict[Path, set[str]]:
    command = [program, "lint", "--format", "json", "--select", "LNT062", *map(str, files)]
    report = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
    by_name: dict[Path, set[str]] = {}
    for file, urdf in zip(sorted(files), sorted(report["urdds"], key=lambda one: one["path"]), strict=True):
        names = {place["subject"].split("`")[1] for one in urdf["findings"] for place in one["places"]}
        # None: the rule did not run, as the URDF is no tree.
        ran = all(check["status"] in ("passed", "failed") for check in urdf["checks"] if check["code"] == "LNT062")
        by_name[file] = names if ran else {"?"}
    return by_name


def main() -> None:
    program, *folders = sys.argv[1:]
    robots, refused = {}, 0
    for path in sorted({path for folder in folders for path in Path(folder).rglob("*.urdf")}):
        try:
            robots[path] = Robot(path)
        except Exception:
            refused += 1
    joints = sum(len(robot.joints) for robot in robots.values())
    print(f"{len(robots)} URDFs with {joints} joints, {refused} that Pinocchio does not read")
    wrong, total, skipped = 0, 0, 0
    for factor in (None, 0.9, 1.1):
        with tempfile.TemporaryDirectory() as folder:
            files, expected = {}, {}
            for k, (path, robot) in enumerate(robots.items()):
                for name, joint in robot.joints.items() if factor else ():
                    limit = joint.find("limit")
                    limit = etree.SubElement(joint, "limit") if limit is None else limit
                    limit.set("effort", repr(float(abs(robot.needed[name]) * factor)))
                file = Path(folder) / f"{k:05}.urdf"
                file.write_bytes(path.read_bytes() if factor is None else etree.tostring(robot.root))
                # Torques that rounding leaves of 0 are no torques.
                needed = robot.expected().items()
                expected[file] = {name: pair for name, pair in needed if abs(pair[0]) > 1e-9}
                files[file] = path
            for file, names in found_by(program, list(files)).items():
                robot = robots[files[file]]
                if names == {"?"}:
                    skipped += 1
                    continue
                names = {name for name in names if abs(robot.needed[name]) > 1e-9}
                total += len(expected[file])
                for name in names if factor is None else ():
                    needed = robot.needed[name]
                    print(f"{files[file]}: {name}: {needed:.4g}, effort {number(robot.joints[name].find('limit'), 'effort'):.4g}")
                for name in names ^ set(expected[file]):
                    wrong += 1
                    print(f"WRONG {factor} {files[file]}: {name}: found {name in names}, Pinocchio {robot.needed[name]:.6g}")
        print(f"efforts {factor or 'as written'}: {total} expected so far, {wrong} wrong, {skipped} not examined")


if __name__ == "__main__":
    main()
