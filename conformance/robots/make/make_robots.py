#!/usr/bin/env python3
"""Writes our robots that have meshes, and the meshes: `python3 conformance/robots/make/make_robots.py [DIR]`.

Into the folder above, or DIR. Python 3.10 and nothing else. The same bytes on every run; a test compares.
"""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))

import files
from solids import box, lathe, moved, prism, scaled, tube, turned
from urdf import collision, inertial, joint, link, material, mesh, pi, robot, visual

HERE = Path(__file__).parent.parent


def bone(length: float, wide: float, waist: float) -> list[tuple[float, float]]:
    """The outline of a limb along z, thick at both ends: (x, z), anticlockwise."""
    end = length * 0.22
    return [
        (-wide, -wide * 0.6), (wide, -wide * 0.6), (wide, end), (waist, end * 1.6), (waist, length - end * 1.6),
        (wide, length - end), (wide, length + wide * 0.6), (-wide, length + wide * 0.6), (-wide, length - end),
        (-waist, length - end * 1.6), (-waist, end * 1.6), (-wide, end),
    ]  # fmt: skip


def welding_arm() -> dict[str, bytes]:
    """Six axes; a mesh in every format, in several units, found by package:// names."""
    orange, grey = (0.95, 0.45, 0.1), (0.35, 0.36, 0.38)
    foot = lathe([(0.16, 0), (0.16, 0.03), (0.1, 0.05), (0.085, 0.16), (0.11, 0.19), (0.11, 0.22)])
    box_of_cables = moved(box(0.1, 0.12, 0.08), (-0.14, 0, 0.06))
    fork = prism([(-0.1, 0), (0.1, 0), (0.1, 0.24), (0.055, 0.24), (0.055, 0.1), (-0.055, 0.1), (-0.055, 0.24), (-0.1, 0.24)], 0.16)
    upper = prism(bone(0.42, 0.05, 0.03), 0.1)
    fore = moved(lathe([(0.055, -0.06), (0.055, 0.05), (0.035, 0.09), (0.03, 0.3), (0.045, 0.33), (0.045, 0.36)]), (0, 0, 0))
    wrist = turned(lathe([(0.03, -0.055), (0.042, -0.045), (0.042, 0.045), (0.03, 0.055)]), "yzx")
    flange = tube(0.012, 0.04, 0.02)
    nozzle = lathe([(0.022, 0), (0.022, 0.08), (0.012, 0.1), (0.009, 0.16)], 14)
    at = "package://urdd_robots/meshes/welding_arm/"
    parts = [
        material("orange", (*orange, 1)),
        material("grey", (*grey, 1)),
        link("base", inertial(14, (0.3, 0.3, 0.2), (0, 0, 0.1)), visual(mesh(at + "base.dae")), collision('<cylinder radius="0.16" length="0.22"/>', (0, 0, 0.11))),
        link("turret", inertial(8, (0.2, 0.16, 0.24), (0, 0, 0.12)), visual(mesh(at + "turret.obj")), collision('<box size="0.2 0.16 0.24"/>', (0, 0, 0.12))),
        link("upper_arm", inertial(6, (0.1, 0.1, 0.48), (0, 0, 0.21)), visual(mesh(at + "UPPER_ARM.STL"), material="orange"), collision(mesh(at + "UPPER_ARM.STL"))),
        link("forearm", inertial(4, (0.11, 0.11, 0.42), (0, 0, 0.15)), visual(mesh(at + "forearm.stl"), material="orange"), collision('<cylinder radius="0.055" length="0.42"/>', (0, 0, 0.15))),
        link("wrist", inertial(1.5, (0.11, 0.084, 0.084)), visual(mesh(at + "wrist.glb")), collision('<sphere radius="0.055"/>')),
        link("flange", inertial(0.5, (0.08, 0.08, 0.02)), visual(mesh(at + "flange.stl", (0.001,) * 3), material="grey")),
        link(
            "torch", inertial(0.9, (0.05, 0.05, 0.2), (0, 0, 0.1)),
            visual(mesh(at + "nozzle.dae"), (0, 0, 0.02), (0, pi / 6, 0)),
            visual('<box size="0.05 0.05 0.06"/>', (0, 0, 0.03), material="grey"),
            collision('<cylinder radius="0.03" length="0.2"/>', (0.04, 0, 0.1), (0, pi / 6, 0)),
        ),
        link("camera", inertial(0.2, (0.04, 0.06, 0.03)), collision('<box size="0.04 0.06 0.03"/>')),
        link("tool_center_point"),
        joint("axis_1", "revolute", "base", "turret", (0, 0, 0.22), axis=(0, 0, 1), limit=(-2.9, 2.9, 300, 2.6)),
        joint("axis_2", "revolute", "turret", "upper_arm", (0, 0, 0.2), axis=(0, 1, 0), limit=(-1.6, 2.2, 300, 2.6)),
        joint("axis_3", "revolute", "upper_arm", "forearm", (0, 0, 0.42), (0, pi / 2, 0), axis=(0, 1, 0), limit=(-2.4, 1.3, 200, 2.8)),
        joint("axis_4", "revolute", "forearm", "wrist", (0, 0, 0.39), axis=(0, 0, 1), limit=(-3, 3, 60, 4)),
        joint("axis_5", "revolute", "wrist", "flange", (0, 0, 0.06), axis=(0, 1, 0), limit=(-1.9, 1.9, 60, 4)),
        joint("axis_6", "continuous", "flange", "torch", (0, 0, 0.01), axis=(0, 0, 1), limit=(None, None, 30, 6)),
        joint("camera_mount", "fixed", "flange", "camera", (0.06, 0, 0.01)),
        joint("tool", "fixed", "torch", "tool_center_point", (0.1, 0, 0.175), (0, pi / 6, 0)),
    ]  # fmt: skip
    folder = "meshes/welding_arm/"
    return {
        "welding_arm.urdf": robot("welding_arm", "An arm of six axes that carries a torch.", *parts).encode(),
        folder + "base.dae": files.collada([(foot, (0, 0, 0)), (box_of_cables, (-0.14, 0, 0.06))], grey, "Y_UP", 0.001),
        folder + "turret.obj": files.obj(fork, "turret.mtl", "orange"),
        folder + "turret.mtl": files.mtl("orange", orange),
        folder + "UPPER_ARM.STL": files.binary_stl(upper),
        folder + "forearm.stl": files.ascii_stl(fore),
        folder + "wrist.glb": files.glb(wrist, grey),
        folder + "flange.stl": files.binary_stl(scaled(flange, 1000)),
        folder + "nozzle.dae": files.collada([(nozzle, (0, 0, 0))], (0.8, 0.6, 0.2), "Z_UP", 1.0),
    }


