"""Writes `conformance/vectors/loops.json` and `spheres.json`, from an exported suite:

    python3 testkit/second_validator/vectors.py SUITE conformance/vectors

What a producer of loops (6.8) or spheres (8.9) has to compute on the way, of cases that are right.
The gaps of `kinds` are closed forms.
"""

from __future__ import annotations

import json
import math
import os
import sys
from typing import Any

if not __package__:
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    __package__ = "second_validator"

from second_validator.derived_meshes import triangles
from second_validator.derived_rules import robot_of
from second_validator.directory import check_directory
from second_validator.documents import read_documents
from second_validator.geometry import diagonal
from second_validator.loops import Loop
from second_validator.loops_matrix import EDGES, matrix, rank, singular_values
from second_validator.modules import Urdd
from second_validator.numeric import distance
from second_validator.report import Report
from second_validator.spheres import balls_of
from second_validator.spheres_fit import (
    INSIDE,
    centroids,
    counted,
    from_piece,
    planes_of_piece,
    points_on,
    standoff,
    uncovered,
)
from second_validator.validator import open_tree

LOOPS = (
    "LOP008/wheels-without-a-loop",
    "LOP008/five-bar-of-which-not-every-sample-closes",
    "LOP008/delta-arm",
    "LOP008/gripper-of-two-loops",
    "LOP008/ankle-with-rods",
    "LOP009/a-slide-a-mimic-joint-a-plane-and-a-ball",
    "LOP009/lengths-count-by-the-reach",
)
SPHERES = "SPH001/as-it-is"
ROOT_HALF = math.sqrt(0.5)
TURN = 0.25  # rad
SHIFT = (0.003, -0.004, 0.012)  # m
KINDS = ("Fixed", "Revolute", "Prismatic", "Cylindrical", "Universal", "Spherical", "Planar")


def kinds() -> list[Any]:
    """6.8.3: gaps of each kind, for a shift alone and for a turn about each axis alone."""
    x, y, z = SHIFT
    apart = {"Prismatic": math.hypot(x, y), "Cylindrical": math.hypot(x, y), "Planar": abs(z)}
    chord = 2 * math.sin(TURN / 2)
    found: list[Any] = []
    for kind in KINDS:
        universal = kind == "Universal"
        # R ez is at a right angle to z where frame B is turned by a quarter about x.
        still = [ROOT_HALF, ROOT_HALF, 0.0, 0.0] if universal else [1.0, 0.0, 0.0, 0.0]
        moved = {"position": list(SHIFT), "quaternion_wxyz": still}
        found.append((kind, moved, apart.get(kind, math.hypot(x, y, z)), 0.0))
        for axis in range(3):
            # The distance of two rotations by an angle is 2 sin (angle / 2), and so is that of two
            # directions.
            directed = chord if axis != 2 else 0.0
            of_kind = {"Fixed": 2 * math.sin(TURN / 2), "Prismatic": 2 * math.sin(TURN / 2)}
            gap = of_kind.get(kind, 0.0 if kind == "Spherical" else directed)
            half = math.pi / 4 if universal else 0.0
            quaternion = [math.cos(TURN / 2), 0.0, 0.0, 0.0]
            quaternion[1 + axis] = math.sin(TURN / 2)
            if universal:
                # The turn about x adds to the quarter: z of R ez is the sine of what is added.
                gap = math.sin(TURN) if axis == 0 else 0.0
                c, s = math.cos(TURN / 2), math.sin(TURN / 2)
                if axis == 0:
                    quaternion = [math.cos(half + TURN / 2), math.sin(half + TURN / 2), 0.0, 0.0]
                elif axis == 1:
                    quaternion = [c * ROOT_HALF, c * ROOT_HALF, s * ROOT_HALF, -s * ROOT_HALF]
                else:
                    quaternion = [c * ROOT_HALF, c * ROOT_HALF, s * ROOT_HALF, s * ROOT_HALF]
            pose = {"position": [0.0, 0.0, 0.0], "quaternion_wxyz": quaternion}
            found.append((kind, pose, 0.0, gap))
    keys = ("kind", "frame_b_in_frame_a", "position_gap", "rotation_gap")
    return [dict(zip(keys, one)) for one in found]


