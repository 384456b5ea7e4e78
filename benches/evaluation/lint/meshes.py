"""Meshes for the prototype: reads STL, OBJ, COLLADA, PLY, glTF and keeps what the rules need of them.

COLLADA: `unit` is applied, `up_axis` is not (as RViz). Units: those of the file, times `unit`.
"""
import functools
import struct
from pathlib import Path
import numpy as np
from lxml import etree
from scipy.spatial import ConvexHull, QhullError


def read_stl(data):
    """(triangles (n, 3, 3), facts)."""
    facts = {}
    binary = None
    if len(data) >= 84:
        n = struct.unpack("<I", data[80:84])[0]
        if 84 + 50 * n == len(data) or (84 + 50 * n < len(data) and not data[:5] == b"solid"):
            binary = n
    if binary is not None:
        facts["stl"] = "binary"
        facts["solid"] = data[:5].lower() == b"solid"
        facts["extra"] = len(data) - 84 - 50 * binary
        records = np.frombuffer(data, dtype=np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]), count=binary, offset=84)
        return records["v"].astype(float), facts
    if data.lstrip()[:5].lower() == b"solid" and b"vertex" in data:
        facts["stl"] = "ascii"
        words = data.split()
        at = [i for i, w in enumerate(words) if w.lower() == b"vertex"]
        values = np.array([[float(words[i + k]) for k in (1, 2, 3)] for i in at])
        return values[: len(values) // 3 * 3].reshape(-1, 3, 3), facts
    facts["stl"] = "truncated"
    if len(data) >= 84:
        n = (len(data) - 84) // 50
        records = np.frombuffer(data, dtype=np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]), count=n, offset=84)
        return records["v"].astype(float), facts
    return np.zeros((0, 3, 3)), facts


def read_obj(data):
    lines = data.replace(b"\\\n", b" ").split(b"\n")
    libraries = [l[7:].strip().decode("utf-8", "replace") for l in lines if l.startswith(b"mtllib ")]
    vlines = [l.split()[1:4] for l in lines if l.startswith((b"v ", b"v\t"))]
    v = np.array([x for l in vlines for x in l], dtype=float).reshape(-1, 3)
    faces, seen = [], 0
    relative = b"f -" in data or b"/-" in data
    for l in lines:
        if relative and l.startswith((b"v ", b"v\t")):
            seen += 1
        elif l.startswith((b"f ", b"f\t")):
            c = [int(w.split(b"/", 1)[0]) for w in l.split()[1:]]
            c = [i - 1 if i > 0 else seen + i for i in c]
            for k in range(1, len(c) - 1):
                faces.append((c[0], c[k], c[k + 1]))
    f = np.array(faces, dtype=int).reshape(-1, 3)
    f = f[((f >= 0) & (f < len(v))).all(axis=1)]
    return v[f], {"mtllib": libraries}


def local(element):
    return etree.QName(element).localname if isinstance(element.tag, str) else ""