def quadruped() -> dict[str, bytes]:
    """A floating base, and legs that share their meshes: mirrored by scale, turned by origin."""
    trunk = prism([(-0.27, -0.06), (0.27, -0.06), (0.3, -0.02), (0.3, 0.05), (0.1, 0.05), (0.1, 0.03), (-0.2, 0.03), (-0.2, 0.06), (-0.29, 0.05), (-0.3, -0.02)], 0.19)
    hip = lathe([(0.046, -0.03), (0.046, 0.03)], 16) + moved(box(0.03, 0.08, 0.05), (0, 0.06, 0))
    thigh = moved(prism([(x, -z) for x, z in reversed(bone(0.22, 0.034, 0.018))], 0.03), (0, 0.015, 0))
    calf = prism([(-0.012, -0.22), (0.012, -0.22), (0.03, -0.1), (0.016, 0.015), (-0.016, 0.015), (0.004, -0.1)], 0.024)
    at = "meshes/quadruped/"
    parts = [
        link("world"),
        link("trunk", inertial(9, (0.55, 0.19, 0.11)), visual(mesh(at + "trunk.obj")), collision('<box size="0.6 0.19 0.12"/>')),
        link("imu"),
        joint("free_flight", "floating", "world", "trunk", (0, 0, 0.4)),
        joint("imu_mount", "fixed", "trunk", "imu", (-0.05, 0.02, 0.03)),
    ]
    for leg, front, left in (("front_left", 1, 1), ("front_right", 1, -1), ("rear_left", -1, 1), ("rear_right", -1, -1)):
        mirror = None if left == 1 else (1, -1, 1)
        parts += [
            link(f"{leg}_hip", inertial(0.7, (0.09, 0.12, 0.09), (0, 0.04 * left, 0)), visual(mesh(at + "hip.stl", mirror), rpy=(0, 0 if front == 1 else pi, 0)), collision('<cylinder radius="0.046" length="0.06"/>')),
            link(f"{leg}_thigh", inertial(1.1, (0.07, 0.03, 0.26), (0, 0.015 * left, -0.11)), visual(mesh(at + "thigh.dae", mirror)), collision('<box size="0.07 0.03 0.26"/>', (0, 0.015 * left, -0.11))),
            link(f"{leg}_calf", inertial(0.3, (0.04, 0.024, 0.23), (0, 0, -0.1)), visual(mesh(at + "calf.stl")), collision('<capsule radius="0.016" length="0.2"/>', (0, 0, -0.11))),
            link(f"{leg}_foot", inertial(0.06, (0.04, 0.04, 0.04)), visual('<sphere radius="0.02"/>'), collision('<sphere radius="0.02"/>')),
            joint(f"{leg}_abduction", "revolute", "trunk", f"{leg}_hip", (0.23 * front, 0.05 * left, 0), axis=(1, 0, 0), limit=(-0.8, 0.8, 24, 30)),
            joint(f"{leg}_swing", "revolute", f"{leg}_hip", f"{leg}_thigh", (0, 0.085 * left, 0), axis=(0, 1, 0), limit=(-1.2, 2.6, 24, 30)),
            joint(f"{leg}_knee", "revolute", f"{leg}_thigh", f"{leg}_calf", (0, 0.015 * left, -0.22), axis=(0, 1, 0), limit=(-2.7, -0.8, 36, 20)),
            joint(f"{leg}_ankle", "fixed", f"{leg}_calf", f"{leg}_foot", (0, 0, -0.225)),
        ]  # fmt: skip
    return {
        "quadruped.urdf": robot("quadruped", "A walking robot of twelve joints and a floating base.", *parts).encode(),
        at + "trunk.obj": files.obj(trunk, "trunk.mtl", "paint"),
        at + "trunk.mtl": files.mtl("paint", (0.2, 0.25, 0.3)),
        at + "hip.stl": files.binary_stl(hip),
        at + "thigh.dae": files.collada([(thigh, (0, 0, 0))], (0.2, 0.25, 0.3), "Z_UP", 0.01),
        at + "calf.stl": files.binary_stl(calf),
    }


