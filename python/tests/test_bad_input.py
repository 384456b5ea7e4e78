"""Common mistakes: each raises an error that says what, where and what to do."""

from __future__ import annotations

import json
import pickle
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import urdd
from conftest import REPOSITORY, ROBOTS


@pytest.mark.parametrize(
    ("q", "words"),
    [
        ([0.0] * 5, r"shape must be \(6,\) or \(n, 6\), not \(5,\)"),
        (np.zeros((6, 5)), r"\(6, 5\)"),
        (0.0, r"not \(\)"),
        ([], r"not \(0,\)"),
        ([0, 0, 0, 0, 0, float("nan")], r"is nan: every value must be finite"),
        ([[0] * 6, [0, float("inf"), 0, 0, 0, 0]], r"configuration 1: DOF `.+` is inf"),
        (np.zeros(6, dtype=complex), r"not of complex128"),
        (["a"] * 6, r"not of <U1"),
        ([[0, 0], [0]], r"array of numbers"),
        (None, r"array of numbers"),
        (np.array([object()] * 6), r"not of object"),
    ],
)
def test_no_configurations(q: Any, words: str, arm: urdd.Robot) -> None:
    for ask in (arm.link_poses, arm.in_collision, arm.distances, arm.clamp, arm.nearest):
        with pytest.raises(urdd.ConfigurationError, match=words):
            ask(q)
    with pytest.raises(ValueError, match=words):
        arm.jacobian(q, "torch")


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"payload": 1.0}, "a payload needs a link"),
        ({"payload": -1.0, "link": "torch"}, "not below 0 kg"),
        ({"payload": float("nan"), "link": "torch"}, "mass is finite"),
        ({"payload": 1.0, "link": "torch", "point": [0, 0]}, "a point must be 3 finite numbers"),
        ({"gravity": [0, 0, float("inf")]}, "gravity must be 3 finite numbers"),
    ],
)
def test_nothing_to_hold(settings: Any, words: str, arm: urdd.Robot) -> None:
    with pytest.raises(urdd.ConfigurationError, match=words):
        arm.gravity_torques(arm.zero, **settings)


def test_huge_values_are_finite(arm: urdd.Robot) -> None:
    q = np.full((2, arm.num_dofs), 1.7e308)
    np.testing.assert_array_equal(arm.clamp(q), np.stack([arm.upper, arm.upper]))
    q[1, 2] = -np.inf
    with pytest.raises(urdd.ConfigurationError, match=r"configuration 1: DOF `.+` is -inf"):
        arm.clamp(q)


def test_every_kind_of_array(arm: urdd.Robot) -> None:
    q = arm.random(40)
    expected = arm.link_poses(q)
    read_only = q.copy()
    read_only.flags.writeable = False
    wide = np.zeros((40, 2 * arm.num_dofs))
    wide[:, ::2] = q
    swapped = q.astype(">f8")
    for same in (q.tolist(), read_only, wide[:, ::2], np.asfortranarray(q), swapped, q[::-1][::-1]):
        np.testing.assert_array_equal(arm.link_poses(same), expected)
    single = q.astype(np.float32)
    np.testing.assert_array_equal(arm.link_poses(single), arm.link_poses(single.astype(np.float64)))
    np.testing.assert_array_equal(arm.link_poses(np.ones((2, 6), dtype=int)), arm.link_poses(np.ones((2, 6))))
    assert arm.link_poses(np.empty((0, arm.num_dofs))).shape == (0, arm.num_links, 4, 4)


def test_no_names(arm: urdd.Robot) -> None:
    with pytest.raises(urdd.UnknownNameError, match="did you mean `torch`") as caught:
        arm.jacobian(arm.zero, "trch")
    assert (caught.value.what, caught.value.nearest) == ("link", "torch")
    with pytest.raises(LookupError, match="there is no DOF"):
        arm.dof("zzz")
    with pytest.raises(urdd.UnknownNameError, match="kind of shapes `cubes`"):
        arm.proximity("cubes")  # type: ignore[arg-type]
    with pytest.raises(IndexError, match="link index 99 is out of range"):
        arm.link_pose(arm.zero, 99)
    np.testing.assert_array_equal(arm.link_pose(arm.zero, -1), arm.link_poses(arm.zero)[-1])
    with pytest.raises(urdd.UnknownNameError, match="there is no rule"):
        urdd.explain("XYZ999")
    assert "DOF" in urdd.explain("DOF003").explanation


