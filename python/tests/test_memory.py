"""A request for too much memory raises `MemoryError`, as in numpy, and the robot still answers afterwards."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import urdd

#: Each asks for more than the 700 MB that are left, or than any memory: in one process, one after another.
TOO_MUCH = [
    "robot.random(10**13)",
    "robot.random(2**62)",
    "robot.random(2**70)",
    "robot.clamp(many(12_000_000))",
    "robot.link_poses(many(700_000))",
    "robot.link_pose(many(6_000_000), 'torch')",
    "robot.link_poses(many(700_000))",
    "robot.jacobian(many(6_000_000), 'torch')",
    "robot.jacobian(many(6_000_000), 'torch', [0, 0, 0.1])",
    "robot.inverse_kinematics('torch', np.zeros((6_000_000, 3)), restarts=0, iterations=1)",
    "robot.inverse_kinematics('torch', np.tile(np.eye(4), (3_000_000, 1, 1)), restarts=0, iterations=1)",
    "robot.distances(many(1_000_000))",
    "robot.distances(many(9_000_000), 'spheres')",
    "robot.self_distance(many(12_000_000))",
    "robot.in_collision(many(12_000_000))",
    "around.distances(many(3_000_000))",
    "around.min_distance(many(12_000_000))",
    "around.in_collision(many(12_000_000))",
    # One configuration among very many obstacles.
    "crowded.min_distance(q[0])",
    "crowded.nearest(q[0])",
    "model.clearances(many(9_000_000))",
    "model.min_clearance(many(12_000_000))",
    "model.may_collide(many(12_000_000))",
    "model.gradient(many(12_000_000))",
    "world.add_hull('h', np.zeros((3_000_000, 3)))",
    "world.add_mesh('m', np.zeros((3_000_000, 3)), np.zeros((3_000_000, 3), dtype=np.uint32))",
    # A robot without DOFs: its configurations take no memory, whatever their number.
    "still.link_poses(np.zeros((10**13, 0)))",
    "still.link_poses(np.zeros((2**59, 0)))",
    "still.in_collision(np.zeros((10**13, 0)))",
    "still.self_distance(np.zeros((10**13, 0)))",
    "still.world_proximity(world).distances(np.zeros((10**13, 0)))",
]

PROGRAM = """
import resource, sys
import numpy as np, urdd

robot, still = urdd.load(sys.argv[1]), urdd.load(sys.argv[2])
world = urdd.World()
for k in range(20):
    world.add_sphere(str(k), 0.1, [k, 0, 0])
around, model, q = robot.world_proximity(world), robot.collision_model(), robot.random(100)

crowd = urdd.World()
for k in range(100_000):
    crowd.add_sphere(str(k), 0.001, [k, 0, 0])
crowded = robot.world_proximity(crowd)

def many(count):
    return np.zeros((count, robot.num_dofs))

def answers():
    found = [robot.link_poses(q), robot.distances(q), robot.in_collision(q), around.min_distance(q)]
    found += [model.min_clearance(q), robot.jacobian(q, 'torch')]
    found += [robot.distances(q, 'spheres'), still.in_collision(np.zeros((3, 0)))]
    return found + [robot.inverse_kinematics('torch', robot.link_pose(q[:3], 'torch')).q]

expected = answers()
size = 4096 * int(open('/proc/self/statm').read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (size + 700_000_000,) * 2)
for words in sys.argv[3:]:
    try:
        print(f"{words}: gives {eval(words)!r:.60}")
    except MemoryError as error:
        print(f"{words}: MemoryError" if str(error) else f"{words}: says nothing")
    for one, before in zip(answers(), expected, strict=True):
        np.testing.assert_array_equal(one, before)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the limit of memory is Linux's")
def test_more_than_there_is_memory_for(learned: urdd.Robot, urdds: object) -> None:
    words = [sys.executable, "-c", PROGRAM, str(learned.path), f"{urdds}/single_link", *TOO_MUCH]
    found = subprocess.run(words, capture_output=True, text=True, check=False, timeout=600)
    assert found.stdout.splitlines() == [f"{words}: MemoryError" for words in TOO_MUCH], found.stderr[-2000:]
    assert found.returncode == 0


def test_numbers_of_numbers(arm: urdd.Robot) -> None:
    """If a number is not a size, the largest one works like any other."""
    pairs = arm.proximity().num_pairs
    assert len(arm.nearest(arm.zero, 2**70)) == pairs
    world = urdd.World()
    world.add_sphere("ball", 0.1)
    assert len(arm.world_proximity(world).nearest(arm.zero, 2**70)) == arm.world_proximity(world).num_pairs
    for wrong, words in (
        (lambda: arm.random(3, seed=-1), "a seed must be from 0"),
        (lambda: arm.inverse_kinematics("torch", [0, 0, 0], seed=-1), "a seed must be from 0"),
        (lambda: arm.inverse_kinematics("torch", [0, 0, 0], restarts=2**70), "restarts must be from 0"),
        (lambda: urdd.export(arm, "curobo", spheres=10**13), "`spheres` must be a whole number from 1 to 10,000"),
        (lambda: urdd.generate("a.urdf", "a", samples=10**13), "samples must be from 1 to 100,000"),
        (lambda: urdd.set_num_threads(-1), "at least 1"),
    ):
        with pytest.raises(ValueError, match=words):
            wrong()


@pytest.mark.skipif(sys.platform != "linux", reason="Linux alone tells how much memory is left")
def test_as_much_as_the_machine_has_is_refused(arm: urdd.Robot) -> None:
    with Path("/proc/meminfo").open(encoding="ascii") as file:
        kibibytes = int(file.readline().split()[1])
    with pytest.raises(MemoryError, match="MiB of memory left"):
        arm.random(1024 * kibibytes // 8 // arm.num_dofs)
