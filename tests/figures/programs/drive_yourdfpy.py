#!/usr/bin/env python3
"""Driver of yourdfpy: `yourdfpy.URDF.load(path)` with its defaults.

Meshes of visuals are loaded into its scene, those of collisions are not. A visual whose mesh is not found or not
loaded is in `robot.links` but not in the scene: it is not among the facts. yourdfpy looks for package:// beside the
URDF and above it: PACKAGES are not used.
"""

from __future__ import annotations

import json
import logging
import math
import os
import sys
import tempfile

PROTOCOL = os.fdopen(os.dup(1), "w", encoding="utf-8", errors="surrogateescape", buffering=1)
CAUGHT = tempfile.TemporaryFile()  # noqa: SIM115
os.dup2(CAUGHT.fileno(), 1)
os.dup2(CAUGHT.fileno(), 2)

import trimesh.transformations as transformations  # noqa: E402
import yourdfpy  # noqa: E402
import yourdfpy.urdf  # noqa: E402

SAID: list[str] = []
SCENES: dict[int, object] = {}


class Keep(logging.Handler):
    def emit(self, record: logging.LogRecord) -> None:
        if record.levelno >= logging.WARNING:
            SAID.append(f"{record.levelname}: {record.getMessage()}")


logging.getLogger("yourdfpy").addHandler(Keep())
logging.getLogger("yourdfpy").propagate = False
ORDINARY = yourdfpy.URDF._geometry2trimeshscene


def noting(self, geometry, load_file, force_mesh, skip_materials):
    made = ORDINARY(self, geometry, load_file, force_mesh, skip_materials)
    SCENES[id(geometry)] = made is not None and len(made.geometry) > 0
    return made


yourdfpy.URDF._geometry2trimeshscene = noting


def number(value) -> str:
    text = f"{float(value):.7g}"
    return "0" if text == "-0" else text


def numbers(values) -> str:
    return " ".join(number(value) for value in values)


def pose(matrix) -> str:
    if matrix is None:
        return "0 0 0 1 0 0 0"
    if not all(math.isfinite(value) for value in matrix.ravel()):
        return numbers(matrix[:3, 3]) + " nan nan nan nan"
    turned = transformations.quaternion_from_matrix(matrix)
    return numbers([*matrix[:3, 3], *(turned if turned[0] >= 0 else -turned)])


def shape(geometry) -> str:
    if geometry.box is not None:
        return "box " + numbers(geometry.box.size)
    if geometry.cylinder is not None:
        return "cylinder " + numbers([geometry.cylinder.radius, geometry.cylinder.length])
    if geometry.sphere is not None:
        return "sphere " + number(geometry.sphere.radius)
    scale = geometry.mesh.scale
    scale = [1, 1, 1] if scale is None else [scale] * 3 if isinstance(scale, float) else scale
    return f"mesh {geometry.mesh.filename} " + numbers(scale)


def of_link(link, materials) -> dict[str, object]:
    key = f"link/{link.name}"
    facts: dict[str, object] = {key: 1}
    if (inertial := link.inertial) is not None:
        facts[f"{key}/inertial"] = 1
        if inertial.mass is not None:
            facts[f"{key}/inertial/mass"] = number(inertial.mass)
        origin = inertial.origin
        facts[f"{key}/inertial/com"] = "0 0 0" if origin is None else numbers(origin[:3, 3])
        if inertial.inertia is not None:
            tensor = inertial.inertia if origin is None else origin[:3, :3] @ inertial.inertia @ origin[:3, :3].T
            facts[f"{key}/inertial/inertia"] = numbers(tensor[i][j] for i in range(3) for j in range(i, 3))
    shown = [visual for visual in link.visuals if SCENES.get(id(visual.geometry))]
    for kind, parts in (("visual", shown), ("collision", link.collisions)):
        if parts:
            facts[f"{key}/{kind}"] = len(parts)
        for i, part in enumerate(parts):
            at = f"{key}/{kind}/{i}"
            facts[f"{at}/geometry"] = shape(part.geometry)
            facts[f"{at}/origin"] = pose(part.origin)
            if part.name is not None:
                facts[f"{at}/name"] = part.name
            if (material := getattr(part, "material", None)) is not None:
                # What apply_visual_color does.
                color = material.color
                if color is None and material.name in materials:
                    color = materials[material.name].color
                if color is not None:
                    facts[f"{at}/color"] = numbers(color.rgba)
    return facts


def of_joint(joint) -> dict[str, object]:
    key = f"joint/{joint.name}"
    facts: dict[str, object] = {key: joint.type, f"{key}/parent": joint.parent, f"{key}/child": joint.child}
    facts[f"{key}/origin"] = pose(joint.origin)
    if joint.type != "fixed":
        facts[f"{key}/axis"] = numbers(joint.axis)
    for name in ("lower", "upper", "velocity", "effort"):
        if joint.limit is not None and (value := getattr(joint.limit, name)) is not None:
            facts[f"{key}/{name}"] = number(value)
    for name in ("damping", "friction"):
        # yourdfpy keeps the text.
        if joint.dynamics is not None and (value := getattr(joint.dynamics, name)) is not None:
            facts[f"{key}/{name}"] = value
    if (mimic := joint.mimic) is not None:
        facts[f"{key}/mimic"] = f"{mimic.joint} {numbers([mimic.multiplier, mimic.offset])}"
    if (safety := joint.safety_controller) is not None:
        values = [safety.soft_lower_limit, safety.soft_upper_limit, safety.k_position, safety.k_velocity]
        facts[f"{key}/safety"] = numbers(0 if value is None else value for value in values)
    if (calibration := joint.calibration) is not None:
        edges = [calibration.rising, calibration.falling]
        facts[f"{key}/calibration"] = " ".join("-" if edge is None else number(edge) for edge in edges)
    return facts


def facts_of(robot: yourdfpy.URDF) -> dict[str, object]:
    facts: dict[str, object] = {"robot": robot.robot.name}
    for material in robot.robot.materials:
        if material.color is not None:
            facts[f"material/{material.name}"] = numbers(material.color.rgba)
        elif material.texture is not None:
            facts[f"material/{material.name}"] = material.texture.filename
    for link in robot.robot.links:
        facts |= of_link(link, robot._material_map)
    for joint in robot.robot.joints:
        facts |= of_joint(joint)
    return facts


def answer(path: str) -> dict[str, object]:
    SAID.clear()
    SCENES.clear()
    try:
        robot = yourdfpy.URDF.load(path)
        return {"verdict": "loads", "why": "", "said": SAID, "facts": facts_of(robot)}
    except Exception as error:
        why = f"{type(error).__name__}: {error}".split("\n")[0]
        return {"verdict": "refuses", "why": why, "said": SAID, "facts": {}}


for line in sys.stdin:
    PROTOCOL.write(json.dumps(answer(line.rstrip("\n")), default=str) + "\n")
    PROTOCOL.flush()
