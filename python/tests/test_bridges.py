"""Other programs receive the same robot: their numbers are compared with ours."""

from __future__ import annotations

import base64
import json
import re
import subprocess
import sys
import urllib.request
import zlib
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


def test_mujoco_holds_a_robot_by_its_actuators(arm: urdd.Robot, mujoco: Any) -> None:
    """Ten seconds under gravity: the mass matrix of MuJoCo is behind the gains, and no joint sags by 0.05 rad."""
    peer = arm.to_mujoco(actuators="position")
    model, data = peer.model, mujoco.MjData(peer.model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    gains = model.actuator_gainprm[:, 0] / (2 * np.pi * 10) ** 2
    driven = model.jnt_dofadr[model.actuator_trnid[:, 0]]
    # The greatest inertia of several configurations is that of this one or more.
    assert (gains > 0.999 * np.diag(mass)[driven]).all()
    assert (gains < 20 * np.diag(mass)[driven]).all()
    start = data.qpos.copy()
    while data.time < 10:
        mujoco.mj_step(model, data)
    assert np.abs(data.qpos - start).max() < 0.05
    assert np.abs(data.qvel).max() < 0.01
    assert not any(warning.number for warning in data.warning)


def test_mujoco_frees_the_base(arm: urdd.Robot, mujoco: Any) -> None:
    peer = arm.to_mujoco(floating_base=True)
    q = arm.random(3, seed=6)
    qpos = peer.q(q)
    np.testing.assert_allclose(peer.dofs(qpos), q, atol=1e-12)
    np.testing.assert_array_equal(qpos[:, :7], np.tile(peer.model.qpos0[:7], (3, 1)))
    data = mujoco.MjData(peer.model)
    # Nothing holds it: it falls 1.23 m in half a second.
    height = data.qpos[2]
    while data.time < 0.5:
        mujoco.mj_step(peer.model, data)
    assert abs(data.qpos[2] - height + 0.5 * 9.81 * data.time**2) < 0.3


@pytest.mark.parametrize("name", NAMES)
def test_newton_moves_alike(name: str, urdds: Path) -> None:
    """`.ci/full usd` has Newton, whose numbers are binary32."""
    newton = pytest.importorskip("newton")
    robot = urdd.load(urdds / name)
    peer = robot.to_newton(floating_base=name == "gripper")
    state = peer.model.state()
    links = {label.rsplit("/", 1)[1]: body for body, label in enumerate(peer.model.body_label)}
    q = robot.random(20, seed=3)
    np.testing.assert_allclose(peer.dofs(peer.q(q)), q, atol=1e-12)
    for ours, own in zip([robot.zero, *q], [peer.model.joint_q.numpy(), *peer.q(q)], strict=True):
        peer.model.joint_q.assign(own.astype(np.float32))
        newton.eval_fk(peer.model, peer.model.joint_q, peer.model.joint_qd, state)
        found = state.body_q.numpy()
        root = found[links[robot.root_link]][:3]
        for link, pose in zip(robot.link_names, robot.link_poses(ours), strict=True):
            if link in links:
                np.testing.assert_allclose(found[links[link]][:3] - root, pose[:3, 3], atol=1e-5)


def test_options_of_mjcf_are_refused_elsewhere(arm: urdd.Robot) -> None:
    with pytest.raises(ValueError, match="for mjcf"):
        urdd.export(arm, "urdf", actuators="position")
    with pytest.raises(ValueError, match="give output"):
        urdd.export(arm, "mjcf", scene=True)
    with pytest.raises(ValueError, match="to 1,000 Hz"):
        urdd.export(arm, "mjcf", bandwidth=float("nan"))
    with pytest.raises(ValueError, match="no actuators `x`"):
        urdd.export(arm, "mjcf", actuators="x")  # type: ignore[arg-type]


def test_a_file_beside_the_urdd_says_what_exports_need(arm: urdd.Robot, mujoco: Any, tmp_path: Path) -> None:
    setup = tmp_path / "arm.export.toml"
    command = [sys.executable, "-m", "urdd", "export", "init", str(arm.path), "-o", str(setup)]
    subprocess.run(command, check=True, capture_output=True)
    setup.write_text(setup.read_text().replace("floating = false", "floating = true"))
    free = urdd.export(arm, "mjcf", setup=setup)
    model = mujoco.MjModel.from_xml_string(free.text, free.files)
    assert model.jnt_type[0] == mujoco.mjtJoint.mjJNT_FREE
    assert model.nsite == 1
    setup.write_text('robot = "other"')
    with pytest.raises(urdd.ExportError, match="this file is for robot `other`"):
        urdd.export(arm, "mjcf", setup=setup)


def test_a_package_of_moveit_is_written_whole(arm: urdd.Robot, tmp_path: Path) -> None:
    made = urdd.export(arm, "moveit", tmp_path / "arm_config")
    assert made.path is not None
    assert (tmp_path / "arm_config" / made.path).read_text() == made.text
    launch = (tmp_path / "arm_config/launch/demo.launch.py").read_text()
    compile(launch, "demo.launch.py", "exec")
    assert 'package = "arm_config"' in launch
    urdf = next((tmp_path / "arm_config/config").glob("*.urdf")).read_text()
    assert "package://arm_config/meshes/" in urdf
    assert made.report["format"] == "MoveIt's configuration"
    humble = urdd.export(arm, "moveit", ros="humble")
    assert b"planning_plugin: " in humble.files["config/ompl_planning.yaml"]
    assert b"planning_plugins:" in made.files["config/ompl_planning.yaml"]
    with pytest.raises(ValueError, match="there are: humble, jazzy"):
        urdd.export(arm, "moveit", ros="foxy")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="ros is for moveit only"):
        urdd.export(arm, "sdf", ros="humble")
    (tmp_path / "arm_config/package.xml").write_text("mine")
    with pytest.raises(FileExistsError):
        urdd.export(arm, "moveit", tmp_path / "arm_config")


