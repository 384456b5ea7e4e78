"""Code that users copy runs, and gives the documented result."""

from __future__ import annotations

import json
import os
import runpy
import subprocess
import sys
import sysconfig
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import urdd
from conftest import NAMES, REPOSITORY, ROBOTS

EXAMPLES = REPOSITORY / "python" / "examples"
SCRIPTS = sysconfig.get_path("scripts")


def run(name: str, *words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, EXAMPLES / name, *words], capture_output=True, text=True, check=True, timeout=300
    )


def test_forward_kinematics(arm: urdd.Robot) -> None:
    lines = run("forward_kinematics.py", arm.path).stdout.splitlines()
    assert [line.split()[0] for line in lines] == list(arm.link_names)
    poses = arm.link_poses(arm.middle)
    np.testing.assert_allclose([float(x) for x in lines[-1].split()[1:4]], poses[-1, :3, 3], atol=1e-4)


def chain(name: str, joints: list[tuple[str, str, float, float]]) -> str:
    """An arm of boxes along the offsets of its joints: (xyz, rpy) of each in its parent, and its limits."""
    links, parts = ['<link name="base"/>'], []
    offsets = [[float(x) for x in xyz.split()] for xyz, *_ in joints] + [[0, 0, 0.05]]
    for k, (xyz, rpy, lower, upper) in enumerate(joints):
        to = np.array(offsets[k + 1])
        size = np.maximum(np.abs(to) - 0.02, 0.06)
        middle = " ".join(str(x) for x in to / 2)
        box = f'<geometry><box size="{" ".join(str(x) for x in size)}"/></geometry><origin xyz="{middle}"/>'
        links.append(f'<link name="l{k}"><visual>{box}</visual><collision>{box}</collision></link>')
        parent = f"l{k - 1}" if k else "base"
        limit = f'<limit lower="{lower}" upper="{upper}" effort="1" velocity="1"/>'
        parts.append(
            f'<joint name="j{k}" type="revolute"><parent link="{parent}"/><child link="l{k}"/>'
            f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="0 0 1"/>{limit}</joint>'
        )
    return f'<robot name="{name}">{"".join(links + parts)}</robot>'


TURN, QUARTER = 2 * np.pi, np.pi / 2
#: Six joints that turn twice, with the lengths of a UR5; seven with those of a Panda.
ARMS = {
    "two_turns": [
        ("0 0 0.089", "0 0 0", -TURN, TURN),
        ("0 0.136 0", f"{QUARTER} 0 0", -TURN, TURN),
        ("0.425 0 -0.12", "0 0 0", -TURN, TURN),
        ("0.392 0 0", "0 0 0", -TURN, TURN),
        ("0 0 0.093", f"{QUARTER} 0 0", -TURN, TURN),
        ("0 0 0.095", f"{-QUARTER} 0 0", -TURN, TURN),
    ],
    "seven_joints": [
        ("0 0 0.333", "0 0 0", -2.9, 2.9),
        ("0 0 0", f"{-QUARTER} 0 0", -1.76, 1.76),
        ("0 -0.316 0", f"{QUARTER} 0 0", -2.9, 2.9),
        ("0.0825 0 0", f"{QUARTER} 0 0", -3.07, -0.07),
        ("-0.0825 0.384 0", f"{-QUARTER} 0 0", -2.9, 2.9),
        ("0 0 0", f"{QUARTER} 0 0", -0.02, 3.75),
        ("0.088 0 0", f"{QUARTER} 0 0", -2.9, 2.9),
    ],
}


