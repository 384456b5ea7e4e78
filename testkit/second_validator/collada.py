"""What a COLLADA file shows (7.5)."""

from __future__ import annotations

import math
import re
from xml.parsers import expat

from .faces import (
    MAX_NODES_INSIDE,
    MAX_TRIANGLES,
    MAX_VISITS,
    UNPLACED,
    Affine,
    Face,
    NotMesh,
    Shown,
    Vertex,
    count_triangles,
    then,
)
from .numeric import cross, dot, from_axis_angle, norm, number, scaled, sub
from .xmltree import Builder, Element, NotXml

MAX_XML_NODES = 4_000_000  # 13.2
MAX_OFFSET = 1024
DECLARATION = re.compile(r"\A<\?xml[ \t\r\n][^>]*\?>")
WHOLE = re.compile(r"[+]?[0-9]+")
POLYGONS = ("triangles", "polylist", "polygons", "tristrips", "trifans")


def plain_name(name: str) -> str:
    """An element's name without its prefix."""
    return name.rpartition(":")[2]


class ColladaBuilder(Builder):
    """Elements by their names without prefix; no DOCTYPE, and at most so many nodes."""

    def __init__(self, data: bytes) -> None:
        super().__init__(data, MAX_XML_NODES)
        self.nodes = 0
        self.parser.StartDoctypeDeclHandler = self.refuse
        self.parser.CommentHandler = self.count_node

    def refuse(self, *_: object) -> None:
        raise NotXml

    def count_node(self, *_: object) -> None:
        self.nodes += 1
        if self.nodes > MAX_XML_NODES:
            raise NotXml

    def start(self, name: str, attributes: dict[str, str]) -> None:
        self.count_node()
        super().start(name, attributes)
        self.stack[-1].name = plain_name(name)

    def characters(self, text: str) -> None:
        self.count_node()
        super().characters(text)

    def instruction(self, target: str, data: str) -> None:
        self.count_node()
        super().instruction(target, data)


def words(element: Element) -> list[str]:
    return element.text.split()


def floats(element: Element, count: int) -> list[float]:
    """The numbers of a transform: none of them finite where one is not."""
    values = [value for value in map(number, words(element)) if value is not None]
    if len(values) != count or len(words(element)) != count:
        raise NotMesh
    return values if all(map(math.isfinite, values)) else [math.nan] * count


def target(element: Element, key: str) -> str:
    """The id that a URL within the file names."""
    return element.attributes.get(key, "").removeprefix("#")


def unit(vector: tuple[float, float, float]) -> tuple[float, float, float]:
    length = norm(vector)
    return scaled(vector, 1 / length) if length > 0 else vector


