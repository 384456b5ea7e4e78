#!/usr/bin/env python3
"""Driver of urdf-usd-converter (Isaac Sim, Newton): `Converter(ros_packages=...).convert(path, folder)`.

    python3 -m venv venv_usd && venv_usd/bin/pip install urdf-usd-converter==0.3.4

All values are read from the stage that it writes. Which prim is which link, joint or geometry is noted while it
writes, since names are made fit for USD. A mesh that could not be converted leaves a prim without a mesh: it is not
among the facts.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import sys
import tempfile
from pathlib import Path

PROTOCOL = os.fdopen(os.dup(1), "w", encoding="utf-8", errors="surrogateescape", buffering=1)
CAUGHT = tempfile.TemporaryFile()  # noqa: SIM115
os.dup2(CAUGHT.fileno(), 1)
os.dup2(CAUGHT.fileno(), 2)

import urdf_usd_converter  # noqa: E402
import usdex.core  # noqa: E402
from pxr import Gf, Usd, UsdGeom, UsdPhysics, UsdShade  # noqa: E402
from urdf_usd_converter._impl import link as writer  # noqa: E402
from urdf_usd_converter._impl.urdf_parser.elements import ElementMesh, ElementVisual  # noqa: E402

PACKAGES = [
    {"name": folder.name, "path": str(folder)}
    for place in os.environ.get("PACKAGES", "").split(os.pathsep)
    if place
    for folder in sorted(Path(place).iterdir())
    if folder.is_dir()
]
LINKS: dict[str, str] = {}  # a prim's path -> the link's name
PARTS: dict[str, list[tuple[str, str, str, str]]] = {}  # a link's path -> kind, name, the prim's path, the mesh's file
JOINTS: dict[str, str] = {}
WRITE_LINK, WRITE_GEOMETRY, WRITE_JOINT = writer.convert_link, writer.convert_geometry, writer.apply_newton_joint_api


def note_link(parent, having_articulation_root, link, data):
    made = WRITE_LINK(parent, having_articulation_root, link, data)
    LINKS[str(made.GetPath())] = link.name
    return made


def note_geometry(parent, name, safe_name, geometry, data):
    made = WRITE_GEOMETRY(parent, name, safe_name, geometry, data)
    kind = "visual" if isinstance(geometry, ElementVisual) else "collision"
    shape = geometry.geometry.shape
    file = shape.filename if isinstance(shape, ElementMesh) else ""
    PARTS.setdefault(str(parent.GetPath()), []).append((kind, geometry.name or "", str(made.GetPath()), file))
    return made


def note_joint(joint, prim):
    JOINTS[str(prim.GetPath())] = joint.name
    return WRITE_JOINT(joint, prim)


writer.convert_link, writer.convert_geometry, writer.apply_newton_joint_api = note_link, note_geometry, note_joint


def number(value) -> str:
    text = f"{float(value):.7g}"
    return "0" if text == "-0" else text


def numbers(values) -> str:
    return " ".join(number(value) for value in values)


def quaternion(turned) -> list[float]:
    values = [turned.GetReal(), *turned.GetImaginary()]
    return [-value for value in values] if values[0] < 0 else values


def pose(prim) -> str:
    position, _, turned, _ = usdex.core.getLocalTransformComponentsQuat(UsdGeom.Xformable(prim))
    return numbers([*position, *quaternion(turned)])


def scale(prim) -> list[float]:
    for op in UsdGeom.Xformable(prim).GetOrderedXformOps():
        if op.GetOpType() == UsdGeom.XformOp.TypeScale:
            return list(op.Get())
    return [1, 1, 1]


def shape(prim, file: str) -> str | None:
    if file:
        meshes = [below for below in Usd.PrimRange(prim) if below.IsA(UsdGeom.Mesh)]
        faces = sum(len(UsdGeom.Mesh(mesh).GetFaceVertexCountsAttr().Get() or []) for mesh in meshes)
        return f"mesh {file} " + numbers(scale(prim)) if faces else None
    if prim.IsA(UsdGeom.Cube):
        return "box " + numbers(UsdGeom.Cube(prim).GetSizeAttr().Get() * value for value in scale(prim))
    if prim.IsA(UsdGeom.Sphere):
        return "sphere " + number(UsdGeom.Sphere(prim).GetRadiusAttr().Get())
    if prim.IsA(UsdGeom.Cylinder):
        cylinder = UsdGeom.Cylinder(prim)
        return "cylinder " + numbers([cylinder.GetRadiusAttr().Get(), cylinder.GetHeightAttr().Get()])
    return prim.GetTypeName()


def color(prim) -> tuple[str | None, str | None]:
    """Of the material that is bound to the prim: colour and texture."""
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    if not material:
        return None, None
    for below in Usd.PrimRange(material.GetPrim()):
        shader = UsdShade.Shader(below)
        if shader and shader.GetIdAttr().Get() == "UsdUVTexture":
            return None, str(shader.GetInput("file").Get().path)
    surface, _, _ = material.ComputeSurfaceSource()
    if not surface:
        return None, None
    values = [
        input_.GetValueProducingAttributes() if (input_ := surface.GetInput(name)) else []
        for name in ("diffuseColor", "opacity")
    ]
    diffuse, opacity = (of[0].Get() if of else None for of in values)
    return (numbers([*map(srgb, diffuse), 1 if opacity is None else opacity]) if diffuse is not None else None), None


def srgb(value: float) -> float:
    """USD's colours are linear."""
    return value * 12.92 if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


