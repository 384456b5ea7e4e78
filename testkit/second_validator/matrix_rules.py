"""The rules of matrices over shapes: statistics, simple skips and skips (8.4 to 8.7)."""

from __future__ import annotations

from typing import Any

from .bodies import Body, distance_of
from .kinematics import Pose, Robot, named, poses, sampled
from .modules import Urdd, file_of
from .numeric import Matrix, agree, product, sub, transposed, turned
from .shape_rules import APPROXIMATIONS, Shapes

STATISTICS = "link_shapes_distance_statistics_module"
SIMPLE = "link_shapes_simple_skips_module"
SKIPS = "link_shapes_skips_module"
KINDS = tuple(
    f"{part}_{shape}"
    for part in ("full", "decomposition")
    for shape in ("convex_hulls", "obbs", "bounding_spheres")
)
CONTACT = 0.001  # 8.6
DISTANCE_TOLERANCE = 1e-5  # 8.5
MAX_PIECES = 500  # 8.4
MAX_DISTANCES = 400_000
REASONS = ("SameLink", "Always", "Adjacent", "Default", "Never", "None")


def matrices(document: Any, name: str) -> list[tuple[str, str, Any]]:
    """The matrices of a document: their kinds, their places and themselves."""
    found = []
    for kind in KINDS:
        if name == STATISTICS:
            for key in ("mean_distances", "min_distances", "max_distances"):
                inside = document[kind]
                found.append((kind, f"/{kind}/{key}", inside and inside[key]))
        elif name == SIMPLE:
            found.append((kind, f"/{kind}_simple_skips", document[f"{kind}_simple_skips"]))
            found.append((kind, f"/reasons/{kind}", document["reasons"][kind]))
        else:
            found.append((kind, f"/{kind}_skips", document[f"{kind}_skips"]))
    return found


def alike(a: Any, b: Any) -> bool:
    """8.4: numbers agree as in 5.6; skips and reasons are equal."""
    return a == b or (isinstance(a, (int, float)) and not isinstance(a, bool) and agree(a, b))


def check_matrices(urdd: Urdd, shapes: Shapes, name: str) -> None:
    """8.1, 8.4."""
    error = urdd.report.error
    document = urdd.documents[name]
    file = file_of(name)
    stated = [(one["link_idx"], one["piece_idx"]) for one in document["decomposition_shapes"]]
    if document["full_shapes"] != shapes.full or stated != shapes.pieces:
        error("SHP010", file, "/full_shapes")
        return
    for kind, pointer, matrix in matrices(document, name):
        count = len(shapes.places(kind))
        if matrix is None:
            if count <= MAX_PIECES:
                error("SHP015", file, pointer)
            continue
        if len(matrix) != count or any(len(row) != count for row in matrix):
            error("SHP005", file, pointer)
            continue
        diagonal = 0.0 if name == STATISTICS else True
        for i in range(count):
            if not pointer.startswith("/reasons") and not alike(matrix[i][i], diagonal):
                error("SHP007", file, f"{pointer}/{i}/{i}")
            for j in range(i):
                if not alike(matrix[i][j], matrix[j][i]):
                    error("SHP006", file, f"{pointer}/{i}/{j}")


class Distances:
    """Distances of shapes in configurations, and the tolerance of 8.5."""

    def __init__(self, robot: Robot, shapes: Shapes, approximations: Any) -> None:
        self.robot = robot
        self.bodies = {kind: shapes.bodies(kind, approximations) for kind in KINDS}
        self.reach = robot.reach()
        self.far = {kind: [body.farthest() for body in self.bodies[kind]] for kind in KINDS}
        self.poses: dict[int | str, list[Pose]] = {}
        self.group = list(range(len(robot.links)))
        for level in robot.levels[1:]:
            for link in level:
                joint = robot.above[link]
                if joint is not None and robot.joints[joint]["joint_type"] == "Fixed":
                    self.group[link] = self.group[robot.parent[joint]]

    def tolerance(self, kind: str, i: int, j: int) -> float:
        """8.5."""
        return DISTANCE_TOLERANCE * (2 * self.reach + self.far[kind][i] + self.far[kind][j])

    def is_rigid(self, a: Body, b: Body) -> bool:
        """8.5: whether only fixed joints are between two shapes, or none."""
        return self.group[a.link] == self.group[b.link]

    def at(self, kind: str, i: int, j: int, k: int | str) -> float:
        """The distance of a pair in sampled configuration k, or in the default one."""
        if k not in self.poses:
            q = named(self.robot, k) if isinstance(k, str) else sampled(self.robot, k)
            self.poses[k] = poses(self.robot, q)
        a, b = self.bodies[kind][i], self.bodies[kind][j]
        if self.is_rigid(a, b) and k != 0:
            return self.at(kind, i, j, 0)
        (rotation, shift), (other, other_shift) = self.poses[k][a.link], self.poses[k][b.link]
        back: Matrix = transposed(rotation)
        relative = (product(back, other), turned(back, sub(other_shift, shift)))
        return distance_of(a, b, relative)


