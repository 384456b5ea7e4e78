"""Distances, collisions, shapes and skips."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import urdd

KINDS: list[urdd.ShapeKind] = ["hulls", "boxes", "spheres", "pieces", "piece-boxes", "piece-spheres"]


@pytest.mark.parametrize("kind", KINDS)
def test_batches_give_what_each_configuration_gives(kind: urdd.ShapeKind, arm: urdd.Robot) -> None:
    proximity = arm.proximity(kind)
    q = arm.random(40)
    distances = proximity.distances(q)
    assert distances.shape == (40, proximity.num_pairs) == (40, len(proximity.pairs))
    np.testing.assert_array_equal(proximity.in_collision(q), (distances <= 0).any(axis=1))
    np.testing.assert_array_equal(proximity.self_distance(q), distances.min(axis=1))
    for k in (0, 7, 39):
        np.testing.assert_array_equal(proximity.distances(q[k]), distances[k])
        assert proximity.in_collision(q[k]) == (distances[k] <= 0).any()
        assert proximity.self_distance(q[k]) == distances[k].min()
        nearest = proximity.nearest(q[k], 4)
        np.testing.assert_array_equal([pair.distance for pair in nearest], np.sort(distances[k])[:4])
        assert len(proximity.collisions(q[k])) == (distances[k] <= 0).sum()


def test_the_points_of_a_pair_are_as_far_apart_as_its_distance(arm: urdd.Robot) -> None:
    for pair in arm.nearest(arm.random(seed=4), 10):
        assert np.linalg.norm(pair.points[0] - pair.points[1]) == pytest.approx(pair.distance, abs=1e-9)
        assert pair.links[0] != pair.links[1]
        assert pair.relative is None or pair.relative >= 0


def test_margins_edges_and_gradients_agree_with_distances(arm: urdd.Robot) -> None:
    proximity = arm.proximity("pieces")
    q = arm.random(60)
    least = proximity.self_distance(q)
    np.testing.assert_array_equal(proximity.is_within(q, 0.05), least <= 0.05)
    assert proximity.is_within(q.reshape(6, 10, -1), 0.0).shape == (6, 10)
    starts, ends = q[:-1], q[:-1] + 0.2 * (q[1:] - q[:-1])
    sampled = proximity.blocked_edge(starts, ends)
    proved = proximity.blocked_edge(starts, ends, resolution=None)
    assert sampled.shape == (59,)
    assert 5 < np.isnan(proved).sum() < 55
    # What is proved free is free where it is sampled.
    assert np.isnan(sampled[np.isnan(proved)]).all()
    for start, end, part in zip(starts, ends, proved, strict=True):
        if not np.isnan(part):
            assert proximity.self_distance(start + part * (end - start)) <= 1.01e-4
    # The first contact: free before, blocked there.
    first = proximity.first_contact(starts, ends)
    assert first.shape == (59, 2)
    np.testing.assert_array_equal(np.isnan(first[:, 1]), np.isnan(sampled))
    for start, end, (free, blocked), part in zip(starts, ends, first, sampled, strict=True):
        if not np.isnan(part) and free > 0:
            assert not proximity.in_collision(start + free * (end - start))
            assert proximity.in_collision(start + blocked * (end - start))
            assert 0 < blocked - free < 1e-3
            assert free <= part
            before = np.linspace(0, 0.99 * free, 30)[:, np.newaxis]
            assert not proximity.in_collision(start + before * (end - start)).any()
    assert proximity.first_contact(starts[0], ends[0], resolution=None).shape == (2,)
    for resolution in (None, 0.01):
        with pytest.raises(ValueError, match="steps: divide it"):
            proximity.blocked_edge(arm.zero, 1e9 * np.eye(arm.num_dofs)[0], resolution=resolution)
    # One start for all ends, as numpy has it.
    np.testing.assert_array_equal(
        proximity.blocked_edge(starts[0], ends), proximity.blocked_edge(np.tile(starts[0], (59, 1)), ends)
    )
    with pytest.raises(urdd.ConfigurationError, match="do not fit"):
        proximity.blocked_edge(starts[:3], ends[:4])
    with pytest.raises(ValueError, match="not below 0"):
        proximity.is_within(q, -1)
    with pytest.raises(ValueError, match="above 0"):
        proximity.blocked_edge(q[0], q[1], resolution=0)
    for pair in proximity.gradients(q[least > 0][0], 5):
        assert pair.gradient is not None
        assert pair.gradient.shape == (arm.num_dofs,)
    assert all(pair.gradient is None for pair in proximity.gradients(q[least == 0][0], 1))


def test_spheres_are_where_a_few_lines_of_numpy_put_them(arm: urdd.Robot) -> None:
    q, proximity, spheres = arm.random(20), arm.proximity("spheres"), arm.spheres("hulls")
    poses = arm.link_poses(q)
    at = {link: k for k, link in enumerate(spheres.links)}
    links = [arm.link(link) for link in spheres.links]
    frames = poses[:, links]
    centres = np.einsum("nsij,sj->nsi", frames[..., :3, :3], spheres.centres) + frames[..., :3, 3]
    for column, pair in enumerate(proximity.pairs):
        a, b = (at[link] for link in pair.links)
        apart = np.linalg.norm(centres[:, a] - centres[:, b], axis=1) - spheres.radii[a] - spheres.radii[b]
        np.testing.assert_allclose(proximity.distances(q)[:, column], np.maximum(apart, 0), atol=1e-9)


def test_shapes_hold_what_they_are_about(arm: urdd.Robot) -> None:
    hulls, pieces = arm.hulls(), arm.pieces()
    assert {hull.link for hull in hulls} == {piece.link for piece in pieces}
    for meshes, boxes, spheres in (
        (hulls, arm.boxes("hulls"), arm.spheres("hulls")),
        (pieces, arm.boxes("pieces"), arm.spheres("pieces")),
    ):
        assert len(meshes) == len(boxes) == len(spheres.radii)
        for k, (mesh, box) in enumerate(zip(meshes, boxes, strict=True)):
            assert mesh.faces.max() < len(mesh.vertices)
            assert (mesh.link, mesh.piece) == (box.link, box.piece) == (spheres.links[k], spheres.pieces[k])
            inside = (mesh.vertices - box.pose[:3, 3]) @ box.pose[:3, :3]
            assert (np.abs(inside) <= box.half_extents + 1e-6).all()
            assert (np.linalg.norm(mesh.vertices - spheres.centres[k], axis=1) <= spheres.radii[k] + 1e-6).all()
    assert {visual.link for visual in arm.visuals()} == {hull.link for hull in hulls}
    for kind in KINDS:
        assert len(arm.shapes(kind)) > 0


@pytest.mark.parametrize("kind", KINDS)
def test_pairs_are_those_that_are_not_skipped(kind: urdd.ShapeKind, arm: urdd.Robot) -> None:
    skips, proximity = arm.skips(kind), arm.proximity(kind)
    assert skips.skipped.diagonal().all()
    assert (skips.skipped == skips.skipped.T).all()
    upper = np.triu(~skips.skipped, 1)
    assert upper.sum() == proximity.num_pairs
    assert skips.reasons is not None
    for row, reasons in enumerate(skips.reasons):
        for column, reason in enumerate(reasons):
            assert (reason == "same-link") == (skips.links[row] == skips.links[column])
            assert bool(skips.skipped[row, column]) == (reason not in ("never", "none"))
    neighbours = {frozenset((joint.parent.link, joint.child.link)) for joint in arm.modules.urdf.joints}
    assert skips.pairs_of_links() <= {frozenset(pair) for pair in _all_pairs(arm.link_names)}
    adjacent = {
        frozenset((skips.links[i], skips.links[j]))
        for i, j in np.argwhere(skips.skipped & ~np.eye(len(skips.links), dtype=bool))
    }
    assert any(pair in neighbours for pair in adjacent)


def _all_pairs(names: tuple[str, ...]) -> list[tuple[str, str]]:
    return [(a, b) for k, a in enumerate(names) for b in names[k + 1 :]]


def test_a_robot_without_geometry_says_what_is_missing(urdds: Path, tmp_path: Path) -> None:
    made = urdd.generate(urdds / "six_axis_arm" / "six_axis_arm.urdf", tmp_path / "core", modules=["core"])
    robot = made.load()
    assert robot.link_poses(robot.zero).shape == (robot.num_links, 4, 4)
    with pytest.raises(urdd.ModuleMissingError, match=r"urdd\.generate") as caught:
        robot.in_collision(robot.zero)
    assert caught.value.module.startswith("link_shapes") or caught.value.module.endswith("meshes_module")


@pytest.mark.parametrize("count", [0, 1, 5])
def test_a_robot_without_dofs(count: int, urdds: Path) -> None:
    robot = urdd.load(urdds / "single_link")
    q = np.zeros((count, 0))
    assert robot.link_poses(q).shape == (count, 1, 4, 4)
    assert robot.jacobian(q, 0).shape == (count, 6, 0)
    assert robot.in_collision(q).tolist() == [False] * count
    assert robot.distances(q).shape == (count, 0)
    assert robot.self_distance(q).tolist() == [float("inf")] * count
    assert robot.nearest(robot.zero, 3) == []
    assert robot.random(count).shape == (count, 0)
