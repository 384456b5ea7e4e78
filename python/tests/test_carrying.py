"""Objects that links carry, and obstacles that move."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

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
