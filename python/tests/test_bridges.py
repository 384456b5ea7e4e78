"""Other programs receive the same robot: their numbers are compared with ours."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import urdd
from conftest import NAMES
from sockets import listening

KINDS: list[urdd.ShapeKind] = ["hulls", "boxes", "spheres", "pieces", "piece-boxes", "piece-spheres"]


@pytest.fixture(scope="module")
def pin() -> Any:
    return import_module("pinocchio")


@pytest.fixture(scope="module")
def mujoco() -> Any:
    return import_module("mujoco")


@pytest.mark.parametrize("name", NAMES)
def test_pinocchio_moves_alike(name: str, urdds: Path, pin: Any) -> None:
    robot = urdd.load(urdds / name)
    peer = robot.to_pinocchio(shapes=None)
    data = peer.model.createData()
    q = robot.random(20, seed=1)
    theirs = peer.q(q)
    np.testing.assert_allclose(peer.dofs(theirs), q, atol=1e-12)
    for ours, own in zip(q, theirs, strict=True):
        pin.computeJointJacobians(peer.model, data, own)
        pin.updateFramePlacements(peer.model, data)
        tangent = peer.tangent(ours)
        for link, pose in zip(robot.link_names, robot.link_poses(ours), strict=True):
            frame = peer.model.getFrameId(link, pin.FrameType.BODY)
            np.testing.assert_allclose(data.oMf[frame].homogeneous, pose, atol=1e-12)
            if robot.num_dofs == 0:
                # Pinocchio crashes on a model without velocities.
                continue
            jacobian = pin.getFrameJacobian(peer.model, data, frame, pin.LOCAL_WORLD_ALIGNED) @ tangent
            np.testing.assert_allclose(jacobian, robot.jacobian(ours, link), atol=1e-11)


@pytest.mark.parametrize("name", ["gripper", "six_axis_arm", "welding_arm"])
def test_pinocchio_reads_the_same_masses_and_limits(name: str, urdds: Path, pin: Any) -> None:
    robot = urdd.load(urdds / name)
    ours = robot.to_pinocchio(shapes=None)
    theirs = pin.buildModelFromXML(robot.urdf_text)
    a, b = ours.model.createData(), theirs.createData()
    still = np.zeros(theirs.nq)
    pin.crba(ours.model, a, ours.q(robot.clamp(np.zeros(robot.num_dofs))))
    assert pin.computeTotalMass(ours.model) == pytest.approx(pin.computeTotalMass(theirs))
    if name == "six_axis_arm":
        # One DOF per joint, in one order: the whole mass matrix.
        zero = np.zeros(robot.num_dofs)
        np.testing.assert_allclose(pin.crba(ours.model, a, ours.q(zero)), pin.crba(theirs, b, still), atol=1e-9)
        np.testing.assert_allclose(ours.model.lowerPositionLimit, theirs.lowerPositionLimit)
        np.testing.assert_allclose(ours.model.upperPositionLimit, theirs.upperPositionLimit)
        np.testing.assert_allclose(ours.model.velocityLimit, theirs.velocityLimit)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["welding_arm", "toy_all_joints"])
def test_coal_finds_the_same_distances(name: str, kind: urdd.ShapeKind, urdds: Path, pin: Any) -> None:
    robot = urdd.load(urdds / name)
    peer = robot.to_pinocchio(kind)
    proximity = robot.proximity(kind)
    assert len(peer.collision_model.collisionPairs) == proximity.num_pairs
    data, geometry = peer.model.createData(), pin.GeometryData(peer.collision_model)
    for request in geometry.distanceRequests:
        request.gjk_tolerance = 1e-9
    for q in robot.random(20, seed=2):
        pin.computeDistances(peer.model, data, peer.collision_model, geometry, peer.q(q))
        theirs = np.array([max(result.min_distance, 0.0) for result in geometry.distanceResults])
        np.testing.assert_allclose(proximity.distances(q), theirs, atol=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_mujoco_moves_alike(name: str, urdds: Path, mujoco: Any) -> None:
    robot = urdd.load(urdds / name)
    peer = robot.to_mujoco()
    data = mujoco.MjData(peer.model)
    q = robot.random(20, seed=3)
    np.testing.assert_allclose(peer.dofs(peer.q(q)), q, atol=1e-12)
    for ours, own in zip(q, peer.q(q), strict=True):
        data.qpos[:] = own
        mujoco.mj_kinematics(peer.model, data)
        for link, pose in zip(robot.link_names, robot.link_poses(ours), strict=True):
            body = peer.model.body(link).id
            np.testing.assert_allclose(data.xpos[body], pose[:3, 3], atol=1e-12)
            np.testing.assert_allclose(data.xmat[body].reshape(3, 3), pose[:3, :3], atol=1e-12)


def test_mujoco_collides_where_we_do(arm: urdd.Robot, mujoco: Any) -> None:
    peer = arm.to_mujoco("hulls")
    data = mujoco.MjData(peer.model)
    q = arm.random(200, seed=4)
    distances = arm.self_distance(q, "hulls")
    clear = np.abs(distances) > 1e-6
    assert 0 < (distances == 0).sum() < 200
    for k in np.flatnonzero(clear | (distances == 0)):
        data.qpos[:] = peer.q(q[k])
        mujoco.mj_forward(peer.model, data)
        if distances[k] > 1e-4:
            assert data.ncon == 0


@pytest.mark.parametrize("kind", ["plain", "hulls", "pieces"])
def test_trimesh_has_the_meshes(kind: urdd.MeshKind, arm: urdd.Robot) -> None:
    q = arm.random(seed=5)
    scene = arm.to_trimesh(q, kind)
    poses = dict(zip(arm.link_names, arm.link_poses(q), strict=True))
    ends: list[np.ndarray[Any, Any]] = []
    for hull in arm.hulls():
        mesh = arm.link_mesh(hull.link, kind)
        # The hull of a link's appearance is the hull; pieces are inside it.
        low, high = hull.vertices.min(axis=0), hull.vertices.max(axis=0)
        np.testing.assert_allclose(mesh.bounds, [low, high], atol=1e-3 if kind == "pieces" else 1e-6)
        ends.append(mesh.vertices @ poses[hull.link][:3, :3].T + poses[hull.link][:3, 3])
    every = np.concatenate(ends)
    np.testing.assert_allclose(scene.bounds, [every.min(axis=0), every.max(axis=0)], atol=1e-6)
    with pytest.raises(urdd.UnknownNameError):
        arm.link_mesh("torhc")


def test_the_page_is_served_until_it_is_closed(arm: urdd.Robot) -> None:
    import urllib.error
    import urllib.request

    before = listening() if sys.platform == "linux" else set[tuple[str, int]]()
    with arm.show(arm.zero, open_browser=False) as shown:
        if sys.platform == "linux":
            assert [address for address, _ in listening() - before] == ["127.0.0.1"]
        address, fragment = shown.address.split("#")
        assert "token=" in fragment
        assert "q=0.0," in fragment
        with urllib.request.urlopen(address, timeout=30) as answer:
            assert b"urdd" in answer.read()
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(address, timeout=30)
    with pytest.raises(ValueError, match="unknown backend"):
        arm.show(backend="cheese", open_browser=False)  # type: ignore[call-overload]


def test_a_notebook_gets_the_page_in_a_frame(arm: urdd.Robot) -> None:
    frame = arm.frame(height=123)
    text = frame._repr_html_()
    assert text.startswith("<iframe")
    assert "123px" in text
    assert '"robot.zip"' in frame.text
    # The frame has an origin of its own: its scripts reach neither the notebook nor its server.
    assert 'sandbox="allow-scripts allow-downloads"' in text


def test_viser_is_told_to_listen_to_this_machine_alone(arm: urdd.Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a stand-in; `peers/test_viser.py` checks the socket of viser itself."""
    told: list[dict[str, Any]] = []

    class Server:
        def __init__(self, **options: Any) -> None:
            told.append(options)
            self.scene = self

        def add_mesh_trimesh(self, name: str, mesh: object) -> SimpleNamespace:
            return SimpleNamespace(name=name, mesh=mesh)

        def get_port(self) -> int:
            return 8080

        def stop(self) -> None:
            told.append({})

    monkeypatch.setitem(sys.modules, "viser", SimpleNamespace(ViserServer=Server))
    with arm.show(backend="viser", open_browser=False) as shown:
        assert shown.address == "http://127.0.0.1:8080"
    assert told == [{"host": "127.0.0.1"}, {}]


