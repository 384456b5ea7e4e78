#!/usr/bin/env python3
"""Compares distance statistics and simple skips of a generated URDD with distances by coal at poses by Pinocchio.

    /opt/peers/bin/python tests/figures/geometry/statistics_by_coal.py URDD... [--pairs N] [--seed S]

Taken from the URDD: the carried URDF, the bounds, which joint a DOF is, the .stl files of hulls and pieces, and the figures
to check. Poses are Pinocchio's, from the URDF's text; the sampled configurations are made here as SPEC 9.3 says.
Distances are coal's between convex bodies, of the files' vertices; contact counts as 0. (python-fcl, which did it before, is
centimetres off where triangle meshes nearly touch.)

Checked for N pairs of hulls and N of pieces which a joint moves against each other (a third of them such as the URDD skips,
where there are so many), and as many rigid pairs:
(a) at SPEC's own first samples: mean, min, max of each moving pair. Goal: all within 1e-6 m. Rigid pairs: at one of them.
(b) at 2,000 other uniform configurations: the URDD's mean lies within 5 standard errors (of both means). Moving pairs only.
(c) `simple_skips` and `reasons` are those that coal's statistics of (a) give.
"""

import argparse
import math
import re
import sys

import coal
import numpy as np
import pinocchio

from urdd import Urdd, indexed

GOAL, ERRORS, OTHERS, SKIP = 1e-6, 5, 2000, 0.001
MASK = 2**64 - 1


def u(k, i):
    """SPEC 9.3, in Python integers."""
    z = (k * 2**32 + i + 1) * 0x9E3779B97F4A7C15 & MASK
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9 & MASK
    z = (z ^ z >> 27) * 0x94D049BB133111EB & MASK
    return ((z ^ z >> 31) >> 11) * 2.0**-53


assert (u(0, 0), u(2, 5), u(5, 7)) == (0.8833108082136426, 0.9660916392335607, 0.9624329601355096)


class Robot:
    """Link poses by Pinocchio. Mimics are taken out of the text and moved here, so that Pinocchio's own rules play no part."""

    def __init__(self, urdd):
        xml = urdd.urdf()
        self.links = [link.get("name") for link in xml.findall("link")]
        self.joints = [(j.get("name"), j.get("type"), self.links.index(j.find("parent").get("link")),
                        self.links.index(j.find("child").get("link"))) for j in xml.findall("joint")]
        odd = {kind for _, kind, *_ in self.joints} - {"fixed", "revolute", "continuous", "prismatic"}
        assert not odd, f"not covered by this script: {odd}"
        text = re.sub(r"<mimic[^>]*/>", "", urdd.urdf_path.read_text())
        self.model = pinocchio.buildModelFromXML(text)
        self.data = self.model.createData()
        self.frames = [self.model.getFrameId(name, pinocchio.FrameType.BODY) for name in self.links]
        dofs, bounds = urdd.document("dof_module"), urdd.document("bounds_module")
        self.lower, self.upper = (np.array(bounds[f"dof_{side}_bounds"]) for side in ("lower", "upper"))
        own = [[d, 1.0, 0.0] for d in range(dofs["num_dofs"])]
        self.drive = {}
        for idx, (of, mimic) in enumerate(zip(dofs["joint_idx_to_dof_idxs_mapping"], dofs["joint_idx_to_mimic_mapping"])):
            if of:
                self.drive[self.joints[idx][0]] = own[of[0]]
            elif mimic:
                self.drive[self.joints[idx][0]] = [mimic["dof_idx"], mimic["multiplier"], mimic["offset"]]
        # Bodies: links that fixed joints hold together.
        self.body = list(range(len(self.links)))
        for _, kind, parent, child in self.joints:
            if kind == "fixed":
                old, new = self.body[child], self.body[parent]
                self.body = [new if b == old else b for b in self.body]
        self.adjacent = {frozenset(j[2:]) for j in self.joints}

    def sampled(self, k):
        return self.lower + np.array([u(k, i) for i in range(len(self.lower))]) * (self.upper - self.lower)

    def poses(self, configuration):
        """(rotation, position) of each link."""
        q = pinocchio.neutral(self.model)
        for name, joint in zip(self.model.names, self.model.joints):
            if name in self.drive:
                dof, multiplier, offset = self.drive[name]
                value = offset + (multiplier * configuration[dof] if dof is not None else 0)
                q[joint.idx_q: joint.idx_q + joint.nq] = value if joint.nq == 1 else (math.cos(value), math.sin(value))
        pinocchio.framesForwardKinematics(self.model, self.data, q)
        return [(self.data.oMf[f].rotation.copy(), self.data.oMf[f].translation.copy()) for f in self.frames]


