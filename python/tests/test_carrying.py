"""Objects that links carry, and obstacles that move."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from numpy.typing import ArrayLike

import urdd


@pytest.fixture
def tool() -> urdd.World:
    tool = urdd.World()
    tool.add_box("brush", size=[0.1, 0.2, 0.04], pose=[0.05, 0, 0.1])
    return tool


def test_what_is_carried_is_as_far_as_an_obstacle_that_is_moved_along(arm: urdd.Robot, tool: urdd.World) -> None:
    carried = arm.proximity().attach("torch", tool)
    assert carried.num_pairs > arm.proximity().num_pairs
    own = {pair.links for pair in arm.proximity().pairs}
    assert all("brush" in pair.links for pair in carried.pairs if pair.links not in own)
    world = urdd.World()
    world.add_box("brush", size=[0.1, 0.2, 0.04], ignore=["torch"])
    in_torch = np.eye(4)
    in_torch[:3, 3] = [0.05, 0, 0.1]
    for q in arm.random(10, seed=1):
        world.move("brush", arm.link_pose(q, "torch") @ in_torch)
        expected = arm.world_proximity(world).nearest(q)[0]
        of_brush = [pair for pair in carried.nearest(q, carried.num_pairs) if "brush" in pair.links]
        assert of_brush[0].distance == pytest.approx(expected.distance, abs=2e-9)
        assert carried.self_distance(q) == min(arm.self_distance(q), of_brush[0].distance)
        assert carried.in_collision(q) == (arm.in_collision(q) or of_brush[0].distance == 0)


def test_obstacles_see_what_is_carried(arm: urdd.Robot, tool: urdd.World) -> None:
    shapes = arm.proximity().attach("torch", tool)
    world = urdd.World()
    world.add_sphere("ball", radius=0.05, centre=arm.link_pose(arm.zero, "torch")[:3, 3] + [0, 0, 0.5])
    around = arm.world_proximity(world, shapes)
    assert "brush" in {pair.link for pair in around.pairs}
    assert around.kind == "pieces"
    q = arm.zero
    found = around.gradients(q, around.num_pairs)
    assert [one.distance for one in found] == [one.distance for one in around.nearest(q, around.num_pairs)]
    step = 1e-6
    for one in found:
        assert one.gradient is not None
        for dof in range(arm.num_dofs):
            moved = np.tile(q, (2, 1))
            moved[:, dof] += [step, -step]
            which = next(k for k, pair in enumerate(around.pairs) if (pair.link, pair.piece) == (one.link, one.piece))
            more, less = around.distances(moved)[:, which]
            assert one.gradient[dof] == pytest.approx((more - less) / (2 * step), abs=1e-4)
    same: urdd.WorldProximity = pickle.loads(pickle.dumps(around))
    assert same.min_distance(q) == around.min_distance(q)
    world.remove("ball")
    world.add_sphere("ball", radius=9, ignore=[*arm.link_names, "brush"])
    assert arm.world_proximity(world, shapes).num_pairs == 0


def test_a_moved_obstacle_is_one_that_was_made_there(arm: urdd.Robot) -> None:
    pose = np.array([[0, -1, 0, 0.6], [1, 0, 0, 0.1], [0, 0, 1, 0.4], [0, 0, 0, 1.0]])
    q = arm.random(20, seed=3)

    def around(*, moved: bool) -> urdd.World:
        world = urdd.World()
        at = np.eye(4) if moved else pose
        world.add_box("box", [0.1, 0.2, 0.3], at)
        world.add_sphere("sphere", 0.1, at[:3, 3])
        world.add_capsule("capsule", 0.1, 0.3, at)
        world.add_cylinder("cylinder", 0.1, 0.3, at)
        world.add_hull("hull", np.diag([0.1, 0.2, 0.3]), at)
        world.add_mesh("mesh", np.eye(3), [[0, 1, 2]], at)
        if moved:
            for name in world.names:
                world.move(name, pose)
        return world

    made, moved = (arm.world_proximity(around(moved=moved)) for moved in (False, True))
    np.testing.assert_array_equal(moved.distances(q), made.distances(q))
    again: urdd.WorldProximity = pickle.loads(pickle.dumps(moved))
    np.testing.assert_array_equal(again.distances(q), made.distances(q))


def test_many_obstacles_move_at_once(arm: urdd.Robot) -> None:
    rng = np.random.default_rng(3)
    q = arm.random(10, seed=2)
    poses = np.tile(np.eye(4), (20, 1, 1))
    poses[:, :3, :3] = np.linalg.qr(rng.normal(size=(20, 3, 3)))[0]
    poses[:, :3, 0] *= np.linalg.det(poses[:, :3, :3])[:, np.newaxis]
    poses[:, :3, 3] = rng.uniform(-0.8, 0.8, (20, 3))

    def boxes(at: np.ndarray) -> urdd.World:
        world = urdd.World()
        for k in range(19):
            world.add_box(f"box_{k}", [0.1, 0.2, 0.05], at[k])
        world.add_sphere("ball", 0.1, at[19, :3, 3])
        return world

    made = arm.world_proximity(boxes(poses))
    world = boxes(np.tile(np.eye(4), (20, 1, 1)))
    before = arm.world_proximity(world)
    moving = arm.world_proximity(world)
    moving.move(world.names, poses)
    np.testing.assert_array_equal(moving.distances(q), made.distances(q))
    again: urdd.WorldProximity = pickle.loads(pickle.dumps(moving))
    np.testing.assert_array_equal(again.distances(q), made.distances(q))
    assert not np.array_equal(before.distances(q), made.distances(q)), "each moves for itself"
    world.move(world.names, poses)
    np.testing.assert_array_equal(arm.world_proximity(world).distances(q), made.distances(q))
    # By positions, and some of them.
    moving.move(["box_3", "ball"], np.zeros((2, 3)))
    np.testing.assert_array_equal(moving.pair_indices, made.pair_indices)
    kept = [k for k, pair in enumerate(moving.pairs) if pair.obstacle not in ("box_3", "ball")]
    np.testing.assert_array_equal(moving.distances(q)[:, kept], made.distances(q)[:, kept])
    least = moving.min_distance(q)
    refused: list[tuple[list[str], ArrayLike, type[Exception], str]] = [
        (["ball", "bal"], np.zeros((2, 3)), KeyError, "bal"),
        (["ball", "box_1"], np.zeros((3, 3)), urdd.ConfigurationError, "the poses of 2 obstacles"),
        (["box_1", "ball"], [[0.0, 0.0, 0.0], [0.0, np.inf, 0.0]], urdd.ObstacleError, "`ball`"),
        (["box_1", "ball"], [[0.0, 0.0, 0.0], [0.0, 1e10, 0.0]], urdd.ObstacleError, "`ball`"),
        (["box_1", "ball"], [np.eye(4), 2 * np.eye(4)], urdd.ObstacleError, "`ball`"),
    ]
    for names, wrong, error, words in refused:
        with pytest.raises(error, match=words):
            moving.move(names, wrong)
        np.testing.assert_array_equal(moving.min_distance(q), least)


def test_moves_one_after_another(arm: urdd.Robot) -> None:
    """What a control loop moves is where a world has it whose obstacles were made there, also for a pickle."""
    world, q = urdd.World(), arm.random(20)
    for k in range(4):
        world.add_box(f"box_{k}", [0.1, 0.2, 0.05], [0.1 * k, 0.5, 0.2])
    moving = arm.world_proximity(world)
    at = np.tile(np.eye(4), (4, 1, 1))
    for step, places in enumerate([[0, 1, 2, 3], [0, 1, 2, 3], [2, 0], [3], [1, 1]]):
        poses = np.tile(np.eye(4), (len(places), 1, 1))
        poses[:, :3, 3] = 0.1 + 0.1 * step
        poses[:, 0, 3] += np.arange(len(places))
        names = [f"box_{k}" for k in places]
        moving.move(names, poses)
        world.move(names, poses)
        made = arm.world_proximity(world).distances(q)
        # A copy is kept.
        poses[:] = at[: len(places)]
        np.testing.assert_array_equal(moving.distances(q), made)
    again: urdd.WorldProximity = pickle.loads(pickle.dumps(moving))
    np.testing.assert_array_equal(again.distances(q), arm.world_proximity(world).distances(q))
    # What is nearly a pose is as for a world: refused or taken, and both agree.
    for row, by, is_pose in ((3, 1e-7, False), (0, 3e-7, True), (0, 1e-5, False)):
        doubtful = np.tile(np.eye(4), (2, 1, 1))
        doubtful[1, row, 0] += by
        for of in (moving, world):
            if is_pose:
                of.move(["box_0", "box_1"], doubtful)
            else:
                with pytest.raises(urdd.ObstacleError, match="`box_1`"):
                    of.move(["box_0", "box_1"], doubtful)
        np.testing.assert_array_equal(moving.distances(q), arm.world_proximity(world).distances(q))


def test_pairs_and_bodies_that_are_left_out(arm: urdd.Robot, tool: urdd.World) -> None:
    shapes = arm.proximity().attach("torch", tool)
    assert shapes.bodies == (*arm.link_names, "brush")
    q = arm.random(5, seed=4)
    for one in (shapes, shapes.without([("brush", "base")]), shapes.without_bodies(["wrist"])):
        names = [tuple(one.bodies[body] for body in pair) for pair in one.pair_bodies]
        assert names == [pair.links for pair in one.pairs]
        kept = [k for k, pair in enumerate(shapes.pairs) if pair in one.pairs]
        np.testing.assert_array_equal(one.distances(q), shapes.distances(q)[:, kept])
        again: urdd.Proximity = pickle.loads(pickle.dumps(one))
        assert again.pairs == one.pairs
    without = shapes.without([("brush", "base")])
    assert without.num_pairs < shapes.num_pairs
    assert not any({"brush", "base"} == set(pair.links) for pair in without.pairs)
    world = urdd.World()
    world.add_sphere("ball", 0.1)
    around = arm.world_proximity(world, shapes.without_bodies(["wrist"]))
    assert {shapes.bodies[body] for body in around.pair_bodies} == {pair.link for pair in around.pairs}
    assert "wrist" not in {pair.link for pair in around.pairs}
    with pytest.raises(urdd.UnknownNameError, match="did you mean `base`"):
        shapes.without([("brush", "bas")])
    with pytest.raises(urdd.UnknownNameError, match="did you mean `base`"):
        shapes.without_bodies(["bas"])


def test_what_cannot_be_carried_or_moved(arm: urdd.Robot, tool: urdd.World) -> None:
    with pytest.raises(urdd.UnknownNameError, match="did you mean `torch`"):
        arm.proximity().attach("torh", tool)
    with pytest.raises(urdd.ObstacleError, match="`brush`: a link or an attached object has this name"):
        arm.proximity().attach("torch", tool).attach("wrist", tool)
    with pytest.raises(KeyError):
        tool.move("table", [0, 0, 0])
    with pytest.raises(urdd.ObstacleError, match="not finite"):
        tool.move("brush", [0, 0, np.nan])
    shapes = arm.proximity().attach("torch", tool)
    before = shapes.self_distance(arm.zero)
    tool.move("brush", [9, 9, 9])
    assert shapes.self_distance(arm.zero) == before, "later changes have no effect"
    assert pickle.loads(pickle.dumps(shapes)).self_distance(arm.zero) == before
    tool.remove("brush")
    tool.add_sphere("brush", 0.1, ignore=["torh"])
    with pytest.raises(urdd.UnknownNameError, match="did you mean `torch`"):
        arm.proximity().attach("torch", tool)


def test_penetrations_are_what_separates(arm: urdd.Robot) -> None:
    world = urdd.World()
    q = arm.zero
    place = arm.link_pose(q, "torch")[:3, 3]
    world.add_box("box", [0.1, 0.1, 0.1], place)
    around = arm.world_proximity(world)
    found = around.penetrations(q)
    assert {(one.link, one.piece) for one in found} == {
        (pair.link, pair.piece)
        for pair, distance in zip(around.pairs, around.distances(q), strict=True)
        if distance == 0
    }
    for one in found:
        assert one.gradient.shape == (arm.num_dofs,)
        for extra, expected in ((1e-5, 1e-5), (-1e-5, 0.0)):
            world.move("box", place + one.direction * (one.depth + extra))
            moved = arm.world_proximity(world)
            which = next(k for k, pair in enumerate(moved.pairs) if (pair.link, pair.piece) == (one.link, one.piece))
            assert moved.distances(q)[which] == pytest.approx(expected, abs=2e-9)
    own = next(q for q in arm.random(1000) if arm.in_collision(q))
    shapes = arm.proximity()
    assert [one.links for one in shapes.penetrations(own)] == [one.links for one in shapes.collisions(own)]
    assert all(one.depth > 0 for one in shapes.penetrations(own))
