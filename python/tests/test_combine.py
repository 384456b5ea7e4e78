"""Combined robots: poses by closed forms, and common mistakes."""

from __future__ import annotations

import json
import pickle
import shutil
import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import urdd
from conftest import ROBOTS

OFFSET = [0.01, -0.02, 0.1]
TURN = [0.3, -0.4, 1.2]


def offset() -> Any:
    """The matrix of OFFSET and TURN: about the fixed axes x, then y, then z."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(TURN), np.sin(TURN)
    found = np.eye(4)
    found[:3, :3] = (
        np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
        @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
        @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    )
    found[:3, 3] = OFFSET
    return found


@pytest.fixture(scope="module")
def made(urdds: Path, tmp_path_factory: pytest.TempPathFactory) -> urdd.Combined:
    """The gripper on the arm."""
    folder = tmp_path_factory.mktemp("combined")
    told: list[tuple[str, int, int]] = []

    def tell(module: str, done: int, total: int) -> None:
        told.append((module, done, total))

    found = urdd.combine(
        [urdds / "welding_arm", urdd.load(urdds / "gripper")],
        folder / "both",
        at="flange",
        xyz=OFFSET,
        rpy=np.array(TURN),
        name="arm_and_gripper",
        samples=100,
        progress=tell,
    )
    assert told[0][:2] == ("urdf_module", 0)
    total = len(found.modules_made) + len(found.modules_kept)
    assert [(done, of) for _, done, of in told] == [(done, total) for done in range(total + 1)]
    return found


def test_each_part_moves_as_by_itself(made: urdd.Combined, arm: urdd.Robot, urdds: Path) -> None:
    robot, gripper = made.load(), urdd.load(urdds / "gripper")
    assert robot.name == made.robot_name == "arm_and_gripper"
    assert robot.num_links == made.num_links == arm.num_links + gripper.num_links
    assert robot.num_dofs == arm.num_dofs + gripper.num_dofs
    q = robot.random(30)
    of_arm = q[:, [robot.dof(name) for name in arm.dof_names]]
    of_gripper = q[:, [robot.dof(f"gripper_{name}") for name in gripper.dof_names]]
    poses = robot.link_poses(q)
    for name in arm.link_names:
        np.testing.assert_allclose(poses[:, robot.link(name)], arm.link_pose(of_arm, name), atol=1e-12)
    base = arm.link_pose(of_arm, "flange") @ offset()
    for name in gripper.link_names:
        pose = gripper.link_pose(of_gripper, name)
        np.testing.assert_allclose(poses[:, robot.link(f"gripper_{name}")], base @ pose, atol=1e-12)


def test_it_passes_and_says_where_each_link_came_from(made: urdd.Combined) -> None:
    (one,) = urdd.validate(made.path).urdds
    assert one.verdict == "pass"
    parts = made.load().modules.composition.parts
    assert [part.id for part in parts] == ["welding_arm", "gripper"]
    assert made.conformance_class == "Shapes"
    assert all(isinstance(note.message, str) and note.kind and str(note) == note.message for note in made.combine_notes)


def test_a_recipe_says_the_same(
    made: urdd.Combined, urdds: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(urdds / "welding_arm", tmp_path / "parts" / "arm")
    recipe = tmp_path / "parts" / "cell.toml"
    recipe.write_text(
        f'name = "arm_and_gripper"\n[[part]]\nid = "welding_arm"\nsource = "arm"\nprefix = ""\n'
        f'[[part]]\nid = "gripper"\nsource = "{(urdds / "gripper").as_posix()}"\n'
        f'attach = {{ to = "welding_arm/flange", xyz = {OFFSET}, rpy = {TURN} }}\n',
        encoding="utf-8",
    )
    # Sources are relative to the recipe.
    monkeypatch.chdir(tmp_path)
    again = urdd.combine("parts/cell.toml", "out", modules=["core"], allowed_folders=[urdds])
    robot = again.load()
    q = robot.random(5)
    np.testing.assert_array_equal(robot.link_poses(q), made.load().link_poses(q))
    assert [note.kind for note in again.combine_notes] == [note.kind for note in made.combine_notes]
    # A second run changes nothing.
    assert not urdd.combine("parts/cell.toml", "out", modules=["core"], allowed_folders=[urdds]).changed


def write(folder: Path, text: str) -> Path:
    path = folder / "cell.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "words", "place"),
    [
        ("name = ", "string|value", (1, 8)),
        ('nmae = "a"\n', "did you mean `name`", (1, 1)),
        ('name = "a"\n', "there is no part", None),
        ('[[part]]\nid = "a"\n', "missing field `source`", (1, 1)),
        ('[[part]]\nid = "a"\nsource = 3\n', "string", (3, 10)),
        (
            '[[part]]\nid = "arm"\nsource = "ARM"\n\n[[part]]\nid = "b"\nsource = "ARM"\n'
            'attach = { to = "arm/flnge" }\n',
            "did you mean `flange`",
            (8, 17),
        ),
        (
            '[[part]]\nid = "arm"\nsource = "ARM"\n\n[[part]]\nid = "b"\nsource = "ARM"\n'
            'attach = { to = "amr/flange" }\n',
            "did you mean `arm`",
            (8, 17),
        ),
    ],
)
def test_no_recipes(text: str, words: str, place: tuple[int, int] | None, urdds: Path, tmp_path: Path) -> None:
    recipe = write(tmp_path, text.replace("ARM", (urdds / "welding_arm").as_posix()))
    with pytest.raises(urdd.CombineError, match=words) as caught:
        urdd.combine(recipe, tmp_path / "out", allowed_folders=[urdds])
    error = caught.value
    assert error.code == "recipe"
    assert str(recipe) in str(error)
    if place is None:
        assert error.places == []
    else:
        (one,) = error.places
        assert (one.file, one.line, one.column) == (str(recipe), *place)
        assert one.problem in str(error)
    copy: urdd.CombineError = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.code, copy.places, copy.part) == (str(error), error.code, error.places, error.part)
    assert not (tmp_path / "out").exists()


def test_no_parts(urdds: Path, tmp_path: Path) -> None:
    arm, gripper, out = urdds / "welding_arm", urdds / "gripper", tmp_path / "out"
    with pytest.raises(urdd.CombineError, match="there is no such URDD or URDF") as caught:
        urdd.combine([arm, tmp_path / "nothing"], out, at="flange")
    assert (caught.value.code, caught.value.part) == ("part", "nothing")
    with pytest.raises(urdd.CombineError, match="did you mean `flange`"):
        urdd.combine([arm, gripper], out, at="flnge")
    (tmp_path / "bad.urdf").write_text('<robot name="a">\n  <link name="l"/>\n  <link name="l"/>\n</robot>\n')
    with pytest.raises(urdd.CombineError) as caught:
        urdd.combine([arm, tmp_path / "bad.urdf"], out, at="flange")
    assert (caught.value.code, caught.value.part) == ("refused", "bad")
    assert caught.value.places[0].line == 3
    with pytest.raises(urdd.CombineError, match=r"recipe is a \.toml file.*urdd\.combine\(\["):
        urdd.combine(arm, out)
    with pytest.raises(urdd.CombineError, match="cannot be read") as caught:
        urdd.combine(tmp_path / "nothing.toml", out)
    assert caught.value.code == "unreadable"
    (tmp_path / "latin.toml").write_bytes(b'name = "\xff"')
    with pytest.raises(urdd.CombineError, match="not UTF-8"):
        urdd.combine(tmp_path / "latin.toml", out)
    assert not out.exists()


def test_what_is_not_asked_right(urdds: Path, tmp_path: Path) -> None:
    arm, gripper, out = urdds / "welding_arm", urdds / "gripper", tmp_path / "out"
    with pytest.raises(ValueError, match="two robots need `at`"):
        urdd.combine([arm, gripper], out)
    for parts in ([], [arm], [arm, gripper, gripper]):
        with pytest.raises(ValueError, match=f"two robots, not {len(parts)}"):
            urdd.combine(parts, out, at="flange")
    with pytest.raises(ValueError, match="a recipe has its own"):
        urdd.combine(write(tmp_path, ""), out, at="flange")
    wrong: list[tuple[Any, str]] = [
        ([0.0, 0.0], r"xyz must be 3 finite numbers, not an array of the shape \(2,\)"),
        ([0.0, 0.0, float("nan")], "xyz must be 3 finite numbers"),
        (["a", "b", "c"], "xyz must be an array of numbers"),
        (np.zeros(3, dtype=complex), "xyz must be an array of numbers"),
        (None, "xyz must be an array of numbers"),
    ]
    for xyz, words in wrong:
        with pytest.raises(urdd.ConfigurationError, match=words):
            urdd.combine([arm, gripper], out, at="flange", xyz=xyz)
    with pytest.raises(TypeError, match=r"combine\(\) got an unexpected keyword argument 'sample'"):
        urdd.combine([arm, gripper], out, at="flange", sample=3)  # type: ignore[call-arg]
    with pytest.raises(ValueError, match="from 1 to 100,000"):
        urdd.combine([arm, gripper], out, at="flange", samples=0)
    with pytest.raises(ValueError, match="there is no module `cheese`"):
        urdd.combine([arm, gripper], out, at="flange", modules=["cheese"])
    assert not out.exists()


def test_a_part_that_fails_validation(urdds: Path, tmp_path: Path) -> None:
    shutil.copytree(urdds / "gripper", tmp_path / "gripper")
    file = tmp_path / "gripper" / "bounds_module" / "module.json"
    document = json.loads(file.read_text())
    document["bounds"] = document["bounds"][:-1] if document.get("bounds") else []
    file.write_text(json.dumps(document))
    parts = [urdds / "welding_arm", tmp_path / "gripper"]
    with pytest.raises(urdd.CombineError, match=r"does not pass urdd\.validate: .*\d finding") as caught:
        urdd.combine(parts, tmp_path / "out", at="flange", modules=["core"])
    assert (caught.value.code, caught.value.part) == ("part-fails", "gripper")
    assert not (tmp_path / "out").exists()
    made = urdd.combine(parts, tmp_path / "out", at="flange", modules=["core"], force=True)
    (one,) = urdd.validate(made.path).urdds
    assert one.verdict == "pass"


def test_something_else_lies_there(urdds: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "mine.txt").write_text("kept")
    parts = [urdds / "welding_arm", ROBOTS / "gripper.urdf"]
    with pytest.raises(urdd.CombineError, match="force"):
        urdd.combine(parts, tmp_path / "out", at="flange", modules=["core"])
    urdd.combine(parts, tmp_path / "out", at="flange", modules=["core"], force=True)
    assert (tmp_path / "out" / "mine.txt").read_text() == "kept"


@pytest.mark.parametrize("stop", ["urdf_module", "link_shapes_distance_statistics_module"])
def test_control_c_in_combine(stop: str, urdds: Path, tmp_path: Path) -> None:
    def progress(module: str, done: int, total: int) -> None:
        assert done < total
        if module == stop:
            signal.raise_signal(signal.SIGINT)

    parts = [urdds / "welding_arm", urdds / "gripper"]
    with pytest.raises(KeyboardInterrupt):
        urdd.combine(parts, tmp_path / "out", at="flange", progress=progress)
    assert list(tmp_path.iterdir()) == []


def test_an_error_of_a_callback_stops_combine(urdds: Path, tmp_path: Path) -> None:
    def progress(module: str, done: int, total: int) -> None:
        raise RuntimeError(f"{module} {done}")

    with pytest.raises(RuntimeError, match="urdf_module 0"):
        urdd.combine([urdds / "welding_arm", urdds / "gripper"], tmp_path / "out", at="flange", progress=progress)
    assert list(tmp_path.iterdir()) == []