def test_visuals_can_have_fewer_triangles(arm: urdd.Robot) -> None:
    def size(made: urdd.Export) -> int:
        return sum(len(data) for path, data in made.files.items() if path.endswith(".obj"))

    full, few = urdd.export(arm, "sdf"), urdd.export(arm, "sdf", visuals=0.5)
    assert size(few) < size(full)
    assert any(note.startswith("visual geometry has ") for note in few.notes)
    with pytest.raises(ValueError, match="a part between 0 and 1"):
        urdd.export(arm, "sdf", visuals=1.5)


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
    import socket
    import urllib.error
    import urllib.parse
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
        # A browser holds connections open on which it has asked for nothing yet.
        port = urllib.parse.urlsplit(address).port
        assert port is not None
        idle = socket.create_connection(("127.0.0.1", port), timeout=30)
    with idle, pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(address, timeout=30)
    with pytest.raises(ValueError, match="unknown backend"):
        arm.show(backend="cheese", open_browser=False)  # type: ignore[call-overload]


def test_a_browser_gets_a_page_that_leads_to_the_token(arm: urdd.Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    import html
    import urllib.parse
    import webbrowser

    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    with arm.show(arm.zero) as shown:
        (address,) = opened
    token = shown.address.split("token=")[1].split("&")[0]
    assert token not in address
    page = Path(urllib.parse.unquote(urllib.parse.urlsplit(address).path))
    assert f'content="0; url={html.escape(shown.address)}"' in page.read_text(encoding="utf-8")
    if sys.platform != "win32":
        assert page.stat().st_mode & 0o777 == 0o600
        assert page.parent.stat().st_mode & 0o777 == 0o700


def test_the_page_gets_what_is_set(arm: urdd.Robot) -> None:
    import json
    import urllib.request

    with arm.show(open_browser=False) as shown:
        address, fragment = shown.address.split("#")
        token = fragment.split("token=")[1].split("&")[0]
        for q in arm.random(3):
            shown.set(q)
        request = urllib.request.Request(f"{address}robots/{arm.path.name}/states", headers={"x-urdd-token": token})
        with urllib.request.urlopen(request, timeout=30) as answer:
            line = next(line for line in answer if line.strip())
        assert json.loads(line)["q"] == arm.random(3)[2].tolist()
        with pytest.raises(urdd.ConfigurationError):
            shown.set([0])
        with pytest.raises(urdd.ConfigurationError):
            shown.set([np.nan] * arm.num_dofs)


def test_a_notebook_gets_the_page_in_a_frame(arm: urdd.Robot) -> None:
    frame = arm.frame(height=123)
    text = frame._repr_html_()
    assert text.startswith("<iframe")
    assert "123px" in text
    assert '"robot.zip"' in frame.text
    # The frame has an origin of its own: its scripts reach neither the notebook nor its server.
    assert 'sandbox="allow-scripts allow-downloads"' in text


def _carried(text: str) -> Any:
    """What a page shows beside its robot."""
    found = re.search(r'id="showing.json">([^<]*)<', text)
    return None if found is None else json.loads(zlib.decompress(base64.b64decode(found[1]), -zlib.MAX_WBITS))


def test_a_frame_shows_a_path_and_a_world(arm: urdd.Robot) -> None:
    """The page's own test (`page/test/showing.test.mjs`) draws each kind."""
    world = urdd.World()
    world.add_box("table", size=[2, 4, 6], pose=[1, 2, 3])
    world.add_sphere("ball", 0.5, [7, 8, 9])
    world.add_points("seen", [[1, 2, 3], [4, 5, 6]], 0.25)
    world.add_mesh("wedge", np.eye(4)[:, :3] + 1, [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    world.add_height_field("hills", [[1, 2, 3]], [0.5, 0.25], 0.1)
    world.move("table", [4, 5, 6])
    path = np.zeros((3, arm.num_dofs))
    path[1, 2] = -0.5
    path[2, 0] = 0.25
    shown = _carried(arm.frame(path[0], path, world).text)
    assert shown["q"] == path[0].tolist()
    # 1 rad/s for the DOF that moves most.
    assert shown["path"] == {"times": [0.0, 0.5, 1.0], "rows": path.tolist()}
    table, ball, seen, wedge, hills = shown["world"]
    assert table["name"] == "table"
    assert table["shape"] == {"kind": "cuboid", "half_extents": [1, 2, 3]}
    assert table["pose"] == [1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1]
    assert ball["shape"] == {"kind": "sphere", "radius": 0.5}
    assert [ball["pose"][k] for k in (3, 7, 11)] == [7, 8, 9]
    assert np.frombuffer(base64.b64decode(seen["shape"]["points"]), "<f4").tolist() == [1, 2, 3, 4, 5, 6]
    assert seen["shape"]["radius"] == 0.25
    assert np.frombuffer(base64.b64decode(wedge["shape"]["faces"]), "<u4").tolist()[:3] == [0, 1, 2]
    assert (hills["shape"]["columns"], hills["shape"]["cell"], hills["shape"]["thickness"]) == (3, [0.5, 0.25], 0.1)
    # The robot alone; and the height alone, as before 1.4.
    assert _carried(arm.frame().text) is None
    assert "height: 123px" in arm.frame(123)._repr_html_()
    for wrong in (np.zeros((0, arm.num_dofs)), np.zeros(arm.num_dofs), [[0.0]]):
        with pytest.raises(urdd.ConfigurationError):
            arm.frame(path=wrong)


def test_the_page_gets_a_world_and_then_another_path(arm: urdd.Robot) -> None:
    world = urdd.World()
    world.add_sphere("ball", 0.5, [7, 8, 9])
    with arm.show(open_browser=False, world=world) as shown:
        assert isinstance(shown, urdd.Shown)
        # It has a copy.
        world.remove("ball")
        shown.set(arm.zero)
        shown.set_around(path=[arm.zero, arm.zero])
        address, token = shown.address.split("#token=")
        request = urllib.request.Request(
            f"{address}robots/{arm.path.name}/states", headers={"x-urdd-token": token.split("&")[0]}
        )
        with urllib.request.urlopen(request, timeout=30) as answer:
            lines = (json.loads(line) for line in answer if line.strip())
            q, around = next(lines), next(lines)
        assert q == {"q": arm.zero.tolist()}
        assert [one["name"] for one in around["world"]] == ["ball"]
        assert around["path"]["rows"] == [arm.zero.tolist()] * 2
    beside: dict[str, Any] = {"backend": "viser", "open_browser": False, "world": world}
    with pytest.raises(ValueError, match="viser shows the robot alone"):
        arm.show(**beside)


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


LEGGED = """<robot name="legged"><link name="trunk">
  <inertial><mass value="2"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><box size="0.4 0.2 0.1"/></geometry></collision></link>
{legs}</robot>"""
LEG = """<link name="{side}_thigh">
  <inertial><mass value="0.5"/><inertia ixx="0.002" iyy="0.002" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><origin xyz="0 0 -0.15"/><geometry><box size="0.02 0.02 0.3"/></geometry></collision></link>
<joint name="{side}_hip_pitch" type="revolute"><parent link="trunk"/><child link="{side}_thigh"/>
  <origin xyz="0 {y} -0.05"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="50" velocity="10"/></joint>"""


@pytest.fixture(scope="module")
def legged(tmp_path_factory: pytest.TempPathFactory) -> urdd.Robot:
    """Two legs of 0.3 m below a trunk; at home they are turned by 0.5 rad."""
    folder = tmp_path_factory.mktemp("legged")
    legs = LEG.format(side="left", y=0.06) + LEG.format(side="right", y=-0.06)
    (folder / "legged.urdf").write_text(LEGGED.format(legs=legs))
    made = urdd.generate(folder / "legged.urdf", folder / "legged", modules=["shapes"])
    positions = [f"{side}_hip_pitch=0.5" for side in ("left", "right")]
    command = [sys.executable, "-m", "urdd", "configurations", "set", str(made.path), "home", *positions]
    subprocess.run(command, check=True, capture_output=True)
    (folder / "legged.export.toml").write_text(
        'robot = "legged"\n[base]\nfloating = true\n'
        '[actuators.joint]\n"*_hip_*" = { kp = 80.0, kv = 3.0 }\n"left*" = { armature = 0.5 }\n'
    )
    return made.load()


def test_mujoco_starts_at_home_on_the_floor_with_its_targets(legged: urdd.Robot, mujoco: Any) -> None:
    peer = legged.to_mujoco(actuators="position", start="home")
    assert peer.joint_names == ("floating_base", "left_hip_pitch", "right_hip_pitch")
    assert peer.actuator_names == ("left_hip_pitch", "right_hip_pitch")
    # The lower edges of a box of 0.3 m, 0.02 m wide, turned by 0.5 rad about the hip, 0.05 m below the base.
    height = 0.05 + 0.3 * np.cos(0.5) + 0.01 * np.sin(0.5)
    np.testing.assert_allclose(peer.start, [0, 0, height, 1, 0, 0, 0, 0.5, 0.5], atol=1e-6)
    data = peer.data()
    np.testing.assert_array_equal(data.qpos, peer.start)
    np.testing.assert_allclose(data.ctrl, [0.5, 0.5])
    low = min(
        (data.geom_xpos[geom] + data.geom_xmat[geom].reshape(3, 3) @ vertex)[2]
        for geom in range(peer.model.ngeom)
        for vertex in _corners(peer.model, geom, mujoco)
    )
    assert abs(low) < 2e-6
    # The gains of the pattern, and the armature of one side.
    np.testing.assert_allclose(peer.model.actuator_gainprm[:, 0], [80, 80])
    np.testing.assert_allclose(peer.model.dof_armature[6:], [0.5, 0])
    # Nothing else is where MuJoCo would have it without a start.
    np.testing.assert_allclose(legged.to_mujoco(start=[0.1, -0.1]).start[7:], [0.1, -0.1])
    assert legged.to_mujoco().start[2] == pytest.approx(0.35, abs=1e-6)
    with pytest.raises(urdd.UnknownNameError, match="there is no named configuration `hom`; there are: home"):
        legged.to_mujoco(start="hom")


def _corners(model: Any, geom: int, mujoco: Any) -> Any:
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        first = model.mesh_vertadr[mesh]
        return model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
    size = model.geom_size[geom]
    return [size * [x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


def test_a_base_is_where_the_setup_has_it(legged: urdd.Robot, tmp_path: Path, mujoco: Any) -> None:
    setup = tmp_path / "other.export.toml"
    setup.write_text('robot = "legged"\n[base]\nfloating = true\nposes.home = [1, 2, 3, 0, 0, 0, 2]\n')
    peer = legged.to_mujoco(start="home", setup=setup)
    np.testing.assert_allclose(peer.start[:7], [1, 2, 3, 0, 0, 0, 1])
    # The keyframe of the file has it too.
    np.testing.assert_allclose(peer.model.key("home").qpos[:7], [1, 2, 3, 0, 0, 0, 1])


def test_a_bridge_is_printed_in_a_few_lines(legged: urdd.Robot, pin: Any) -> None:
    shown = [repr(legged.to_mujoco(actuators="position")), repr(legged.to_pinocchio())]
    for text in shown:
        assert len(text) < 400, text
        assert "left_hip_pitch, right_hip_pitch" in text
    assert "actuators: left_hip_pitch" in shown[0]


def test_newton_starts_at_home_on_the_floor_with_its_targets(legged: urdd.Robot) -> None:
    pytest.importorskip("newton")
    peer = legged.to_newton(actuators="position", start="home")
    height = 0.05 + 0.3 * np.cos(0.5) + 0.01 * np.sin(0.5)
    names = peer.joint_names
    assert sorted(names[1:]) == ["left_hip_pitch", "right_hip_pitch"]
    np.testing.assert_allclose(peer.start, [0, 0, height, 0, 0, 0, 1, 0.5, 0.5], atol=1e-6)
    np.testing.assert_allclose(peer.model.joint_q.numpy(), peer.start, atol=1e-6)
    np.testing.assert_allclose(peer.model.joint_target_q.numpy()[7:], [0.5, 0.5], atol=1e-6)
    assert sorted(peer.drive_names) == ["left_hip_pitch", "right_hip_pitch"]
    assert len(repr(peer)) < 400
