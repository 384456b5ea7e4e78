#!/usr/bin/env python3
"""Writes rotations.json, in_plane_bases.json, mimics.json and inertia.json of conformance/vectors: closed forms in 50 digits.

    PYTHON -m pip install mpmath==1.4.1 scipy==1.17.1 mujoco==4.0.0 numpy==2.4.6
    PYTHON tests/figures/make_conventions.py

Every input is a double; what is computed from it is rounded once, at the end. Peers (scipy, MuJoCo, numpy) must agree, or nothing
is written. Last run: CPython 3.11.7, Linux x86-64.
"""

import math

import mpmath as mp
import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from vectors import plain, write

MADE_BY = "tests/figures/make_conventions.py"
mp.mp.dps = 50


# --- rotations (SPEC 5.4) ----------------------------------------------------------------------------------------------------

def product(p, q):
    a, b, c, d = p
    w, x, y, z = q
    return (a * w - b * x - c * y - d * z, a * x + b * w + c * z - d * y, a * y - b * z + c * w + d * x, a * z + b * y - c * x + d * w)


def about(axis, angle):
    half = mp.mpf(angle) / 2
    return (mp.cos(half), *(mp.sin(half) * mp.mpf(x) for x in axis))


def canonical(q):
    sign = next((-1 if x < 0 else 1 for x in q if x != 0), 1)
    return plain(sign * x for x in q)


def of_rpy(rpy):
    roll, pitch, yaw = rpy
    return canonical(product(product(about((0, 0, 1), yaw), about((0, 1, 0), pitch)), about((1, 0, 0), roll)))


def of_rotation_vector(v):
    angle = mp.sqrt(sum(mp.mpf(x) ** 2 for x in v))
    return canonical(about([mp.mpf(x) / angle for x in v], angle)) if angle else [1.0, 0.0, 0.0, 0.0]


def near(q, other):
    return min(np.abs(np.array(q) - other).max(), np.abs(np.array(q) + other).max())


def rotations():
    quarter = math.pi / 2
    rpys = [
        (0.0, 0.0, 0.0), (0.3, 0.0, 0.0), (0.0, 0.3, 0.0), (0.0, 0.0, 0.3), (0.1, 0.2, 0.3), (-1.0, 0.5, 2.5), (2.0, -1.2, -3.0),
        (1e-9, -2e-9, 3e-9), (quarter, 0.0, 0.0), (0.0, 0.0, quarter), (quarter, 0.0, quarter), (math.pi, 0.0, 0.0), (0.0, math.pi, 0.0),
        (0.0, 0.0, math.pi), (math.pi, math.pi, math.pi), (7.0, -8.0, 9.0), (1.5707963, 0.0, -1.5707963),
    ]
    of_angles = [{"rpy": rpy, "quaternion_wxyz": of_rpy(rpy)} for rpy in rpys]
    for case in of_angles:
        x, y, z, w = Rotation.from_euler("xyz", case["rpy"]).as_quat()
        assert near(case["quaternion_wxyz"], np.array([w, x, y, z])) < 1e-15, case
    # At pitch of a quarter turn roll and yaw turn about one axis: only roll - yaw (or roll + yaw) is left of them.
    lock = [
        ((0.3, quarter, 0.5), (-0.2, quarter, 0.0)), ((0.3, quarter, 0.5), (0.0, quarter, 0.2)),
        ((0.3, -quarter, 0.5), (0.8, -quarter, 0.0)), ((-2.0, -quarter, 3.0), (0.0, -quarter, 1.0)),
        # And everywhere there are two ways to say a rotation.
        ((0.1, 0.2, 0.3), (0.1 - math.pi, math.pi - 0.2, 0.3 - math.pi)),
    ]
    same = []
    for first, second in lock:
        a, b = of_rpy(first), of_rpy(second)
        assert near(a, np.array(b)) < 1e-15
        same.append({"rpy": first, "same_as_rpy": second, "quaternion_wxyz": a})
    signs = [
        ((1.0, 0.0, 0.0, 0.0), 1), ((-1.0, 0.0, 0.0, 0.0), -1), ((0.0, -1.0, 0.0, 0.0), -1), ((0.0, 0.0, -1.0, 0.0), -1), ((0.0, 0.0, 0.0, -1.0), -1),
        ((0.0, 0.6, -0.8, 0.0), 1), ((0.0, -0.6, 0.8, 0.0), -1), ((0.0, 0.0, -0.8, 0.6), -1), ((-0.5, 0.5, 0.5, -0.5), -1), ((0.5, -0.5, -0.5, -0.5), 1),
    ]
    signs = [{"quaternion_wxyz": q, "canonical_wxyz": plain(sign * x for x in q)} for q, sign in signs]
    vectors = [
        (0.0, 0.0, 0.0), (0.3, 0.0, 0.0), (0.1, -0.2, 0.3), (1e-12, 2e-12, -2e-12), (1e-5, 0.0, 0.0), (2.0, -1.0, 2.0), (math.pi, 0.0, 0.0),
        (0.0, -math.pi, 0.0), (0.0, 0.0, 3.0), (0.0, 4.0, 0.0), (-5.0, 1.0, 3.0),
    ]
    of_vectors = []
    for v in vectors:
        q = of_rotation_vector(v)
        x, y, z, w = Rotation.from_rotvec(v).as_quat()
        assert near(q, np.array([w, x, y, z])) < 1e-15
        of_vectors.append({"rotation_vector": v, "quaternion_wxyz": q})
    write("rotations.json", MADE_BY, rpy=of_angles, gimbal_lock=same, canonical=signs, rotation_vectors=of_vectors)


