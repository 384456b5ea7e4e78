"""Poses, Jacobians, inverse kinematics."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import urdd
from conftest import NAMES


def rotation(wxyz: list[float]) -> NDArray[np.float64]:
    w, x, y, z = wxyz
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


@pytest.mark.parametrize("name", NAMES)
def test_poses_are_those_of_the_peers(name: str, urdds: Path, figures: Any) -> None:
    (figure,) = (one for one in figures["robots"] if one["path"].endswith(f"/{name}.urdf"))
    robot = urdd.load(urdds / name)
    configurations = figure["configurations"]
    assert configurations
    poses = robot.link_poses([one["configuration"] for one in configurations])
    for one, found in zip(configurations, poses, strict=True):
        for link, pose in one["links"].items():
            matrix = found[robot.link(link)]
            np.testing.assert_allclose(matrix[:3, 3], pose["position"], atol=1e-12)
            np.testing.assert_allclose(matrix[:3, :3], rotation(pose["quaternion_wxyz"]), atol=1e-12)
            np.testing.assert_array_equal(matrix[3], [0, 0, 0, 1])


@pytest.mark.parametrize("count", [0, 1, 16, 17, 1000])
def test_a_batch_gives_what_each_configuration_gives(count: int, toy: urdd.Robot) -> None:
    q = toy.random(count, seed=3)
    poses, jacobians = toy.link_poses(q), toy.jacobian(q, "finger")
    assert poses.shape == (count, toy.num_links, 4, 4)
    assert jacobians.shape == (count, 6, toy.num_dofs)
    for k in range(0, count, 97):
        np.testing.assert_array_equal(poses[k], toy.link_poses(q[k]))
        np.testing.assert_array_equal(jacobians[k], toy.jacobian(q[k], "finger"))
        np.testing.assert_array_equal(poses[k, toy.link("finger")], toy.link_pose(q[k], "finger"))


def test_axes_before_the_last_are_kept(arm: urdd.Robot) -> None:
    q = arm.random(24).reshape(2, 3, 4, arm.num_dofs)
    assert arm.link_poses(q).shape == (2, 3, 4, arm.num_links, 4, 4)
    assert arm.jacobian(q, "torch").shape == (2, 3, 4, 6, arm.num_dofs)
    assert arm.distances(q).shape == (2, 3, 4, arm.proximity().num_pairs)
    assert arm.in_collision(q).shape == (2, 3, 4)
    assert arm.clamp(q).shape == q.shape
    np.testing.assert_array_equal(arm.link_poses(q)[1, 2, 3], arm.link_poses(q[1, 2, 3]))
    assert arm.link_pose(q, "torch").shape == (2, 3, 4, 4, 4)
    np.testing.assert_array_equal(arm.link_pose(q, "torch"), arm.link_poses(q)[..., arm.link("torch"), :, :])


@pytest.mark.parametrize("name", ["toy_all_joints", "planar_base_arm", "welding_arm"])
@pytest.mark.parametrize("point", [None, (0.1, -0.2, 0.3)])
def test_jacobians_are_differences_of_poses(name: str, point: tuple[float, ...] | None, urdds: Path) -> None:
    robot = urdd.load(urdds / name)
    q, step = robot.random(seed=5), 1e-6
    for link in robot.link_names:
        at = np.append(np.zeros(3) if point is None else point, 1.0)
        found = robot.jacobian(q, link, point)
        for dof in range(robot.num_dofs):
            ahead, behind = q.copy(), q.copy()
            ahead[dof] += step
            behind[dof] -= step
            a, b = robot.link_pose(ahead, link), robot.link_pose(behind, link)
            np.testing.assert_allclose(found[:3, dof], ((a - b) @ at)[:3] / (2 * step), atol=1e-7)
            turn = (a[:3, :3] - b[:3, :3]) @ robot.link_pose(q, link)[:3, :3].T / (2 * step)
            np.testing.assert_allclose(found[3:, dof], [turn[2, 1], turn[0, 2], turn[1, 0]], atol=1e-7)


def test_configurations(arm: urdd.Robot, toy: urdd.Robot) -> None:
    for robot in (arm, toy):
        assert robot.bounds.shape == (robot.num_dofs, 2)
        assert robot.zero.shape == robot.middle.shape == (robot.num_dofs,)
        assert robot.is_within_bounds(robot.random(1000)).all()
    np.testing.assert_array_equal(arm.lower, arm.bounds[:, 0])
    np.testing.assert_array_equal(arm.upper, arm.bounds[:, 1])
    np.testing.assert_allclose(arm.middle, arm.bounds.mean(axis=1), atol=1e-15)
    np.testing.assert_array_equal(arm.clamp(arm.upper + 1), arm.upper)
    assert not arm.is_within_bounds(arm.upper + 1)
    assert set(toy.dof_units) == {"rad", "m"}


def test_samples_are_those_of_the_specification(arm: urdd.Robot) -> None:
    # SPEC 9.3, in a few lines of another language.
    def u(k: int, dof: int) -> float:
        mask = 2**64 - 1
        z = (k * 2**32 + dof + 1) * 0x9E3779B97F4A7C15 & mask
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 & mask
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB & mask
        return ((z ^ (z >> 31)) >> 11) * 2.0**-53

    found = arm.random(5)
    for seed, begin in ((0, 0), (1, 0x9E3779B9), (2, 2 * 0x9E3779B9 % 2**32)):
        weight = np.array([[u(begin + k, dof) for dof in range(arm.num_dofs)] for k in range(5)])
        expected = arm.lower * (1 - weight) + arm.upper * weight
        np.testing.assert_allclose(arm.random(5, seed), expected, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(found, arm.random(9)[:5])
    np.testing.assert_array_equal(found[0], arm.random())
    golden = [one for one in arm.modules.kinematics_samples.samples if one.kind == "Sampled"]
    assert golden
    for one in golden:
        assert one.sample_idx is not None
        np.testing.assert_array_equal(one.configuration, arm.random(one.sample_idx + 1)[-1])


def test_inverse_kinematics_reaches_what_can_be_reached(arm: urdd.Robot) -> None:
    q = arm.random(50, seed=1)
    targets = arm.link_pose(q, "torch")
    found = arm.inverse_kinematics("torch", targets)
    assert found.q.shape == (50, arm.num_dofs)
    assert found.reached.all()
    reached = arm.link_pose(found.q, "torch")
    np.testing.assert_allclose(reached[:, :3, 3], targets[:, :3, 3], atol=1e-6)
    np.testing.assert_allclose(reached[:, :3, :3], targets[:, :3, :3], atol=3e-6)
    assert arm.is_within_bounds(found.q).all()
    one = arm.inverse_kinematics("torch", targets[7])
    np.testing.assert_array_equal(one.q, found.q[7])
    assert one.reached
    assert one.position_error <= 1e-6
    grid = arm.inverse_kinematics("torch", targets[:6].reshape(2, 3, 4, 4), q[:6].reshape(2, 3, -1))
    assert grid.q.shape == (2, 3, arm.num_dofs)
    assert grid.reached.shape == grid.restarts.shape == (2, 3)
    np.testing.assert_array_equal(grid.q[1, 2], arm.inverse_kinematics("torch", targets[5], q[5]).q)


def test_inverse_kinematics_of_a_place_and_of_a_point(arm: urdd.Robot) -> None:
    place, point = arm.link_pose(arm.random(seed=9), "torch")[:3, 3], (0.0, 0.0, 0.05)
    found = arm.inverse_kinematics("torch", place, arm.middle, point=point)
    assert found.reached
    np.testing.assert_allclose((arm.link_pose(found.q, "torch") @ [*point, 1])[:3], place, atol=1e-6)
    far = arm.inverse_kinematics("torch", [100.0, 0, 0], restarts=2)
    assert not far.reached
    assert far.position_error > 90


def test_limits_masses_and_groups(arm: urdd.Robot, tmp_path: Path) -> None:
    bounds = arm.modules.bounds
    for limits, stated in (
        (arm.velocity_limits, bounds.dof_velocity_limits),
        (arm.effort_limits, bounds.dof_effort_limits),
    ):
        np.testing.assert_array_equal(limits, [np.inf if limit is None else limit for limit in stated])
    masses = arm.link_masses
    links = arm.modules.urdf.links
    stated_masses = [
        0 if link.inertial is None or link.inertial.mass is None else link.inertial.mass.value for link in links
    ]
    np.testing.assert_array_equal(masses, stated_masses)
    q = arm.random(5, seed=2)
    centres = arm.link_centres_of_mass
    expected = np.zeros((5, 3))
    for k, link in enumerate(arm.link_names):
        pose = arm.link_pose(q, link)
        expected += masses[k] * (pose[:, :3, :3] @ centres[k] + pose[:, :3, 3]) / masses.sum()
    np.testing.assert_allclose(arm.centre_of_mass(q), expected, atol=1e-14)
    assert arm.centre_of_mass(q[0]).shape == (3,)

    # By the Jacobian of each centre of mass.
    held = sum(9.81 * masses[k] * arm.jacobian(q, k, centres[k])[:, 2] for k in range(arm.num_links))
    np.testing.assert_allclose(arm.gravity_torques(q), held, atol=1e-12)
    assert arm.gravity_torques(q[0]).shape == (arm.num_dofs,)
    payload = 9.81 * 2.0 * arm.jacobian(q, "torch", [0.1, 0, -0.2])[:, 2]
    loaded = arm.gravity_torques(q, payload=2.0, link="torch", point=[0.1, 0, -0.2], gravity=[0, 0, 9.81])
    np.testing.assert_allclose(loaded, -(held + payload), atol=1e-12)

    pose = arm.link_pose(q, "torch", relative_to="wrist")
    for k in range(5):
        base, tip = arm.link_pose(q[k], "wrist"), arm.link_pose(q[k], "torch")
        np.testing.assert_allclose(pose[k], np.linalg.inv(base) @ tip, atol=1e-14)
    assert arm.dofs_between("torch", arm.root_link).tolist() == list(range(arm.num_dofs))
    assert arm.dofs_between("torch", "torch").tolist() == []

    guessed = arm.joint_groups()
    assert any(dofs.tolist() == list(range(arm.num_dofs)) for dofs in guessed.values()), guessed
    names = arm.joint_names
    first, last = arm.dof_names[0], arm.dof_names[-1]
    srdf = tmp_path / "arm.srdf"
    text = (
        f'<robot name="{arm.modules.urdf.name}"><group name="one"><joint name="{last}"/></group>'
        f'<group name="chain"><chain base_link="{arm.root_link}" tip_link="torch"/></group>'
        f'<group name="both"><group name="one"/><joint name="{first}"/></group></robot>'
    )
    srdf.write_text(text)
    groups = {name: dofs.tolist() for name, dofs in arm.joint_groups(srdf).items()}
    count = arm.num_dofs
    assert groups == {"one": [count - 1], "chain": list(range(count)), "both": [0, count - 1]}
    assert first in names
    for wrong, message in (
        (text.replace(last, last + "s"), "line 1: there is no joint"),
        (text.replace('<joint name="' + last, '<group name="both"/><joint name="' + last), "contains itself"),
        (text.replace('"torch"', '"torh"'), "did you mean `torch`"),
        (text.replace("<robot name=", '<robot name="x" nam='), "arm.srdf"),
    ):
        srdf.write_text(wrong)
        with pytest.raises(urdd.ExportError, match=message):
            arm.joint_groups(srdf)
    with pytest.raises(FileNotFoundError, match=r"nowhere\.srdf"):
        arm.joint_groups(tmp_path / "nowhere.srdf")


def test_inverse_kinematics_with_conditions(arm: urdd.Robot) -> None:
    q = arm.random(8, seed=5)
    targets = arm.link_pose(q, "torch")
    plain = arm.inverse_kinematics("torch", targets)
    assert plain.reached.all()
    assert set(plain.verdict) == {"reached"}
    turned = arm.inverse_kinematics("torch", targets, weights=[0, 0, 0, 1, 1, 1])
    assert turned.reached.all()
    np.testing.assert_allclose(arm.link_pose(turned.q, "torch")[:, :3, :3], targets[:, :3, :3], atol=3e-6)
    far = targets[0].copy()
    far[:3, 3] = [9, 0, 0]
    assert arm.inverse_kinematics("torch", far).verdict == "out of reach"
    assert arm.inverse_kinematics("torch", far, weights=[0, 0, 0, 1, 1, 1]).reached

    name = arm.dof_names[2]
    locked = arm.inverse_kinematics("torch", targets, q, locked=[name])
    np.testing.assert_array_equal(locked.q[:, 2], q[:, 2])
    near = arm.inverse_kinematics("torch", targets, posture=q[0])
    assert near.reached.all()
    away = [np.linalg.norm(solution.q - q[0], axis=1) for solution in (near, plain)]
    assert (away[0] <= away[1] + 1e-6).all()
    np.testing.assert_allclose(near.q[0], q[0], atol=1e-4)

    itself = arm.proximity()
    world = urdd.World()
    world.add_sphere("ball", radius=0.1, centre=targets[0, :3, 3], ignore=["torch"])
    around = arm.world_proximity(world)
    free = arm.inverse_kinematics("torch", targets, free_of=[itself, around])
    assert (free.reached <= ~(itself.in_collision(free.q) | around.in_collision(free.q))).all()
    world.add_sphere("all", radius=5)
    refused = arm.inverse_kinematics("torch", targets[0], free_of=arm.world_proximity(world))
    assert refused.verdict == "refused"
    assert not refused.reached
    by = refused.refused_by
    assert isinstance(by, urdd.ObstacleDistance)
    assert (by.obstacle, by.distance) == ("all", 0)
    assert by.link in arm.link_names
    for wrong in ({"weights": [1, 1]}, {"weights": [-1] * 6}, {"posture": [0]}, {"free_of": [1]}):
        with pytest.raises(urdd.ConfigurationError):
            arm.inverse_kinematics("torch", far, **wrong)  # type: ignore[arg-type]
    with pytest.raises(urdd.UnknownNameError):
        arm.inverse_kinematics("torch", far, locked=["nobody"])


def test_inverse_kinematics_follows_a_joint_that_is_not_limited(arm: urdd.Robot) -> None:
    """`axis_6` is continuous: one and a half turns, in small steps and each from the one before."""
    np.testing.assert_array_equal(arm.dof_is_limited, arm.modules.bounds.dof_limited)
    np.testing.assert_array_equal(arm.dof_is_limited, [True] * 5 + [False])
    q = np.array([0.1, 0.2, -0.4, 0.3, 0.5, -1.0])
    for angle in np.arange(-1.0, 8.0, 0.1):
        wanted = np.array([*q[:5], angle])
        found = arm.inverse_kinematics("torch", arm.link_pose(wanted, "torch"), q)
        assert found.reached
        np.testing.assert_allclose(found.q, wanted, atol=1e-4)
        q = found.q
    # Given bounds bind it.
    bound = arm.inverse_kinematics("torch", arm.link_pose(q, "torch"), q, bounds=arm.bounds)
    assert bound.reached
    assert arm.is_within_bounds(bound.q)


def test_inverse_kinematics_keeps_a_margin_from_obstacles(arm: urdd.Robot) -> None:
    world = urdd.World()
    for name, x in (("one", 0.45), ("other", -0.45)):
        world.add_sphere(name, radius=0.2, centre=[x, 0.1, 0.5])
    itself, around = arm.proximity(), arm.world_proximity(world)
    targets = arm.link_pose(arm.random(30), "torch")
    plain = arm.inverse_kinematics("torch", targets)
    assert (around.min_distance(plain.q) <= 0.03).sum() >= 3
    free = arm.inverse_kinematics("torch", targets, free_of=[itself, around], margin=0.03)
    kept = (around.min_distance(free.q) > 0.03) & ~itself.in_collision(free.q)
    np.testing.assert_array_equal(free.reached, kept)
    assert {"reached", "refused"} <= set(free.verdict)
    assert isinstance(free.refused_by, np.ndarray)
    assert free.refused_by.shape == (30,)
    named = np.array([by is not None for by in free.refused_by])
    np.testing.assert_array_equal(named, free.verdict == "refused")
    for by, q in zip(free.refused_by[named], free.q[named], strict=True):
        if isinstance(by, urdd.ObstacleDistance):
            assert by.distance <= 0.03
            assert by.distance == around.min_distance(q)
        else:
            assert by.distance == 0
            assert itself.in_collision(q)


@pytest.mark.parametrize(
    "wrong",
    [
        *({key: value} for key in ("position_tolerance", "rotation_tolerance") for value in (np.nan, -1.0)),
        *({"margin": value} for value in (np.nan, -0.1, np.inf)),
        *({"weights": value} for value in ([np.nan] * 6, [0] * 6, [1, 1, 1, 1, 1, -1], [1] * 5)),
        *({"posture": value} for value in ([], [0] * 5, [np.nan] * 6, [[0] * 6])),
        *({"bounds": value} for value in ([[1, -1]] * 6, [[0, np.nan]] * 6, [[0, np.inf]] * 6, [[0, 1]] * 5)),
        {"point": [0, np.inf, 0]},
        {"start": [0] * 5},
    ],
    ids=str,
)
def test_settings_of_inverse_kinematics_that_make_no_sense(arm: urdd.Robot, wrong: dict[str, Any]) -> None:
    with pytest.raises(urdd.ConfigurationError):
        arm.inverse_kinematics("torch", arm.link_pose(arm.zero, "torch"), **wrong)


def test_numbers_of_inverse_kinematics_that_are_out_of_range(arm: urdd.Robot) -> None:
    target = arm.link_pose(arm.zero, "torch")
    for wrong in ({"iterations": 0}, {"iterations": -1}, {"restarts": -1}, {"seed": -1}):
        with pytest.raises(ValueError, match="must be from"):
            arm.inverse_kinematics("torch", target, **wrong)  # type: ignore[arg-type]
