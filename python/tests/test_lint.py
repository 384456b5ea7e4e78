"""Linting: findings and what programs do, as the command says them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import urdd
from conftest import REPOSITORY
from test_command import run
from urdd.report import Does, Report, read_report

CASES = REPOSITORY / "crates" / "urdd-lint" / "tests" / "cases"
#: A safety controller without `k_velocity`: urdfdom refuses it, and with it ROS, Gazebo and Pinocchio (tests/figures).
REFUSED = CASES / "LNT060" / "invalid.urdf"


def test_it_finds_what_the_command_finds(tmp_path: Path) -> None:
    (tmp_path / "a.urdf").write_bytes(REFUSED.read_bytes())
    (tmp_path / "b.urdf").write_bytes((CASES / "LNT001" / "invalid.urdf").read_bytes())
    for path in (tmp_path, REFUSED):
        report = urdd.lint(path)
        assert report == read_report(run("lint", path, "--format", "json").stdout)
    first, second = urdd.lint(tmp_path).urdds
    assert (first.path, first.kind, first.verdict) == ("a.urdf", "urdf", "fail")
    assert [finding.code for finding in second.findings] == ["LNT001"]
    assert (urdd.explain("LNT060").name, urdd.explain("LNT060").clause) == ("refused-by-programs", "")


def test_it_says_what_programs_do() -> None:
    (urdf,) = urdd.lint(REFUSED).urdds
    does = {program.program: program.does for program in urdf.programs}
    refusing = {"urdfdom6", "urdfdom4", "urdfdom3", "sdformat", "sdformat14", "sdformat16", "pinocchio"}
    assert {name for name, deed in does.items() if deed == "refuses"} == refusing
    assert does["mujoco"] is None
    (finding,) = urdf.findings
    assert {one.program for one in finding.programs} == refusing
    assert Does("pinocchio", "refuses", False) in finding.places[0].programs
    pinocchio = next(program for program in urdf.programs if program.program == "pinocchio")
    (effect,) = [effect for effect in pinocchio.effects if not effect.is_usual]
    lines = REFUSED.read_text(encoding="utf-8").splitlines()
    assert effect.line is not None
    assert "<safety_controller" in lines[effect.line - 1]


def test_the_programs_that_matter_are_chosen(tmp_path: Path) -> None:
    def severity(**options: object) -> tuple[str, list[str]]:
        (urdf,) = urdd.lint(REFUSED, **options).urdds  # type: ignore[arg-type]
        return urdf.findings[0].severity, [one.program for one in urdf.programs if one.is_chosen]

    assert severity(for_=["mujoco"]) == ("info", ["mujoco"])
    assert severity(for_=("mujoco", "humble")) == ("error", ["mujoco", "urdfdom3"])
    settings = tmp_path / "urdd.toml"
    settings.write_text('for = ["mujoco"]\n', encoding="utf-8")
    assert severity(config=settings) == ("info", ["mujoco"])
    assert severity(config=settings, for_=["ros"])[0] == "error"
    assert severity(config=settings, for_=[]) == ("error", [])


def test_an_unknown_program_is_refused_with_the_list() -> None:
    with pytest.raises(ValueError, match=r"for_: there is no program `gazeboo`; write some of ros, .*gazebo, .*three"):
        urdd.lint(REFUSED, for_=["gazeboo"])
    with pytest.raises(TypeError, match="for_ must be a list of words"):
        urdd.lint(REFUSED, for_="ros")


def test_settings_count(tmp_path: Path) -> None:
    assert urdd.lint(REFUSED, ignore=["LNT060"]).urdds[0].findings == []
    assert urdd.lint(REFUSED, select=["LNT001"]).urdds[0].findings == []
    assert urdd.lint(REFUSED, for_=["mujoco"], fail_on="info").urdds[0].verdict == "fail"
    assert len(urdd.lint(CASES / "LNT060", exclude=["in*"]).urdds) == 1
    baseline = tmp_path / "known.json"
    assert run("lint", REFUSED, "--write-baseline", baseline).returncode == 0
    assert urdd.lint(REFUSED, baseline=baseline).urdds[0].findings == []
    # Packages beside the robot's folder are found without a word.
    part = tmp_path / "far" / "away" / "part"
    part.mkdir(parents=True)
    (part / "package.xml").write_text("<package><name>elsewhere</name></package>", encoding="utf-8")
    urdf = tmp_path / "robot" / "arm.urdf"
    urdf.parent.mkdir()
    mesh = '<visual><geometry><mesh filename="package://elsewhere/box.stl"/></geometry></visual>'
    urdf.write_text(f'<robot name="arm"><link name="a">{mesh}</link></robot>', encoding="utf-8")

    def unknown(report: Report) -> bool:
        reasons = [reason for link in report.urdds[0].geometry_not_verified for reason in link.reasons]
        return any("a package that is not found" in reason for reason in reasons)

    assert unknown(urdd.lint(urdf))
    assert not unknown(urdd.lint(urdf, packages={"elsewhere": part}))


def test_what_cannot_be_linted_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match="lint needs a path"):
        urdd.lint()
    with pytest.raises(urdd.OpenError, match="nowhere"):
        urdd.lint(tmp_path / "nowhere.urdf")
    with pytest.raises(urdd.OpenError, match=r"none\.json"):
        urdd.lint(REFUSED, baseline=tmp_path / "none.json")
    (tmp_path / "arm.urdf.xacro").write_text("<robot/>", encoding="utf-8")
    with pytest.raises(urdd.OpenError, match="xacro=True"):
        urdd.lint(tmp_path)
    with pytest.raises(ValueError, match="xacro_timeout"):
        urdd.lint(REFUSED, xacro_timeout=0)


def test_a_report_of_before_programs_is_read() -> None:
    report = json.loads(run("lint", REFUSED, "--format", "json").stdout)

    def without(value: object) -> object:
        if isinstance(value, list):
            return [without(one) for one in value]
        if isinstance(value, dict):
            return {key: without(one) for key, one in value.items() if key != "programs"}
        return value

    (urdf,) = read_report(json.dumps(without(report))).urdds
    (finding,) = urdf.findings
    assert (urdf.programs, finding.programs, finding.places[0].programs) == ([], [], [])