@pytest.mark.parametrize(
    ("target", "words"),
    [
        (np.eye(4)[:3], "shape"),
        ([0.0, float("nan"), 0.0], "not finite"),
        (np.diag([1.0, 1.0, 2.0, 1.0]), "not a pose"),
        (np.diag([1.0, 1.0, -1.0, 1.0]), "not a pose"),
    ],
)
def test_no_targets(target: Any, words: str, arm: urdd.Robot) -> None:
    with pytest.raises(urdd.ConfigurationError, match=words):
        arm.inverse_kinematics("torch", target)


def test_no_urdds(tmp_path: Path, urdds: Path) -> None:
    with pytest.raises(urdd.OpenError, match="no such file"):
        urdd.load(tmp_path / "nothing")
    (tmp_path / "empty").mkdir()
    with pytest.raises(OSError, match="there is no URDD in this folder"):
        urdd.load(tmp_path / "empty")
    with pytest.raises(urdd.OpenError, match=r"urdd\.generate\("):
        urdd.load(ROBOTS / "welding_arm.urdf")
    with pytest.raises(urdd.OpenError, match="folder that it is in"):
        urdd.load(urdds / "welding_arm" / "urdd.json")
    (tmp_path / "bad.zip").write_bytes(b"PK\x03\x04 and nothing else")
    with pytest.raises(urdd.OpenError):
        urdd.load(tmp_path / "bad.zip")
    with pytest.raises(urdd.OpenError):
        urdd.validate(tmp_path / "empty")


def test_a_urdd_that_fails_validation(urdds: Path, tmp_path: Path) -> None:
    shutil.copytree(urdds / "gripper", tmp_path / "gripper")
    file = tmp_path / "gripper" / "dof_module" / "module.json"
    document = json.loads(file.read_text())
    document["num_dofs"] = "one"
    file.write_text(json.dumps(document))
    robot = urdd.load(tmp_path / "gripper")
    with pytest.raises(urdd.ModuleUnusableError, match=r"dof_module.*module\.json.*urdd\.validate") as caught:
        robot.link_poses([0.0])
    assert caught.value.module == "dof_module"
    assert "dof_module" in repr(robot)
    with pytest.raises(urdd.ModuleUnusableError):
        _ = robot.modules.dof
    (one,) = urdd.validate(tmp_path / "gripper").urdds
    assert one.verdict == "fail"
    assert any(finding.pointer == "/num_dofs" and finding.line is not None for finding in one.findings)
    with pytest.raises(
        urdd.ValidationError, match=r"(?s)does not pass validation.*dof_module/module.json#/num_dofs"
    ) as failed:
        urdd.load(tmp_path / "gripper", validate=True)
    assert failed.value.findings == one.findings
    again: urdd.ValidationError = pickle.loads(pickle.dumps(failed.value))
    assert (str(again), again.findings) == (str(failed.value), one.findings)
    assert urdd.load(urdds / "gripper", validate=True).num_dofs == 1


