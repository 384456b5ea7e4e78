"""The rules of boxes, spheres and largest distances (8.1 to 8.3)."""

from __future__ import annotations

from typing import Any

from .bodies import Body, box_body, sphere_body
from .derived_meshes import corners, triangles
from .geometry import Point
from .modules import Urdd, file_of
from .numeric import agree, distance, from_rpy, norm, sub, transposed, turned

APPROXIMATIONS = "link_shapes_approximations_module"
DISTANCES = "link_shapes_max_distance_from_origin_module"
FIT = 1e-6  # 8.2, 8.3
LISTS = {
    APPROXIMATIONS: ("full_obbs", "full_bounding_spheres"),
    DISTANCES: (
        "full_convex_hulls_maximum_distances",
        "full_obbs_maximum_distances",
        "full_bounding_spheres_maximum_distances",
    ),
}


class Shapes:
    """8.1: the shapes of a robot, full ones and pieces, and their points."""

    def __init__(self, urdd: Urdd) -> None:
        hulls = urdd.documents["convex_hull_meshes_module"]["link_hulls"]
        pieces = urdd.documents["convex_decomposition_meshes_module"]["link_pieces"]
        self.full = [link for link, hull in enumerate(hulls) if hull]
        self.pieces = [
            (link, piece) for link, found in enumerate(pieces) for piece in range(len(found))
        ]
        self.points: dict[tuple[int, int | None], list[Point]] = {}
        for link in self.full:
            self.points[link, None] = corners(triangles(urdd, hulls[link]))
        for link, piece in self.pieces:
            self.points[link, piece] = corners(triangles(urdd, pieces[link][piece]))

    def places(self, kind: str) -> list[tuple[int, int | None]]:
        """The shapes of a kind of matrix, in their order."""
        return [(link, None) for link in self.full] if kind.startswith("full") else [*self.pieces]

    def bodies(self, kind: str, approximations: Any) -> list[Body]:
        """The bodies of a kind of matrix."""
        found = []
        for link, piece in self.places(kind):
            if kind.endswith("convex_hulls"):
                found.append(Body(link, tuple(self.points[link, piece])))
                continue
            stated = approximations[kind][link]
            shape = stated if piece is None else stated[piece]
            make = box_body if kind.endswith("obbs") else sphere_body
            found.append(make(link, shape))
        return found


def box_is_impossible(box: Any) -> bool:
    """8.2."""
    return min(box["half_extents"]) < 0 or max(box["half_extents"]) <= 0


def check_box(urdd: Urdd, box: Any, points: list[Point], pointer: str) -> None:
    """8.2: a box holds its points, and touches them with all six sides."""
    if box_is_impossible(box):
        urdd.report.error("SHP003", file_of(APPROXIMATIONS), pointer)
        return
    tolerance = FIT * max(norm(point) for point in points)
    back = transposed(from_rpy(box["offset_rpy"]))
    inside = [turned(back, sub(point, box["offset_xyz"])) for point in points]
    half = box["half_extents"]
    beyond = [[max(0.0, abs(p[axis]) - half[axis]) for axis in range(3)] for p in inside]
    if any(norm(over) > tolerance for over in beyond):
        urdd.report.error("SHP017", file_of(APPROXIMATIONS), pointer)
    for axis in range(3):
        sides = (max(p[axis] for p in inside), -min(p[axis] for p in inside))
        if any(half[axis] - side > tolerance for side in sides):
            urdd.report.error("SHP018", file_of(APPROXIMATIONS), pointer)


def check_sphere(urdd: Urdd, sphere: Any, points: list[Point], pointer: str) -> None:
    """8.2: a sphere holds its points, and touches them."""
    if sphere["radius"] <= 0:
        urdd.report.error("SHP003", file_of(APPROXIMATIONS), pointer)
        return
    tolerance = FIT * max(norm(point) for point in points)
    off = sphere["radius"] - max(distance(point, sphere["offset_xyz"]) for point in points)
    if off < -tolerance:
        urdd.report.error("SHP017", file_of(APPROXIMATIONS), pointer)
    if off > tolerance:
        urdd.report.error("SHP018", file_of(APPROXIMATIONS), pointer)


def check_presence(urdd: Urdd, shapes: Shapes, name: str) -> None:
    """8.2, 8.3: one entry per link, and null for links without a hull."""
    count = len(urdd.documents["urdf_module"]["links"])
    for key, stated in urdd.documents[name].items():
        if key.startswith(("full_", "decomposition_")) and len(stated) != count:
            urdd.report.error("SHP001", file_of(name), "/" + key)
    if not urdd.report.clean("SHP001"):
        return
    for key in LISTS[name]:
        for link, stated in enumerate(urdd.documents[name][key]):
            if (stated is not None) != (link in shapes.full):
                urdd.report.error("SHP002", file_of(name), f"/{key}/{link}")


def check_approximations(urdd: Urdd, shapes: Shapes) -> None:
    """8.2: every box and sphere."""
    document = urdd.documents[APPROXIMATIONS]
    for (link, piece), points in shapes.points.items():
        part = "full" if piece is None else "decomposition"
        for kind, check in (("obbs", check_box), ("bounding_spheres", check_sphere)):
            key = f"{part}_{kind}"
            stated = document[key][link]
            shape = stated if piece is None else stated[piece]
            check(urdd, shape, points, f"/{key}/{link}")


def check_distances(urdd: Urdd, shapes: Shapes) -> None:
    """8.3."""
    document = urdd.documents[DISTANCES]
    approximations = urdd.documents[APPROXIMATIONS]
    for part in ("full", "decomposition"):
        boxes = shapes.bodies(f"{part}_obbs", approximations)
        spheres = shapes.bodies(f"{part}_bounding_spheres", approximations)
        for (link, piece), box, sphere in zip(shapes.places(part), boxes, spheres):
            stated = []
            for kind in ("convex_hulls", "obbs", "bounding_spheres"):
                values = document[f"{part}_{kind}_maximum_distances"][link]
                stated.append(values if piece is None else values[piece])
            pointer = f"/{part}_convex_hulls_maximum_distances/{link}"
            right = (box.farthest(), sphere.farthest())
            if not (agree(stated[1], right[0]) and agree(stated[2], right[1])):
                urdd.report.error("SHP004", file_of(DISTANCES), pointer)
            if not 0 <= stated[0] <= (1 + FIT) * min(right):
                urdd.report.error("SHP004", file_of(DISTANCES), pointer)
                continue
            farthest = max(norm(point) for point in shapes.points[link, piece])
            if abs(stated[0] - farthest) > FIT * farthest:
                urdd.report.error("SHP021", file_of(DISTANCES), pointer)


def check_shapes(urdd: Urdd) -> Shapes | None:
    """8.1 to 8.3; gives the shapes where matrices can be judged."""
    meshes = ("convex_hull_meshes_module", "convex_decomposition_meshes_module")
    if not urdd.have("urdf_module", *meshes) or not urdd.report.clean("URD", "MSH", "DIR0"):
        return None
    shapes = Shapes(urdd)
    for name in (APPROXIMATIONS, DISTANCES):
        if urdd.have(name):
            check_presence(urdd, shapes, name)
    if not urdd.report.clean("SHP"):
        return None
    if urdd.have(APPROXIMATIONS):
        check_approximations(urdd, shapes)
        if urdd.have(DISTANCES):
            check_distances(urdd, shapes)
    return shapes
