"""The rules of `link_shapes_spheres_module` (8.9)."""

from __future__ import annotations

import itertools
from typing import Any

from .bodies import Body, distance_of
from .derived_meshes import triangles
from .geometry import Triangle, diagonal
from .kinematics import Pose, Robot, compose, poses, sampled
from .model_rules import unskipped
from .modules import Urdd, file_of
from .numeric import add, distance, norm, sub, transposed, turned
from .shape_rules import Shapes
from .spheres_fit import Ball, standoff, uncovered, uncovered_points

NAME = "link_shapes_spheres_module"
FILE = file_of(NAME)
MAX_LEVELS = 16  # 8.9.2
MAX_SPHERES = 65_536  # 8.9.2
MAX_SAMPLES = 100_000  # 8.9.2
FIRST = 2**31  # 8.9.6
IN_OUTER = 1e-9  # 8.9.3
COVERED = 1e-6  # 8.9.4
LENGTHS = 1e-6  # 8.9.5
LENGTHS_FAR = 1e-7  # 8.9.5
FRACTIONS = 1e-4  # 8.9.5
TOUCHING = 1e-9  # 8.9.6
COUNTED = 10_000  # 8.9.7
MOST_SAMPLES = 2_000  # 8.9.7: beyond this, pairs and counts are not verified
OFTEN = ("never", "sometimes", "always")


def error(urdd: Urdd, code: str, pointer: str) -> None:
    urdd.report.error(code, FILE, pointer)


def balls_of(spheres: Any) -> tuple[Ball, ...]:
    """Centre and radius of each sphere."""
    return tuple((tuple(float(x) for x in s["offset_xyz"]), float(s["radius"])) for s in spheres)


def check_sizes(urdd: Urdd, module: Any) -> None:
    """8.9.2: how many of each."""
    if not 1 <= len(module["levels"]) <= MAX_LEVELS:
        error(urdd, "SPH001", "/levels")
    if not 1 <= module["num_samples"] <= MAX_SAMPLES:
        error(urdd, "SPH001", "/num_samples")
    for place, level in enumerate(module["levels"]):
        if sum(len(of_link) for of_link in level["spheres"]) > MAX_SPHERES:
            error(urdd, "SPH001", f"/levels/{place}/spheres")
        for link, spheres in enumerate(level["spheres"]):
            if any(sphere["radius"] <= 0 for sphere in spheres):
                error(urdd, "SPH003", f"/levels/{place}/spheres/{link}")


def check_lists(urdd: Urdd, module: Any, pieces: list[int]) -> None:
    """8.9.2: which links have spheres and fits."""
    for place, level in enumerate(module["levels"]):
        pointer = f"/levels/{place}"
        if len(level["spheres"]) != len(pieces) or len(level["fits"]) != len(pieces):
            error(urdd, "SPH002", pointer)
            continue
        for link, count in enumerate(pieces):
            spheres = level["spheres"][link]
            if (count == 0 and spheres) or (place == 0 and count > 0 and len(spheres) != 1):
                error(urdd, "SPH002", f"{pointer}/spheres/{link}")
            if (level["fits"][link] is None) == bool(spheres):
                error(urdd, "SPH002", f"{pointer}/fits/{link}")


def check_nesting(urdd: Urdd, module: Any) -> None:
    """8.9.3."""
    for place, level in enumerate(module["levels"]):
        outer = level["outer_level_idx"]
        if (outer is not None and outer >= place) or (outer is None) != (place == 0):
            error(urdd, "SPH004", f"/levels/{place}/outer_level_idx")
            continue
        for link, spheres in enumerate(level["spheres"]):
            around = [] if outer is None else module["levels"][outer]["spheres"][link]
            for number, sphere in enumerate(spheres):
                if not is_in_outer(sphere, around, place == 0):
                    error(urdd, "SPH004", f"/levels/{place}/spheres/{link}/{number}")


def is_in_outer(sphere: Any, around: Any, is_first: bool) -> bool:
    idx = sphere["outer_sphere_idx"]
    if is_first or idx is None or idx >= len(around):
        return is_first and idx is None
    outer = around[idx]
    apart = distance(sphere["offset_xyz"], outer["offset_xyz"])
    return apart + sphere["radius"] - outer["radius"] <= IN_OUTER * outer["radius"]


def check_covering(urdd: Urdd, module: Any, meshes: list[list[list[Triangle]]]) -> None:
    """8.9.4."""
    if not module["levels"][0]["covers"]:
        error(urdd, "SPH005", "/levels/0/covers")
    for place, level in enumerate(module["levels"]):
        for link, pieces in enumerate(meshes if level["covers"] else []):
            balls = balls_of(level["spheres"][link])
            for piece in pieces:
                farthest = max(norm(corner) for triangle in piece for corner in triangle)
                found = uncovered_points(tuple(piece), balls, COVERED * farthest)
                if any(found):
                    error(urdd, "SPH005", f"/levels/{place}/spheres/{link}")