def hand() -> dict[str, bytes]:
    """Five fingers with many links; the last phalanges follow, the thumb's by a mimic of a mimic."""
    palm = prism([(-0.035, 0), (0.035, 0), (0.045, 0.05), (0.042, 0.09), (0.02, 0.1), (-0.04, 0.092), (-0.045, 0.04)], 0.026)
    knuckle = turned(lathe([(0.007, -0.009), (0.0085, -0.006), (0.0085, 0.006), (0.007, 0.009)], 12), "zxy")
    phalanx = prism(bone(0.03, 0.0075, 0.0055), 0.013)
    tip = lathe([(0.0065, 0), (0.0068, 0.008), (0.005, 0.014), (0.002, 0.017)], 12)
    at = "meshes/hand/"
    parts = [link("palm", inertial(0.35, (0.085, 0.026, 0.1), (0, 0, 0.05)), visual(mesh(at + "palm.stl")), collision('<box size="0.09 0.026 0.1"/>', (0, 0, 0.05)))]
    fingers = [
        ("thumb", (-0.045, -0.012, 0.03), (0.5, -0.9, 0), 0.95), ("index", (-0.03, 0, 0.1), (0, -0.06, 0), 1.0),
        ("middle", (-0.01, 0, 0.104), (0, 0, 0), 1.1), ("ring", (0.011, 0, 0.104), (0, 0.06, 0), 1.02), ("little", (0.031, 0, 0.097), (0, 0.14, 0), 0.8),
    ]  # fmt: skip
    for name, place, turn, size in fingers:
        long = 0.03 * size
        mass = 0.012 * size**3
        bone_link = lambda part: link(f"{name}_{part}", inertial(mass, (0.015 * size, 0.013 * size, 0.038 * size), (0, 0, long / 2)), visual(mesh(at + "phalanx.stl", (size,) * 3)), collision(f'<capsule radius="{0.0075 * size:.6g}" length="{long:.6g}"/>', (0, 0, long / 2)))
        parts += [
            link(f"{name}_knuckle", inertial(0.004, (0.018, 0.017, 0.017)), visual(mesh(at + "knuckle.obj")), collision('<sphere radius="0.009"/>')),
            bone_link("proximal"), bone_link("middle"), bone_link("distal"),
            link(f"{name}_tip", inertial(0.004, (0.013, 0.013, 0.017), (0, 0, 0.008)), visual(mesh(at + "tip.stl", (size,) * 3)), collision('<sphere radius="0.006"/>', (0, 0, 0.008))),
            joint(f"{name}_spread", "revolute", "palm", f"{name}_knuckle", place, turn, axis=(0, 1, 0), limit=(-0.3, 0.3, 1, 4)),
            joint(f"{name}_flexion", "revolute", f"{name}_knuckle", f"{name}_proximal", (0, 0, 0.01), axis=(1, 0, 0), limit=(0, 1.6, 1, 4)),
            joint(f"{name}_middle_flexion", "revolute", f"{name}_proximal", f"{name}_middle", (0, 0, long + 0.008), axis=(1, 0, 0), limit=(0, 1.7, 1, 4),
                  mimic=("thumb_flexion", 0.8, 0.05) if name == "thumb" else None),
            joint(f"{name}_distal_flexion", "revolute", f"{name}_middle", f"{name}_distal", (0, 0, long + 0.008), axis=(1, 0, 0), limit=(0, 1.4, 1, 4),
                  mimic=(f"{name}_middle_flexion", 0.7, 0)),
            joint(f"{name}_tip_mount", "fixed", f"{name}_distal", f"{name}_tip", (0, 0, long + 0.004)),
        ]  # fmt: skip
    return {
        "hand.urdf": robot("hand", "A hand of 26 links whose last phalanges follow the others.", *parts).encode(),
        at + "palm.stl": files.binary_stl(palm),
        at + "knuckle.obj": files.obj(knuckle, "knuckle.mtl", "steel"),
        at + "knuckle.mtl": files.mtl("steel", (0.6, 0.6, 0.62)),
        at + "phalanx.stl": files.binary_stl(phalanx),
        at + "tip.stl": files.ascii_stl(tip),
    }


