"""Loads what `urdd export` writes into the programs that it is for, and compares numbers.

    pip install mujoco==4.0.0 pin==4.1.0 drake==1.51.1 yourdfpy==0.0.60 numpy
    cargo build
    urdd generate ROBOT.urdf -o URDD            # for each robot
    python3 tests/figures/exports/peers.py target/debug/urdd URDD... [--json tests/figures/exports/results.json]

What is compared, for each URDD:

- MuJoCo (MJCF): the poses of all links at the kinematics samples; the total mass; for CONFIGURATIONS sampled
  configurations the pairs of pieces in contact beside `urdd check-collisions`; a simulation at rest.
- Pinocchio with coal (URDF and SRDF): poses, mass, and the pairs of links in contact among those that the SRDF leaves.
- yourdfpy (URDF): poses.
- Drake (its URDF, and SDF): poses, mass, and the pairs of links in contact.
- libsdformat (SDF), where SDF_LOAD names the program of `sdf.cpp`: poses with all joints at 0, mass, collisions.

Exits with 1 where poses differ by more than 1e-9, masses by more than what the file itself names, or answers by more than
a band of 10 micrometres around contact and the pairs of links that the file names.
"""

import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import pinocchio as pin

from programs import Drake, Libsdformat, Mujoco, NotComparable, Pinocchio, Urdd, Yourdfpy

POSE_TOLERANCE = 1e-9
# Contact within this is a matter of binary32 meshes and of each program's own tolerance.
BAND = 1e-5
CONFIGURATIONS = 100
NAMED = re.compile(r"links `(.*?)` and `(.*?)` are (disabled|checked) as a whole.*?(?:in (\d+) of (\d+) sampled)?\.? -->")


def of_links(pairs):
    return {tuple(sorted(link for link, _ in pair)) for pair in pairs}


def named(text):
    """The pairs of links of which a file says that its answers differ: disabled or checked, in how many configurations."""
    found = {}
    for a, b, done, lost, samples in NAMED.findall(text):
        found[tuple(sorted((a, b)))] = (done, int(lost or 0), int(samples or 0))
    return found


def by_mujoco(urdd, folder):
    file = folder / "mujoco.xml"
    text = urdd.export("mjcf", file)
    loaded = Mujoco(urdd, file)
    model, data = loaded.model, loaded.data
    geoms = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_GEOM, geom) for geom in range(model.ngeom)]
    place = lambda q: loaded.place(urdd.values(q))
    difference = urdd.difference(loaded)
    rigid = urdd_rigid(urdd)
    missed, more, seen, lasted = set(), set(), 0, []
    for q, expected in urdd.collisions(CONFIGURATIONS):
        place(q)
        begun = time.perf_counter()
        mujoco.mj_collision(model, data)
        lasted.append(time.perf_counter() - begun)
        found = {}
        for contact in data.contact[: data.ncon]:
            pair = tuple(sorted(tuple_of(geoms[geom]) for geom in contact.geom))
            found[pair] = min(found.get(pair, 0.0), contact.dist)
        seen += len(expected)
        for pair in expected - found.keys():
            ids = [geoms.index(f"{link}/{piece}") for link, piece in pair]
            if rigid[pair[0][0]] == rigid[pair[1][0]]:
                continue
            if mujoco.mj_geomDistance(model, data, *ids, 1.0, None) < -BAND:
                missed.add(pair)
        more |= {pair for pair, depth in found.items() if pair not in expected and depth < -BAND}
    # At rest: no contact in the default configuration, nothing moves without gravity, nothing diverges with it.
    zero = next(sample for sample in urdd.samples if sample["kind"] == "Zero")["configuration"]
    bounds = urdd.document("bounds_module")
    zero = [min(max(v, lo), hi) for v, (lo, hi) in zip(zero, bounds["bounds"])]
    place(zero)
    start = data.qpos.copy()
    mujoco.mj_forward(model, data)
    contacts = int(data.ncon)
    model.opt.gravity[:] = 0
    for _ in range(100):
        mujoco.mj_step(model, data)
    drift = float(np.abs(data.qpos - start).max()) if model.nq else 0.0
    model.opt.gravity[:] = (0, 0, -9.81)
    for _ in range(200):
        mujoco.mj_step(model, data)
    warned = sum(int(warning.number) for warning in data.warning)
    masses = float(model.body_mass.sum())
    kept = sum(
        link["inertial"]["mass"]["value"]
        for link in urdd.links
        if link["name"] == "world" and link["inertial"] and link["inertial"]["mass"]
    )
    assumed = 1e-9 * text.count("1e-9 kg and 1e-9 kg m")
    said = {
        "poses": difference,
        "mass": masses,
        "mass_difference": abs(masses - (urdd.mass - kept)),
        "geoms": int((model.geom_group == 3).sum()),
        "pairs": int(model.npair),
        "excludes": int(model.nexclude),
        "contacts": seen,
        "missed": sorted(missed),
        "more": sorted(more),
        "collision_us": float(np.median(lasted) * 1e6),
        "contacts_at_rest": contacts,
        "drift_at_rest": drift,
        "warnings": warned,
    }
    expected_at_rest = default_contacts(urdd, zero)
    said["failed"] = bool(
        difference > POSE_TOLERANCE
        or missed
        or more
        or said["mass_difference"] > assumed + 1e-12 * max(1.0, urdd.mass)
        or (contacts > 0) != expected_at_rest
        or (not expected_at_rest and drift > 1e-9)
        or warned
        or not np.isfinite(data.qpos).all()
    )
    return said


