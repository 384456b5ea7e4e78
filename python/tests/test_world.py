"""Obstacles: distances by closed forms and by Coal, and common mistakes."""

from __future__ import annotations

import multiprocessing
import pickle
import signal
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from typing import Any

import numpy as np
import pytest

import urdd

#: A pose that is turned about all axes.
TILTED = np.array(
    [
        [0.36, 0.48, -0.8, 0.3],
        [-0.8, 0.6, 0.0, -0.2],
        [0.48, 0.64, 0.6, 0.5],
        [0.0, 0.0, 0.0, 1.0],
    ]
)


def spheres_of(robot: urdd.Robot, q: Any) -> tuple[Any, Any]:
    """The centres (n, spheres, 3) and the radii of the links' spheres, by numpy."""
    spheres = robot.spheres("hulls")
    frames = robot.link_poses(q)[:, [robot.link(link) for link in spheres.links]]
    centres = np.einsum("nsij,sj->nsi", frames[..., :3, :3], spheres.centres) + frames[..., :3, 3]
    return centres, spheres.radii


def to_box(points: Any, half: Any) -> Any:
    return np.linalg.norm(np.maximum(np.abs(points) - half, 0.0), axis=-1)


def to_line(points: Any, half: float) -> Any:
    nearest = points.copy()
    nearest[..., :2] = 0.0
    nearest[..., 2] = np.clip(nearest[..., 2], -half, half)
    return np.linalg.norm(points - nearest, axis=-1)


def test_spheres_are_as_far_from_obstacles_as_closed_forms_say(arm: urdd.Robot) -> None:
    world = urdd.World()
    world.add_sphere("ball", 0.2, [0.5, 0.1, 0.9])
    world.add_box("box", [0.2, 0.6, 0.4], TILTED)
    world.add_capsule("rod", 0.05, 0.8, TILTED)
    world.add_hull("point", [[0.0, 0.0, 0.0]], [1.0, 1.0, 1.0])
    around = arm.world_proximity(world, "spheres")
    q = arm.random(50)
    centres, radii = spheres_of(arm, q)
    inside = (centres - TILTED[:3, 3]) @ TILTED[:3, :3]
    apart = np.stack(
        [
            np.linalg.norm(centres - [0.5, 0.1, 0.9], axis=-1) - 0.2,
            to_box(inside, [0.1, 0.3, 0.2]),
            to_line(inside, 0.4) - 0.05,
            np.linalg.norm(centres - 1.0, axis=-1),
        ],
        axis=-1,
    )
    expected = np.maximum(apart - radii[:, None], 0.0)
    assert (expected == 0).any()
    assert (expected > 0).any()
    found = around.distances(q)
    assert found.shape == (50, around.num_pairs) == (50, 4 * len(radii))
    np.testing.assert_allclose(found, expected.reshape(50, -1), atol=1e-9)
    links = arm.spheres("hulls").links
    pairs = [(link, 0, obstacle) for link in links for obstacle in ("ball", "box", "rod", "point")]
    assert [(pair.link, pair.piece, pair.obstacle) for pair in around.pairs] == pairs
    np.testing.assert_array_equal(around.min_distance(q), found.min(axis=1))
    np.testing.assert_array_equal(around.in_collision(q), (found <= 0).any(axis=1))


@pytest.mark.parametrize("kind", ["hulls", "pieces", "piece-boxes"])
def test_coal_finds_the_same_distances(kind: urdd.ShapeKind, urdds: Any) -> None:
    robot = urdd.load(urdds / "quadruped")
    pin: Any = import_module("pinocchio")
    coal: Any = import_module("coal")
    points = np.random.default_rng(3).normal(size=(30, 3)) * 0.1
    world = urdd.World()
    world.add_box("box", [0.2, 0.6, 0.4], TILTED)
    world.add_sphere("ball", 0.2, TILTED[:3, 3])
    world.add_capsule("rod", 0.05, 0.8, TILTED)
    world.add_cylinder("drum", 0.2, 0.3, TILTED)
    world.add_hull("rock", points, TILTED)
    corners = coal.StdVec_Vec3s()
    corners.extend(list(points))
    bodies = [
        coal.Box(0.2, 0.6, 0.4),
        coal.Sphere(0.2),
        coal.Capsule(0.05, 0.8),
        coal.Cylinder(0.2, 0.3),
        coal.ConvexBase.convexHull(corners, False, ""),
    ]
    peer = robot.to_pinocchio(kind)
    data, geometry = peer.model.createData(), pin.GeometryData(peer.collision_model)
    around = robot.world_proximity(world, kind)
    names = {one.name: number for number, one in enumerate(peer.collision_model.geometryObjects)}
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    place = coal.Transform3s(TILTED[:3, :3], TILTED[:3, 3])
    for q in robot.random(5, seed=2):
        pin.updateGeometryPlacements(peer.model, data, peer.collision_model, geometry, peer.q(q))
        for pair, found in zip(around.pairs, around.distances(q), strict=True):
            number = names[f"{pair.link}/{pair.piece}"]
            at = geometry.oMg[number]
            result.clear()
            body = bodies[world.names.index(pair.obstacle)]
            shape = peer.collision_model.geometryObjects[number].geometry
            apart = coal.distance(shape, coal.Transform3s(at.rotation, at.translation), body, place, request, result)
            # The cylinder is represented by a prism around it, which is larger by 0.13 % of the radius.
            larger = 0.2 * (1 / np.cos(np.pi / 64) - 1) if pair.obstacle == "drum" else 0.0
            assert max(apart, 0.0) - larger - 1e-6 <= found <= max(apart, 0.0) + 1e-6, pair