def of_link(prim, name: str) -> dict[str, object]:
    key = f"link/{name}"
    facts: dict[str, object] = {key: 1}
    if prim.HasAPI(UsdPhysics.MassAPI):
        body = UsdPhysics.MassAPI(prim)
        facts[f"{key}/inertial"] = 1
        if body.GetMassAttr().HasAuthoredValue():
            facts[f"{key}/inertial/mass"] = number(body.GetMassAttr().Get())
        centre = body.GetCenterOfMassAttr()
        facts[f"{key}/inertial/com"] = numbers(centre.Get()) if centre.HasAuthoredValue() else "0 0 0"
        tensor = prim.GetAttribute("newton:inertia")
        if body.GetDiagonalInertiaAttr().HasAuthoredValue() and tensor and tensor.Get() is not None:
            xx, yy, zz, xy, xz, yz = tensor.Get()
            facts[f"{key}/inertial/inertia"] = numbers([xx, xy, xz, yy, yz, zz])
    counts = {"visual": 0, "collision": 0}
    for kind, part_name, path, file in PARTS.get(str(prim.GetPath()), []):
        part = prim.GetStage().GetPrimAtPath(path)
        if (text := shape(part, file)) is None:
            continue
        at = f"{key}/{kind}/{counts[kind]}"
        counts[kind] += 1
        facts[f"{at}/geometry"], facts[f"{at}/origin"] = text, pose(part)
        if part_name:
            facts[f"{at}/name"] = part_name
        if kind == "visual":
            shown, texture = color(part)
            if shown:
                facts[f"{at}/color"] = shown
            if texture:
                facts[f"{at}/texture"] = texture
    return facts | {f"{key}/{kind}": count for kind, count in counts.items() if count}