def default_contacts(urdd, q):
    command = [urdd.program, "check-collisions", str(urdd.root), "-c", "-", "--format", "json"]
    done = subprocess.run(command, input=json.dumps(q) + "\n", capture_output=True, text=True)
    return json.loads(done.stdout.splitlines()[0])["in_collision"]


def tuple_of(geom):
    link, piece = geom.rsplit("/", 1)
    return link, int(piece)


def urdd_rigid(urdd):
    """For each link the first of those that fixed joints hold together with it."""
    rigid = {name: name for name in urdd.names}
    for _ in urdd.joints:
        for joint in urdd.joints:
            if joint["joint_type"] == "Fixed":
                rigid[joint["child"]["link"]] = rigid[joint["parent"]["link"]]
    return rigid


def judged(found, depth, expected, names, may_miss):
    """Pairs of links that a program misses or has besides, but for the band and those that the file names."""
    missed = {pair for pair in expected - found if not may_miss(pair) and names.get(pair, ("",))[0] != "disabled"}
    more = {
        pair
        for pair in found - expected
        if names.get(pair, ("",))[0] != "checked" and depth(pair) > BAND
    }
    return missed, more


def by_pinocchio(urdd, folder):
    file = folder / "robot.urdf"
    urdd.export("urdf", file)
    loaded = Pinocchio(urdd, file)
    model = loaded.model
    difference = urdd.difference(loaded)
    total = pin.computeTotalMass(model)
    said = {
        "poses": difference,
        "mass": float(total),
        "mimics_followed": loaded.followed,
        "mimics": sum("Mimic" in joint.shortname() for joint in model.joints),
        "failed": difference > POSE_TOLERANCE or abs(total - urdd.mass) > 1e-9 * max(1.0, urdd.mass),
    }
    for keep in ([], ["--keep-pairs"]):
        said["keep" if keep else "pairs"] = pinocchio_pairs(urdd, folder, file, loaded, keep)
        said["failed"] |= bool(said["keep" if keep else "pairs"]["missed"] or said["keep" if keep else "pairs"]["more"])
    return said