@pytest.mark.parametrize("name", ["welding_arm", "six_axis_arm", *ARMS])
def test_a_planner_finds_ways_between_ends_that_a_person_would_choose(
    name: str, urdds: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = urdds / name
    if name in ARMS:
        folder = tmp_path / name
        (tmp_path / "arm.urdf").write_text(chain(name, ARMS[name]), encoding="utf-8")
        urdd.generate(tmp_path / "arm.urdf", folder, samples=100)
    plan = runpy.run_path(str(EXAMPLES / "rrt_connect.py"))["main"]

    robot = urdd.load(folder)
    for seed in range(10):
        monkeypatch.setattr(sys, "argv", ["rrt_connect.py", str(folder), str(seed)])
        begin = time.monotonic()
        plan()
        assert time.monotonic() - begin < 30
        out, err = capsys.readouterr()
        path = np.loadtxt(out.splitlines(), delimiter=",", skiprows=1)
        assert "not proved" not in err
        assert np.isnan(robot.proximity().blocked_edge(path[:-1], path[1:], resolution=0.005)).all()
        assert np.abs(path[-1] - path[0]).max() <= np.pi


def test_a_planner_needs_no_other_library(arm: urdd.Robot) -> None:
    """Its path is checked again at a tenth of the resolution."""
    found = run("rrt_connect.py", arm.path, "3")
    path = np.loadtxt(found.stdout.splitlines(), delimiter=",", skiprows=1)
    assert len(path) >= 2
    assert "proved free" in found.stderr
    assert "not proved" not in found.stderr
    checks = arm.proximity("pieces").blocked_edge(path[:-1], path[1:], resolution=0.002)
    assert np.isnan(checks).all()


@pytest.mark.parametrize("name", ["welding_arm", "six_axis_arm"])
def test_what_is_planned_by_spheres_is_proved_by_shapes(name: str, tmp_path: Path) -> None:
    urdd.generate(ROBOTS / f"{name}.urdf", tmp_path / name, modules=["all", "spheres"])
    robot = urdd.load(tmp_path / name)
    world = urdd.World()
    world.add_sphere("ball", radius=0.15, centre=[0.45, 0.1, 0.6])
    lengths = []
    for seed in range(5):
        found = run("plan_by_spheres.py", robot.path, str(seed))
        path = np.loadtxt(found.stdout.splitlines(), delimiter=",", skiprows=1)
        assert "proved free" in found.stderr
        for check in (robot.proximity("pieces"), robot.world_proximity(world)):
            assert np.isnan(check.blocked_edge(path[:-1], path[1:], resolution=0.002)).all()
        lengths.append(len(path))
    assert max(lengths) > 2, "no straight motion was in the way of anything: the searches were not tried"


@pytest.mark.parametrize("name", sorted(path.stem for path in ROBOTS.glob("*.urdf")))
def test_forward_kinematics_by_json_and_numpy(name: str, tmp_path: Path) -> None:
    """Joints of every kind: its poses are those in each URDD."""
    urdd.generate(ROBOTS / f"{name}.urdf", tmp_path / name, modules=["kinematics_samples"])
    script = REPOSITORY / "examples" / "forward_kinematics.py"
    command: list[str | Path] = [sys.executable, script, tmp_path / name, "--check"]
    found = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    assert "differ" in found.stdout


def test_a_controller_keeps_its_distance(arm: urdd.Robot) -> None:
    target = np.array([0.3, 0.4, 0.3])
    found = run("resolved_rate.py", arm.path, "torch", *map(str, target))
    path = np.loadtxt(found.stdout.splitlines(), delimiter=",", skiprows=1)
    assert len(path) > 30
    assert "0.000 m from the target" in found.stderr
    world = urdd.World()
    world.add_sphere("ball", radius=0.1, centre=(arm.link_pose(arm.zero, "torch")[:3, 3] + target) / 2)
    around = arm.world_proximity(world)
    # Straight there, the ball is in the way; the path keeps 2 cm, but for what a step of a curved motion takes.
    least = around.min_distance(path)
    assert 0.0195 < least.min() < 0.021
    assert not arm.in_collision(path).any()
    speeds = np.linalg.norm(np.diff(arm.link_pose(path, "torch")[:, :3, 3], axis=0), axis=1) * 60
    assert np.median(speeds) < 0.51


def test_a_part_is_carried_from_place_to_place(arm: urdd.Robot) -> None:
    found = run("pick_and_place.py", arm.path, "torch")
    assert found.stderr.count("; free at 2 mm") == 3
    path = np.loadtxt(found.stdout.splitlines(), delimiter=",", skiprows=1)
    limited = arm.dof_is_limited
    np.testing.assert_array_equal(path[:, limited], arm.clamp(path)[:, limited])
    assert not arm.in_collision(path).any()


@pytest.mark.parametrize("name", NAMES)
def test_poses_and_spheres_by_arrays(name: str, urdds: Path) -> None:
    """As PyTorch and JAX compute them (`.ci/full`)."""
    robot = urdd.load(urdds / name)
    if {joint.joint_type for joint in robot.modules.chain.joints_in_chain} & {"Floating", "Spherical"}:
        with pytest.raises(urdd.ExportError, match="its rotation is a vector"):
            robot.chain_arrays()
        return
    assert "numpy: poses within" in run("array_kinematics.py", robot.path).stdout


def test_inverse_kinematics(arm: urdd.Robot) -> None:
    own, ours = run("inverse_kinematics.py", arm.path, "torch").stdout.splitlines()
    assert float(own.split("error ")[1].split(",")[0]) < 1e-6
    assert "reached True" in ours


def test_collision_free(arm: urdd.Robot) -> None:
    found = run("collision_free.py", arm.path, "200")
    head, *rows = found.stdout.splitlines()
    assert head.split(",") == list(arm.dof_names)
    q = np.array([[float(word) for word in row.split(",")] for row in rows])
    assert q.shape == (200, arm.num_dofs)
    assert not arm.in_collision(q).any()


def test_nearest_pairs(arm: urdd.Robot) -> None:
    _, *rows = run("nearest_pairs.py", arm.path, "5").stdout.splitlines()
    found = [float(row.split()[2]) for row in rows]
    np.testing.assert_allclose(found, np.sort(arm.distances(arm.zero))[:5], atol=1e-4)


def test_obstacles(arm: urdd.Robot) -> None:
    head, *rows, shares, free = run("obstacles.py", arm.path, "200").stdout.splitlines()
    assert head.split()[:2] == ["link", "obstacle"]
    assert len(rows) == 5
    assert all(row.split()[0] in arm.link_names for row in rows)
    found = [float(row.split()[2]) for row in rows]
    assert found == sorted(found)
    q = arm.random(200)
    assert shares.startswith(f"{found_share(arm, q)} of 200 touch an obstacle, {np.mean(arm.in_collision(q)):.1%}")
    assert int(free.split()[0]) > 0


def found_share(robot: urdd.Robot, q: Any) -> str:
    """How many configurations touch the obstacles of the example, with every distance computed."""
    world = urdd.World()
    world.add_box("table", [2.0, 2.0, 0.1], [0.0, 0.0, -0.05], ignore=[robot.root_link])
    world.add_capsule("lamp", 0.05, 1.0, [0.5, 0.5, 0.5])
    world.add_sphere("ball", 0.1, [0.6, 0.0, 0.4])
    return f"{np.mean((robot.world_proximity(world).distances(q) == 0).any(axis=1)):.1%}"


def test_planner_spheres(arm: urdd.Robot) -> None:
    words = run("planner_spheres.py", arm.path).stdout.split()
    assert int(words[0]) == len(arm.spheres().radii)


def test_the_notebook(urdds: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its cells, one after the other. `peers/test_notebook.py` runs it in a kernel."""
    monkeypatch.chdir(urdds)
    notebook: Any = json.loads((EXAMPLES / "robot.ipynb").read_text(encoding="utf-8"))
    names: dict[str, object] = {}
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(cells) >= 4
    for cell in cells:
        exec(compile(cell, "robot.ipynb", "exec"), names)


@pytest.mark.skipif(sys.platform == "win32", reason="Slurm runs on Linux")
def test_a_slurm_array_makes_every_robot_once(tmp_path: Path) -> None:
    output = tmp_path / "urdds"
    sources = tmp_path / "robots"
    sources.mkdir()
    for name in ("gripper", "six_axis_arm", "planar_base_arm"):
        (sources / f"{name}.urdf").write_bytes((ROBOTS / f"{name}.urdf").read_bytes())
    (sources / "bad.urdf").write_text("<robot/>")
    for task in ("1", "2"):
        environment = {
            **os.environ,
            "PATH": f"{SCRIPTS}{os.pathsep}{os.environ['PATH']}",
            "SLURM_ARRAY_TASK_ID": task,
            "SLURM_ARRAY_TASK_COUNT": "2",
        }
        words: list[str | Path] = ["bash", EXAMPLES / "many_robots_slurm.sh", sources, output]
        subprocess.run(words, env=environment, check=True, timeout=300)
    told = [json.loads(line) for task in "12" for line in (output / f"{task}.jsonl").read_text().splitlines()]
    robots = [one for one in told if "summary" not in one]
    assert len(robots) == 4
    made = {path.name for path in output.iterdir() if path.is_dir()}
    assert made == {"gripper", "six_axis_arm", "planar_base_arm"}
    # The same shares as Python's.
    shares = [urdd.find_urdfs(sources, shard=(part, 2)) for part in (1, 2)]
    assert sorted(job.name for share in shares for job in share) == [
        "bad",
        "gripper",
        "planar_base_arm",
        "six_axis_arm",
    ]
    assert [len(share) for share in shares] == [2, 2]