def of_joint(prim, name: str) -> dict[str, object]:
    key = f"joint/{name}"
    joint = UsdPhysics.Joint(prim)
    kinds = {"PhysicsFixedJoint": "fixed", "PhysicsPrismaticJoint": "prismatic", "PhysicsRevoluteJoint": "revolute"}
    kind = kinds.get(prim.GetTypeName(), "planar")
    facts: dict[str, object] = {}
    turns, slides = prim.IsA(UsdPhysics.RevoluteJoint), prim.IsA(UsdPhysics.PrismaticJoint)
    if turns or slides:
        of = UsdPhysics.RevoluteJoint(prim) if turns else UsdPhysics.PrismaticJoint(prim)
        unit = {"X": Gf.Vec3f(1, 0, 0), "Y": Gf.Vec3f(0, 1, 0), "Z": Gf.Vec3f(0, 0, 1)}[of.GetAxisAttr().Get()]
        facts[f"{key}/axis"] = numbers(joint.GetLocalRot1Attr().Get().Transform(unit))
        lower, upper = of.GetLowerLimitAttr(), of.GetUpperLimitAttr()
        if (lower.HasAuthoredValue() and math.isfinite(lower.Get())) or (
            upper.HasAuthoredValue() and math.isfinite(upper.Get())
        ):
            read = math.radians if turns else float
            facts[f"{key}/lower"], facts[f"{key}/upper"] = number(read(lower.Get())), number(read(upper.Get()))
        elif turns:
            kind = "continuous"
    facts[key] = kind
    for side, targets in (("parent", joint.GetBody0Rel()), ("child", joint.GetBody1Rel())):
        for target in targets.GetTargets():
            if str(target) in LINKS:
                facts[f"{key}/{side}"] = LINKS[str(target)]
                if side == "child":
                    facts[f"{key}/origin"] = pose(prim.GetStage().GetPrimAtPath(target))
    degrees = math.pi / 180 if turns else 1
    for attribute, fact, factor in (
        ("urdf:limit:effort", "effort", 1),
        ("newton:velocityLimit", "velocity", degrees),
        ("newton:damping", "damping", 1 / degrees),
        ("newton:friction", "friction", 1),
    ):
        found = prim.GetAttribute(attribute)
        if found and found.HasAuthoredValue() and found.Get() is not None:
            facts[f"{key}/{fact}"] = number(found.Get() * factor)
    if prim.HasAPI("NewtonMimicAPI"):
        driver = [
            JOINTS.get(str(target), str(target)) for target in prim.GetRelationship("newton:mimicJoint").GetTargets()
        ]
        offset = prim.GetAttribute("newton:mimicCoef0").Get() * degrees
        facts[f"{key}/mimic"] = f"{' '.join(driver)} {numbers([prim.GetAttribute('newton:mimicCoef1').Get(), offset])}"
    for element, names in (
        ("safety_controller", ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")),
        ("calibration", ("rising", "falling")),
    ):
        found = [prim.GetAttribute(f"urdf:{element}:{name}") for name in names]
        if any(found):
            absent = "-" if element == "calibration" else "0"
            text = " ".join(number(value.Get()) if value else absent for value in found)
            facts[f"{key}/{element.removesuffix('_controller')}"] = text
    return facts


def facts_of(stage) -> dict[str, object]:
    root = stage.GetDefaultPrim()
    facts: dict[str, object] = {"robot": root.GetDisplayName() or root.GetName()}
    for path, name in LINKS.items():
        if prim := stage.GetPrimAtPath(path):
            facts |= of_link(prim, name)
    for path, name in JOINTS.items():
        if prim := stage.GetPrimAtPath(path):
            facts |= of_joint(prim, name)
    return facts


def said() -> list[str]:
    CAUGHT.seek(0)
    lines = CAUGHT.read().decode("utf-8", "replace").splitlines()
    CAUGHT.seek(0)
    CAUGHT.truncate()
    found = [line.split(" -- ", 1)[-1] for line in lines if line.startswith(("Warning", "Error"))]
    return [line for line in found if "was deprecated in" not in line][:20]


def answer(path: str) -> dict[str, object]:
    LINKS.clear()
    PARTS.clear()
    JOINTS.clear()
    folder = tempfile.mkdtemp()
    try:
        asset = urdf_usd_converter.Converter(ros_packages=PACKAGES).convert(path, folder)
        stage = Usd.Stage.Open(asset.path)
        return {"verdict": "loads", "why": "", "facts": facts_of(stage), "said": said()}
    except Exception as error:
        why = f"{type(error).__name__}: {error}".split("\n")[0]
        return {"verdict": "refuses", "why": why, "facts": {}, "said": said()}
    finally:
        shutil.rmtree(folder, ignore_errors=True)


for line in sys.stdin:
    PROTOCOL.write(json.dumps(answer(line.rstrip("\n"))) + "\n")
    PROTOCOL.flush()