def check_order(urdd: Urdd, document: Any, kind: str, i: int, j: int) -> None:
    """8.5: the order of min, mean and max."""
    error = urdd.report.error
    low, mean, high = (document[kind][f"{key}_distances"][i][j] for key in ("min", "mean", "max"))
    slack = document["num_samples"] * 2.0**-52 * max(abs(low), abs(high))
    if low > mean + slack or mean > high + slack:
        error("SHP008", file_of(STATISTICS), f"/{kind}/mean_distances/{i}/{j}")
    if min(low, mean, high) < 0:
        error("SHP009", file_of(STATISTICS), f"/{kind}/min_distances/{i}/{j}")


def check_pair(urdd: Urdd, distances: Distances, kind: str, i: int, j: int, count: int) -> None:
    """8.5: what is stated of a pair is what the modules give."""
    error = urdd.report.error
    document = urdd.documents[STATISTICS]
    pointer = f"/{kind}/mean_distances/{i}/{j}"
    low, mean, high = (document[kind][f"{key}_distances"][i][j] for key in ("min", "mean", "max"))
    tolerance = distances.tolerance(kind, i, j)
    a, b = distances.bodies[kind][i], distances.bodies[kind][j]
    if distances.is_rigid(a, b) and max(low, mean, high) - min(low, mean, high) > tolerance:
        error("SHP022", file_of(STATISTICS), pointer)
        return
    found = [distances.at(kind, i, j, k) for k in range(count)]
    if count == document["num_samples"]:
        right = (min(found), sum(found) / count, max(found))
        if any(abs(one - other) > tolerance for one, other in zip((low, mean, high), right)):
            error("SHP024", file_of(STATISTICS), pointer)
    elif any(not low - tolerance <= one <= high + tolerance for one in found):
        error("SHP023", file_of(STATISTICS), pointer)


