"""Plans a motion by spheres, in a millisecond, and lets the exact shapes prove it. Prints the path as CSV.

    urdd generate ROBOT.urdf -o URDD --modules all,spheres
    python plan_by_spheres.py URDD [SEED]

SEED chooses the ends. `rrt_connect.py` plans by the exact shapes alone, and keeps a distance.
"""

import sys

import numpy as np

import urdd

REACH = 1.0  # the longest motion by which a tree grows, rad or m
BATCH = 16  # samples that a tree grows towards at once: a call of few motions is mostly Python
RESOLUTION = 0.02  # no sphere travels farther between two configurations that are checked, m


def plan(checker, lower, upper, start, goal, random, rounds=2_000):
    """RRT-Connect: configurations (n, DOFs) from start to goal, between which no sphere touches; or None."""
    trees, parents = [start[None], goal[None]], [[-1], [-1]]

    def grow(side, targets, reach):
        """The nearest nodes of a tree move towards the targets. Where nothing is in the way, these are new nodes."""
        nodes = trees[side]
        gaps = ((targets[:, None] - nodes) ** 2).sum(axis=2)
        near = gaps.argmin(axis=1)
        parts = np.minimum(1.0, reach / np.maximum(gaps.min(axis=1), 1e-18) ** 0.5)
        ends = np.where(parts[:, None] < 1, nodes[near] + parts[:, None] * (targets - nodes[near]), targets)
        free = np.isnan(checker.blocked_edge(nodes[near], ends, resolution=RESOLUTION))
        trees[side] = np.concatenate([nodes, ends[free]])
        parents[side] += near[free].tolist()
        return np.flatnonzero(free)

    def walk(side, node):
        found = []
        while node >= 0:
            found.append(trees[side][node])
            node = parents[side][node]
        return found

    targets = goal[None]  # the straight motion first
    for _ in range(rounds):
        side = int(len(trees[0]) > len(trees[1]))  # the smaller tree
        own, other = len(trees[side]), len(trees[1 - side])
        if len(grow(side, targets, REACH)) > 0:
            met = grow(1 - side, trees[side][own:], np.inf)
            if len(met) > 0:
                path = np.array(walk(side, own + met[0])[::-1] + walk(1 - side, other)[1:])
                return path[:: 1 - 2 * side]
        targets = random.uniform(lower, upper, (BATCH, len(start)))
    return None


def shorten(checker, path):
    """The shortest way along configurations of the path: all motions between two of them are checked at once."""
    first, last = np.triu_indices(len(path), 1)
    free = np.isnan(checker.blocked_edge(path[first], path[last], resolution=RESOLUTION))
    least, before = np.full(len(path), np.inf), np.zeros(len(path), int)
    least[0] = 0
    for a, b in np.column_stack([first, last])[free]:  # ascending by `a`, whose least is known
        length = least[a] + np.linalg.norm(path[b] - path[a])
        if length < least[b]:
            least[b], before[b] = length, a
    kept = [len(path) - 1]
    while kept[-1] > 0:
        kept.append(before[kept[-1]])
    return path[kept[::-1]]


def is_proved(exact, path):
    """Whether the exact shapes touch nowhere on a path: no resolution, each motion as a whole."""
    return all(np.isnan(check.blocked_edge(path[:-1], path[1:], resolution=None)).all() for check in exact)


def plan_proved(checker, exact, lower, upper, start, goal, random, times=10):
    """A path that the exact shapes prove free, of several that spheres find; or None."""
    for _ in range(times):
        path = plan(checker, lower, upper, start, goal, random)
        if path is None or is_proved(exact, path):
            return path
    return None


def main():
    robot = urdd.load(sys.argv[1])
    random = np.random.default_rng(int(sys.argv[2]) if len(sys.argv) > 2 else 0)
    world = urdd.World()
    base = [link for link in robot.link_names if len(robot.dofs_between(robot.root_link, link)) == 0]
    world.add_box("table", size=[2, 2, 0.1], pose=[0, 0, -0.05], ignore=base)
    world.add_sphere("ball", radius=0.15, centre=[0.45, 0.1, 0.6])
    checker = robot.sphere_checker(world=world)
    exact = [robot.proximity("pieces"), robot.world_proximity(world)]
    middle = robot.bounds.mean(axis=1)
    lower, upper = np.maximum(robot.bounds[:, 0], middle - np.pi), np.minimum(robot.bounds[:, 1], middle + np.pi)
    samples = random.uniform(lower, upper, (10_000, robot.num_dofs))
    touches = checker.in_collision(samples) | exact[0].in_collision(samples) | exact[1].in_collision(samples)
    if (~touches).sum() < 2:
        raise SystemExit("no two free configurations were found: move or remove obstacles")
    start, goal = samples[~touches][:2]
    path = plan_proved(checker, exact, lower, upper, start, goal, random)
    if path is None:
        raise SystemExit("no path was found: try other ends (another SEED)")
    short = shorten(checker, path)
    path = short if is_proved(exact, short) else path
    np.savetxt(sys.stdout, path, delimiter=",", header=",".join(robot.dof_names), comments="")
    print(f"{len(path)} configurations; proved free", file=sys.stderr)


if __name__ == "__main__":
    main()
