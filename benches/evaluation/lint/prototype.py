#!/usr/bin/env python3
"""Prototype of the rules of `urdd lint`: one function a rule.

Usage: prototype.py [--rules LNT010,LNT012] [--root DIR] URDF...
Prints JSON lines: file, package, rule, element, line, message, data.

Conventions
- An element is named `link NAME`, `joint NAME`, `robot`, `material NAME`, ...
- A *body* is a set of links that fixed joints hold together.
- A joint *moves* if it is revolute, continuous, prismatic, planar, floating or spherical.
- Numbers that cannot be read count as absent: the reader (SPEC 6.1.8) reports them.
- Lengths are metres, masses kilograms, angles radians.
"""
import argparse
import json
import sys

import geometry, inertia, joints, paths, pose, structure  # noqa: F401: each registers its rules
from model import *


def run(path, root=None, only=None):
    robot = Robot(path, root)
    for code, (name, function) in RULES.items():
        if only and code not in only or robot.xacro and code != "LNT051":
            continue
        try:
            for element, message, data in function(robot):
                yield {"file": str(path), "rule": code, "name": name, "element": element, "message": message, "data": data}
        except Exception as error:                           # a fault of the prototype, not of the robot
            print(f"{path}: {code}: {type(error).__name__}: {error}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rules")
    parser.add_argument("--root", help="folder of packages: the search for package:// stops here")
    parser.add_argument("--package", help="name of the package for the report")
    parser.add_argument("paths", nargs="+")
    options = parser.parse_args()
    only = set(options.rules.split(",")) if options.rules else None
    for path in options.paths:
        try:
            for finding in run(path, options.root, only):
                print(json.dumps(finding))
        except Exception as error:
            print(json.dumps({"file": path, "rule": "READ", "name": "not-readable", "element": "robot", "message": f"{type(error).__name__}: {error}", "data": {}}))


if __name__ == "__main__":
    main()