# --- in-plane bases (SPEC 5.9) ------------------------------------------------------------------------------------------------

def in_plane_bases():
    axes = [
        (0, 0, 1), (0, 0, -1), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 2.5), (0, 0, -0.1), (1, 1, 0), (1, 0, 1), (1, 2, 3), (-1, 2, -3),
        (0.6, 0, -0.8), (0, 0.6, -0.8), (1e-6, 0, 1), (1e-6, 2e-6, -1), (0, -3e-9, -1),
        # On either side of the limit of 1e-10.
        (9e-11, 0, 1), (9e-11, 0, -1), (0, 9e-11, -1), (1.2e-10, 0, -1), (0, 1.2e-10, -1), (-0.9e-10, 0.9e-10, -1),
    ]
    cases = []
    for axis in axes:
        n = [mp.mpf(x) for x in axis]
        length = mp.sqrt(sum(x * x for x in n))
        n = [x / length for x in n]
        sine = mp.hypot(n[0], n[1])
        if sine < mp.mpf("1e-10"):
            x, y = [1, 0, 0], [0, 1 if n[2] > 0 else -1, 0]
        else:
            # Rodrigues: u = (-ny, nx, 0) / sine is the axis of the arc, and cos = nz, sin = sine.
            u = [-n[1] / sine, n[0] / sine, mp.mpf(0)]

            def turned(v):
                cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
                along = sum(a * b for a, b in zip(u, v)) * (1 - n[2])
                return [v[i] * n[2] + cross[i] * sine + u[i] * along for i in range(3)]

            x, y = turned([1, 0, 0]), turned([0, 1, 0])
        case = {"axis": plain(axis), "unit_axis": plain(n), "x": plain(x), "y": plain(y)}
        quat = np.zeros(4)
        mujoco.mju_quatZ2Vec(quat, np.array(case["unit_axis"]))
        for name, along in (("x", (1.0, 0, 0)), ("y", (0, 1.0, 0))):
            peer = np.zeros(3)
            mujoco.mju_rotVecQuat(peer, np.array(along), quat)
            if sine < mp.mpf("1e-10"):
                continue  # MuJoCo turns along the arc down to 1e-15
            # MuJoCo takes the angle of the arc for exact as far as its cosine says it: half of the digits near half a turn.
            assert np.abs(peer - case[name]).max() < 1e-7, (axis, name, peer, case[name])
        cases.append(case)
    write("in_plane_bases.json", MADE_BY, bases=cases)