def test_advice_is_for_python(urdds: Path, tmp_path: Path) -> None:
    """No error refers users to the command line: neither its commands nor its flags."""
    core = urdd.generate(ROBOTS / "gripper.urdf", tmp_path / "core", modules=["core"]).load()
    (tmp_path / "away.stl").write_bytes((ROBOTS / "meshes" / "welding_arm" / "flange.stl").read_bytes())
    folder = tmp_path / "a" / "b"
    folder.mkdir(parents=True)
    away, thin, lost = (folder / f"{name}.urdf" for name in ("away", "thin", "lost"))
    named = '<robot name="a"><link name="l"><visual><geometry><mesh filename="{}"/></geometry></visual></link></robot>'
    away.write_text(named.format("../../away.stl"))
    shape = '<origin xyz="1e9 0 0"/><geometry><box size="1 1 1"/></geometry>'
    box = f'<robot name="a"><link name="l"><visual>{shape}</visual></link></robot>'
    thin.write_text(box)
    lost.write_text(named.format("nowhere.stl"))
    occupied = tmp_path / "occupied"
    occupied.mkdir()
    (occupied / "mine.txt").write_text("kept")
    edited = tmp_path / "edited"
    shutil.copytree(urdds / "gripper", edited)
    module = edited / "link_shapes_modules" / "link_shapes_skips_module" / "module.json"
    document = json.loads(module.read_text())
    a, b = core.link_names[:2]
    document["edits"] = [{"link_a": a, "link_b": b, "skip": True, "reason": "mine"}]
    module.write_text(json.dumps(document))
    module.with_suffix(".yaml").unlink()
    broken = tmp_path / "broken"
    shutil.copytree(urdds / "gripper", broken)
    (broken / "dof_module" / "module.json").write_text("{}")
    new, gripper = tmp_path / "new", ROBOTS / "gripper.urdf"
    for ask, words in (
        (lambda: core.in_collision(core.zero), r"_module is missing: generate it with urdd\.generate"),
        (lambda: core.collision_model(), r"modules=\["),
        (lambda: core.modules.convex_hull_meshes, r"is missing: generate it with urdd\.generate"),
        (lambda: urdd.load(broken).link_poses([0.0]), r"urdd\.validate\(path\) says more"),
        (lambda: urdd.generate(gripper, occupied), "force=True"),
        (lambda: urdd.generate(away, new), r"allowed_folders=\[folder\]"),
        (lambda: urdd.generate(thin, new), r"modules=\[\"core\"\]"),
        (lambda: urdd.generate(lost, new, strict=True), "strict=True"),
        (lambda: urdd.generate(gripper, edited, modules=["core"]), '"link_shapes_skips" to modules.*drop_edits=True'),
        (lambda: urdd.combine([broken, urdds / "gripper"], new, at=a), r"does not pass urdd\.validate.*force=True"),
        (lambda: urdd.combine([away, gripper], new, at="l"), r"allowed_folders"),
        (lambda: urdd.combine(tmp_path / "core", new), r"urdd\.combine\("),
        (lambda: urdd.explain("XYZ999"), "DOF003"),
        (lambda: urdd.load(gripper), r"urdd\.generate\("),
    ):
        with pytest.raises(urdd.UrddError, match=words) as caught:
            ask()
        said = [str(caught.value), *(place.problem for place in getattr(caught.value, "places", []))]
        for text in said:
            assert not re.search(r"--[a-z]|`urdd ", text), text


def test_a_urdd_of_before_version_1() -> None:
    robot = urdd.load(REPOSITORY / "conformance" / "bases" / "legacy" / "robot")
    with pytest.raises(urdd.ModuleUnusableError, match="before version 1"):
        _ = robot.modules.dof
    assert robot.modules.json("dof_module")["num_dofs"] >= 1
    with pytest.raises(urdd.ModuleMissingError, match="chain_module"):
        robot.link_poses([0.0])


def test_no_sources(tmp_path: Path) -> None:
    with pytest.raises(urdd.GenerateError, match="cannot be read") as caught:
        urdd.generate(tmp_path / "nothing.urdf", tmp_path / "out")
    assert caught.value.code == "unreadable"
    (tmp_path / "bad.urdf").write_text('<robot name="a">\n  <link name="l"/>\n  <link name="l"/>\n</robot>\n')
    with pytest.raises(urdd.GenerateError) as caught:
        urdd.generate(tmp_path / "bad.urdf", tmp_path / "out")
    assert caught.value.code == "refused"
    assert caught.value.places[0].line > 0
    assert not (tmp_path / "out").exists()
    for wrong, words in (
        ({"modules": ["cheese"]}, "there is no module `cheese`"),
        ({"samples": 0}, "from 1 to 100,000"),
        ({"pieces": 0}, "from 1 to 64"),
        ({"pieces": 300}, "from 1 to 64"),
        ({"piece_tolerance": 0.0}, "above 0 metres"),
        ({"geometry": "both"}, "neither visual nor collision"),
        ({"mesh_formats": ["ply"]}, "there are: glb, stl, obj"),
        ({"skip": ["sometimes"]}, "there are: same-link"),
        ({"packages": {"a": tmp_path / "nowhere"}}, "is not a folder"),
    ):
        options: dict[str, Any] = wrong
        with pytest.raises(ValueError, match=words):
            urdd.generate(ROBOTS / "gripper.urdf", tmp_path / "out", **options)
    with pytest.raises(TypeError, match="list of words"):
        urdd.generate(ROBOTS / "gripper.urdf", tmp_path / "out", modules="core")