def scaled_parts() -> dict[str, bytes]:
    """What converters get wrong: scales, mirrored scales, several visuals, one file name in two folders, odd names."""
    wedge = prism([(0, 0), (0.2, 0), (0.2, 0.03), (0.05, 0.12), (0, 0.12)], 0.08)
    peg = lathe([(0.03, 0), (0.03, 0.02), (0.012, 0.03), (0.012, 0.1)], 16)
    at = "meshes/scaled_parts/"
    parts = [
        link("base", inertial(2, (0.2, 0.08, 0.12), (0.1, 0, 0.06)), visual(mesh(at + "left/part.stl", (0.001,) * 3)), collision(mesh(at + "left/part.stl", (0.001,) * 3))),
        link("mirrored", inertial(2, (0.2, 0.08, 0.12), (-0.1, 0, 0.06)), visual(mesh(at + "left/part.stl", (-0.001, 0.001, 0.001)))),
        link("through the point", inertial(2, (0.2, 0.08, 0.12), (-0.1, 0, -0.06)), visual(mesh(at + "left/part.stl", (-0.001, -0.001, -0.001)))),
        link("stretched", inertial(1, (0.06, 0.12, 0.05), (0, 0, 0.02)), visual(mesh(at + "right/part.stl", (1, 2, 0.5)), (0, 0, 0.01), (0, 0, 0.3))),
        link(
            "several/visuals", inertial(1, (0.2, 0.1, 0.12)),
            visual(mesh(at + "right/part.stl")), visual(mesh(at + "right/part.stl"), (0.1, 0, 0), (pi, 0, 0)), visual('<box size="0.16 0.03 0.02"/>', (0.05, 0, 0)),
            collision(mesh(at + "left/part.stl", (0.001,) * 3), (-0.1, 0, 0)),
        ),
        link("größe µ 手", inertial(1, (0.06, 0.06, 0.1), (0, 0, 0.05)), visual(mesh(at + "right/part.stl")), collision('<cylinder radius="0.03" length="0.1"/>', (0, 0, 0.05))),
        joint("slide", "prismatic", "base", "mirrored", (-0.02, 0, 0), axis=(1, 0, 0), limit=(-0.1, 0.1, 20, 0.5)),
        joint("turn", "revolute", "mirrored", "through the point", (0, 0.1, 0), axis=(0, 0.6, 0.8), limit=(-1, 1, 20, 2)),
        joint("rigid", "fixed", "base", "stretched", (0.1, 0.2, 0)),
        joint("spin", "continuous", "base", "several/visuals", (0.1, -0.3, 0), axis=(0, 0, 1)),
        joint("follow", "revolute", "several/visuals", "größe µ 手", (0, -0.2, 0), (0, 0, 1.2), axis=(0, 0, 2), limit=(-0.6, 0.6, 20, 2), mimic=("turn", -0.5, 0.1)),
    ]  # fmt: skip
    return {
        "scaled_parts.urdf": robot("scaled_parts", "Scaled, mirrored and repeated meshes, and two files of one name.", *parts).encode(),
        at + "left/part.stl": files.binary_stl(scaled(wedge, 1000)),
        at + "right/part.stl": files.binary_stl(peg),
    }


def main() -> None:
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for make in (welding_arm, quadruped, hand, scaled_parts):
        for name, data in make().items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)


if __name__ == "__main__":
    main()
