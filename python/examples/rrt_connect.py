"""Plans a motion among obstacles by RRT-Connect, and proves it free. Prints the path as CSV.

python rrt_connect.py URDD [SEED]

SEED chooses the ends: a free configuration, and another pose of the last link, reached as near to it as possible.
"""

import sys

import numpy as np

import urdd

STEP = 0.3  # the longest motion that a tree grows by, rad or m
MARGIN = 0.01  # the distance that is kept from obstacles, m; links may be nearer to each other


def plan(robot, checks, start, goal, random, tries=20_000):
    def free(a, b):
        return all(np.isnan(check.blocked_edge(a, b, margin=margin, resolution=0.02)) for check, margin in checks)

    def grow(nodes, parents, target):
        near = int(np.argmin([np.linalg.norm(node - target) for node in nodes]))
        far = np.linalg.norm(target - nodes[near])
        new = target if far <= STEP else nodes[near] + (target - nodes[near]) * (STEP / far)
        if not free(nodes[near], new):
            return None
        nodes.append(new)
        parents.append(near)
        return new

    for name, end in (("start", start), ("goal", goal)):
        for check, margin in checks:
            for pair in check.nearest(end, 1):
                if pair.distance <= margin:
                    one, other = getattr(pair, "links", None) or (pair.link, pair.obstacle)
                    raise SystemExit(f"there is no path: at the {name}, {one} is {pair.distance:.4f} m from {other}")

    def path(nodes, parents):
        place, found = len(nodes) - 1, []
        while place is not None:
            found.append(nodes[place])
            place = parents[place]
        return found

    trees = [([start], [None]), ([goal], [None])]
    lower, upper = window(robot)
    lower, upper = np.min([lower, start, goal], axis=0), np.max([upper, start, goal], axis=0)
    for count in range(tries):
        here, there = trees[count % 2], trees[1 - count % 2]
        new = grow(*here, random.uniform(lower, upper))
        while new is not None and (reached := grow(*there, new)) is not None:
            if np.array_equal(reached, new):
                own, other = path(*here)[::-1], path(*there)[1:]
                return np.array(own + other)[:: 1 if count % 2 == 0 else -1]
    raise SystemExit(
        f"no path was found in {tries:,} tries. There may be none: try other ends (another SEED), ends that are nearer "
        "to each other, a smaller MARGIN, or more tries."
    )


def window(robot):
    """Bounds of at most one turn about their middle: joints that turn twice only search longer."""
    lower, upper = robot.bounds.T
    middle = (lower + upper) / 2
    return np.maximum(lower, middle - np.pi), np.minimum(upper, middle + np.pi)


def choose_ends(robot, checks, random):
    """A free configuration, and one that reaches another pose of the last link: the nearest, within half a turn."""

    def free(q):
        return not any(check.is_within(q, 2 * margin) for check, margin in checks)

    tip = max(robot.link_names, key=lambda link: len(robot.dofs_between(robot.root_link, link)))
    shapes = [check for check, _ in checks]
    lower, upper = window(robot)
    for start, other in random.uniform(lower, upper, (2000, 2, robot.num_dofs)):
        if free(start):
            bounds = np.transpose([np.maximum(lower, start - np.pi), np.minimum(upper, start + np.pi)])
            found = robot.inverse_kinematics(
                tip, robot.link_pose(other, tip), start, posture=start, bounds=bounds, free_of=shapes, margin=2 * MARGIN
            )
            if found.reached and free(found.q):
                return start, found.q
    raise SystemExit("no two free configurations were found: move or remove obstacles, or choose a smaller MARGIN")


def main():
    robot = urdd.load(sys.argv[1])
    random = np.random.default_rng(int(sys.argv[2]) if len(sys.argv) > 2 else 0)
    world = urdd.World()
    base = [link for link in robot.link_names if len(robot.dofs_between(robot.root_link, link)) == 0]
    world.add_box("table", size=[2, 2, 0.1], pose=[0, 0, -0.05], ignore=base)
    world.add_sphere("ball", radius=0.15, centre=[0.45, 0.1, 0.6])
    checks = [(robot.proximity("pieces"), 2e-4), (robot.world_proximity(world), MARGIN)]
    start, goal = choose_ends(robot, checks, random)
    path = plan(robot, checks, start, goal, random)
    proved = all(np.isnan(check.blocked_edge(path[:-1], path[1:], resolution=None)).all() for check, _ in checks)
    np.savetxt(sys.stdout, path, delimiter=",", header=",".join(robot.dof_names), comments="")
    print(f"{len(path)} configurations; {'proved free' if proved else 'not proved free'}", file=sys.stderr)


if __name__ == "__main__":
    main()