def opened(suite: str, case: str) -> Urdd:
    urdd = Urdd(open_tree(os.path.join(suite, "invalid", case, "robot")), Report())
    check_directory(urdd)
    read_documents(urdd)
    assert not urdd.report.errors, case
    return urdd


def of_loops(suite: str, case: str) -> Any:
    """The matrix of 6.8.7 at the reference configuration, and the gaps of its loops."""
    urdd = opened(suite, case)
    robot, module = robot_of(urdd.documents["urdf_module"]), urdd.documents["loops_module"]
    loops = [Loop(robot, loop) for loop in module["loops"]]
    q = [float(value) for value in module["reference_configuration"]]
    rows = matrix(robot, loops, module["couplings"], q)
    values = sorted(singular_values(rows), reverse=True)
    count = rank(values, max(values, default=0.0), EDGES[0])
    assert count == rank(values, max(values, default=0.0), EDGES[1]), "a rank that everybody counts"
    return {
        "case": case,
        "reach": robot.reach(),
        "matrix": rows,
        "singular_values": values[: min(len(rows), len(q))],
        "rank": count,
        "num_independent": len(q) - count,
    }


def of_spheres(suite: str) -> Any:
    """8.9.5: what the fits of a case rest on, for each link and level with spheres."""
    urdd = opened(suite, SPHERES)
    module = urdd.documents["link_shapes_spheres_module"]
    link_pieces = urdd.documents["convex_decomposition_meshes_module"]["link_pieces"]
    found = []
    for place, level in enumerate(module["levels"]):
        for link, spheres in enumerate(level["spheres"]):
            if not spheres:
                continue
            pieces = tuple(tuple(triangles(urdd, piece)) for piece in link_pieces[link])
            balls = balls_of(spheres)
            size = diagonal([p for piece in pieces for triangle in piece for p in triangle])
            planes = [planes_of_piece(piece) for piece in pieces]
            first = []
            for point in points_on(balls[0]):
                inside = any(distance(point, at) < INSIDE * radius for at, radius in balls[1:])
                near = min(from_piece(piece, of, point) for piece, of in zip(pieces, planes))
                first.append(None if inside else near)
            parts = [len(centroids(triangle, size)) for piece in pieces for triangle in piece]
            largest, mean = standoff(pieces, balls)
            fraction, farthest = uncovered(pieces, balls, size)
            found.append(
                {
                    "level": place,
                    "link_idx": link,
                    "diagonal": size,
                    "standoffs_of_first_sphere": first,
                    "max_standoff": largest,
                    "mean_standoff": mean,
                    "num_parts": parts,
                    "num_centroids_that_count": len(counted(pieces, size)),
                    "area_that_counts": math.fsum(area for _, area in counted(pieces, size)),
                    "uncovered_fraction": fraction,
                    "max_uncovered": farthest,
                }
            )
    unit = points_on(((0.0, 0.0, 0.0), 1.0))
    return {"case": SPHERES, "unit_vectors": unit, "links": found}


def main(suite: str, out: str) -> None:
    truths = {
        "loops.json": {"kinds": kinds(), "matrices": [of_loops(suite, case) for case in LOOPS]},
        "spheres.json": of_spheres(suite),
    }
    for name, value in truths.items():
        with open(os.path.join(out, name), "w", encoding="utf-8") as file:
            lists = [
                f'  "{key}": [\n' + ",\n".join("    " + json.dumps(one) for one in part) + "\n  ]"
                if isinstance(part, list)
                else f'  "{key}": {json.dumps(part)}'
                for key, part in value.items()
            ]
            file.write("{\n" + ",\n".join(lists) + "\n}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
