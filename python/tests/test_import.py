"""MJCF, SDF and USD as sources."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

import urdd

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_an_mjcf_is_written_and_generated(tmp_path: Path) -> None:
    imported = urdd.import_robot(EXAMPLES / "mjcf" / "arm.xml", tmp_path / "arm")
    assert imported.urdf == tmp_path / "arm" / "tabletop_arm.urdf"
    assert all(path.is_file() for path in imported.files)
    assert {path.name for path in imported.files} >= {"tabletop_arm.srdf", "tabletop_arm.export.toml", "turret.obj"}
    assert imported.report["format"] == "mjcf"
    assert any("floor" not in note and "world itself" in note for note in imported.notes)
    made = urdd.generate(EXAMPLES / "mjcf" / "arm.xml", tmp_path / "robot", modules=["core"])
    robot = made.load()
    # The qpos of the keyframe; the right finger follows.
    assert list(robot.named_configurations["home"]) == [0.0, -0.6, 1.4, 0.8, 0.0, 0.02]


def test_a_usd_of_several_layers_is_written_and_generated(tmp_path: Path) -> None:
    scara = EXAMPLES / "usd" / "scara.usda"
    imported = urdd.import_robot(scara, tmp_path / "scara")
    assert imported.report["format"] == "usd"
    assert {path.name for path in imported.files} >= {"scara.urdf", "scara.srdf", "scara.export.toml"}
    robot = urdd.generate(scara, tmp_path / "urdd", modules=["core"]).load()
    assert robot.dof_names == ("shoulder", "elbow", "lift", "spin", "left_grip")
    # Where the stage has the fingers: one is turned by half a turn.
    right = robot.link_pose(robot.zero, "right_finger")
    np.testing.assert_allclose(right[:3, 3], [0.55, -0.004, 0.19], atol=1e-6)
    np.testing.assert_allclose(right[:3, 0], [-1, 0, 0], atol=1e-6)


def test_files_of_a_person_stay(tmp_path: Path) -> None:
    urdf = urdd.import_robot(EXAMPLES / "sdf" / "model.sdf", tmp_path, ball="revolute").urdf
    urdf.write_text("mine")
    with pytest.raises(FileExistsError, match=r"lift_cart\.urdf"):
        urdd.import_robot(EXAMPLES / "sdf" / "model.sdf", tmp_path, ball="revolute")
    assert urdf.read_text() == "mine"
    urdd.import_robot(EXAMPLES / "sdf" / "model.sdf", tmp_path, ball="revolute", force=True)
    assert "caster_joint_x" in urdf.read_text()


def test_what_is_wrong_has_its_place(tmp_path: Path) -> None:
    file = tmp_path / "robot.xml"
    file.write_text('<mujoco>\n <worldbody><body pos="1 2"/></worldbody></mujoco>')
    with pytest.raises(urdd.GenerateError) as caught:
        urdd.import_robot(file, tmp_path / "out")
    ((name, line, _, _),) = caught.value.places
    assert (name, line) == (str(file), 2)
    assert not (tmp_path / "out").exists()
    with pytest.raises(ValueError, match="neither none nor tiny"):
        urdd.import_robot(file, tmp_path / "out", massless="some")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="neither spherical nor revolute"):
        urdd.import_robot(file, tmp_path / "out", ball="cubic")  # type: ignore[arg-type]
    urdf = tmp_path / "robot.urdf"
    urdf.write_text('<robot name="r"><link name="a"/></robot>')
    with pytest.raises(urdd.GenerateError, match="a URDF already"):
        urdd.import_robot(urdf, tmp_path / "out")


@pytest.mark.skipif(sys.platform == "win32", reason="links need a privilege there")
def test_links_and_pipes_in_the_way_are_refused(tmp_path: Path) -> None:
    source, out, elsewhere = EXAMPLES / "sdf" / "model.sdf", tmp_path / "out", tmp_path / "elsewhere"
    urdf = urdd.import_robot(source, out, ball="revolute").urdf
    robot = urdd.generate(urdf, tmp_path / "robot").load()
    elsewhere.mkdir()

    def write(place: Path, force: bool) -> None:
        if place == urdf:
            urdd.import_robot(source, out, ball="revolute", force=force)
        else:
            urdd.export(robot, "mjcf", tmp_path / "made" / "r.xml", force=force)

    for place in (urdf, tmp_path / "made" / "r.xml", tmp_path / "made" / "r_meshes"):
        place.parent.mkdir(exist_ok=True)
        for obstacle in ("link", "pipe"):
            if place.exists():
                place.unlink()
            if obstacle == "link":
                place.symlink_to(elsewhere)
            else:
                os.mkfifo(place)
            for force in (False, True):
                with pytest.raises(OSError, match=f"{place.name}: a {obstacle}.* is in the way"):
                    write(place, force)
            place.unlink()
            assert list(elsewhere.iterdir()) == []
    # Meshes may be beside the folder of the file.
    urdd.export(robot, "mjcf", tmp_path / "made" / "r.xml", mesh_folder="../meshes")
    assert (tmp_path / "made" / "r.xml").is_file()
    assert list((tmp_path / "meshes").iterdir()) != []
    assert not list(tmp_path.rglob(".urdd-*"))
