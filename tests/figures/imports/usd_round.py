"""Takes URDFs to USD and back, and compares both URDFs: links, joints, limits, mimics, masses, poses in 20 configurations.

    python usd_round.py URDD export|converter WORK URDF...

`export`: by `urdd generate` and `urdd export usd`; `converter`: by urdf-usd-converter of PyPI. Numbers of USD are binary32.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np
import trimesh

from kinematics import Urdf, floats, of_quaternion, origin, pose

# Of lengths in m, angles, masses against themselves.
FAR = 2e-6


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError((done.stderr or done.stdout).strip().splitlines()[-1][:300])
    return done


def usd_of(urdd, way, urdf, folder):
    if way == "export":
        run(urdd, "generate", urdf, "-o", folder / "urdd", "--modules", "link_shapes_skips")
        (folder / "usd").mkdir()
        run(urdd, "export", "usd", folder / "urdd", "-o", folder / "usd" / "robot.usda", "--actuators", "position")
    else:
        import urdf_usd_converter

        urdf_usd_converter.Converter().convert(str(urdf), str(folder / "usd"))
    roots = sorted((folder / "usd").rglob("*.usd*"), key=lambda path: (len(path.parts), path))
    return roots[0]


def limits(joint):
    element = joint.find("limit")
    if element is None or joint.get("type") == "continuous":
        return None
    return float(element.get("lower", 0)), float(element.get("upper", 0))


def drawn(rng, kind):
    """20 values of a joint, as `kinematics` takes them."""
    quaternions = rng.normal(size=(20, 4))
    rotations = of_quaternion(quaternions / np.linalg.norm(quaternions, axis=1)[:, None])
    if kind == "floating":
        return np.stack([pose(of, rng.uniform(-1, 1, 3)) for of in rotations])
    return rotations if kind == "spherical" else rng.uniform(-1, 1, (20, 3) if kind == "planar" else 20)


def leader(robot, joint):
    """The joint that a joint follows, through others: its name, multiplier and offset."""
    name, multiplier, offset = joint.get("name"), 1.0, 0.0
    while (of := robot[name].find("mimic")) is not None:
        own, shift = float(of.get("multiplier", 1)), float(of.get("offset", 0))
        name, multiplier, offset = of.get("joint"), multiplier * own, offset + multiplier * shift
    return name, multiplier, offset


def points(shape, folder):
    """Points whose box is that of a shape, in the frame of its link."""
    geometry = shape.find("geometry")[0]
    if geometry.tag == "box":
        made = trimesh.creation.box(floats(geometry.get("size"), 3)).vertices
    elif geometry.tag == "sphere":
        made = trimesh.creation.icosphere(subdivisions=5, radius=float(geometry.get("radius"))).vertices
    elif geometry.tag == "capsule":
        made = trimesh.creation.capsule(float(geometry.get("length")), float(geometry.get("radius")), count=[64, 64]).vertices
        made = made - made.mean(0)
    elif geometry.tag == "cylinder":
        size = {name: float(geometry.get(of)) for name, of in (("radius", "radius"), ("height", "length"))}
        made = trimesh.creation.cylinder(**size, sections=256).vertices
    else:
        name = geometry.get("filename")
        name = name.split("://")[1].split("/", 1)[-1] if "://" in name else name
        if not (folder / name).is_file():
            raise KeyError
        made = trimesh.load(folder / name, force="mesh").vertices
        made = made * (floats(geometry.get("scale"), 3) if geometry.get("scale") else 1)
    pose = origin(shape)
    return made @ pose[:3, :3].T + pose[:3, 3]


def box(robot, link, kind):
    """The box of all visuals or collisions of a link."""
    shapes = robot.links[link].findall(kind)
    if not shapes:
        return None
    meshes = [mesh.get("filename") for shape in shapes for mesh in shape.iter("mesh")]
    # What the converter leaves out, and what trimesh reads without its unit.
    if any(shape.find("geometry/capsule") is not None for shape in shapes) or any(mesh.lower().endswith((".dae", ".glb")) for mesh in meshes):
        raise KeyError
    all_points = np.concatenate([points(shape, pathlib.Path(robot.path).parent) for shape in shapes])
    return np.stack([all_points.min(0), all_points.max(0)])


def compare_shapes(one, other, wrong):
    """Boxes around what is seen and what collides, within what the facets of round shapes are."""
    compared = 0
    for link in one.links:
        if link not in other.links:
            continue
        for kind in ("visual", "collision"):
            try:
                theirs, ours = box(one, link, kind), box(other, link, kind)
            except KeyError:
                continue
            if (theirs is None) != (ours is None):
                wrong.append(f"link {link}: {kind} {ours is not None} for {theirs is not None}")
            elif theirs is not None:
                compared += 1
                if np.abs(theirs - ours).max() > 1e-3 * np.ptp(theirs, axis=0).max() + 1e-6:
                    wrong.append(f"link {link}: {kind} in {ours.tolist()} for {theirs.tolist()}")
    return compared


def is_merged(robot, name):
    """Whether the converter has no link of it: by a fixed joint, or a root, without a mass or a shape of its own."""
    joint, link = robot.into.get(name), robot.links[name]
    is_fixed = joint is None or joint.get("type") == "fixed"
    return is_fixed and (link.find("inertial") is None or link.find("visual") is None and link.find("collision") is None)


def compare(one, other, wrong):
    """What differs between two robots."""
    links = [name for name in one.links if name in other.links]
    missing = sorted(set(one.links) - set(other.links))
    if [name for name in missing if not is_merged(one, name)]:
        wrong.append(f"links are missing: {missing[:5]}")
    # A visual whose mesh is not found stays as a frame.
    bare = {name for name, link in other.links.items() if len(link) == 0}
    if more := sorted(set(other.links) - set(one.links) - bare):
        wrong.append(f"links are more: {more[:5]}")
    joints = {joint.get("name"): joint for joint in other.joints}
    values, rng = {}, np.random.default_rng(0)
    for joint in one.moving:
        name, kind = joint.get("name"), joint.get("type")
        own = joints.get(name)
        if own is None and kind == "floating" and joint.find("parent").get("link") == one.root:
            # The base is free.
            values[name] = np.broadcast_to(np.eye(4), (20, 4, 4))
            continue
        if own is None:
            wrong.append(f"joint {name} is missing")
            return
        span = limits(joint) if kind in ("revolute", "prismatic") else None
        if span and span[0] == span[1] and own.get("type") == "fixed":
            # It cannot move.
            values[name] = np.full(20, span[0])
            continue
        if own.get("type") != kind:
            wrong.append(f"joint {name} is {own.get('type')} for {kind}")
        theirs, ours = (limits(of) if of.get("type") in ("revolute", "prismatic") else None for of in (joint, own))
        if (theirs is None) != (ours is None) or theirs and max(abs(a - b) for a, b in zip(theirs, ours)) > FAR * max(1, *map(abs, theirs)):
            wrong.append(f"joint {name}: limits {ours} for {theirs}")
        follows = joint.find("mimic") is not None
        # What follows is not driven: `urdd export` leaves its effort out.
        # Nor those of planar joints are in USD.
        for attribute in () if kind == "planar" else ("velocity",) if follows else ("effort", "velocity"):
            theirs, ours = ((of.find("limit").get(attribute) if of.find("limit") is not None else None) for of in (joint, own))
            if theirs and float(theirs) > 0 and abs(float(ours or 1000) - float(theirs)) > 1e-5 * float(theirs):
                wrong.append(f"joint {name}: {attribute} {ours} for {theirs}")
        theirs, ours = leader({of.get("name"): of for of in one.joints}, joint), leader(joints, own)
        if theirs[0] != ours[0] or np.abs(np.subtract(theirs[1:], ours[1:])).max() > FAR * max(1, abs(theirs[1])):
            wrong.append(f"joint {name} follows {ours} for {theirs}")
        values[name] = drawn(rng, kind)
    for link in links:
        (mass, centre, inertia), (mass2, centre2, inertia2) = one.inertial(link), other.inertial(link)
        # What says no mass has that of its shapes in USD.
        if mass == 0:
            continue
        # Nor does a centre that is not said, which is that of the shapes, and an inertia of 0.
        is_said = one.links[link].find("inertial/origin") is not None
        if abs(mass - mass2) > FAR * mass or is_said and np.abs(centre - centre2).max() > FAR:
            wrong.append(f"link {link}: mass {mass2} {centre2} for {mass} {centre}")
        if inertia.any() and np.abs(inertia - inertia2).max() > 1e-5 * max(np.abs(inertia).max(), 1e-6):
            wrong.append(f"link {link}: inertia {inertia2.tolist()} for {inertia.tolist()}")
    try:
        poses, poses2 = one.poses(values, 20), other.poses(values, 20)
    except ValueError as why:
        wrong.append(f"poses are not compared: {why}")
        return
    # The world of a converted robot may be left out.
    root, root2 = (np.linalg.inv(of[links[0]]) for of in (poses, poses2))
    far = {link: np.abs(root2 @ poses2[link] - root @ poses[link]).max() for link in links}
    worst = max(far, key=far.get)
    if far[worst] > 1e-5:
        wrong.append(f"link {worst} is {far[worst]:.3g} away, of {sum(of > 1e-5 for of in far.values())} links")


def main():
    urdd, way, work = sys.argv[1:4]
    totals = dict(robots=0, right=0, merged=0, refused=0, unconverted=0, boxes=0)
    for urdf in map(pathlib.Path, sys.argv[4:]):
        folder = pathlib.Path(work) / f"{totals['robots']}_{urdf.stem}"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        totals["robots"] += 1
        try:
            usd = usd_of(urdd, way, urdf.resolve(), folder)
        except Exception as why:
            totals["unconverted"] += 1
            print(f"{urdf}: not converted: {str(why)[:200]}", flush=True)
            continue
        try:
            run(urdd, "import", usd, "-o", folder / "back", "--report", folder / "report.json")
        except RuntimeError as why:
            totals["refused"] += 1
            print(f"{urdf}: refused: {why}", flush=True)
            continue
        wrong = []
        try:
            one, other = Urdf(urdf), Urdf(next((folder / "back").glob("*.urdf")))
            compare(one, other, wrong)
            # `urdd export` writes pieces of ours.
            if way == "converter":
                totals["boxes"] += compare_shapes(one, other, wrong)
        except Exception as why:
            wrong.append(f"not compared: {why!r}")
        totals["right"] += not wrong
        # Right but for links that the converter has no body for.
        totals["merged"] += not wrong and not set(one.links) <= set(other.links)
        if not wrong:
            shutil.rmtree(folder)
        for line in wrong[:6]:
            print(f"{urdf}: {line}", flush=True)
    print(json.dumps(totals))


if __name__ == "__main__":
    main()