def test_one_configuration_and_many_give_the_same(arm: urdd.Robot) -> None:
    world = urdd.World()
    world.add_box("box", [0.2, 0.6, 0.4], TILTED)
    world.add_sphere("ball", 0.2, [0.5, 0.1, 0.9])
    around = arm.world_proximity(world)
    q = arm.random(30)
    distances = around.distances(q)
    assert around.distances(q.reshape(5, 6, -1)).shape == (5, 6, around.num_pairs)
    for k in (0, 11, 29):
        np.testing.assert_array_equal(around.distances(q[k]), distances[k])
        assert around.min_distance(q[k]) == distances[k].min()
        assert around.in_collision(q[k]) == (distances[k] <= 0).any()
        nearest = around.nearest(q[k], 5)
        np.testing.assert_allclose([pair.distance for pair in nearest], np.sort(distances[k])[:5], atol=1e-12)
        for pair in nearest:
            apart = np.linalg.norm(pair.points[0] - pair.points[1])
            assert apart == pytest.approx(pair.distance, abs=1e-9)
    assert around.distances(q[:0]).shape == (0, around.num_pairs)


def test_points_are_on_the_bodies(arm: urdd.Robot) -> None:
    world = urdd.World()
    world.add_box("box", [0.2, 0.6, 0.4], TILTED)
    q = arm.random(seed=5)
    seen = 0
    for pair in arm.world_proximity(world, "spheres").nearest(q, 4):
        if pair.distance == 0:
            continue
        seen += 1
        inside = (pair.points[1] - TILTED[:3, 3]) @ TILTED[:3, :3]
        np.testing.assert_allclose(to_box(inside, [0.1, 0.3, 0.2]), 0.0, atol=1e-9)
        assert np.abs(np.abs(inside) - [0.1, 0.3, 0.2]).min() < 1e-9
        spheres = arm.spheres("hulls")
        k = spheres.links.index(pair.link)
        centre = (arm.link_pose(q, pair.link) @ [*spheres.centres[k], 1.0])[:3]
        assert np.linalg.norm(pair.points[0] - centre) == pytest.approx(spheres.radii[k], abs=1e-9)
    assert seen > 0


def test_a_mesh_keeps_its_notch(arm: urdd.Robot) -> None:
    trimesh: Any = import_module("trimesh")
    # Two walls at a right angle, as one mesh: the space between them is free.
    floor = trimesh.creation.box([2.0, 1.0, 0.1])
    floor.apply_translation([0.0, 0.0, 0.05])
    wall = trimesh.creation.box([0.1, 1.0, 2.0])
    wall.apply_translation([-0.95, 0.0, 1.1])
    both = trimesh.util.concatenate([floor, wall])
    center = [2.0, 2.0, 0.0]
    walls, hull, solid = urdd.World(), urdd.World(), urdd.World()
    walls.add_mesh("angle", both.vertices, both.faces, center)
    hull.add_hull("angle", both.vertices, center)
    solid.add_box("floor", [2.0, 1.0, 0.1], [2.0, 2.0, 0.05])
    solid.add_box("wall", [0.1, 1.0, 2.0], [1.05, 2.0, 1.1])
    assert walls.num_parts("angle") >= 2
    q = arm.random(20)
    found, filled = arm.world_proximity(walls).min_distance(q), arm.world_proximity(hull).min_distance(q)
    np.testing.assert_allclose(found, arm.world_proximity(solid).min_distance(q), atol=1e-6)
    assert (filled <= found + 1e-9).all()
    # One distance for each shape and obstacle, however many pieces the mesh has.
    around = arm.world_proximity(walls)
    assert around.num_pairs == len(arm.pieces())
    np.testing.assert_array_equal(around.distances(q).min(axis=1), found)


