"""Distances and collisions by Pinocchio with coal, on the hulls, pieces, pairs and configurations of a URDD.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install pin
    /tmp/peers/bin/python benches/proximity_coal.py [--configurations 200] target/release/urdd URDD...

`example-robot-data:NAME` in the place of a URDD stands for one that is made of `NAME.urdf` of that package (`pip install
example-robot-data`), such as `example-robot-data:panda`.

Each configuration is one of SPEC 9.2. First the distances of all pairs are compared with those of
`urdd check-collisions` (to 1e-6 m), then the answers yes or no; then the processor's time is measured, one thread: the
median of five rounds, in microseconds for a configuration, without what Python itself takes for an empty loop.
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile
import time

import coal
import numpy
import pinocchio

ROUNDS = 5
HULLS = ("hulls", "mesh_modules/convex_hull_meshes_module/module.json", "full_convex_hulls_skips")
PIECES = (
    "pieces",
    "mesh_modules/convex_decomposition_meshes_module/module.json",
    "decomposition_convex_hulls_skips",
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("urdds", nargs="+")
    parser.add_argument("--configurations", type=int, default=200)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for urdd in given.urdds:
            robot = Robot(made(given.program, urdd, folder))
            for kind in (HULLS, PIECES):
                compare(given.program, robot, given.configurations, *kind)


EXAMPLE = "example-robot-data:"


def made(program: str, urdd: str, folder: str) -> str:
    """The path of a URDD, which is made first where it is of a robot of example-robot-data."""
    if not urdd.startswith(EXAMPLE):
        return urdd
    name = urdd.removeprefix(EXAMPLE)
    prefix = next(p for p in pathlib.Path(pinocchio.__file__).parents if p.name == "cmeel.prefix")
    share = prefix / "share" / "example-robot-data"
    (urdf,) = (share / "robots").rglob(f"{name}.urdf")
    target = os.path.join(folder, name)
    package = f"example-robot-data={share}"
    command = [program, "generate", str(urdf), "-o", target, "--package", package]
    subprocess.run(command, check=True, capture_output=True)
    return target


class Robot:
    """A URDD, and the model that Pinocchio makes of its URDF."""

    def __init__(self, root: str) -> None:
        self.root = root
        urdf = self.module("urdd.json")["source"]["Urdf"]["path"]
        self.model = pinocchio.buildModelFromUrdf(os.path.join(root, urdf))
        self.chain = self.module("chain_module/module.json")
        self.dof = self.module("dof_module/module.json")
        self.links = [link["name"] for link in self.chain["links_in_chain"]]

    def module(self, path: str):
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            return json.load(file)

    def configuration(self, values):
        """A configuration of ours in Pinocchio's order; joints of one degree of freedom only."""
        q = pinocchio.neutral(self.model)
        for index, joint in enumerate(self.chain["joints_in_chain"]):
            number = self.model.getJointId(joint["joint_name"])
            dofs = self.dof["joint_idx_to_dof_idxs_mapping"][index]
            mimic = self.dof["joint_idx_to_mimic_mapping"][index]
            if number >= self.model.njoints or not (dofs or mimic):
                continue
            if mimic:
                driver = mimic["dof_idx"]
                value = 0.0 if driver is None else values[driver] * mimic["multiplier"]
                value += mimic["offset"]
            else:
                (dof,) = dofs
                value = values[dof]
            at = self.model.joints[number].idx_q
            if self.model.joints[number].nq == 2:
                q[at], q[at + 1] = numpy.cos(value), numpy.sin(value)
            else:
                q[at] = value
        return q

    def geometry(self, module: str, skips: str):
        """The shapes of a kind, with the pairs that are not skipped."""
        lists = self.module(module)
        if "link_hulls" in lists:
            files = [(link, 0, one) for link, one in enumerate(lists["link_hulls"]) if one]
        else:
            files = [
                (link, piece, one)
                for link, pieces in enumerate(lists["link_pieces"])
                for piece, one in enumerate(pieces)
            ]
        geometry = pinocchio.GeometryModel()
        for link, piece, file in files:
            mesh = coal.MeshLoader().load(os.path.join(self.root, file["stl"]), numpy.ones(3))
            mesh.buildConvexHull(True, "Qt")
            number = self.model.getFrameId(self.links[link])
            frame = self.model.frames[number]
            name = f"{self.links[link]}[{piece}]"
            shape = pinocchio.GeometryObject(
                name, frame.parentJoint, number, frame.placement, mesh.convex
            )
            geometry.addGeometryObject(shape)
        matrix = self.module("link_shapes_modules/link_shapes_skips_module/module.json")[skips]
        for a, (link_a, _, _) in enumerate(files):
            for b in range(a + 1, len(files)):
                if link_a != files[b][0] and not matrix[a][b]:
                    geometry.addCollisionPair(pinocchio.CollisionPair(a, b))
        return geometry


