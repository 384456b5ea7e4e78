"""Who is right where urdd and FCL differ about a collision: coal, on the same hulls.

    python benches/planning/judge.py URDD ANSWERS [--agreeing 2000]

ANSWERS is what `planning` writes. Looks at every configuration in which the two differ, and at the first of the others.
Those with a distance within 1e-6 m of contact are counted apart. Exits with 1 where urdd is wrong. Needs the package `pin`.
"""

from __future__ import annotations

import argparse
import collections
import json
import pathlib
import re
import sys

import coal
import numpy
import pinocchio

sys.path.append(str(pathlib.Path(__file__).parent.parent))

from proximity_coal import HULLS, Robot

NEAR = 1e-6


def scene() -> list[tuple[numpy.ndarray, coal.CollisionGeometry]]:
    """The boxes and balls of scene.hpp."""
    text = (pathlib.Path(__file__).parent / "scene.hpp").read_text(encoding="utf-8")
    boxes, balls = re.findall(r"> (boxes|balls)\{(.*?)\};", text, re.DOTALL)
    found = []
    for numbers in groups(boxes[1], 6):
        found.append((numbers[:3], coal.Box(*(2 * numbers[3:]))))
    for numbers in groups(balls[1], 4):
        found.append((numbers[:3], coal.Sphere(numbers[3])))
    return found


def groups(text: str, size: int) -> numpy.ndarray:
    return numpy.array([float(number) for number in re.findall(r"-?\d+\.?\d*", text)]).reshape(-1, size)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdd")
    parser.add_argument("answers")
    parser.add_argument("--agreeing", type=int, default=2000)
    given = parser.parse_args()
    robot = Robot(given.urdd)
    geometry = robot.geometry(*HULLS[1:])
    links = list(geometry.geometryObjects)
    for number, (centre, shape) in enumerate(scene()):
        placement = pinocchio.SE3(numpy.eye(3), numpy.array(centre))
        index = geometry.addGeometryObject(pinocchio.GeometryObject(f"obstacle {number}", 0, 0, placement, shape))
        for link, of in enumerate(links):
            # The robot stands on the first.
            if number > 0 or of.name != f"{robot.links[0]}[0]":
                geometry.addCollisionPair(pinocchio.CollisionPair(link, index))
    data, of_geometry = robot.model.createData(), geometry.createData()
    agreeing = given.agreeing
    counts: collections.Counter[str] = collections.Counter()
    for line in pathlib.Path(given.answers).read_text(encoding="utf-8").splitlines():
        answer = json.loads(line)
        if answer["urdd"] == answer["fcl"]:
            agreeing -= 1
            if agreeing < 0:
                continue
        pinocchio.updateGeometryPlacements(robot.model, data, geometry, of_geometry, robot.configuration(answer["q"]))
        pinocchio.computeDistances(geometry, of_geometry)
        distance = min(result.min_distance for result in of_geometry.distanceResults)
        if abs(distance) < NEAR:
            counts["within 1e-6 m of contact"] += 1
            continue
        for name in ("urdd", "fcl"):
            counts[f"{name} {'right' if answer[name] == (distance < 0) else 'WRONG'}"] += 1
    print(", ".join(f"{name}: {count}" for name, count in sorted(counts.items())))
    return 1 if counts["urdd WRONG"] else 0


if __name__ == "__main__":
    sys.exit(main())
