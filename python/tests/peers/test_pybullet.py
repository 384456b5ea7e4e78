"""PyBullet gets the same robot."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pybullet
import pytest

import urdd
from pybullet_stand_in import MIXED


@pytest.fixture
def client() -> Iterator[int]:
    number: int = pybullet.connect(pybullet.DIRECT)
    yield number
    pybullet.disconnect(number)


@pytest.mark.parametrize("name", ["gripper", "hand", "six_axis_arm", "welding_arm"])
def test_it_moves_alike(name: str, urdds: Path, client: int) -> None:
    robot = urdd.load(urdds / name)
    peer = robot.to_pybullet(client)
    root = robot.link_names[robot.modules.chain.root_idx]
    for q in robot.random(10, seed=6):
        peer.set(q)
        np.testing.assert_allclose(peer.get(), q, atol=1e-12)
        states = pybullet.getJointStates(peer.body, peer.joints, physicsClientId=client)
        np.testing.assert_allclose(peer.q(q), [state[0] for state in states], atol=1e-12)
        np.testing.assert_array_equal(peer.dofs(peer.q(q)), q)
        for link, pose in zip(robot.link_names, robot.link_poses(q), strict=True):
            if link == root:
                continue
            state = pybullet.getLinkState(
                peer.body, peer.links[link], computeForwardKinematics=1, physicsClientId=client
            )
            # PyBullet keeps single precision of a URDF.
            np.testing.assert_allclose(state[4], pose[:3, 3], atol=1e-5)
            matrix = np.reshape(pybullet.getMatrixFromQuaternion(state[5]), (3, 3))
            np.testing.assert_allclose(matrix, pose[:3, :3], atol=1e-5)


@pytest.mark.parametrize("name", ["planar_base_arm", "quadruped", "toy_all_joints"])
def test_joints_that_it_does_not_read(name: str, urdds: Path, client: int) -> None:
    with pytest.raises(urdd.ExportError, match="joints of one DOF only"):
        urdd.load(urdds / name).to_pybullet(client)


def contacts(body: int, client: int) -> set[tuple[int, int]]:
    """The pairs of links in contact, by index."""
    pybullet.performCollisionDetection(physicsClientId=client)
    found = pybullet.getContactPoints(body, body, physicsClientId=client)
    return {(min(one[3], one[4]), max(one[3], one[4])) for one in found if one[8] < -1e-3}


def test_nothing_touches_at_all_times(tmp_path: Path, client: int) -> None:
    robot = urdd.generate_text(MIXED, tmp_path / "mixed").load()
    peer = robot.to_pybullet(client)
    assert len(peer.notes) == 1
    for q in robot.random(50, seed=7):
        peer.set(q)
        assert contacts(peer.body, client) == set()
    kept = robot.to_pybullet(client, keep_pairs=True)
    kept.set(robot.zero)
    assert contacts(kept.body, client) == {(-1, kept.links["tool"])}


def test_it_collides_where_we_do(arm: urdd.Robot, client: int) -> None:
    peer = arm.to_pybullet(client)
    assert peer.notes == []
    q = arm.random(300, seed=8)
    distances, told = arm.self_distance(q), arm.in_collision(q)
    assert 0 < told.sum() < 300
    for one, distance in zip(q, distances, strict=True):
        peer.set(one)
        # Hulls have a margin in PyBullet; contacts count from a depth of 1 mm.
        if distance > 1e-3:
            assert contacts(peer.body, client) == set()
