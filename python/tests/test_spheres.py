"""Spheres in the place of shapes, clouds of points and fields of heights: by numpy."""

from __future__ import annotations

import pickle
import resource
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import urdd


def level_of(robot: urdd.Robot) -> dict[str, Any]:
    """The bounding spheres of the pieces, by link."""
    spheres = robot.spheres("pieces")
    rows = np.column_stack([spheres.centres, spheres.radii])
    return {link: rows[[own == link for own in spheres.links]] for link in dict.fromkeys(spheres.links)}


def gaps(robot: urdd.Robot, level: dict[str, Any], pairs: Any, q: Any) -> Any:
    """(n,): how far the spheres of the pairs are apart."""
    poses = robot.link_poses(q)
    centres = {
        link: np.einsum("nij,sj->nsi", poses[:, robot.link(link), :3, :3], own[:, :3])
        + poses[:, robot.link(link), None, :3, 3]
        for link, own in level.items()
    }
    each = []
    for a, b in pairs:
        apart = np.linalg.norm(centres[a][:, :, None] - centres[b][:, None], axis=-1)
        each.append((apart - level[a][:, 3][:, None] - level[b][:, 3]).min(axis=(1, 2)))
    return np.min(each, axis=0)


@pytest.mark.parametrize("covers", [False, True])
def test_spheres_touch_where_numpy_says(arm: urdd.Robot, covers: bool) -> None:
    level = level_of(arm)
    links = list(level)
    pairs = [(a, b) for k, a in enumerate(links) for b in links[k + 3 :]]
    checker = arm.sphere_checker(level, pairs, covers=covers)
    q = arm.random(1000)
    gap = gaps(arm, level, pairs, q)
    clear = np.abs(gap) > 1e-4
    assert checker.covers is covers
    assert (checker.in_collision(q) == (gap <= 0))[clear].all()
    assert 0 < checker.in_collision(q).mean() < 1
    near = np.abs(gap - 0.02) > 1e-4
    assert (checker.is_within(q, 0.02) == (gap <= 0.02))[near].all()
    assert checker.in_collision(q[0]).shape == ()
    again = pickle.loads(pickle.dumps(checker))
    assert (again.in_collision(q) == checker.in_collision(q)).all()


def test_an_edge_is_blocked_where_a_configuration_is(arm: urdd.Robot) -> None:
    world = urdd.World()
    world.add_points("seen", np.random.default_rng(1).uniform(-0.6, 0.6, (3000, 3)) + np.array([0.9, 0, 0.6]), 0.01)
    checker = arm.sphere_checker(level_of(arm), [], world=world)
    start, end = arm.random(200), arm.random(200, seed=9)
    blocked = checker.blocked_edge(start, end, resolution=0.02)
    first = checker.first_contact(start, end, resolution=0.02)
    hit = ~np.isnan(blocked)
    assert 0 < hit.mean() < 1
    assert (np.isnan(first[:, 0]) == ~hit).all()
    for part in (blocked, first[:, 1]):
        at = start + part[:, None] * (end - start)
        at[part == 1.0] = end[part == 1.0]
        assert checker.in_collision(at[hit]).all()
    assert (first[hit, 1] <= blocked[hit]).all()


def test_a_cloud_is_as_far_as_its_nearest_point(arm: urdd.Robot) -> None:
    rng = np.random.default_rng(2)
    points = rng.uniform(-1.0, 1.0, (2000, 3)) + np.array([1.2, 0, 0])
    world = urdd.World()
    world.add_points("cloud", points, 0.01)
    around = arm.world_proximity(world, "spheres")
    q = arm.random(40)
    spheres = arm.spheres("hulls")
    frames = arm.link_poses(q)[:, [arm.link(link) for link in spheres.links]]
    centres = np.einsum("nsij,sj->nsi", frames[..., :3, :3], spheres.centres) + frames[..., :3, 3]
    apart = np.linalg.norm(centres[:, :, None] - points, axis=-1).min(axis=-1) - spheres.radii - 0.01
    assert np.allclose(around.min_distance(q), np.maximum(apart.min(axis=-1), 0.0), atol=1e-8)
    assert around.num_pairs == len(spheres.links)