def is_within(stated: float, found: tuple[float, float], tolerance: float) -> bool:
    return found[0] - tolerance <= stated <= found[1] + tolerance


def check_fits(urdd: Urdd, module: Any, meshes: list[list[list[Triangle]]]) -> None:
    """8.9.5."""
    for place, level in enumerate(module["levels"]):
        for link, (fit, pieces) in enumerate(zip(level["fits"], meshes)):
            if fit is None:
                continue
            pointer = f"/levels/{place}/fits/{link}"
            size = diagonal([p for piece in pieces for triangle in piece for p in triangle])
            key = tuple(tuple(piece) for piece in pieces)
            balls = balls_of(level["spheres"][link])
            farthest = max(norm(p) for piece in pieces for triangle in piece for p in triangle)
            length = max(LENGTHS * size, LENGTHS_FAR * farthest)
            largest, mean = standoff(key, balls, size)
            if not is_within(fit["max_standoff"], largest, length):
                error(urdd, "SPH006", pointer)
            if not is_within(fit["mean_standoff"], mean, length):
                error(urdd, "SPH006", pointer)
            fraction, outermost = uncovered(key, balls, size)
            if not is_within(fit["uncovered_fraction"], fraction, FRACTIONS):
                error(urdd, "SPH007", pointer)
            if not is_within(fit["max_uncovered"], outermost, length):
                error(urdd, "SPH007", pointer)


def pairs_of(stated: Any) -> list[tuple[int, int]]:
    return [(pair["link_a_idx"], pair["link_b_idx"]) for pair in stated]


def check_pairs(urdd: Urdd, module: Any) -> None:
    """8.9.6: the order of lists of pairs."""
    for place, level in enumerate(module["levels"]):
        has = {link for link, spheres in enumerate(level["spheres"]) if spheres}
        for key in ("ignored_pairs", "always_pairs", "sometimes_pairs"):
            pairs = pairs_of(level[key])
            right = all(a < b and a in has and b in has for a, b in pairs)
            if pairs != sorted(set(pairs)) or not right:
                error(urdd, "SPH009", f"/levels/{place}/{key}")
        if set(pairs_of(level["always_pairs"])) & set(pairs_of(level["sometimes_pairs"])):
            error(urdd, "SPH009", f"/levels/{place}/sometimes_pairs")


def check_ignored(urdd: Urdd, module: Any, asked: set[tuple[int, int]]) -> None:
    """8.9.7: what a level may ignore."""
    for place, level in enumerate(module["levels"]):
        ignored = set(pairs_of(level["ignored_pairs"]))
        if (level["covers"] and ignored) or not ignored <= asked:
            error(urdd, "SPH010", f"/levels/{place}/ignored_pairs")


def check_sums(urdd: Urdd, module: Any) -> None:
    """8.9.7: which counts can be."""
    for place, level in enumerate(module["levels"]):
        e = level["evaluation"]
        right = e["num_colliding"] + e["num_free"] == module["num_samples"]
        if (
            not right
            or e["num_missed"] > e["num_colliding"]
            or e["num_false_contacts"] > e["num_free"]
        ):
            error(urdd, "SPH011", f"/levels/{place}/evaluation")


def gap(a: list[Ball], b: list[Ball]) -> float:
    """How far the nearest spheres of two links are apart; negative in contact."""
    return min(distance(p, q) - (r + s) for (p, r), (q, s) in itertools.product(a, b))


def placed(balls: tuple[Ball, ...], pose: Pose) -> list[Ball]:
    rotation, shift = pose
    return [(add(turned(rotation, centre), shift), radius) for centre, radius in balls]


def often(gaps: list[float], larger: float) -> int:
    """How often links are in contact where radii are together larger by this."""
    touching = [gap <= larger for gap in gaps]
    return 2 if all(touching) else 1 if any(touching) else 0