def read_dae(data):
    root = etree.fromstring(data, etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=True, recover=True))
    for e in root.iter():
        if isinstance(e.tag, str):
            e.tag = etree.QName(e).localname
    ids = {e.get("id"): e for e in root.iter() if isinstance(e.tag, str) and e.get("id")}
    unit = root.find("asset/unit")
    meter = 1.0
    facts = {"up_axis": (root.findtext("asset/up_axis") or "").strip() or None, "unit": unit.get("meter") if unit is not None else None}
    try:
        meter = float(unit.get("meter")) if unit is not None and unit.get("meter") else 1.0
        if not meter > 0:
            meter = 1.0
    except ValueError:
        pass
    facts["images"] = [(i.text or i.findtext("ref") or "").strip() for i in root.findall("library_images/image/init_from")]

    def ref(url):
        return ids.get(url[1:]) if url and url.startswith("#") else None

    def floats(source):
        a = source.find("float_array")
        values = np.array((a.text or "").split(), dtype=float)
        accessor = source.find("technique_common/accessor")
        stride = int(accessor.get("stride", 1)) if accessor is not None else 3
        return values[: len(values) // stride * stride].reshape(-1, stride)[:, :3]

    def geometry(element):
        triangles = []
        mesh = element.find("mesh")
        if mesh is None:
            return np.zeros((0, 3, 3))
        for kind in ("triangles", "polylist", "polygons", "tristrips", "trifans"):
            for p in mesh.findall(kind):
                inputs = p.findall("input")
                if not inputs:
                    continue
                stride = max(int(i.get("offset", 0)) for i in inputs) + 1
                vertex = next((i for i in inputs if i.get("semantic") == "VERTEX"), None)
                if vertex is None:
                    continue
                source = ref(vertex.get("source"))
                position = next((i for i in source.findall("input") if i.get("semantic") == "POSITION"), None) if source is not None else None
                if position is None:
                    continue
                points = floats(ref(position.get("source")))
                offset = int(vertex.get("offset", 0))
                counts = None
                if kind == "polylist":
                    counts = np.array((p.findtext("vcount") or "").split(), dtype=int)
                for q in p.findall("p"):
                    index = np.array((q.text or "").split(), dtype=int)
                    index = index[: len(index) // stride * stride].reshape(-1, stride)[:, offset]
                    if kind == "triangles":
                        f = index[: len(index) // 3 * 3].reshape(-1, 3)
                    elif kind == "polylist":
                        f, at = [], 0
                        if (counts == 3).all():
                            f = index[: len(index) // 3 * 3].reshape(-1, 3)
                        else:
                            for c in counts:
                                for k in range(1, c - 1):
                                    f.append((index[at], index[at + k], index[at + k + 1]))
                                at += c
                    elif kind == "tristrips":
                        f = [(index[k], index[k + 1], index[k + 2]) for k in range(len(index) - 2)]
                    else:
                        f = [(index[0], index[k], index[k + 1]) for k in range(1, len(index) - 1)]
                    f = np.array(f, dtype=int).reshape(-1, 3)
                    f = f[((f >= 0) & (f < len(points))).all(axis=1)]
                    triangles.append(points[f])
        return np.concatenate(triangles) if triangles else np.zeros((0, 3, 3))

    cache, out, nodes = {}, [], [0]

    def walk(node, t, depth=0):
        if depth > 64:
            return
        for e in node:
            name = e.tag if isinstance(e.tag, str) else ""
            values = np.array((e.text or "").split(), dtype=float) if name in ("matrix", "translate", "rotate", "scale") else None
            if name == "matrix" and len(values) == 16:
                t = t @ values.reshape(4, 4)
            elif name == "translate":
                m = np.eye(4); m[:3, 3] = values[:3]; t = t @ m
            elif name == "scale":
                t = t @ np.diag([*values[:3], 1])
            elif name == "rotate":
                a, angle = values[:3], np.radians(values[3])
                n = np.linalg.norm(a)
                if n > 0:
                    a = a / n
                    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
                    m = np.eye(4); m[:3, :3] = np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
                    t = t @ m
        for e in node:
            name = e.tag if isinstance(e.tag, str) else ""
            if name == "node":
                walk(e, t, depth + 1)
            elif name == "instance_node" and ref(e.get("url")) is not None:
                walk(ref(e.get("url")), t, depth + 1)
            elif name in ("instance_geometry", "instance_controller"):
                g = ref(e.get("url"))
                if g is not None and name == "instance_controller":
                    skin = g.find("skin")
                    g = ref(skin.get("source")) if skin is not None else None
                if g is None:
                    continue
                key = g.get("id")
                if key not in cache:
                    cache[key] = geometry(g)
                tri = cache[key]
                out.append(tri @ t[:3, :3].T + t[:3, 3])
                if not np.allclose(t, np.eye(4)):
                    nodes[0] += 1
    scene = root.find("scene/instance_visual_scene")
    top = ref(scene.get("url")) if scene is not None else None
    tops = [top] if top is not None else root.findall("library_visual_scenes/visual_scene")
    for top in tops:
        walk(top, np.eye(4))
    facts["moved_nodes"] = nodes[0]
    if not out and not tops:
        out = [geometry(g) for g in root.findall("library_geometries/geometry")]
        facts["no_scene"] = True
    tri = np.concatenate(out) if out else np.zeros((0, 3, 3))
    return tri * meter, facts


def read_other(path):
    import trimesh
    mesh = trimesh.load(path, force="mesh", process=False, skip_materials=True)
    return np.asarray(mesh.triangles, dtype=float), {}


def mixed(rows):
    """One 64-bit number for each row of three integers; equal rows have equal numbers."""
    u = np.ascontiguousarray(rows).astype(np.uint64)
    h = u[:, 0] * np.uint64(0x9E3779B97F4A7C15)
    for i in (1, 2):
        h = ((h ^ (h >> np.uint64(29))) + u[:, i]) * np.uint64(0xBF58476D1CE4E5B9)
    return h ^ (h >> np.uint64(32))


def closed(triangles, points, size):
    """Whether every edge has a partner in the other direction, after points that differ by less than 1e-6 of the size are one."""
    if len(triangles) == 0:
        return False
    key = np.round(triangles.reshape(-1, 3) / max(size * 1e-6, 1e-300)).astype(np.int64)
    _, index = np.unique(mixed(key), return_inverse=True)
    f = index.reshape(-1, 3)
    f = f[(f[:, 0] != f[:, 1]) & (f[:, 1] != f[:, 2]) & (f[:, 2] != f[:, 0])]
    edges = np.concatenate([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]])
    low = np.sort(edges, axis=1)
    _, counts = np.unique(low[:, 0] * np.int64(len(index) + 1) + low[:, 1], return_counts=True)
    return {"watertight": bool((counts % 2 == 0).all()), "open_edges": int((counts == 1).sum()), "edges": int(len(counts))}


def hull_points(points):
    """The corners of the convex hull, or the points themselves where they have no volume."""
    if len(points) < 5:
        return points
    try:
        hull = ConvexHull(points)
        return points[hull.vertices]
    except (QhullError, ValueError):
        return np.unique(points, axis=0)[:5000]


@functools.cache
def summary(path):
    """What the rules need of a mesh file; `ok` is False where it cannot be read."""
    path = Path(path)
    size_of_file = path.stat().st_size
    try:
        data = path.read_bytes()
        ending = path.suffix.lower()
        if data[:40].startswith(b"version https://git-lfs"):
            raise ValueError("a Git LFS pointer")
        if ending == ".stl":
            tri, facts = read_stl(data)
        elif ending == ".obj":
            tri, facts = read_obj(data)
        elif ending == ".dae":
            tri, facts = read_dae(data)
        else:
            tri, facts = read_other(path)
        tri = tri[np.isfinite(tri).all(axis=(1, 2))]
        points = tri.reshape(-1, 3)
        result = {"ok": len(tri) > 0, "triangles": len(tri), "facts": facts, "error": None if len(tri) else "no triangles", "bytes": size_of_file}
        if len(tri):
            result["low"], result["high"] = points.min(axis=0), points.max(axis=0)
            size = float(np.linalg.norm(result["high"] - result["low"]))
            _, first = np.unique(mixed(np.ascontiguousarray(points + 0.0).view(np.int64)), return_index=True)
            result["hull"] = hull_points(points[first])
            result["volume"] = float(np.einsum("ij,ij->i", tri[:, 0], np.cross(tri[:, 1], tri[:, 2])).sum() / 6)
            result["closed"] = closed(tri, points, size)
    except Exception as error:
        result = {"ok": False, "triangles": 0, "facts": {}, "error": f"{type(error).__name__}: {error}"[:200], "bytes": size_of_file}
    return result
