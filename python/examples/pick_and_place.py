"""Picks a part up, carries it to another place, and puts it down, among obstacles. Prints the path as CSV.

python pick_and_place.py URDD LINK [--show]

LINK carries the part, which hangs below it. With --show, the page moves along.
"""

import itertools
import sys
import time

import numpy as np
from rrt_connect import plan

import urdd

SIZE = [0.04, 0.04, 0.08]  # of the part, m
MARGIN = 0.005  # the distance that is kept from obstacles, m


def reach(robot, link, checks, start):
    """A configuration in which the part can be gripped or put down, anywhere that the link reaches."""
    for q in robot.random(2000, seed=start):
        pose = robot.link_pose(q, link)
        found = robot.inverse_kinematics(link, pose, q, free_of=checks)
        if found.reached:
            return found.q
    raise SystemExit("no place was found")


def main():
    robot, link = urdd.load(sys.argv[1]), sys.argv[2]
    world = urdd.World()
    base = [link for link in robot.link_names if len(robot.dofs_between(robot.root_link, link)) == 0]
    world.add_box("table", size=[2, 2, 0.1], pose=[0, 0, -0.05], ignore=base)
    world.add_sphere("ball", radius=0.15, centre=[0.45, 0.1, 0.6])
    part = urdd.World()
    part.add_box("part", SIZE, pose=[0, 0, SIZE[2] / 2 + 0.01], ignore=[link])

    empty = robot.proximity()
    holding = empty.attach(link, part)
    free = [holding, robot.world_proximity(world, holding)]
    picks, places = (reach(robot, link, free, seed) for seed in (1, 2))
    # Where the part lies: an obstacle as long as nobody holds it.
    lies = urdd.World()
    in_link = np.eye(4)
    in_link[:3, 3] = [0, 0, SIZE[2] / 2 + 0.01]
    lies.add_box("part", SIZE, robot.link_pose(picks, link) @ in_link, ignore=[link])

    random = np.random.default_rng(0)
    home = next(q for q in [robot.zero, *robot.random(2000)] if not any(check.is_within(q, MARGIN) for check in free))
    there = [(empty, 2e-4), (robot.world_proximity(world), MARGIN / 2), (robot.world_proximity(lies), 0.0)]
    carry = [(holding, 0.0), (robot.world_proximity(world, holding), 0.0)]
    lies.move("part", robot.link_pose(places, link) @ in_link)
    back = [*there[:2], (robot.world_proximity(lies), 0.0)]
    legs = [plan(robot, there, home, picks, random), plan(robot, carry, picks, places, random)]
    legs.append(plan(robot, back, places, home, random))
    for leg, checks in zip(legs, (there, carry, back), strict=True):
        ok = all(np.isnan(check.blocked_edge(leg[:-1], leg[1:], resolution=0.002)).all() for check, _ in checks)
        print(f"{len(leg)} configurations; {'free' if ok else 'not free'} at 2 mm", file=sys.stderr)
    path = np.concatenate(legs)
    np.savetxt(sys.stdout, path, delimiter=",", header=",".join(robot.dof_names), comments="")
    if "--show" in sys.argv:
        with robot.show(home) as shown:
            for start, end in itertools.pairwise(path):
                for part_of_way in np.linspace(0, 1, 30):
                    shown.set(start + part_of_way * (end - start))
                    time.sleep(1 / 60)


if __name__ == "__main__":
    main()