def test_links_may_be_ignored(arm: urdd.Robot) -> None:
    size, place = [3.0, 3.0, 0.2], [0.0, 0.0, -0.05]
    q = arm.random(40)
    world = urdd.World()
    world.add_box("table", size, place)
    assert arm.world_proximity(world).in_collision(q).all()
    free = urdd.World()
    free.add_box("table", size, place, ignore=["base"])
    around = arm.world_proximity(free)
    assert "base" not in {pair.link for pair in around.pairs}
    kept = [k for k, pair in enumerate(arm.world_proximity(world).pairs) if pair.link != "base"]
    np.testing.assert_array_equal(around.distances(q), arm.world_proximity(world).distances(q)[:, kept])
    free.remove("table")
    free.add_box("table", size, place, ignore=["bse"])
    with pytest.raises(urdd.UnknownNameError, match="did you mean `base`"):
        arm.world_proximity(free)


def test_a_world_is_a_collection(arm: urdd.Robot) -> None:
    world = urdd.World()
    assert len(world) == 0
    assert repr(world) == "<urdd.World: empty>"
    empty = arm.world_proximity(world)
    assert empty.distances(arm.random(3)).shape == (3, 0)
    assert empty.min_distance(arm.random(3)).tolist() == [float("inf")] * 3
    assert empty.in_collision(arm.random(3)).tolist() == [False] * 3
    assert empty.nearest(arm.zero, 2) == []
    world.add_sphere("a", 0.1)
    world.add_cylinder("b", 0.1, 1.0, TILTED, ignore=["base"])
    assert list(world) == ["a", "b"]
    assert "b" in world
    assert "c" not in world
    assert repr(world) == "<urdd.World: a (sphere), b (cylinder)>"
    before = arm.world_proximity(world)
    again: urdd.World = pickle.loads(pickle.dumps(world))
    q = arm.random(10)
    np.testing.assert_array_equal(arm.world_proximity(again).distances(q), before.distances(q))
    assert arm.world_proximity(again).pairs == before.pairs
    world.remove("a")
    assert world.names == ("b",)
    # Prepared data remains unchanged, also when it is pickled.
    assert before.obstacle_names == ("a", "b")
    same: urdd.WorldProximity = pickle.loads(pickle.dumps(before))
    assert (same.kind, same.obstacle_names, same.pairs) == (before.kind, before.obstacle_names, before.pairs)
    np.testing.assert_array_equal(same.distances(q), before.distances(q))
    assert repr(before) == f"<urdd.WorldProximity: pieces and 2 obstacles, {before.num_pairs} pairs>"
    with pytest.raises(KeyError):
        world.remove("a")
    with pytest.raises(ValueError, match="an obstacle `b` already"):
        world.add_sphere("b", 1.0)


def test_a_robot_without_dofs_among_obstacles(urdds: Any) -> None:
    robot = urdd.load(urdds / "single_link")
    world = urdd.World()
    world.add_sphere("ball", 0.1, [3.0, 0.0, 0.0])
    found = robot.world_proximity(world, "hulls").min_distance(np.zeros((4, 0)))
    assert found.shape == (4,)
    assert (found == found[0]).all()
    assert 0 < found[0] < 3


NAN = float("nan")


@pytest.mark.parametrize(
    ("method", "arguments", "words"),
    [
        ("add_box", ([1, 1],), r"size must be 3 finite numbers, not an array of the shape \(2,\)"),
        ("add_box", ([1, NAN, 1],), "size must be 3 finite numbers"),
        ("add_box", ([1, -1, 1],), "half extent or radius is -0.5; give one from 0"),
        ("add_box", ([1, 1, 1], np.eye(3)), r"a pose must have the shape \(4, 4\) or \(3,\), not \(3, 3\)"),
        ("add_box", ([1, 1, 1], 2 * np.eye(4)), "a pose is not a pose"),
        ("add_box", ([1, 1, 1], np.diag([1.0, 1.0, -1.0, 1.0])), "a pose is not a pose"),
        ("add_box", ([1, 1, 1], [0, NAN, 0]), "a pose is not finite"),
        ("add_box", (["a", "b", "c"],), "array of numbers"),
        ("add_sphere", (-1,), "half extent or radius"),
        ("add_sphere", (NAN,), "half extent or radius"),
        ("add_sphere", (float("inf"),), "half extent or radius"),
        ("add_sphere", (1e12,), "half extent or radius"),
        ("add_sphere", (1, [0, 0]), "centre must be 3"),
        ("add_capsule", (0.1, -1), "half extent or radius"),
        ("add_cylinder", (NAN, 1), "half extent or radius"),
        ("add_hull", ([],), r"points must have the shape \(n, 3\), not \(0,\)"),
        ("add_hull", (np.zeros((0, 3)),), "no vertices"),
        ("add_hull", ([[0, 0, NAN]],), "finite"),
        ("add_hull", ([[0, 0]],), r"\(1, 2\)"),
        ("add_mesh", (np.eye(3), [[0, 1, 3]]), "a face has a vertex index that is out of range"),
        ("add_mesh", (np.eye(3), [[0, 1, -1]]), "a face has a vertex index that is out of range"),
        ("add_mesh", (np.eye(3), [[0, 1]]), "faces must be whole numbers"),
        ("add_mesh", (np.eye(3), [[0.0, 1.0, 2.0]]), "faces must be whole numbers"),
        ("add_mesh", (np.eye(2), [[0, 1, 1]]), r"vertices must have the shape \(n, 3\)"),
    ],
)
def test_no_obstacles(method: str, arguments: tuple[Any, ...], words: str) -> None:
    world = urdd.World()
    with pytest.raises(urdd.ObstacleError, match=rf"obstacle `thing`: .*{words}") as caught:
        getattr(world, method)("thing", *arguments)
    assert caught.value.name == "thing"
    assert len(world) == 0
    copy: urdd.ObstacleError = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.name) == (str(caught.value), "thing")