def test_a_number_of_threads_that_cannot_be(arm: urdd.Robot) -> None:
    code = (
        "import resource, sys, urdd\n"
        "robot = urdd.load(sys.argv[1])\n"
        "expected = robot.in_collision(robot.random(50))\n"
        "resource.setrlimit(resource.RLIMIT_AS, (4 << 30,) * 2)\n"
        "try:\n"
        "    urdd.set_num_threads(50_000)\n"
        "except RuntimeError as error:\n"
        "    print(error)\n"
        "assert (robot.in_collision(robot.random(50)) == expected).all()\n"
    )
    if sys.platform == "linux":
        words = [sys.executable, "-c", code, str(arm.path)]
        found = subprocess.run(words, capture_output=True, text=True, check=True, timeout=120)
        assert found.stdout.startswith("50000 threads cannot be started")


def test_names_that_are_nearly_right_bring_the_right_one() -> None:
    """The names in which Python's interpreter searches for a suggestion."""
    for name in urdd.__all__:
        assert name in dir(urdd)
    with pytest.raises(AttributeError) as caught:
        _ = urdd.modulez
    assert (caught.value.name, caught.value.obj) == ("modulez", urdd)
    options: dict[str, Any] = {"sample": 3}
    with pytest.raises(TypeError, match=r"generate_text\(\) got .* 'sample'. Did you mean 'samples'\?"):
        urdd.generate_text("<robot/>", "nowhere", **options)


def _press_after(seconds: float) -> threading.Timer:
    timer = threading.Timer(seconds, signal.raise_signal, [signal.SIGINT])
    timer.start()
    return timer


def test_control_c_in_a_batch(arm: urdd.Robot) -> None:
    q = np.tile(arm.random(20_000), (20, 1))
    arm.proximity()
    timer = _press_after(0.2)
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):  # noqa: PT012
        for _ in range(100):
            arm.distances(q)
    timer.join()
    assert time.monotonic() - begin < 30
    assert arm.link_poses(q[:3]).shape == (3, arm.num_links, 4, 4)


def test_control_c_in_inverse_kinematics(arm: urdd.Robot) -> None:
    for target in (np.full(3, 9.0), np.full((3, 3), 9.0)):
        timer = _press_after(0.3)
        begin = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            arm.inverse_kinematics("torch", target, restarts=10**9)
        timer.join()
        assert time.monotonic() - begin < 30
    assert arm.inverse_kinematics("torch", arm.link_pose(arm.middle, "torch")).reached


def test_control_c_in_generate(tmp_path: Path) -> None:
    begun: list[str] = []

    def progress(module: str, done: int, total: int) -> None:
        begun.append(module)
        assert done < total
        if module == "link_shapes_distance_statistics_module":
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        urdd.generate(ROBOTS / "welding_arm.urdf", tmp_path / "out", samples=100_000, progress=progress)
    assert begun[0] == "urdf_module"
    assert list(tmp_path.iterdir()) == []


def test_an_error_of_a_callback_stops(tmp_path: Path) -> None:
    def progress(module: str, done: int, total: int) -> None:
        raise RuntimeError(f"{module} {done} {total}")

    with pytest.raises(RuntimeError, match="urdf_module 0 15"):
        urdd.generate(ROBOTS / "welding_arm.urdf", tmp_path / "out", samples=100_000, progress=progress)
    assert list(tmp_path.iterdir()) == []
