"""Kinematic loops: a four-bar by the law of cosines, and what follows from it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import urdd
from urdd._arrays import Floats

GROUND, CRANK, COUPLER, ROCKER = 0.4, 0.12, 0.35, 0.25


def _joint(name: str, parent: str, x: float) -> str:
    return (
        f'<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{name}_link"/>'
        f'<origin xyz="{x} 0 0"/><axis xyz="0 0 1"/></joint>'
    )


def _link(name: str, length: float, z: float) -> str:
    return (
        f'<link name="{name}"><visual><origin xyz="{length / 2} 0 {z}"/>'
        f'<geometry><box size="{length} 0.02 0.02"/></geometry></visual></link>'
    )


FOUR_BAR = f"""<robot name="four_bar">{_link("ground", GROUND, -0.05)}{_link("crank_link", CRANK, 0)}
{_link("coupler_link", COUPLER, 0.05)}{_link("rocker_link", ROCKER, 0.1)}
{_joint("crank", "ground", 0)}{_joint("coupler", "crank_link", CRANK)}{_joint("rocker", "ground", GROUND)}
<loop name="pin" type="revolute"><predecessor link="coupler_link"><origin xyz="{COUPLER} 0 0"/></predecessor>
<successor link="rocker_link"><origin xyz="{ROCKER} 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"""


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory: pytest.TempPathFactory) -> urdd.Robot:
    folder = tmp_path_factory.mktemp("loops")
    (folder / "four_bar.urdf").write_text(FOUR_BAR, encoding="utf-8")
    urdd.generate(folder / "four_bar.urdf", folder / "four_bar", samples=10)
    return urdd.load(folder / "four_bar")


def at(crank: Floats, side: float = -1.0) -> Floats:
    """The circles about the ends of crank and rocker meet in two points, of which ``side`` chooses one."""
    x, y = GROUND - CRANK * np.cos(crank), -CRANK * np.sin(crank)
    far = np.hypot(x, y)
    turned = np.arctan2(-y, -x) + side * np.arccos((ROCKER**2 + far**2 - COUPLER**2) / (2 * ROCKER * far))
    along = np.stack([GROUND + ROCKER * np.cos(turned), ROCKER * np.sin(turned)])
    along -= np.stack([CRANK * np.cos(crank), CRANK * np.sin(crank)])
    return np.stack([crank, np.arctan2(along[1], along[0]) - crank, turned], axis=-1)


def test_gaps_and_closing(four_bar: urdd.Robot) -> None:
    assert (four_bar.loop_names, four_bar.coupling_names) == (("pin",), ())
    np.testing.assert_array_equal(four_bar.independent_dofs, [four_bar.dof("crank")])
    q = at(np.linspace(0, 6, 24)).reshape(4, 6, 3)
    errors = four_bar.loop_errors(q)
    assert errors.position.shape == errors.rotation.shape == (4, 6, 1)
    assert errors.sums.shape == (4, 6, 0)
    assert errors.is_closed.all()
    off = np.add(q, [0, 1e-3, -0.1])
    assert not four_bar.loop_errors(off).is_closed.any()
    found = four_bar.close(off, held=["crank"])
    assert found.is_closed.all()
    np.testing.assert_array_equal(found.configuration[..., 0], q[..., 0])
    np.testing.assert_allclose(np.cos(found.configuration - q), 1, atol=1e-15)
    one = four_bar.close(off[0, 0], held=["crank"])
    np.testing.assert_array_equal(
        four_bar.close(off[0, 0], held=four_bar.independent_dofs).configuration, one.configuration
    )
    with pytest.raises(IndexError, match="DOF index 3 is out of range"):
        four_bar.close(off[0, 0], held=[3])
    assert one.is_closed
    np.testing.assert_array_equal(one.configuration, found.configuration[0, 0])
    narrow = [[-9, 9], [-9, 9], [q[0, 0, 2] + 1, 9]]
    apart = four_bar.close(q[0, 0], held=["crank"], bounds=narrow)
    assert not apart.is_closed
    assert apart.configuration[2] >= q[0, 0, 2] + 1
    with pytest.raises(urdd.UnknownNameError, match="crank"):
        four_bar.close(q, held=["crnk"])
    with pytest.raises(TypeError):
        four_bar.close(q, held="crank")
    for bounds in (narrow[:2], [[1, 0]] * 3, [[np.nan, 1]] * 3):
        with pytest.raises(urdd.ConfigurationError):
            four_bar.close(q, bounds=bounds)