def test_a_field_has_a_column_for_each_height(arm: urdd.Robot) -> None:
    heights = np.array([[0.1, 0.9, 0.2], [0.3, 0.0, 1.1]])
    field, columns = urdd.World(), urdd.World()
    field.add_height_field("field", heights, [0.3, 0.4], 0.5, [0.2, -0.2, 0.0])
    for (row, column), height in np.ndenumerate(heights):
        centre = [0.2 + 0.3 * column, -0.2 + 0.4 * row, height - 0.25]
        columns.add_box(f"{row} {column}", [0.3, 0.4, 0.5], centre)
    q = arm.random(50)
    ours, boxes = (arm.world_proximity(world).min_distance(q) for world in (field, columns))
    assert np.allclose(ours, boxes, atol=1e-8)
    field.move("field", [5.0, 0.0, 0.0])
    assert not arm.world_proximity(field).in_collision(q).any()


def test_more_than_ten_million_points_are_refused_before_they_are_copied() -> None:
    world = urdd.World()
    # The system gives memory for zeros once they are read.
    points = np.zeros((100_000_000, 3))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(urdd.ObstacleError, match="100000000 points, and 10000000 are allowed"):
        world.add_points("cloud", points, 0.01)
    with pytest.raises(urdd.ObstacleError, match="300000000 points, and 10000000 are allowed"):
        world.add_height_field("field", points, [0.1, 0.1], 0.1)
    kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert kilobytes < 100_000


def test_what_makes_no_sense_is_refused(arm: urdd.Robot) -> None:
    link = arm.link_names[1]
    for radius in (0.0, -1.0, np.nan, 1e300):
        with pytest.raises(urdd.ConfigurationError, match="radius"):
            arm.sphere_checker({link: [[0, 0, 0, radius]]}, [])
    with pytest.raises(urdd.UnknownNameError):
        arm.sphere_checker({"nothing": [[0, 0, 0, 0.1]]}, [])
    with pytest.raises(urdd.ConfigurationError, match="shape"):
        arm.sphere_checker({link: [[0, 0, 0.1]]}, [])
    checker = arm.sphere_checker({link: [[0, 0, 0, 0.1]]}, [])
    with pytest.raises(urdd.ConfigurationError):
        checker.in_collision(arm.zero[:-1])
    world = urdd.World()
    for points, radius in (([[np.nan, 0, 0]], 0.0), ([[0, 0, 0]], -1.0), ([[0, 0, 0]], 1e300), ([[0, 0]], 0.0)):
        with pytest.raises(urdd.ObstacleError):
            world.add_points("cloud", points, radius)
    with pytest.raises(urdd.ObstacleError):
        world.add_height_field("field", [[0.0, np.inf]], [0.1, 0.1], 0.1)
    world.add_points("cloud", [[0, 0, 0]])
    assert world.num_parts("cloud") == 1


def test_the_spheres_of_a_urdd_make_a_checker(arm: urdd.Robot, tmp_path: Path) -> None:
    """Covering spheres never call a collision free, and fitted ones are as good as the URDD says."""
    with pytest.raises(urdd.UrddError):
        arm.sphere_checker()
    urdf = Path(__file__).parents[2] / "conformance/robots/six_axis_arm.urdf"
    urdd.generate(urdf, tmp_path / "arm", modules=["all", "spheres"])
    robot = urdd.load(tmp_path / "arm")
    q = robot.random(4000)
    collides = robot.proximity("pieces").in_collision(q)
    covering, fitted = robot.sphere_checker(covers=True), robot.sphere_checker()
    assert covering.covers
    assert not fitted.covers
    assert covering.in_collision(q)[collides].all()
    level = robot.modules.link_shapes_spheres.levels[-1]
    wrong = (fitted.in_collision(q) != collides).mean()
    said = (level.evaluation.num_missed + level.evaluation.num_false_contacts) / 10_000
    assert wrong < said + 0.02
    assert 0.001 < collides.mean() < 0.999