class Shape:
    def __init__(self, link, triangles):
        vertices, faces = indexed(triangles)
        mesh = coal.BVHModelOBBRSS()
        mesh.beginModel(len(faces), len(vertices))
        mesh.addVertices(vertices)
        mesh.addTriangles(faces.astype(np.int64))
        mesh.endModel()
        mesh.buildConvexHull(True, "Qt")
        self.link, self.convex = link, mesh.convex


REQUEST = coal.DistanceRequest()
REQUEST.gjk_tolerance = 1e-9  # of itself 1e-6, which is the goal


def distance(a, b, poses):
    places = [coal.Transform3s(*poses[shape.link]) for shape in (a, b)]
    found = coal.distance(a.convex, places[0], b.convex, places[1], REQUEST, coal.DistanceResult())
    return max(found, 0.0)


def chosen(rng, pairs, skips, count):
    """`count` pairs at random, a third of them skipped ones where there are so many."""
    yes = [p for p in pairs if skips[p[0]][p[1]]]
    no = [p for p in pairs if not skips[p[0]][p[1]]]
    take = min(len(yes), max(count // 3, count - len(no)))
    pick = lambda some, n: [some[k] for k in rng.permutation(len(some))[:n]]
    return pick(yes, take) + pick(no, count - take)


def compare(root, count, seed):
    urdd = Urdd(root)
    robot = Robot(urdd)
    statistics = urdd.document("link_shapes_distance_statistics_module")
    skips = urdd.document("link_shapes_simple_skips_module")
    hulls = urdd.document("convex_hull_meshes_module")["link_hulls"]
    pieces = urdd.document("convex_decomposition_meshes_module")["link_pieces"]
    files = {"full": [(i, hulls[i]["stl"]) for i in statistics["full_shapes"]],
             "decomposition": [(p["link_idx"], pieces[p["link_idx"]][p["piece_idx"]]["stl"]) for p in statistics["decomposition_shapes"]]}
    rng = np.random.default_rng(seed)
    own = [robot.poses(robot.sampled(k)) for k in range(statistics["num_samples"])]
    others = [robot.poses(q) for q in rng.uniform(robot.lower, robot.upper, (OTHERS, len(robot.lower)))]
    good = True
    for kind in ("full", "decomposition"):
        stated = statistics[f"{kind}_convex_hulls"]
        said, why = skips[f"{kind}_convex_hulls_simple_skips"], skips["reasons"][f"{kind}_convex_hulls"]
        links = [link for link, _ in files[kind]]
        pairs = [(i, j) for i in range(len(links)) for j in range(i) if links[i] != links[j]]
        rigid = {p: robot.body[links[p[0]]] == robot.body[links[p[1]]] for p in pairs}
        moving = chosen(rng, [p for p in pairs if not rigid[p]], said, count)
        still = chosen(rng, [p for p in pairs if rigid[p]], said, count)
        shapes = {i: Shape(links[i], urdd.triangles(files[kind][i][1])) for p in moving + still for i in p}
        worst, errors, wrong, skipped = dict.fromkeys(("mean", "min", "max"), 0.0), 0.0, 0, 0
        for i, j in moving + still:
            a, b = shapes[i], shapes[j]
            d = np.array([distance(a, b, poses) for poses in (own[:1] if rigid[i, j] else own)])
            found = {"mean": d.mean(), "min": d.min(), "max": d.max()}
            for key, value in found.items():
                worst[key] = max(worst[key], abs(stated[f"{key}_distances"][i][j] - value))
            skip = bool(found["max"] <= SKIP)
            reason = ("Always" if skip else "Adjacent" if frozenset((a.link, b.link)) in robot.adjacent
                      else "Never" if found["min"] > SKIP else "None")
            wrong += (said[i][j], why[i][j]) != (skip, reason)
            skipped += skip
            if not rigid[i, j]:
                o = np.array([distance(a, b, poses) for poses in others])
                error = math.sqrt(d.var(ddof=1) / len(d) + o.var(ddof=1) / len(o))
                errors = max(errors, abs(o.mean() - stated["mean_distances"][i][j]) / (error + 1e-9))
        fine = max(worst.values()) <= GOAL and errors <= ERRORS and not wrong
        good &= fine
        print(f"{urdd.metadata['robot_name']:16} {'hulls' if kind == 'full' else 'pieces':6} moving {len(moving):3} of {sum(not r for r in rigid.values()):5}"
              f", rigid {len(still):3}; differs by mean {worst['mean']:.1e} min {worst['min']:.1e} max {worst['max']:.1e} m;"
              f" other samples: {errors:.1f} standard errors; skips {skipped:3}, wrong {wrong}  {'good' if fine else 'NOT WITHIN THE GOALS'}", flush=True)
    return good


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdds", nargs="+")
    parser.add_argument("--pairs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    sys.exit(not all([compare(root, arguments.pairs, arguments.seed) for root in arguments.urdds]))