class ColladaReader:
    """Follows a document from its scene."""

    def __init__(self, root: Element) -> None:
        self.root = root
        self.by_id: dict[str, Element] = {}
        waiting = [root]
        while waiting:
            element = waiting.pop()
            waiting += reversed(element.children)
            if "id" in element.attributes:
                self.by_id.setdefault(element.attributes["id"], element)
        self.visits = 0
        self.triangles = 0
        self.faces = Shown()
        self.meshes: dict[int, list[Face]] = {}

    def named(self, element: Element, key: str, kind: str) -> Element | None:
        found = self.by_id.get(target(element, key))
        return found if found and found.name == kind else None

    def in_libraries(self, library: str, kind: str) -> list[Element]:
        return [one for found in self.root.all(library) for one in found.all(kind)]

    def show(self) -> Shown:
        asset = self.root.first("asset")
        meter = asset and asset.first("unit")
        value = number(meter.attributes.get("meter", "").strip()) if meter else None
        size = value if value and 0 < value < math.inf else 1.0
        place: Affine = ((size, 0, 0, 0), (0, size, 0, 0), (0, 0, size, 0))
        scenes = self.in_libraries("library_visual_scenes", "visual_scene")
        scene = self.root.first("scene")
        shown = scene and scene.first("instance_visual_scene")
        chosen = shown and self.named(shown, "url", "visual_scene")
        if chosen:
            scenes = [chosen]
        elif not scenes:
            for geometry in self.in_libraries("library_geometries", "geometry"):
                self.geometry(geometry, place)
        for visual_scene in scenes[:1]:
            for node in visual_scene.all("node"):
                self.node(node, place, ())
        return self.faces

    def node(self, node: Element, above: Affine, inside: tuple[int, ...]) -> None:
        self.visits += 1
        if id(node) in inside or self.visits > MAX_VISITS or len(inside) >= MAX_NODES_INSIDE:
            raise NotMesh
        here = above
        for child in node.children:
            here = then(here, transform(child))
        self.look_at_place(here)
        within = (*inside, id(node))
        for child in node.children:
            if child.name == "node":
                self.node(child, here, within)
            elif child.name == "instance_node":
                other = self.named(child, "url", "node")
                if other:
                    self.node(other, here, within)
            elif child.name == "instance_geometry":
                geometry = self.named(child, "url", "geometry")
                if geometry:
                    self.geometry(geometry, here)
            elif child.name == "instance_controller":
                self.controller(self.named(child, "url", "controller"), here, ())

    def look_at_place(self, place: Affine) -> None:
        if not all(math.isfinite(part) for row in place for part in row):
            self.faces.may_be_refused = True

    def controller(
        self, controller: Element | None, place: Affine, inside: tuple[int, ...]
    ) -> None:
        """7.8: a skin is read as it stands, with its `bind_shape_matrix`."""
        inner = controller and controller.first("skin", "morph")
        if not inner or id(controller) in inside:
            return
        bind = inner.first("bind_shape_matrix")
        if bind:
            place = then(place, matrix(floats(bind, 16)))
            self.look_at_place(place)
        geometry = self.named(inner, "source", "geometry")
        if geometry:
            self.geometry(geometry, place)
        else:
            further = self.named(inner, "source", "controller")
            self.controller(further, place, (*inside, id(controller)))

    def geometry(self, geometry: Element, place: Affine) -> None:
        mesh = geometry.first("mesh", "convex_mesh")
        if not mesh:
            return
        if id(mesh) not in self.meshes:
            self.meshes[id(mesh)] = self.mesh(mesh)
        found = self.meshes[id(mesh)]
        self.triangles += count_triangles(found)
        if self.triangles > MAX_TRIANGLES:
            raise NotMesh
        self.faces += [Face(face.corners, place) for face in found]

    def mesh(self, mesh: Element) -> list[Face]:
        faces: list[Face] = []
        for primitive in mesh.children:
            if primitive.name in POLYGONS:
                faces += self.primitive(mesh, primitive)
        return faces

    def primitive(self, mesh: Element, primitive: Element) -> list[Face]:
        offsets = {}
        stride = 1
        for entry in primitive.all("input"):
            stated = entry.attributes.get("offset", "0").strip()
            if not WHOLE.fullmatch(stated) or int(stated) >= MAX_OFFSET:
                raise NotMesh
            stride = max(stride, int(stated) + 1)
            offsets.setdefault(entry.attributes.get("semantic"), (int(stated), entry))
        lists = primitive.all("p")
        lists += [p for hole in primitive.all("ph") for p in hole.all("p")]
        if not lists:
            return []
        if "VERTEX" not in offsets:
            raise NotMesh
        offset, entry = offsets["VERTEX"]
        positions = self.positions(mesh, entry)
        faces = []
        for p in lists:
            found = words(p)
            indices = found[offset::stride][: len(found) // stride]
            corners = [corner_of(word, positions) for word in indices]
            faces += cut(primitive, corners)
        return faces

    def positions(self, mesh: Element, entry: Element) -> list[Vertex]:
        """The positions that an input `VERTEX` leads to."""
        try:
            (wanted,) = [
                one
                for one in self.named(entry, "source", "vertices").all("input")  # type: ignore[union-attr]
                if one.attributes.get("semantic") == "POSITION"
            ]
            source = self.named(wanted, "source", "source")
            accessor = source.first("technique_common").first("accessor")  # type: ignore[union-attr]
            array = words(self.named(accessor, "source", "float_array"))  # type: ignore[arg-type]
            stride = int(accessor.attributes["stride"])  # type: ignore[union-attr]
            offset = int(accessor.attributes.get("offset", "0"))  # type: ignore[union-attr]
        except (AttributeError, LookupError, ValueError) as fault:
            raise NotMesh from fault
        places = component_places(accessor, stride)  # type: ignore[arg-type]
        if stride > len(places):
            self.faces.may_be_refused = True
        numbers = [number(word) for word in array]
        found: list[Vertex] = []
        for start in range(offset, len(numbers) - stride + 1, stride):
            parts = [numbers[start + place] for place in places]
            found.append(None if None in parts else tuple(parts))  # type: ignore[arg-type]
        return found


def component_places(accessor: Element, stride: int) -> list[int]:
    """Which three numbers of each group are the position."""
    if stride < 3:
        raise NotMesh
    names = [param.attributes.get("name") for param in accessor.all("param")][:stride]
    if all(name in names for name in "XYZ"):
        return [names.index(name) for name in "XYZ"]
    return [0, 1, 2]


def corner_of(word: str, positions: list[Vertex]) -> Vertex:
    """A corner, or None where its index is not one or beyond the vertices."""
    if not WHOLE.fullmatch(word) or int(word) >= len(positions):
        return None
    return positions[int(word)]


def cut(primitive: Element, corners: list[Vertex]) -> list[Face]:
    """The faces of a list of corners."""
    kind = primitive.name
    if kind == "triangles":
        return [Face(corners[n : n + 3]) for n in range(0, len(corners) - 2, 3)]
    if kind == "polylist":
        faces = []
        at = 0
        for word in [word for counts in primitive.all("vcount") for word in words(counts)]:
            size = int(word) if WHOLE.fullmatch(word) else 0
            faces.append(Face(corners[at : at + size]))
            at += size
        return faces
    if kind == "tristrips":
        triples = [corners[n : n + 3] for n in range(len(corners) - 2)]
        return [Face([b, a, c] if n % 2 else [a, b, c]) for n, (a, b, c) in enumerate(triples)]
    if kind == "trifans":
        return [Face([corners[0], *corners[n : n + 2]]) for n in range(1, len(corners) - 1)]
    return [Face(corners)]


def matrix(m: list[float]) -> Affine:
    return tuple((m[4 * r], m[4 * r + 1], m[4 * r + 2], m[4 * r + 3]) for r in range(3))


def transform(element: Element) -> Affine:
    """The transform that an element of a node says, if it is one."""
    kind = element.name
    if kind == "matrix":
        return matrix(floats(element, 16))
    if kind == "translate":
        x, y, z = floats(element, 3)
        return ((1, 0, 0, x), (0, 1, 0, y), (0, 0, 1, z))
    if kind == "scale":
        x, y, z = floats(element, 3)
        return ((x, 0, 0, 0), (0, y, 0, 0), (0, 0, z, 0))
    if kind == "rotate":
        x, y, z, angle = floats(element, 4)
        axis = unit((x, y, z))
        rows = from_axis_angle(axis, math.radians(angle))
        return tuple((*row, 0.0) for row in rows)  # type: ignore[misc]
    if kind == "skew":
        return skew(floats(element, 7))
    return look_at(floats(element, 9)) if kind == "lookat" else UNPLACED


def skew(values: list[float]) -> Affine:
    """7.5: adds a ((tan(u + t) - tan u) b · x) to x."""
    t = math.radians(values[0])
    r, a = unit((values[1], values[2], values[3])), unit((values[4], values[5], values[6]))
    along = dot(r, a)
    b = unit(sub(r, scaled(a, along)))
    u = math.atan2(along, dot(r, b))
    factor = math.tan(u + t) - math.tan(u)
    rows = []
    for n in range(3):
        row = [(1.0 if k == n else 0.0) + a[n] * factor * b[k] for k in range(3)]
        rows.append((row[0], row[1], row[2], 0.0))
    return tuple(rows)


def look_at(values: list[float]) -> Affine:
    """7.5: the pose of a frame at the eye, of which -z points at the interest."""
    eye, interest = (values[0], values[1], values[2]), (values[3], values[4], values[5])
    z = unit(sub(eye, interest))
    x = cross((values[6], values[7], values[8]), z)
    if norm(x) == 0:
        raise NotMesh
    x = unit(x)
    y = cross(z, x)
    return tuple((x[n], y[n], z[n], eye[n]) for n in range(3))


def parse_collada(data: bytes) -> Element:
    """The tree of a file, whatever its declaration says. Raises NotMesh."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        text = data.decode("utf-16", "replace")
    else:
        text = data.decode("utf-8", "replace")
    text = DECLARATION.sub(" ", text.removeprefix("\ufeff").strip())
    encoded = text.encode("utf-8", "replace")
    builder = ColladaBuilder(encoded)
    try:
        builder.parser.Parse(encoded, True)
    except (expat.ExpatError, NotXml) as fault:
        raise NotMesh from fault
    return builder.root  # type: ignore[return-value]


def read_collada(data: bytes) -> Shown:
    root = parse_collada(data)
    return ColladaReader(root).show() if root.name == "COLLADA" else Shown()