# --- mimics (SPEC 5.10) ---------------------------------------------------------------------------------------------------------

MIMICS = {
    "a mimic": [("drive", "revolute", None), ("follow", "revolute", ("drive", 0.5, 0.25))],
    "a chain of three": [
        ("drive", "revolute", None), ("first", "revolute", ("drive", -1.5, 0.25)),
        ("second", "prismatic", ("first", 0.125, -0.5)), ("third", "continuous", ("second", 4.0, 1.0)),
    ],
    "each before its driver": [
        ("third", "revolute", ("second", 2.0, 0.1)), ("second", "revolute", ("first", -3.0, 0.2)),
        ("first", "revolute", ("drive", 0.7, 0.3)), ("other", "prismatic", None), ("drive", "revolute", None),
    ],
    "two on one driver": [
        ("left", "prismatic", ("motor", 0.01, 0.0)), ("motor", "continuous", None), ("right", "prismatic", ("motor", -0.01, 0.0)),
    ],
    "multiplier of zero": [("drive", "revolute", None), ("still", "revolute", ("drive", 0.0, 0.75)), ("after", "revolute", ("still", 2.0, 0.5))],
    "ends in a fixed joint": [
        ("first", "revolute", ("weld", 2.0, 0.5)), ("second", "revolute", ("first", -3.0, 0.25)), ("weld", "fixed", None), ("free", "revolute", None),
    ],
    "ends in a fixed joint that has a mimic": [
        ("drive", "revolute", None), ("weld", "fixed", ("drive", 5.0, 0.75)), ("first", "revolute", ("weld", 2.0, 0.5)),
    ],
    "beside joints with several DOFs": [
        ("ball", "spherical", None), ("first", "revolute", ("drive", 1.0, 0.0)), ("base", "planar", None), ("drive", "prismatic", None), ("free", "floating", None),
    ],
}
DOFS = {"fixed": 0, "revolute": 1, "continuous": 1, "prismatic": 1, "planar": 3, "spherical": 3, "floating": 6}


def mimics():
    cases = []
    for name, joints in MIMICS.items():
        by_name = {joint[0]: joint for joint in joints}
        first_dof, total = {}, 0
        for joint, kind, mimic in joints:
            first_dof[joint] = total
            total += 0 if mimic else DOFS[kind]

        def resolve(joint):
            """(DOF or None, multiplier, offset): joint = multiplier * q[dof] + offset."""
            _, kind, mimic = by_name[joint]
            if kind == "fixed":
                return None, mp.mpf(1), mp.mpf(0)
            if mimic is None:
                return first_dof[joint], mp.mpf(1), mp.mpf(0)
            dof, m2, o2 = resolve(mimic[0])
            m1, o1 = mp.mpf(mimic[1]), mp.mpf(mimic[2])
            return dof, m1 * m2, m1 * o2 + o1

        resolved = []
        for joint, kind, mimic in joints:
            dof, multiplier, offset = resolve(joint)
            moves = mimic is not None and kind != "fixed"
            resolved.append({"dof_idx": dof, "multiplier": float(multiplier), "offset": float(offset)} if moves else None)
        configuration = [round(0.3 + 0.17 * n, 2) for n in range(total)]
        positions = []
        for (joint, kind, mimic), follows in zip(joints, resolved):
            if follows:
                dof, multiplier, offset = resolve(joint)
                positions.append([float(offset + (multiplier * mp.mpf(configuration[dof]) if dof is not None else 0))])
            else:
                positions.append(configuration[first_dof[joint]:first_dof[joint] + DOFS[kind]] if mimic is None else [])
        cases.append({
            "name": name,
            "joints": [
                {"name": joint, "type": kind, "mimic": mimic and {"joint": mimic[0], "multiplier": mimic[1], "offset": mimic[2]}}
                for joint, kind, mimic in joints
            ],
            "resolved": resolved, "configuration": configuration, "positions": positions,
        })
    write("mimics.json", MADE_BY, robots=cases)