def check_contacts(
    urdd: Urdd, robot: Robot, level: Any, at: list[list[Pose]], place: int
) -> dict[tuple[int, int], list[float]]:
    """8.9.6: how often links are in contact; gives how far they are apart."""
    balls = [balls_of(spheres) for spheres in level["spheres"]]
    has = [link for link, of_link in enumerate(balls) if of_link]
    found: dict[tuple[int, int], list[float]] = {
        pair: [] for pair in itertools.combinations(has, 2)
    }
    for of_links in at:
        moved = {link: placed(balls[link], of_links[link]) for link in has}
        for a, b in found:
            found[a, b].append(gap(moved[a], moved[b]))
    slack = TOUCHING * 2 * robot.reach()
    stated = dict.fromkeys(pairs_of(level["sometimes_pairs"]), 1)
    stated.update(dict.fromkeys(pairs_of(level["always_pairs"]), 2))
    for pair, gaps in found.items():
        if not often(gaps, -slack) <= stated.get(pair, 0) <= often(gaps, slack):
            error(urdd, "SPH008", f"/levels/{place}/{OFTEN[often(gaps, 0.0)]}_pairs")
    return found


def collisions(shapes: Shapes, asked: Any, at: list[list[Pose]]) -> list[bool]:
    """8.8.5, 8.8.9: for each configuration, whether pieces are in contact."""
    bodies: dict[int, list[Body]] = {}
    for body in shapes.bodies("decomposition_convex_hulls", None):
        bodies.setdefault(body.link, []).append(body)
    return [any(links_touch(bodies[a], bodies[b], of[a], of[b]) for a, b in asked) for of in at]


def links_touch(a: list[Body], b: list[Body], pose: Pose, other: Pose) -> bool:
    back = transposed(pose[0])
    zero = (0.0, 0.0, 0.0)
    relative = compose((back, zero), (other[0], sub(other[1], pose[1])))
    for one, two in itertools.product(a, b):
        # No point of a body is farther from its link's origin than this.
        if norm(relative[1]) <= one.farthest() + two.farthest():
            if distance_of(one, two, relative) == 0:
                return True
    return False


def check_counts(
    urdd: Urdd, level: Any, place: int, in_collision: list[bool], touch: list[list[bool]]
) -> None:
    """8.9.7. `touch` is where radii are smaller by the tolerance, and larger."""
    tight, loose = [list(zip(in_collision, of)) for of in touch]
    colliding, free = in_collision.count(True), in_collision.count(False)
    right = {
        "num_colliding": (colliding, colliding, len(tight)),
        "num_missed": (loose.count((True, False)), tight.count((True, False)), colliding),
        "num_free": (free, free, len(tight)),
        "num_false_contacts": (tight.count((False, True)), loose.count((False, True)), free),
    }
    for key, (least, most, among) in right.items():
        slack = -(-among // COUNTED)
        if not least - slack <= level["evaluation"][key] <= most + slack:
            error(urdd, "SPH012", f"/levels/{place}/evaluation/{key}")


def check_samples(urdd: Urdd, robot: Robot, shapes: Shapes, module: Any) -> None:
    """8.9.6, 8.9.7: what is said of sampled configurations."""
    count = module["num_samples"]
    if count > MOST_SAMPLES:
        return
    asked = unskipped(urdd, shapes)
    at = [poses(robot, sampled(robot, FIRST + k)) for k in range(count)]
    found = [check_contacts(urdd, robot, level, at, k) for k, level in enumerate(module["levels"])]
    if not urdd.report.clean("SPH"):
        return
    in_collision = collisions(shapes, sorted(asked), at)
    for place, (level, gaps) in enumerate(zip(module["levels"], found)):
        pairs = [
            gaps[pair] for pair in asked - set(pairs_of(level["ignored_pairs"])) if pair in gaps
        ]
        slack = TOUCHING * 2 * robot.reach()
        touch = [
            [any(of[k] <= larger for of in pairs) for k in range(count)]
            for larger in (-slack, slack)
        ]
        check_counts(urdd, level, place, in_collision, touch)


def check_spheres(urdd: Urdd, robot: Robot, shapes: Shapes) -> None:
    """8.9."""
    if not urdd.have(NAME, "link_shapes_skips_module") or not urdd.report.clean("SHP"):
        return
    module = urdd.documents[NAME]
    pieces = urdd.documents["convex_decomposition_meshes_module"]["link_pieces"]
    check_sizes(urdd, module)
    check_lists(urdd, module, [len(of_link) for of_link in pieces])
    if not urdd.report.clean("SPH"):
        return
    check_nesting(urdd, module)
    check_pairs(urdd, module)
    check_sums(urdd, module)
    if urdd.report.clean("SPH009"):
        check_ignored(urdd, module, unskipped(urdd, shapes))
    meshes = [[triangles(urdd, piece) for piece in of_link] for of_link in pieces]
    if urdd.report.clean("SPH"):
        check_covering(urdd, module, meshes)
        check_fits(urdd, module, meshes)
    if urdd.report.clean("SPH"):
        check_samples(urdd, robot, shapes, module)
