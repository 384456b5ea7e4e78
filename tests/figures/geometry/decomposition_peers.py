#!/usr/bin/env python3
"""Convex pieces of a generated URDD beside those of CoACD and V-HACD at the same number of pieces, link by link.

    /tmp/split_venv/bin/python tests/figures/geometry/decomposition_peers.py --peers FOLDER [--pieces N] URDD[:LINK,LINK...]...

For each link named (all that have pieces, without names): the plain mesh of the URDD is divided by CoACD (threshold 0.05,
its default) and V-HACD (its defaults), both into at most N pieces, 7 without --pieces, one thread. Their pieces are kept in
FOLDER and are not made again: CoACD takes minutes for some links. In millimetres, measured by `pieces.py`:
- mean and max: how far the outer surface of the pieces stands off the link's surface.
- outside: how far the link's surface lies outside of the pieces. We promise 0.2 mm, the peers nothing.
- ratio: our mean over that of the better peer. Goals: geometric mean at most 1, worst at most 1.25; exit status 1 beyond.
Seconds are processor time of the peers.
"""

import argparse
import os
import pathlib
import sys
import time

os.environ["OMP_NUM_THREADS"] = "1"

import coacd
import numpy as np
import vhacdx

from pieces import distances
from urdd import Urdd, indexed

GOAL_MEAN, GOAL_WORST = 1.0, 1.25


def by_coacd(vertices, faces, most):
    coacd.set_log_level("error")
    return coacd.run_coacd(coacd.Mesh(vertices, faces), threshold=0.05, max_convex_hull=most)


def by_vhacd(vertices, faces, most):
    return vhacdx.compute_vhacd(vertices, faces, maxConvexHulls=most)


def made(folder, peer, name, plain, most):
    """The pieces' triangles by a peer, and its seconds; made where the folder does not hold them."""
    path = folder / f"{peer.__name__}_{most}_{name}.npz"
    if not path.exists():
        vertices, faces = indexed(plain)
        begin = time.process_time()
        pieces = peer(vertices, faces, most)
        seconds = time.process_time() - begin
        triangles = {f"piece{k}": np.asarray(v)[np.asarray(f).reshape(-1, 3)] for k, (v, f) in enumerate(pieces)}
        np.savez_compressed(path, seconds=seconds, **triangles)
    with np.load(path) as data:
        return [data[key] for key in data.files if key.startswith("piece")], float(data["seconds"])


def links(argument):
    """(name, plain triangles, our pieces' triangles) of the links asked for."""
    root, _, names = argument.partition(":")
    urdd = Urdd(root)
    chain = urdd.document("chain_module")["links_in_chain"]
    plain = urdd.document("plain_meshes_module")["link_meshes"]
    ours = urdd.document("convex_decomposition_meshes_module")["link_pieces"]
    wanted = set(names.split(",")) if names else {link["name"] for link in chain}
    if unknown := wanted - {link["name"] for link in chain}:
        sys.exit(f"{root} has no link {', '.join(sorted(unknown))}")
    for link, mesh, pieces in zip(chain, plain, ours, strict=True):
        if mesh and link["name"] in wanted:
            name = f"{urdd.metadata['robot_name']}_{link['name']}"
            yield name, urdd.triangles(mesh["files"]["stl"]), [urdd.triangles(p["stl"]) for p in pieces]


def told(pieces, measured, seconds=None):
    outside, off = measured
    after = "" if seconds is None else f" {seconds:.1f} s"
    return f"{1e3 * off.mean():.3f} / {1e3 * off.max():.2f} ({len(pieces)}){after}"


def compare(name, plain, ours, arguments):
    """Prints a row; our mean over the better peer's."""
    of = lambda pieces: distances(plain, pieces, arguments.samples, np.random.default_rng(7))
    mine = of(ours)
    row, best = [told(ours, mine), f"{1e3 * mine[0]:.3f}"], np.inf
    for peer in (by_coacd, by_vhacd):
        pieces, seconds = made(arguments.peers, peer, name, plain, arguments.pieces)
        theirs = of(pieces)
        best = min(best, theirs[1].mean())
        row.append(told(pieces, theirs, seconds))
    # 1 um is no distance to compare.
    ratio = max(mine[1].mean(), 1e-6) / max(best, 1e-6)
    print("|", name, "|", " | ".join(row), "|", f"{ratio:.2f} |", flush=True)
    return ratio


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdds", nargs="+")
    parser.add_argument("--peers", type=pathlib.Path, required=True)
    parser.add_argument("--pieces", type=int, default=7)
    parser.add_argument("--samples", type=int, default=6000)
    arguments = parser.parse_args()
    arguments.peers.mkdir(parents=True, exist_ok=True)
    print("| link | ours: mean / max (pieces) | outside | CoACD | V-HACD | ratio |\n|---|---|---|---|---|---|")
    ratios = [compare(*link, arguments) for urdd in arguments.urdds for link in links(urdd)]
    mean = float(np.exp(np.mean(np.log(ratios))))
    good = mean <= GOAL_MEAN and max(ratios) <= GOAL_WORST
    print(f"{len(ratios)} links: geometric mean of the ratios {mean:.3f}, worst {max(ratios):.3f}"
          f"  {'good' if good else 'NOT WITHIN THE GOALS'}")
    sys.exit(not good)