# --- inertia (SPEC 6.1.7) --------------------------------------------------------------------------------------------------------

def box(mass, x, y, z):
    return [mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)]


def inertia():
    def diagonal(moments):
        return [moments[0], 0.0, 0.0, moments[1], 0.0, moments[2]]

    def turned(moments, rpy):
        r = Rotation.from_euler("xyz", rpy).as_matrix()
        t = r @ np.diag(moments) @ r.T
        return [t[0, 0], t[0, 1], t[0, 2], t[1, 1], t[1, 2], t[2, 2]]

    tensors = {
        "a box": diagonal(box(2.0, 0.1, 0.2, 0.3)),
        "the box, turned": turned(box(2.0, 0.1, 0.2, 0.3), (0.4, -0.7, 1.1)),
        "a ball": diagonal([0.4 * 3.0 * 0.05**2] * 3),
        "a cylinder": diagonal([1.5 * (3 * 0.04**2 + 0.3**2) / 12] * 2 + [1.5 * 0.04**2 / 2]),
        "a flat plate: largest = sum of the others": diagonal(box(1.0, 0.5, 0.25, 0.0)),
        "the plate, turned": turned(box(1.0, 0.5, 0.25, 0.0), (1.0, 2.0, 3.0)),
        "a steel rod of 1 m, 0.1 mm thick": diagonal([0.0833, 0.0833, 1.25e-9]),
        "a speck of dust": diagonal(box(1e-12, 1e-6, 2e-6, 3e-6)),
        "a ship": diagonal(box(4e8, 60.0, 50.0, 300.0)),
        "no moment about z": diagonal([0.1, 0.1, 0.0]),
        "a moment about z of 0.9e-9 of the largest": diagonal([1.0, 1.0, 0.9e-9]),
        "a moment about z of 1.1e-9 of the largest": diagonal([1.0, 1.0, 1.1e-9]),
        "a sign lost": diagonal([0.1, -0.1, 0.1]),
        "all signs lost": diagonal([-0.1, -0.2, -0.25]),
        "products larger than the moments": [0.1, 0.2, 0.0, 0.1, 0.0, 0.15],
        "positive diagonal, one moment 0": [1.0, 1.0, 0.0, 1.0, 0.0, 1.5],
        "units mixed": diagonal([1e-3, 1e-3, 1.0]),
        "the largest 1 % too large": diagonal([0.3, 0.7, 1.01]),
        "the same, turned": turned([0.3, 0.7, 1.01], (-0.3, 0.8, 2.0)),
        "the largest 0.9e-6 of itself too large": diagonal([0.3, 0.7, 1.0 + 0.9e-6]),
        "the largest 1.1e-6 of itself too large": diagonal([0.3, 0.7, 1.0 + 1.1e-6]),
    }
    cases = []
    for name, tensor in tensors.items():
        xx, xy, xz, yy, yz, zz = map(mp.mpf, tensor)
        moments = sorted(mp.eigsy(mp.matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), eigvals_only=True))
        f = [float(x) for x in tensor]
        peer = np.linalg.eigvalsh([[f[0], f[1], f[2]], [f[1], f[3], f[4]], [f[2], f[4], f[5]]])
        assert np.abs(peer - plain(moments)).max() < 1e-15 * np.abs(peer).max() * 8, name
        definite = moments[0] > mp.mpf("1e-9") * abs(moments[2])
        triangle = moments[2] - (moments[0] + moments[1]) <= mp.mpf("1e-6") * moments[2] if definite else None
        cases.append({
            "name": name, "inertia": dict(zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), plain(tensor))),
            # Moments that are 0 come out as what the rounding of the tensor leaves.
            "principal_moments": [0.0 if abs(x) < mp.mpf("1e-18") * abs(moments[2]) else float(x) for x in moments],
            "positive_definite": bool(definite), "triangle_inequality": None if triangle is None else bool(triangle),
        })
    write("inertia.json", MADE_BY, tensors=cases)


if __name__ == "__main__":
    rotations()
    in_plane_bases()
    mimics()
    inertia()