def test_equations_and_velocities(four_bar: urdd.Robot) -> None:
    q = at(np.linspace(0.1, 6, 10))
    step = 1e-6
    jacobian = four_bar.loop_jacobian(q)
    assert jacobian.shape == (10, 5, 3)
    assert four_bar.num_loop_equations == 5
    for dof in range(3):
        by = step * np.eye(3)[dof]
        expected = (four_bar.loop_residuals(q + by) - four_bar.loop_residuals(q - by)) / (2 * step)
        np.testing.assert_allclose(jacobian[..., dof], expected, atol=1e-9)
    velocities = four_bar.loop_velocities(q, [2.0])
    np.testing.assert_allclose(jacobian @ velocities[..., None], 0, atol=1e-12)
    expected = (at(q[:, 0] + step) - at(q[:, 0] - step)) / step
    np.testing.assert_allclose(velocities, expected, atol=1e-8)
    assert four_bar.loop_velocities(q[0], [1.0]).shape == (3,)
    free = four_bar.free_dofs(q[0])
    assert (free.independent.tolist(), free.dependent.tolist()) == ([0], [1, 2])
    for wrong in ([1.0, 2.0], [np.nan]):
        with pytest.raises(urdd.ConfigurationError):
            four_bar.loop_velocities(q, wrong)


def test_inverse_kinematics_and_motions_stay_closed(four_bar: urdd.Robot) -> None:
    start, end = at(np.array([0.5, 2.0]))
    target = four_bar.link_pose(end, "rocker_link")
    found = four_bar.inverse_kinematics("rocker_link", target, start)
    assert found.reached
    assert four_bar.loop_errors(found.q).is_closed
    beyond = four_bar.link_pose([0, 0, 0], "rocker_link")
    found = four_bar.inverse_kinematics("rocker_link", beyond, start)
    assert not found.reached
    assert found.verdict == "loops"
    assert four_bar.inverse_kinematics("rocker_link", beyond, start, open_loops=True).reached
    proximity = four_bar.proximity()
    assert np.isnan(proximity.blocked_edge(start, end))
    assert np.isnan(proximity.first_contact(start, end)).all()
    assert proximity.obstruction(start, end) == "nothing"
    other = at(np.array([2.0]), 1.0)[0]
    assert four_bar.loop_errors(other).is_closed
    assert proximity.obstruction([start, start], [end, other]).tolist() == ["nothing", "branch"]
    assert proximity.blocked_edge(start, other) == 1
    with pytest.raises(urdd.ConfigurationError, match=r"the end .* `pin` .* call `close` first"):
        proximity.blocked_edge(start, np.add(end, [0, 0.01, 0]))
    with pytest.raises(urdd.ConfigurationError, match="resolution"):
        proximity.blocked_edge(start, end, resolution=None)
    assert np.isnan(proximity.blocked_edge(start, end, resolution=None, open_loops=True))


def test_a_tree_is_closed(arm: urdd.Robot) -> None:
    q = arm.random(3)
    errors = arm.loop_errors(q)
    assert errors.is_closed.all()
    assert errors.position.shape == (3, 0)
    np.testing.assert_array_equal(arm.close(q).configuration, q)
    np.testing.assert_array_equal(arm.independent_dofs, np.arange(arm.num_dofs))
    assert arm.loop_jacobian(q).shape == (3, 0, arm.num_dofs)
    assert arm.loop_residuals(q).shape == (3, 0)
    np.testing.assert_array_equal(arm.loop_velocities(q, q), q)
    assert arm.loop_names == ()


def test_the_block_in_the_documentation(
    four_bar: urdd.Robot, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """That of docs/loops.md, unchanged."""
    assert four_bar.folder is not None
    monkeypatch.chdir(four_bar.folder.parent)
    text = (Path(__file__).parents[2] / "docs/loops.md").read_text(encoding="utf-8")
    (block,) = text.split("```python\n")[1:]
    exec(block.split("```")[0], {})
    assert "closed" in capsys.readouterr().out