def test_what_is_not_installed_is_named(arm: urdd.Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(ModuleNotFoundError, match=r"needs the package `mujoco`.*pip install 'urdd\[mujoco\]'"):
        arm.to_mujoco()


def test_rotations_and_planes() -> None:
    from urdd import _joints

    generator = np.random.default_rng(7)
    for axis in [*np.eye(3), *-np.eye(3), *(v / np.linalg.norm(v) for v in generator.normal(size=(20, 3)))]:
        basis = _joints.in_plane_basis(axis)
        np.testing.assert_allclose(basis @ basis.T, np.eye(3), atol=1e-14)
        assert np.linalg.det(basis) == pytest.approx(1)
        np.testing.assert_allclose(basis[:, 2], axis, atol=1e-15)
    vectors = generator.normal(size=(50, 3))
    vectors *= (generator.uniform(0, np.pi, size=50) / np.linalg.norm(vectors, axis=1))[:, None]
    vectors[0] = 0
    vectors[1] = [1e-12, 0, 0]
    wxyz = _joints.quaternion_of(vectors)
    np.testing.assert_allclose(_joints.rotation_vector_of(wxyz), vectors, atol=1e-13)
    for one in wxyz:
        matrix = _joints.pose([0, 0, 0], one.tolist())[:3, :3]
        found = _joints.quaternion_of_matrix(matrix)
        np.testing.assert_allclose(np.abs(found @ one), 1, atol=1e-14)
