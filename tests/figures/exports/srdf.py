"""Compares the SRDF that `urdd export` writes with one that people published.

    pip install example-robot-data==6.0.0
    urdd generate .../panda_description/urdf/panda.urdf -o panda
    python3 tests/figures/exports/srdf.py target/release/urdd panda .../panda_description/srdf/panda.srdf

Prints how many pairs both disable, and each pair that one disables alone, with its reason there.
"""

import collections
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET


def pairs(path):
    found = ET.parse(path).getroot().iter("disable_collisions")
    return {tuple(sorted((pair.get("link1"), pair.get("link2")))): pair.get("reason") for pair in found}


def main():
    program, urdd, published = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "robot.srdf"
        command = [program, "export", "srdf", urdd, "-o", str(file), "--reasons", "always,adjacent,default,never"]
        subprocess.run(command, check=True, capture_output=True)
        ours = pairs(file)
    theirs = pairs(published)
    both = theirs.keys() & ours.keys()
    print(f"published {len(theirs)}, urdd {len(ours)}, both {len(both)}")
    reasons = collections.Counter((theirs[pair], ours[pair]) for pair in both)
    for (published_reason, own), count in sorted(reasons.items()):
        print(f"  {count} published as {published_reason}, here {own}")
    for pair in sorted(theirs.keys() ^ ours.keys()):
        whose = "published" if pair in theirs else "urdd"
        print(f"  only {whose}: {pair[0]} {pair[1]} {theirs.get(pair) or ours.get(pair)}")


if __name__ == "__main__":
    main()
