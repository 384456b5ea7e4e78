#!/usr/bin/env python3
"""Writes conformance/vectors/sampled_configurations.json: the numbers u(k, i) that sampled configurations are made of, uniform
rotations from them, and whole configurations of a robot.

To reproduce, with any Python 3.9 or newer and nothing else:  python3 tests/figures/make_sampled_configurations.py

u(k, i) is exact: integers to the last step, then 53 bits scaled by a power of two. Figures are given as a number and as its
53-bit integer (`mantissa`, u = mantissa * 2^-53). Rotations go through the platform's sqrt, sin and cos: equal to about 1e-15.
Last run: CPython 3.11.7, Linux x86-64.
"""

import json
import math
import pathlib

MASK = 2**64 - 1
GAMMA = 0x9E3779B97F4A7C15


def mix(x):
    """The finaliser of SplitMix64."""
    x ^= x >> 30
    x = x * 0xBF58476D1CE4E5B9 & MASK
    x ^= x >> 27
    x = x * 0x94D049BB133111EB & MASK
    return x ^ x >> 31


def mantissa(k, i):
    return mix((k * 2**32 + i + 1) * GAMMA & MASK) >> 11


def u(k, i):
    return mantissa(k, i) * 2.0**-53


def quaternion_wxyz(u1, u2, u3):
    """Shoemake's uniform rotation, with w >= 0."""
    a, b = math.sqrt(1 - u1), math.sqrt(u1)
    q = (b * math.cos(2 * math.pi * u3), a * math.sin(2 * math.pi * u2), a * math.cos(2 * math.pi * u2), b * math.sin(2 * math.pi * u3))
    return tuple((-x if q[0] < 0 else x) + 0.0 for x in q)


def rotation_vector(quaternion):
    w, *xyz = quaternion
    sine = math.hypot(*xyz)
    scale = 2 * math.atan2(sine, w) / sine if sine else 2.0
    return tuple(scale * x + 0.0 for x in xyz)


# Joints of a robot, with the bounds of their DOFs: one joint of each kind, limited or not, and one that is locked.
JOINTS = [
    ("revolute", [(-1.5, 2.25)]),
    ("prismatic", [(0.125, 0.125)]),
    ("spherical", [(-math.pi, math.pi)] * 3),
    ("fixed", []),
    ("planar", [(-1.0, 1.0), (-1.0, 1.0), (-math.pi, math.pi)]),
    ("continuous", [(-math.pi, math.pi)]),
    ("floating", [(-1.0, 1.0)] * 3 + [(-math.pi, math.pi)] * 3),
    ("prismatic", [(-2e-3, 0.9)]),
]


def configuration(label, k=None):
    q = []
    for kind, bounds in JOINTS:
        ball = 3 if kind in ("spherical", "floating") else 0
        for lower, upper in bounds[:len(bounds) - ball]:
            q.append({"Zero": 0.0, "Middle": lower / 2 + upper / 2, "Lower": lower, "Upper": upper}.get(label) if k is None else lower * (1 - u(k, len(q))) + upper * u(k, len(q)))
        if ball and k is None:
            q += {"Lower": (-math.pi, 0.0, 0.0), "Upper": (math.pi, 0.0, 0.0)}.get(label, (0.0, 0.0, 0.0))
        elif ball:
            q += rotation_vector(quaternion_wxyz(*(u(k, len(q) + n) for n in range(3))))
    return {"name": label} | ({} if k is None else {"sample_idx": k}) | {"configuration": q}


def main():
    # The stream of SplitMix64 with seed 0, as its author's C program prints it: u(0, 0), u(0, 1), … are its top 53 bits.
    assert [mix(n * GAMMA & MASK) for n in (1, 2, 3)] == [0xE220A8397B1DCDAF, 0x6E789E6AA1B965F4, 0x06C45D188009454F]
    pairs = [(k, i) for k in range(6) for i in range(8)] + [(0, 1999), (999, 41), (999_999, 0), (999_999, 1999), (2**32 - 1, 0), (2**32 - 1, 2**32 - 2)]
    triples = [tuple(u(k, i) for i in (at, at + 1, at + 2)) for k, at in ((0, 0), (1, 0), (2, 3), (5, 4))]
    triples += [(0.0, 0.25, 0.5), (0.75, 0.375, 0.625)]  # a half turn (w = 0); a quaternion whose sign is turned round
    document = {
        "made_by": "tests/figures/make_sampled_configurations.py",
        "u": [{"k": k, "i": i, "mantissa": mantissa(k, i), "u": u(k, i)} for k, i in pairs],
        "rotations": [
            {"u": three, "quaternion_wxyz": quaternion_wxyz(*three), "rotation_vector": rotation_vector(quaternion_wxyz(*three))}
            for three in triples
        ],
        "joints": [{"joint_type": kind.capitalize(), "bounds": bounds} for kind, bounds in JOINTS],
        "configurations": [configuration(label) for label in ("Zero", "Middle", "Lower", "Upper")]
        + [configuration("Sampled", k) for k in (0, 1, 2, 3, 999, 2**32 - 1)],
    }
    lists = [key for key in document if key != "made_by"]
    lines = json.dumps(document | {key: number for number, key in enumerate(lists)}, indent=1)
    for number, key in enumerate(lists):
        body = ",\n  ".join(json.dumps(item) for item in document[key])
        lines = lines.replace(f'"{key}": {number}', f'"{key}": [\n  {body}\n ]')
    vectors = pathlib.Path(__file__).resolve().parents[2] / "conformance" / "vectors"
    (vectors / "sampled_configurations.json").write_text(lines + "\n")


if __name__ == "__main__":
    main()
