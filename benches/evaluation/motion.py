# ruff: noqa: E402
"""What planners ask, beside Pinocchio with coal, MuJoCo, and OMPL with coal: margins, gradients, edges, plans.

    python benches/evaluation/motion.py --robots FOLDER [--configurations 500] [--queries 20]

UR5 and H1 are the paper's, Panda is that of the package `example-robot-data`. Needs the packages urdd (a release wheel
of these sources), pin, mujoco and ompl. For each robot a URDD is made, and all ask the same of its convex pieces and its
pairs that are not skipped, in Python, on one thread; times are those of the processor, the median of five rounds. Single
questions are asked in a loop, of which the empty loop is taken off; `batch` is one call for all.

- A margin: is any pair within 2 cm? Coal by its broad phase with a security margin, MuJoCo by geoms with that margin.
- Gradients of the 8 nearest pairs: coal's distances of all pairs, then Pinocchio's Jacobians at the closest points. They
  are held to ours, and coal's depths of overlaps to our penetrations.
- Depths: every pair that overlaps, coal's by its broad phase with contacts.
- Boxes: whether the robot touches any of 20 around it, which move before each question.
- An edge: a straight motion, sampled so that no link moves by more than 2 cm between two samples. Coal asks at the same
  samples.
- Inverse kinematics, of poses that random configurations have: any solution, one free of collision, the one nearest to a
  posture.
- A plan: RRT-Connect of `python/examples/rrt_connect.py` beside OMPL's with coal's answers, among a table and a ball.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import coal
import numpy as np
import pinocchio
import urdd
from robots import ROOT

sys.path[:0] = [str(ROOT / "benches"), str(ROOT / "python" / "examples")]
import proximity_coal
import rrt_connect
from results import Table, write

MARGIN = 0.02
NEAREST = 8
RESOLUTION = 0.02
ROUNDS = 5
BOXES = 20


def seconds(run: Callable[[], object]) -> float:
    times = []
    for _ in range(ROUNDS):
        start = time.process_time()
        run()
        times.append(time.process_time() - start)
    return statistics.median(times)


def each(ask: Callable[[Any], object], questions: list[Any]) -> float:
    """Microseconds for a question, in a loop."""

    def loop(ask: Callable[[Any], object]) -> None:
        for question in questions:
            ask(question)

    return (seconds(lambda: loop(ask)) - seconds(lambda: loop(lambda _: None))) / len(questions) * 1e6


class Coal:
    """The robot in Pinocchio with coal: pieces, and pairs that are not skipped."""

    def __init__(self, robot: urdd.Robot) -> None:
        peer = proximity_coal.Robot(str(robot.path))
        self.peer, self.model, self.data = peer, peer.model, peer.model.createData()
        self.geometry = peer.geometry(*proximity_coal.PIECES[1:])
        self.names = [shape.name for shape in self.geometry.geometryObjects]
        self.exact = self.geometry.createData()
        self.near = self.geometry.createData()
        for request in self.near.collisionRequests:
            request.security_margin = MARGIN
        # Links that are fixed to each other have no margin.
        for k, pair in enumerate(self.geometry.collisionPairs):
            joints = {self.geometry.geometryObjects[shape].parentJoint for shape in (pair.first, pair.second)}
            if len(joints) == 1:
                self.near.deactivateCollisionPair(k)
        self.tree = pinocchio.BroadPhaseManager_DynamicAABBTreeCollisionManager(self.model, self.geometry, self.near)
        self.overlapping = self.geometry.createData()
        for request in self.overlapping.collisionRequests:
            request.enable_contact = True
        self.overlaps = pinocchio.BroadPhaseManager_DynamicAABBTreeCollisionManager(
            self.model, self.geometry, self.overlapping
        )
        self.touch, self.broad = self.asked()

    def asked(self, is_around: bool = False) -> tuple[Any, Any]:
        """The pairs of the geometry as it is now, or of those only the ones with obstacles, and their broad phase."""
        touch = self.geometry.createData()
        for k, pair in enumerate(self.geometry.collisionPairs):
            if is_around and pair.second < len(self.names):
                touch.deactivateCollisionPair(k)
        return touch, pinocchio.BroadPhaseManager_DynamicAABBTreeCollisionManager(self.model, self.geometry, touch)

    def q(self, q: Any) -> Any:
        return self.peer.configuration(q)

    def is_within(self, q: Any) -> bool:
        pinocchio.updateGeometryPlacements(self.model, self.data, self.geometry, self.near, q)
        return pinocchio.computeCollisions(self.model, self.data, self.tree, q, True)

    def in_collision(self, q: Any) -> bool:
        pinocchio.updateGeometryPlacements(self.model, self.data, self.geometry, self.touch, q)
        return pinocchio.computeCollisions(self.model, self.data, self.broad, q, True)

    def add(self, shape: coal.CollisionGeometry, pose: Any, ignore: list[str]) -> int:
        """An obstacle, which all links may touch but those to ignore."""
        at = self.geometry.addGeometryObject(pinocchio.GeometryObject(f"obstacle {pose}", 0, pose, shape))
        for other, name in enumerate(self.names):
            if name.split("[")[0] not in ignore:
                self.geometry.addCollisionPair(pinocchio.CollisionPair(other, at))
        return at

    def around(self) -> None:
        """Takes the obstacles that were added, and leaves out the pairs of the robot itself."""
        self.touch, self.broad = self.asked(is_around=True)

    def penetrations(self, q: Any) -> None:
        pinocchio.updateGeometryPlacements(self.model, self.data, self.geometry, self.overlapping, q)
        pinocchio.computeCollisions(self.model, self.data, self.overlaps, q, False)

    def gradients(self, q: Any) -> list[tuple[float, str, str, Any]]:
        pinocchio.computeDistances(self.model, self.data, self.geometry, self.exact, q)
        pinocchio.computeJointJacobians(self.model, self.data, q)
        results = self.exact.distanceResults
        order = sorted(range(len(results)), key=lambda k: results[k].min_distance)[:NEAREST]
        found = []
        for k in order:
            result, pair = results[k], self.geometry.collisionPairs[k]
            points = [result.getNearestPoint1(), result.getNearestPoint2()]
            between = points[1] - points[0]
            rows = []
            for point, shape in zip(points, (pair.first, pair.second), strict=True):
                joint = self.geometry.geometryObjects[shape].parentJoint
                jacobian = pinocchio.getJointJacobian(
                    self.model, self.data, joint, pinocchio.ReferenceFrame.LOCAL_WORLD_ALIGNED
                )
                arm = point - self.data.oMi[joint].translation
                rows.append(jacobian[:3] - np.cross(arm, jacobian[3:], axisb=0).T)
            length = float(np.linalg.norm(between))
            gradient = between / max(length, 1e-12) @ (rows[1] - rows[0])
            found.append((result.min_distance, self.names[pair.first], self.names[pair.second], gradient))
        return found


def samples(robot: urdd.Robot, start: Any, end: Any) -> Any:
    """Configurations between which no link moves by more than the resolution."""
    for count in range(2, 10_000):
        q = start + np.linspace(0, 1, count)[:, None] * (end - start)
        steps = np.linalg.norm(np.diff(robot.link_poses(q)[:, :, :3, 3], axis=0), axis=2)
        if steps.max() <= RESOLUTION:
            return q
    raise AssertionError("an edge without end")


def of_robot(name: str, robot: urdd.Robot, count: int) -> tuple[list[list[str]], str]:
    urdd.set_num_threads(1)
    shapes, peer = robot.proximity("pieces"), Coal(robot)
    q = robot.random(count)
    theirs = [peer.q(row) for row in q]
    expected = shapes.is_within(q, MARGIN)
    clear = np.abs(shapes.self_distance(q) - MARGIN) > 1e-5
    wrong = sum(peer.is_within(own) != want for own, want, sure in zip(theirs, expected, clear, strict=True) if sure)
    assert wrong == 0, f"{name}: {wrong} margins differ from coal's"
    batch = seconds(lambda: shapes.is_within(q, MARGIN)) / count * 1e6
    rows = [
        [
            name,
            "margin of 2 cm",
            batch,
            each(lambda one: shapes.is_within(one, MARGIN), list(q)),
            each(peer.is_within, theirs),
        ]
    ]

    import mujoco

    loaded = robot.to_mujoco("pieces", visuals=False)
    model, data = loaded.model, mujoco.MjData(loaded.model)
    model.geom_margin[:] = MARGIN
    model.pair_margin[:] = MARGIN

    def by_mujoco(q: Any) -> bool:
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        return bool((data.contact.dist[: data.ncon] <= MARGIN).any())

    rows[0].append(each(by_mujoco, list(loaded.q(q))))
    alike = np.mean([by_mujoco(one) == want for one, want in zip(loaded.q(q), expected, strict=True)])

    moved = {name: k for k, name in enumerate(peer.model.names)}
    index = [peer.model.joints[moved[dof]].idx_v for dof in robot.dof_names]
    off = []
    for row, own in zip(q[:100], theirs, strict=False):
        found = shapes.gradients(row, NEAREST)
        ours = {
            tuple(f"{link}[{piece}]" for link, piece in zip(one.links, one.pieces, strict=True)): one for one in found
        }
        for distance, *pair, gradient in peer.gradients(own):
            one = ours.get(tuple(pair))
            if one is not None and one.gradient is not None and distance > 1e-3:
                off.append(np.abs(gradient[index] - one.gradient).max())
    depths: list[float] = []
    for row, own in zip(q[:100], theirs, strict=False):
        overlaps = shapes.penetrations(row)
        if not overlaps:
            continue
        pinocchio.computeDistances(peer.model, peer.data, peer.geometry, peer.exact, own)
        pairs = ((pair.first, pair.second) for pair in peer.geometry.collisionPairs)
        results = dict(zip(pairs, peer.exact.distanceResults, strict=True))
        for one in overlaps:
            places = zip(one.links, one.pieces, strict=True)
            pair = tuple(peer.names.index(f"{link}[{piece}]") for link, piece in places)
            depths.append(abs(one.depth + results[pair].min_distance))
    assert max(depths) < 2e-6, f"{name}: depths differ from coal's by {max(depths)} m"
    # Where two faces or edges are parallel, other points are as close, and the gradient is another one.
    alike_gradients = float(np.mean(np.array(off) < 1e-4))
    rows.append(
        [
            name,
            "gradients of 8 pairs",
            None,
            each(lambda one: shapes.gradients(one, NEAREST), list(q)),
            each(peer.gradients, theirs),
            None,
        ]
    )
    ask_depths = [each(shapes.penetrations, list(q)), each(peer.penetrations, theirs)]
    rows.append([name, "depths of overlaps", None, *ask_depths, None])

    random = np.random.default_rng(1)
    starts = q[: count // 5]
    ends = np.clip(starts + random.normal(size=starts.shape) * 0.3, *robot.bounds.T)
    between = [samples(robot, *edge) for edge in zip(starts, ends, strict=True)]
    ours_blocked = ~np.isnan(shapes.blocked_edge(starts, ends, resolution=RESOLUTION))

    def by_coal(edge: list[Any]) -> bool:
        return any(peer.in_collision(one) for one in edge)

    edges = [[peer.q(one) for one in edge] for edge in between]
    same = np.mean([by_coal(edge) == want for edge, want in zip(edges, ours_blocked, strict=True)])
    batch = seconds(lambda: shapes.blocked_edge(starts, ends, resolution=RESOLUTION)) / len(starts) * 1e6
    pairs = list(zip(starts, ends, strict=True))
    single = each(lambda edge: shapes.blocked_edge(*edge, resolution=RESOLUTION), pairs)
    rows.append([name, "edge at 2 cm", batch, single, each(by_coal, edges), None])
    agree = f"MuJoCo's margins agree in {alike:.1%}, coal's edges in {same:.1%}, gradients in {alike_gradients:.1%}"
    note = f"{name}: {agree}, depths of {len(depths)} overlaps within {max(depths):.0e} m"
    return [[*row[:2], *("-" if value is None else f"{value:.1f}" for value in row[2:])] for row in rows], note


def box_poses(time: float) -> Any:
    """The poses (20, 4, 4) of the boxes, about 0.9 m from the base."""
    poses = []
    for k in range(BOXES):
        phase = time + k
        pose = pinocchio.rpy.rpyToMatrix(0.3 * phase, phase, 0.7 * phase)
        place = np.array([0.9 * np.cos(phase), 0.9 * np.sin(phase), 0.05 * k])
        poses.append(pinocchio.SE3(pose, place).homogeneous)
    return np.array(poses)


def boxes(name: str, robot: urdd.Robot, count: int) -> tuple[list[str], str]:
    """Yes or no among boxes that move."""
    world, shapes, q = urdd.World(), robot.proximity("pieces"), robot.random(count)
    names = [f"box {k}" for k in range(BOXES)]
    for one, pose in zip(names, box_poses(0), strict=True):
        world.add_box(one, size=[0.1, 0.1, 0.1], pose=pose)
    peer = Coal(robot)
    moved = [peer.add(coal.Box(0.1, 0.1, 0.1), pinocchio.SE3(pose), []) for pose in box_poses(0)]
    peer.around()
    questions = [(box_poses(0.01 * k), row, peer.q(row)) for k, row in enumerate(q)]

    around = robot.world_proximity(world, shapes)

    def ours(question: Any) -> bool:
        poses, row, _ = question
        around.move(names, poses)
        return bool(around.in_collision(row))

    def by_coal(question: Any) -> bool:
        poses, _, row = question
        for at, pose in zip(moved, poses, strict=True):
            peer.geometry.geometryObjects[at].placement = pinocchio.SE3(pose)
        return peer.in_collision(row)

    same = np.mean([ours(one) == by_coal(one) for one in questions])
    still = robot.world_proximity(world, shapes)
    batch = seconds(lambda: still.in_collision(q)) / count * 1e6
    times = [batch, each(ours, questions), each(by_coal, questions)]
    note = f"{name}: coal's answers among boxes are the same in {same:.1%}"
    return [name, f"{BOXES} moving boxes", *(f"{one:.1f}" for one in times), "-"], note


def inverse(name: str, robot: urdd.Robot, count: int) -> list[str]:
    """Microseconds of inverse kinematics of the link that is last, in batches."""
    tip = max(robot.link_names, key=lambda link: len(robot.dofs_between(robot.root_link, link)))
    targets = robot.link_poses(robot.random(count, seed=3))[:, robot.link(tip)]
    shapes = robot.proximity("pieces")
    cells = [name, tip]
    for options in ({}, {"free_of": shapes}, {"posture": robot.middle}):
        solutions = robot.inverse_kinematics(tip, targets, **options)
        taken = seconds(lambda options=options: robot.inverse_kinematics(tip, targets, **options)) / count * 1e6
        cells.append(f"{taken:.0f} ({np.mean(solutions.reached):.1%})")
    return cells


def plans(name: str, robot: urdd.Robot, queries: int) -> list[str]:
    """Seconds for a plan, ours and OMPL's with coal."""
    from ompl import base, geometric

    world = urdd.World()
    still = [link for link in robot.link_names if len(robot.dofs_between(robot.root_link, link)) == 0]
    world.add_box("table", size=[2, 2, 0.1], pose=[0, 0, -0.05], ignore=still)
    world.add_sphere("ball", radius=0.15, centre=[0.45, 0.1, 0.6])
    checks = [(robot.proximity(), 0.0), (robot.world_proximity(world), 0.0)]
    peer = Coal(robot)
    at = [pinocchio.SE3(np.eye(3), np.array(place)) for place in ([0, 0, -0.05], [0.45, 0.1, 0.6])]
    peer.add(coal.Box(2, 2, 0.1), at[0], still)
    peer.add(coal.Sphere(0.15), at[1], [])
    peer.touch, peer.broad = peer.asked()
    space = base.RealVectorStateSpace(robot.num_dofs)
    bounds = base.RealVectorBounds(robot.num_dofs)
    for dof, (low, high) in enumerate(robot.bounds.tolist()):
        bounds.setLow(dof, low)
        bounds.setHigh(dof, high)
    space.setBounds(bounds)

    def is_valid(state: Any) -> bool:
        return not peer.in_collision(peer.q([state[k] for k in range(robot.num_dofs)]))

    def by_ompl(start: Any, goal: Any) -> bool:
        setup = geometric.SimpleSetup(space)
        setup.setStateValidityChecker(is_valid)
        # The same 2 cm of motion as a part of the space's size, for a turn of every DOF by 1 rad.
        reach = np.abs(robot.link_poses(robot.random(200))[:, :, :3, 3]).max()
        setup.getSpaceInformation().setStateValidityCheckingResolution(RESOLUTION / reach / space.getMaximumExtent())
        states = [space.allocState() for _ in range(2)]
        for state, q in zip(states, (start, goal), strict=True):
            for k, value in enumerate(q.tolist()):
                state[k] = value
        setup.setStartAndGoalStates(*states)
        planner = geometric.RRTConnect(setup.getSpaceInformation())
        planner.setRange(rrt_connect.STEP)
        setup.setPlanner(planner)
        return bool(setup.solve(60.0))

    # Neighbours are always near each other.
    (own, _), (around, _) = checks
    # Beyond half a turn, an elbow would have to pass through the upper arm: there is no way between.
    ends = robot.random(100_000)
    ends = ends[(np.abs(ends) <= np.pi).all(axis=1)]
    ends = ends[~(own.is_within(ends, 1e-4) | around.is_within(ends, MARGIN))][: 2 * queries]
    assert len(ends) == 2 * queries, f"{name}: too few free configurations"
    found: dict[str, list[float]] = {"ours": [], "ompl": []}
    for start, goal in zip(ends[::2], ends[1::2], strict=True):
        random = np.random.default_rng(0)
        begin = time.process_time()
        rrt_connect.plan(robot, checks, start, goal, random)
        found["ours"].append(time.process_time() - begin)
        begin = time.process_time()
        assert by_ompl(start, goal), f"{name}: OMPL found no plan"
        found["ompl"].append(time.process_time() - begin)
    return [name, *(f"{1000 * statistics.median(found[who]):.1f}" for who in ("ours", "ompl"))]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=Path, required=True, help="the folder that docs/evaluation.md describes")
    parser.add_argument("--configurations", type=int, default=500)
    parser.add_argument("--queries", type=int, default=20)
    given = parser.parse_args()
    prefix = next(path for path in Path(pinocchio.__file__).parents if path.name == "cmeel.prefix")
    share = prefix / "share" / "example-robot-data"
    sources = {
        "UR5": given.robots / "ur5" / "robot.urdf",
        "Panda": next(share.rglob("panda.urdf")),
        "H1": given.robots / "h1" / "robot.urdf",
    }
    rows: list[list[str]] = []
    planned: list[list[str]] = []
    reached: list[list[str]] = []
    notes: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        for name, source in sources.items():
            urdd.generate(source, Path(folder) / name, packages={"example-robot-data": share})
            robot = urdd.load(Path(folder) / name)
            found, note = of_robot(name, robot, given.configurations)
            moved, of_boxes = boxes(name, robot, given.configurations)
            rows += [*found, moved]
            notes += [note, of_boxes]
            reached.append(inverse(name, robot, given.configurations))
            print(*notes[-2:], *rows[-5:], reached[-1], sep="\n", flush=True)
            if name != "H1":
                planned.append(plans(name, robot, given.queries))
                print(planned[-1], flush=True)
    columns = ["robot", "question", "batch, µs", "single, µs", "by coal, µs", "by MuJoCo, µs"]
    items: dict[str, Table | str] = {
        "questions": {"columns": columns, "rows": rows},
        "inverse": {
            "columns": ["robot", "link", "any, µs (reached)", "free of collision", "nearest to a posture"],
            "rows": reached,
        },
        "plans": {"columns": ["robot", "ours, ms", "OMPL with coal, ms"], "rows": planned},
        "agree": "; ".join(notes),
    }
    peers = [
        f"{name} {importlib.metadata.version(package)}"
        for name, package in (("Pinocchio", "pin"), ("coal", "coal"), ("MuJoCo", "mujoco"), ("OMPL", "ompl"))
    ]
    write("motion", items, f"urdd {urdd.__version__}", *peers)


if __name__ == "__main__":
    main()
