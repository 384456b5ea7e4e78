#!/usr/bin/env python3
"""Makes the URDDs in examples/urdds from our own robots, with examples/minimal_producer.py.

    python3 examples/make_urdds.py

- arm: a right one.
- stale_gripper: one whose URDF was changed afterwards, and the modules were not. Somebody gave the
  motor more travel and mistyped a mass, as happens; nothing tells, until one validates.
"""

import hashlib
import json
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROBOTS = HERE.parent / "conformance" / "robots"


def produce(robot: str, name: str) -> pathlib.Path:
    out = HERE / "urdds" / name
    shutil.rmtree(out, ignore_errors=True)
    out.parent.mkdir(exist_ok=True)
    urdf = ROBOTS / f"{robot}.urdf"
    subprocess.run([sys.executable, HERE / "minimal_producer.py", urdf, out], check=True)
    return out


def main() -> None:
    produce("six_axis_arm", "arm")

    gripper = produce("gripper", "stale_gripper")
    root = json.loads((gripper / "urdd.json").read_text())
    urdf = gripper / root["source"]["Urdf"]["path"]
    text = urdf.read_text()
    for old, new in [('upper="4"', 'upper="4.5"'), ('<mass value="0.6"/>', '<mass value="-0.6"/>')]:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    urdf.write_text(text)
    # Whoever changed the URDF brought its hash up to date, and thought that was all.
    hash_of_old = root["source"]["Urdf"]["sha256"]
    hash_of_new = hashlib.sha256(text.encode()).hexdigest()
    metadata = gripper / "urdd.json"
    metadata.write_text(
        metadata.read_text()
        .replace(hash_of_old, hash_of_new)
        .replace(f'"size": {root["source"]["Urdf"]["size"]}', f'"size": {len(text.encode())}', 1)
    )


main()
