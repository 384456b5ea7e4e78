"""PyBullet's body of a robot, with a stand-in; `peers/test_pybullet.py` uses PyBullet itself."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import urdd
from pybullet_stand_in import MIXED, StandIn


@pytest.fixture(scope="module")
def mixed(tmp_path_factory: pytest.TempPathFactory) -> urdd.Robot:
    """A robot with a pair of links some of whose pieces are always in contact, and others sometimes."""
    return urdd.generate_text(MIXED, tmp_path_factory.mktemp("mixed") / "mixed").load()


@pytest.fixture
def bullet(monkeypatch: pytest.MonkeyPatch) -> StandIn:
    made = StandIn()
    monkeypatch.setitem(sys.modules, "pybullet", made)
    return made


@pytest.mark.parametrize("name", ["gripper", "hand", "welding_arm"])
def test_q_is_one_position_for_each_joint(name: str, urdds: Path, bullet: StandIn) -> None:
    robot = urdd.load(urdds / name)
    peer = robot.to_pybullet()
    q = robot.random(20, seed=6)
    theirs = peer.q(q)
    assert theirs.shape == (20, len(peer.joints))
    assert peer.q(q.reshape(4, 5, -1)).shape == (4, 5, len(peer.joints))
    np.testing.assert_array_equal(peer.dofs(theirs), q)
    peer.set(q[0])
    # Mimic joints too.
    np.testing.assert_array_equal([bullet.positions[number] for number in peer.joints], peer.q(q[0]))
    np.testing.assert_array_equal(peer.get(), q[0])
    assert [bullet.joints[number][0] for number in peer.joints] == [joint.name for joint in peer._moving]


def test_links_of_which_all_pieces_are_skipped_do_not_collide(arm: urdd.Robot, bullet: StandIn) -> None:
    peer = arm.to_pybullet()
    numbers = {name: number for number, (_, name) in enumerate(bullet.joints)} | {arm.root_link: -1}
    expected = {tuple(sorted(numbers[name] for name in pair)) for pair in arm.skips().pairs_of_links()}
    assert expected
    assert bullet.filters == dict.fromkeys(expected, 0)
    assert peer.notes == []


def test_links_of_which_some_pieces_are_skipped(mixed: urdd.Robot, bullet: StandIn) -> None:
    assert mixed.skips().pairs_of_links() == set()
    peer = mixed.to_pybullet()
    assert bullet.filters == {(-1, peer.links["tool"]): 0}
    (note,) = peer.notes
    q = mixed.random(1000)
    lost = int(mixed.in_collision(q).sum())
    # By a closed form: the far boxes overlap if the tool is turned back by less than some 10 degrees of 355.
    assert 30 < lost < 100
    assert note == (
        f"links `base` and `tool` do not collide: 1 of 4 pairs of their pieces are skipped, and PyBullet knows links "
        f"only; in {lost} of 1000 sampled configurations the others touch"
    )


def test_pairs_are_kept_where_one_wants_them(mixed: urdd.Robot, bullet: StandIn) -> None:
    peer = mixed.to_pybullet(keep_pairs=True)
    assert bullet.filters == {}
    (note,) = peer.notes
    assert "they may always touch" in note