def test_every_kind_of_array_makes_an_obstacle(arm: urdd.Robot) -> None:
    q = arm.random(5)
    points = np.random.default_rng(1).normal(size=(20, 3)).astype(np.float32)
    read_only = points.copy()
    read_only.flags.writeable = False
    wide = np.zeros((20, 6), dtype=np.float32)
    wide[:, ::2] = points
    expected = None
    for same in (points, points.astype(float), read_only, wide[:, ::2], np.asfortranarray(points), points.tolist()):
        world = urdd.World()
        world.add_hull("rock", same, TILTED.tolist())
        found = arm.world_proximity(world).distances(q)
        expected = found if expected is None else expected
        np.testing.assert_array_equal(found, expected)
    # It is copied: later changes of the array have no effect.
    mine = points.astype(float)
    world = urdd.World()
    world.add_hull("rock", mine, TILTED)
    mine += 9.0
    np.testing.assert_array_equal(arm.world_proximity(pickle.loads(pickle.dumps(world))).distances(q), expected)


@pytest.mark.parametrize(
    ("q", "words"),
    [
        ([0.0] * 5, r"shape must be \(6,\) or \(n, 6\), not \(5,\)"),
        ([0, 0, 0, 0, 0, NAN], "is nan: every value must be finite"),
        (np.zeros(6, dtype=complex), "not of complex128"),
        (None, "array of numbers"),
    ],
)
def test_no_configurations_among_obstacles(q: Any, words: str, arm: urdd.Robot) -> None:
    world = urdd.World()
    world.add_sphere("ball", 0.1)
    around = arm.world_proximity(world)
    for ask in (around.distances, around.min_distance, around.in_collision, around.nearest):
        with pytest.raises(urdd.ConfigurationError, match=words):
            ask(q)
    with pytest.raises(urdd.ConfigurationError, match="one configuration"):
        around.nearest(arm.random(2))
    with pytest.raises(ValueError, match="not be negative"):
        around.nearest(arm.zero, -1)
    with pytest.raises(urdd.UnknownNameError, match="kind of shapes"):
        arm.world_proximity(world, "cubes")  # type: ignore[arg-type]


def _crowd() -> urdd.World:
    world = urdd.World()
    for k in range(10):
        world.add_sphere(f"ball {k}", 0.1, [0.3 * k, 1.0, 1.0])
    return world


def test_control_c_in_a_batch_among_obstacles(arm: urdd.Robot) -> None:
    around = arm.world_proximity(_crowd())
    q = np.tile(arm.random(1000), (200, 1))
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):  # noqa: PT012
        for _ in range(100):
            around.distances(q)
    timer.join()
    assert time.monotonic() - begin < 30
    assert around.min_distance(q[0]) > 0


def test_threads_ask_among_obstacles(arm: urdd.Robot) -> None:
    around = arm.world_proximity(_crowd())
    q = arm.random(200)
    expected = around.distances(q)
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(around.distances, [q] * 8):
            np.testing.assert_array_equal(found, expected)


def _in_child(around: urdd.WorldProximity, q: Any, queue: multiprocessing.Queue[float]) -> None:
    queue.put(float(around.distances(q).sum()))


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_fork_works_on_among_obstacles(arm: urdd.Robot) -> None:
    around = arm.world_proximity(_crowd())
    q = arm.random(100)
    context = multiprocessing.get_context("fork")
    queue: multiprocessing.Queue[float] = context.Queue()
    expected = float(around.distances(q).sum())
    process = context.Process(target=_in_child, args=(around, q, queue))
    process.start()
    assert queue.get(timeout=60) == expected
    process.join(60)
    assert process.exitcode == 0