def pinocchio_pairs(urdd, folder, file, loaded, keep):
    text = urdd.export("srdf", folder / "robot.srdf", *keep)
    names, model = named(text), loaded.model
    geometry = pin.buildGeomFromUrdf(model, str(file), pin.GeometryType.COLLISION, str(folder))
    for of in geometry.geometryObjects:
        if hasattr(of.geometry, "buildConvexRepresentation"):
            of.geometry.buildConvexRepresentation(False)
            of.geometry = of.geometry.convex
    geometry.addAllCollisionPairs()
    pin.removeCollisionPairs(model, geometry, str(folder / "robot.srdf"))
    links = [model.frames[of.parentFrame].name for of in geometry.geometryObjects]
    of_data = pin.GeometryData(geometry)
    missed, more, lost, seen = set(), set(), 0, 0
    rigid = urdd_rigid(urdd)
    for q, expected in urdd.collisions(CONFIGURATIONS // 2):
        pin.computeCollisions(model, loaded.data, geometry, of_data, loaded.configuration(urdd.values(q)), False)
        found = {}
        for at, pair in enumerate(geometry.collisionPairs):
            result = of_data.collisionResults[at]
            if result.isCollision():
                key = tuple(sorted((links[pair.first], links[pair.second])))
                depth = max(-contact.penetration_depth for contact in result.getContacts())
                found[key] = max(found.get(key, 0.0), abs(depth))
        links_expected = of_links(expected)
        seen += len(links_expected)
        lost += len({pair for pair in links_expected - found.keys() if pair in names})
        fixed = lambda pair: rigid[pair[0]] == rigid[pair[1]]
        absent, besides = judged(found.keys(), found.get, links_expected, names, fixed)
        missed |= {pair for pair in absent if not grazes(urdd, q, pair)}
        more |= besides
    return {"contacts": seen, "lost": lost, "named": len(names), "missed": sorted(missed), "more": sorted(more)}


def grazes(urdd, q, pair):
    """Whether pairs of links that urdd finds in contact are so within the band: not in contact in MuJoCo's depth."""
    return urdd.depth(q, pair) <= BAND


def by_yourdfpy(urdd, folder):
    difference = urdd.difference(Yourdfpy(urdd, folder / "robot.urdf"))
    return {"poses": difference, "failed": difference > POSE_TOLERANCE}


def by_sdf(urdd, folder):
    said = by_drake(urdd, folder, "sdf")
    if program := os.environ.get("SDF_LOAD"):
        done = subprocess.run([program, str(folder / "drake.sdf")], capture_output=True, text=True)
        links = [json.loads(line) for line in done.stdout.splitlines()]
        names = [name for name in urdd.names if name != "world"]
        said["libsdformat"] = {"status": done.returncode, "collisions": sum(link["collisions"] for link in links)}
        if [link["link"] for link in links][: len(names)] != names or done.returncode:
            said["failed"] = True
        # libsdformat 12 knows no mimics: all joints are at 0. Drake's poses are those of all configurations.
        kept = [mass for name, mass in masses_of(urdd) if name != "world"]
        light = sum(mass <= 0 for mass in kept) + len(links) - len(names)
        masses, kept = sum(link["mass"] for link in links) - LEAST * light, sum(mass for mass in kept if mass > 0)
        said["libsdformat"]["mass"] = masses
        said["failed"] |= abs(masses - kept) > 1e-9 * max(1.0, kept)
    return said


# Mass that SDF has for a link without one, kg.
LEAST = 1e-6


def masses_of(urdd):
    for link in urdd.links:
        yield link["name"], ((link["inertial"] or {}).get("mass") or {}).get("value", 0.0)


def by_drake(urdd, folder, form="urdf"):
    file = folder / f"drake.{form}"
    text = urdd.export("drake" if form == "urdf" else form, file)
    names = named(text)
    loaded = Drake(urdd, file)
    plant, context, model = loaded.plant, loaded.context, loaded.model
    at_root = loaded.scene.GetMyContextFromRoot(loaded.context_of_all)
    inspector = loaded.scene.model_inspector()
    difference = urdd.difference(loaded)
    total = plant.CalcTotalMass(context, [model])
    kept = sum(
        link["inertial"]["mass"]["value"]
        for link in urdd.links
        if link["name"] == "world" and link["inertial"] and link["inertial"]["mass"]
    )
    name_of = lambda geometry: plant.GetBodyFromFrameId(inspector.GetFrameId(geometry)).name()
    candidates = {tuple(sorted((name_of(a), name_of(b)))) for a, b in inspector.GetCollisionCandidates()}
    missed, more, lost, seen = set(), set(), 0, 0
    for q, expected in urdd.collisions(CONFIGURATIONS // 2):
        loaded.place(urdd.values(q))
        query = loaded.scene.get_query_output_port().Eval(at_root)
        found = {}
        for pair in query.ComputePointPairPenetration():
            key = tuple(sorted((name_of(pair.id_A), name_of(pair.id_B))))
            found[key] = max(found.get(key, 0.0), pair.depth)
        links_expected = of_links(expected)
        seen += len(links_expected)
        lost += len({pair for pair in links_expected - found.keys() if pair in names})
        # Drake itself leaves out links that a joint connects, and links that never move against each other.
        own = lambda pair: pair not in candidates and pair not in names and is_adjacent(urdd, pair)
        absent, besides = judged(found.keys(), found.get, links_expected, names, own)
        missed |= {pair for pair in absent if not grazes(urdd, q, pair)}
        more |= besides
    said = {
        "poses": difference,
        "mass": float(total),
        "contacts": seen,
        "lost": lost,
        "named": len(names),
        "missed": sorted(missed),
        "more": sorted(more),
    }
    # SDF gives LEAST to links without mass, and to those between the parts of joints.
    light = LEAST * plant.num_bodies() if form == "sdf" else 0.0
    wrong_mass = abs(total - (urdd.mass - kept)) > 1e-9 * max(1.0, urdd.mass) + light
    said["failed"] = bool(difference > POSE_TOLERANCE or missed or more or wrong_mass)
    return said


def is_adjacent(urdd, pair):
    rigid = urdd_rigid(urdd)
    ends = {rigid[pair[0]], rigid[pair[1]]}
    joined = [{rigid[joint["parent"]["link"]], rigid[joint["child"]["link"]]} for joint in urdd.joints]
    return len(ends) == 1 or ends in joined


def depths(urdd, folder):
    """A function of a configuration and two links: how deep MuJoCo finds their pieces in each other, m."""
    loaded = Mujoco(urdd, folder / "mujoco.xml")
    model, data = loaded.model, loaded.data
    geoms = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_GEOM, geom) for geom in range(model.ngeom)]
    by_link = {}
    for geom, name in enumerate(geoms):
        if name and "/" in name:
            by_link.setdefault(tuple_of(name)[0], []).append(geom)

    def depth(q, pair):
        loaded.place(urdd.values(q))
        a, b = (by_link[name] for name in pair)
        return -min(mujoco.mj_geomDistance(model, data, i, j, 1.0, None) for i in a for j in b)

    return depth


