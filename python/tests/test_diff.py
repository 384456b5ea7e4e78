"""Comparison: what differs is named, what is within the tolerance is not."""

from __future__ import annotations

from pathlib import Path

import pytest

import urdd

ROBOT = """<robot name="r"><link name="a"><inertial><mass value="{mass}"/></inertial></link><link name="b"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 {z}"/>
<limit lower="-1" upper="{upper}" effort="1" velocity="1"/></joint></robot>"""


def robot(folder: Path, name: str, mass: str = "1", z: str = "1", upper: str = "1") -> Path:
    path = folder / f"{name}.urdf"
    path.write_text(ROBOT.format(mass=mass, z=z, upper=upper), encoding="utf-8")
    return path


def test_each_change_is_named(tmp_path: Path) -> None:
    report = urdd.diff(robot(tmp_path, "a"), str(robot(tmp_path, "b", mass="2", upper="1.25")))
    assert not report.same
    (link,) = report.links
    assert (link.name, [(change.field, change.before, change.after) for change in link.changes]) == (
        "a",
        [("inertial.mass", "1", "2")],
    )
    (joint,) = report.joints
    assert [(change.field, change.after, change.unit) for change in joint.changes] == [("limit.upper", "1.25", "rad")]
    assert report.findings is not None


def test_a_tolerance_is_in_the_unit_of_each_value(tmp_path: Path) -> None:
    # 2 ** -20 is exact in every sum here.
    step = 2.0**-20
    near = robot(tmp_path, "near", mass=repr(1 + step), z=repr(1 + step), upper=repr(1 + step))
    for tolerance, same in [(0.0, False), (step / 2, False), (step, True), (2 * step, True)]:
        report = urdd.diff(robot(tmp_path, "a"), near, tolerance=tolerance, findings=False)
        assert report.same is same, tolerance
        assert report.findings is None
        assert (report.poses is None) is same


def test_a_tolerance_holds_for_modules_too(tmp_path: Path) -> None:
    first, second = robot(tmp_path, "a"), robot(tmp_path, "b", upper="1.0000001")
    made = [urdd.generate(path, tmp_path / path.stem, modules=["core"]).path for path in (first, second)]
    exact = urdd.diff(*made, findings=False)
    assert not exact.same
    assert [joint.name for joint in exact.joints] == ["j"]
    assert urdd.diff(*made, findings=False, tolerance=1e-6).same


def test_bad_input(tmp_path: Path) -> None:
    path = robot(tmp_path, "a")
    for tolerance in (-1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="`tolerance` must be at least 0"):
            urdd.diff(path, path, tolerance=tolerance)
    with pytest.raises(urdd.OpenError, match="nothing"):
        urdd.diff(path, tmp_path / "nothing")
    with pytest.raises(ValueError, match="is not a folder"):
        urdd.diff(path, path, allowed_folders=[tmp_path / "nothing"])
