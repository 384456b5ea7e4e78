"""Poses and distances of spheres in batches, by NumPy, PyTorch or JAX: all that they need is in `chain_arrays()`.

python array_kinematics.py URDD [numpy|torch|jax]

Prints how far the poses and the distances are from those of the library.
"""

import importlib
import sys

import numpy as np

import urdd

SPHERES = "piece-spheres"


def link_poses(xp, array, chain, q):
    """(n, links, 4, 4) from q (n, dofs)."""
    n = q.shape[0]
    frames = {-1: array(np.tile(np.eye(4), (n, 1, 1)))}
    x, y, z = chain.axis.T
    o = np.zeros_like(x)
    cross = np.stack([np.stack(row, -1) for row in ((o, -z, y), (z, o, -x), (-y, x, o))], 1)
    for k, parent in enumerate(chain.parent.tolist()):
        motion = array(np.tile(np.eye(4), (n, 1, 1)))
        if chain.axis[k].any():
            dof = int(chain.dof[k])
            driver = q[:, dof] if dof >= 0 else q.sum(1) * 0.0
            p = (chain.multiplier[k] * driver + chain.offset[k])[:, None, None]
            # As 4 by 4 matrices: the cross product of the axis, or the axis as a translation.
            change = np.zeros((4, 4))
            if chain.turns[k]:
                change[:3, :3] = cross[k]
                motion = motion + xp.sin(p) * array(change) + (1 - xp.cos(p)) * array(change @ change)
            else:
                change[:3, 3] = chain.axis[k]
                motion = motion + p * array(change)
        frames[k] = frames[parent] @ array(chain.origin[k]) @ motion
    return xp.stack([frames[frame] for frame in chain.link_frame.tolist()], 1)


def sphere_distances(xp, array, poses, links, centres, radii, pairs):
    """(n, pairs): the distances of pairs of spheres, not below 0."""
    ends = np.concatenate([centres, np.ones((len(centres), 1))], 1)[:, :, None]
    places = (poses[:, links] @ array(ends))[:, :, :3, 0]
    between = places[:, pairs[:, 0]] - places[:, pairs[:, 1]]
    apart = xp.sqrt((between * between).sum(-1)) - array(radii[pairs].sum(1))
    return apart * (apart > 0)


def main():
    robot = urdd.load(sys.argv[1])
    name = sys.argv[2] if len(sys.argv) > 2 else "numpy"
    xp = importlib.import_module("jax.numpy" if name == "jax" else name)
    if name == "jax":
        importlib.import_module("jax").config.update("jax_enable_x64", True)
    array = xp.asarray
    q = robot.random(256)
    poses = link_poses(xp, array, robot.chain_arrays(), array(q))
    spheres, proximity = robot.spheres("pieces"), robot.proximity(SPHERES)
    links = np.array([robot.link(link) for link in spheres.links])
    places = {
        (link, piece): k for k, (link, piece) in enumerate(zip(links.tolist(), spheres.pieces.tolist(), strict=True))
    }
    shapes = proximity.pair_indices.reshape(-1, 2).tolist()
    pairs = np.array([places[tuple(shape)] for shape in shapes], dtype=np.int64).reshape(-1, 2)
    distances = sphere_distances(xp, array, poses, links, spheres.centres, spheres.radii, pairs)
    off = [np.abs(np.asarray(poses) - robot.link_poses(q)).max(initial=0)]
    off.append(np.abs(np.asarray(distances) - proximity.distances(q)).max(initial=0))
    print(f"{name}: poses within {off[0]:.1e}, distances of {len(pairs)} pairs of spheres within {off[1]:.1e}")
    return 0 if max(off) < 1e-6 else 1


if __name__ == "__main__":
    sys.exit(main())
