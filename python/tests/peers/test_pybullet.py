"""PyBullet gets the same robot."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pybullet
import pytest

import urdd


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
    for q in robot.sample(10, seed=6):
        peer.set(q)
        np.testing.assert_allclose(peer.q(), q, atol=1e-12)
        for link, pose in robot.link_poses(q).items():
            if link == root:
                continue
            state = pybullet.getLinkState(
                peer.body, peer.links[link], computeForwardKinematics=1, physicsClientId=client
            )
            # Single precision is what PyBullet keeps of a URDF.
            np.testing.assert_allclose(state[4], pose[:3, 3], atol=1e-5)
            matrix = np.reshape(pybullet.getMatrixFromQuaternion(state[5]), (3, 3))
            np.testing.assert_allclose(matrix, pose[:3, :3], atol=1e-5)


@pytest.mark.parametrize("name", ["planar_base_arm", "quadruped", "toy_all_joints"])
def test_joints_that_it_does_not_read(name: str, urdds: Path, client: int) -> None:
    with pytest.raises(urdd.ExportError, match="joints of one DOF only"):
        urdd.load(urdds / name).to_pybullet(client)