def check_statistics(urdd: Urdd, distances: Distances) -> None:
    """8.5."""
    document = urdd.documents[STATISTICS]
    if document["num_samples"] < 1:
        urdd.report.error("SHP016", file_of(STATISTICS), "/num_samples")
        return
    pairs = [
        (kind, i, j)
        for kind in KINDS
        if document[kind]
        for i in range(len(distances.bodies[kind]))
        for j in range(i)
    ]
    for kind, i, j in pairs:
        check_order(urdd, document, kind, i, j)
    if not urdd.report.clean("SHP"):
        return
    most = max(1, MAX_DISTANCES // max(1, len(pairs)))
    for kind, i, j in pairs:
        check_pair(urdd, distances, kind, i, j, min(most, document["num_samples"]))


def beside(a: float, bound: float) -> bool:
    """8.6: a distance that agrees with a bound, and is not equal to it, passes on either side."""
    return a != bound and agree(a, bound)


def adjacent(robot: Robot, a: int, b: int) -> bool:
    return (a, b) in zip(robot.parent, robot.child) or (b, a) in zip(robot.parent, robot.child)


def check_reason(urdd: Urdd, distances: Distances, kind: str, i: int, j: int) -> None:
    """8.6: the first reason that applies."""
    stated = urdd.documents[SIMPLE]["reasons"][kind][i][j]
    statistics = urdd.documents[STATISTICS][kind]
    largest, smallest = statistics["max_distances"][i][j], statistics["min_distances"][i][j]
    a, b = distances.bodies[kind][i].link, distances.bodies[kind][j].link
    right = []
    if a == b:
        right = ["SameLink"]
    elif largest <= CONTACT and not beside(largest, CONTACT):
        right = ["Always"]
    else:
        right = ["Always"] if beside(largest, CONTACT) else []
        if adjacent(distances.robot, a, b):
            right += ["Adjacent"]
        else:
            off = distances.at(kind, i, j, "Default") - CONTACT
            tolerance = distances.tolerance(kind, i, j)
            right += ["Default"] if off <= tolerance else []
            if off >= -tolerance:
                right += ["Never"] if smallest > CONTACT or beside(smallest, CONTACT) else []
                right += ["None"] if smallest <= CONTACT or beside(smallest, CONTACT) else []
    if stated not in right:
        late = ("Never", "None")
        by_default = (stated == "Default" and set(right) & set(late)) or (
            stated in late and right == ["Default"]
        )
        code = "SHP026" if by_default else "SHP012"
        urdd.report.error(code, file_of(SIMPLE), f"/reasons/{kind}/{i}/{j}")


def check_simple(urdd: Urdd, distances: Distances) -> None:
    """8.6."""
    document = urdd.documents[SIMPLE]
    for kind in KINDS:
        skips, reasons = document[f"{kind}_simple_skips"], document["reasons"][kind]
        statistics = urdd.documents[STATISTICS][kind]
        if not statistics:
            continue
        for i, body in enumerate(distances.bodies[kind]):
            for j in range(i):
                largest = statistics["max_distances"][i][j]
                same_link = body.link == distances.bodies[kind][j].link
                right = same_link or largest <= CONTACT
                either = not same_link and beside(largest, CONTACT)
                if skips and skips[i][j] != right and not either:
                    urdd.report.error("SHP011", file_of(SIMPLE), f"/{kind}_simple_skips/{i}/{j}")
                if reasons:
                    check_reason(urdd, distances, kind, i, j)
            if reasons and reasons[i][i] != "SameLink":
                urdd.report.error("SHP012", file_of(SIMPLE), f"/reasons/{kind}/{i}/{i}")


def check_skips(urdd: Urdd, shapes: Shapes) -> None:
    """8.7."""
    document = urdd.documents[SKIPS]
    names = [link["name"] for link in urdd.documents["urdf_module"]["links"]]
    places = [REASONS.index(reason) for reason in document["skipped_reasons"]]
    if places != sorted(set(places)):
        urdd.report.error("SHP027", file_of(SKIPS), "/skipped_reasons")
    for place, edit in enumerate(document["edits"]):
        if edit["link_a"] not in names or edit["link_b"] not in names:
            urdd.report.error("SHP014", file_of(SKIPS), f"/edits/{place}")
    if not urdd.report.clean("SHP014") or not urdd.have(SIMPLE):
        return
    edited = {}
    for edit in document["edits"]:
        edited[edit["link_a"], edit["link_b"]] = edit["skip"]
        edited[edit["link_b"], edit["link_a"]] = edit["skip"]
    for kind in KINDS:
        skips, reasons = document[f"{kind}_skips"], urdd.documents[SIMPLE]["reasons"][kind]
        if not skips or not reasons:
            continue
        links = [names[link] for link, _ in shapes.places(kind)]
        for i, a in enumerate(links):
            for j, b in enumerate(links[:i]):
                right = edited.get((a, b), reasons[i][j] in document["skipped_reasons"])
                if skips[i][j] != right:
                    urdd.report.error("SHP013", file_of(SKIPS), f"/{kind}_skips/{i}/{j}")


def check_all_matrices(urdd: Urdd, robot: Robot, shapes: Shapes) -> None:
    """8.4 to 8.7."""
    for name in (STATISTICS, SIMPLE, SKIPS):
        if urdd.have(name):
            check_matrices(urdd, shapes, name)
    if not urdd.report.clean("SHP"):
        return
    if urdd.have(SKIPS):
        check_skips(urdd, shapes)
    if urdd.have(APPROXIMATIONS, STATISTICS):
        distances = Distances(robot, shapes, urdd.documents[APPROXIMATIONS])
        check_statistics(urdd, distances)
        if urdd.have(SIMPLE) and urdd.report.clean("SHP"):
            check_simple(urdd, distances)