def machine_name():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()


def machine():
    commit = subprocess.run(["git", "rev-parse", "HEAD"], capture_output=True, text=True).stdout.strip()
    dirty = subprocess.run(["git", "status", "--porcelain", "src"], capture_output=True, text=True).stdout.strip()
    from importlib.metadata import version

    return {
        "machine": machine_name(),
        "cores": os.cpu_count(),
        "load": os.getloadavg()[0],
        "commit": commit + ("+" if dirty else ""),
        "programs": {name: version(name) for name in ("mujoco", "pin", "drake", "yourdfpy")},
        "configurations": CONFIGURATIONS,
        "band_m": BAND,
    }


def main():
    program, *paths = sys.argv[1:]
    out = None
    if "--json" in paths:
        at = paths.index("--json")
        out = pathlib.Path(paths[at + 1])
        del paths[at : at + 2]
    results = {"run": machine(), "robots": {}}
    failed = False
    for path in paths:
        urdd = Urdd(program, path)
        said = {}
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for name, ask in (
                ("mujoco", by_mujoco),
                ("pinocchio", by_pinocchio),
                ("yourdfpy", by_yourdfpy),
                ("drake", by_drake),
                ("sdf", by_sdf),
            ):
                try:
                    said[name] = ask(urdd, folder)
                except (ValueError, RuntimeError, KeyError, NotComparable) as error:
                    said[name] = {"refused": str(error).splitlines()[0].replace(f"{folder}/", "")}
                if name == "mujoco" and "refused" not in said[name]:
                    urdd.depth = depths(urdd, folder)
                print(urdd.root.name, name, json.dumps(said[name]), flush=True)
                failed |= said[name].get("failed", name in ("mujoco", "drake") or not urdd.kinds & {"Planar", "Floating", "Spherical"})
        results["robots"][urdd.root.name] = said
    if out:
        out.write_text(json.dumps(results, indent=1) + "\n")
    sys.exit(failed)


if __name__ == "__main__":
    main()