def ask(program: str, robot: Robot, count: int, kind: str, pairs: int):
    command = [program, "check-collisions", robot.root, "--random", str(count)]
    command += ["--shapes", kind, "--format", "json", "--nearest", str(pairs)]
    output = subprocess.run(command, check=False, capture_output=True, text=True).stdout
    return [json.loads(line) for line in output.splitlines()]


def compare(
    program: str, robot: Robot, count: int, kind: str, module: str, skips: str
) -> None:
    geometry = robot.geometry(module, skips)
    pairs = len(geometry.collisionPairs)
    model, data, found = robot.model, robot.model.createData(), geometry.createData()
    ours = ask(program, robot, count, kind, pairs)
    all_q = [robot.configuration(one["values"]) for one in ours]
    names = [shape.name for shape in geometry.geometryObjects]
    exact = geometry.createData()
    for request in exact.distanceRequests:
        request.gjk_tolerance = 1e-9  # of itself 1e-6, by which times are measured
    worst, collisions = 0.0, 0
    for one, q in zip(ours, all_q):
        pinocchio.computeDistances(model, data, geometry, exact, q)
        theirs = {}
        for pair, result in zip(geometry.collisionPairs, exact.distanceResults):
            theirs[names[pair.first], names[pair.second]] = max(result.min_distance, 0.0)
        assert len(one["nearest"]) == len(theirs)
        for pair in one["nearest"]:
            a, b = (f"{name}[{piece}]" for name, piece in zip(pair["links"], pair["pieces"]))
            worst = max(worst, abs(pair["distance"] - theirs[a, b]))
        collides = pinocchio.computeCollisions(model, data, geometry, found, q, True)
        assert collides == one["in_collision"], (one["configuration"], collides)
        collisions += collides
    assert worst < 1e-6, worst

    broad = pinocchio.BroadPhaseManager_DynamicAABBTreeCollisionManager(model, geometry, found)

    def distances(q):
        pinocchio.computeDistances(model, data, geometry, found, q)

    def collide(q):
        pinocchio.computeCollisions(model, data, geometry, found, q, True)

    def collide_by_tree(q):
        pinocchio.updateGeometryPlacements(model, data, geometry, found, q)
        pinocchio.computeCollisions(model, data, broad, q, True)

    print(
        f"{os.path.basename(robot.root)}, {kind}: {pairs} pairs, distances within {worst:.1e} m, "
        f"{collisions} of {len(all_q)} collide, as with us"
    )
    for what, run in (
        ("distances", distances),
        ("collision", collide),
        ("collision, broad phase", collide_by_tree),
    ):
        print(f"  {what:<24} {timed(run, all_q):9.2f} us")


def timed(run, all_q) -> float:
    def once(run) -> float:
        start = time.process_time()
        for q in all_q:
            run(q)
        return time.process_time() - start

    times = sorted(once(run) - once(lambda q: None) for _ in range(ROUNDS))
    return times[ROUNDS // 2] / len(all_q) * 1e6


if __name__ == "__main__":
    main()
