"""Rules about shapes and meshes."""
from shapes import *


@rule("LNT020", "visual-without-collision")
def visual_without_collision(robot):
    """A body, of a robot that has collisions, with visuals of 10 cm or more and without a collision; not one whose topmost link is `world`."""
    if not any(link.collisions for link in robot.links.values()):
        return
    shapes = body_shapes(robot)
    for top, members in robot.bodies().items():
        if top == "world" or any(robot.links[n].collisions for n, _ in members):
            continue
        points = [p for k, p in shapes[top][0] if k == "visual"]
        if points:
            points = np.concatenate(points)
            size = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
            if size >= 0.1:
                yield where("link", top), f"drawn with a length of {size * 1000:.0f} mm, but nothing can collide with it", {"size": size}


@rule("LNT052", "robot-without-collision")
def robot_without_collision(robot):
    """A robot with a joint that moves and with visuals, and without any collision."""
    if (any(j.type in MOVING for j in robot.joints.values()) and any(link.visuals for link in robot.links.values())
            and not any(link.collisions for link in robot.links.values())):
        yield "robot", "no link has a collision shape", {}


@rule("LNT021", "visual-and-collision-apart")
def visual_and_collision_apart(robot):
    """Boxes along the link's axes around all visuals and around all collisions: of the same three lengths, sorted, to 5 %, with
    centres apart by more than 20 % of the diagonal (moved); or diagonals whose ratio is 10, 100, 1000 or 25.4 to 3 % (scaled)."""
    for name, found in link_shapes(robot).items():
        if any(p is None for _, p in found):
            continue
        visual = [p for k, p in found if k == "visual"]
        collision = [p for k, p in found if k == "collision"]
        if not visual or not collision:
            continue
        v, c = np.concatenate(visual), np.concatenate(collision)
        a, b = v.max(axis=0) - v.min(axis=0), c.max(axis=0) - c.min(axis=0)
        apart = float(np.linalg.norm((v.max(axis=0) + v.min(axis=0) - c.max(axis=0) - c.min(axis=0)) / 2))
        la, lb = float(np.linalg.norm(a)), float(np.linalg.norm(b))
        if min(la, lb) <= 0:
            continue
        ratio = max(la, lb) / min(la, lb)
        if (np.abs(np.sort(a) - np.sort(b)) <= 0.05 * np.maximum(np.sort(a), np.sort(b))).all() and apart > 0.2 * max(la, lb):
            yield where("link", name), f"visuals and collisions have the same size ({la * 1000:.0f} mm), but are {apart * 1000:.0f} mm apart", {"kind": "moved", "apart": apart, "visual": la, "collision": lb}
        elif any(abs(ratio / k - 1) < 0.03 for k in (10, 25.4, 100, 1000)):
            yield where("link", name), f"visuals are {la:.3g} m long, collisions {lb:.3g} m", {"kind": "scaled", "visual": la, "collision": lb}


@rule("LNT022", "mesh-in-millimetres")
def mesh_in_millimetres(robot):
    """A robot with a joint that moves; a mesh, as scaled, more than 100 times as long as the robot's longest joint offset, prismatic range
    and 5 cm; or shorter than 1 mm."""
    if not any(j.type in MOVING for j in robot.joints.values()):
        return
    reach_ = 0.05
    for joint in robot.joints.values():
        reach_ = max(reach_, float(np.linalg.norm(joint.origin[:3, 3])))
        if joint.type == "prismatic":
            reach_ = max(reach_, abs(joint.bound("upper") or 0.0), abs(joint.bound("lower") or 0.0))

    def findings():
        for link, kind, index, element, shape in robot.meshes():
            mesh = mesh_of(robot, shape)
            if mesh is None:
                continue
            size = float(np.linalg.norm((mesh["high"] - mesh["low"]) * (numbers(shape.get("scale"), 3) or [1, 1, 1])))
            if size > 100 * reach_:
                yield where("link", link.name), shape.get("filename"), f"{kind} mesh is {size:.4g} m long: in millimetres, without `scale=\"0.001 0.001 0.001\"`?", {"kind": "large", "size": size, "offset": reach_}
            elif size < 0.001:
                yield where("link", link.name), shape.get("filename"), f"{kind} mesh is {size * 1000:.4g} mm long: scaled to metres twice?", {"kind": "small", "size": size, "offset": reach_}
    yield from once(findings())


HEAVY = 50_000


@rule("LNT024", "heavy-collision-mesh")
def heavy_collision_mesh(robot):
    """A collision mesh of more than 50,000 triangles; above 200,000 in an STL MuJoCo refuses it."""
    def findings():
        for link, kind, index, element, shape in robot.meshes("collision"):
            mesh = mesh_of(robot, shape)
            if mesh and mesh["triangles"] > HEAVY:
                yield where("link", link.name), shape.get("filename"), f"collision mesh of {mesh['triangles']} triangles", {"triangles": mesh["triangles"], "name": shape.get("filename")}
    yield from once(findings())


@rule("LNT025", "collision-mesh-not-closed")
def collision_mesh_not_closed(robot):
    """A collision mesh with an edge that an odd number of triangles have."""
    def findings():
        for link, kind, index, element, shape in robot.meshes("collision"):
            mesh = mesh_of(robot, shape)
            if mesh and not mesh["closed"]["watertight"]:
                c = mesh["closed"]
                yield where("link", link.name), shape.get("filename"), f"collision mesh has {c['open_edges']} open edges of {c['edges']}", {**c, "name": shape.get("filename")}
    yield from once(findings())


@rule("LNT030", "texture-missing")
def texture_missing(robot):
    """A texture that the URDF, an OBJ's material library or a COLLADA file names, and that is not there; the library itself too."""
    def findings():
        for element in robot.xml.iter("texture"):
            name = element.get("filename")
            if name and robot.find(name)[0] is None:
                yield where("material", element.getparent().get("name", "")), name, f"texture `{name}` is not there", {"name": name, "from": "urdf"}
        for link, kind, index, element, shape in robot.meshes("visual"):
            path, _ = robot.find(shape.get("filename"))
            if path is None:
                continue
            facts = summary(path)["facts"]
            names = [unquote(n) for n in facts.get("images", [])]
            for library in facts.get("mtllib", []):
                file = path.parent / library
                if not file.is_file():
                    yield where("link", link.name), f"{path.name} {library}", f"`{path.name}` names the material library `{library}`, which is not there", {"name": library, "from": "mtllib", "mesh": str(path)}
                    continue
                for line in file.read_text("utf-8", "replace").splitlines():
                    words = line.split()
                    if words and words[0].lower() in ("map_kd", "map_ka", "map_ks", "map_d", "map_bump", "bump"):
                        names.append(line.strip().split(None, 1)[1] if len(words) > 1 and not words[1].startswith("-") else words[-1])
            for name in names:
                file = re.sub(r"^file:(//)?", "", name).replace("\\", "/").strip()
                if file and not file.startswith("data:") and not (path.parent / file).is_file():
                    yield where("link", link.name), f"{path.name} {name}", f"`{path.name}` names the texture `{name}`, which is not there", {"name": name, "from": path.suffix, "mesh": str(path)}
    yield from once(findings())


@rule("LNT031", "collada-unit")
def collada_unit(robot):
    """A COLLADA file whose unit is not 1 m."""
    def findings():
        for link, kind, index, element, shape in robot.meshes():
            path, _ = robot.find(shape.get("filename"))
            if path is not None and path.suffix.lower() == ".dae":
                unit = number(summary(path)["facts"].get("unit"))
                if unit is not None and abs(unit - 1) > 1e-6:
                    yield where("link", link.name), shape.get("filename"), f"`{path.name}` has a unit of {unit:g} m: RViz and PyBullet apply it, Pinocchio and trimesh do not", {"unit": unit, "name": path.name}
    yield from once(findings())


@rule("LNT053", "collada-up-axis")
def collada_up_axis(robot):
    """A COLLADA file whose up axis is X or Y."""
    def findings():
        for link, kind, index, element, shape in robot.meshes():
            path, _ = robot.find(shape.get("filename"))
            if path is not None and path.suffix.lower() == ".dae":
                up = summary(path)["facts"].get("up_axis")
                if up not in (None, "Z_UP"):
                    yield where("link", link.name), shape.get("filename"), f"`{path.name}` has the up axis {up}", {"up": up, "name": path.name}
    yield from once(findings())


def stl_faults(robot, wanted):
    """(element, file, message, data) of the STLs of the kinds that are wanted."""
    for link, kind, index, element, shape in robot.meshes():
        path, _ = robot.find(shape.get("filename"))
        if path is None or path.suffix.lower() != ".stl":
            continue
        facts = summary(path)["facts"]
        fault = facts.get("stl") if facts.get("stl") in ("ascii", "truncated") else "solid" if facts.get("solid") else None
        if fault in wanted:
            text = {"ascii": "is an STL in text, which MuJoCo refuses and PyBullet cannot collide with", "truncated": "is not a whole STL",
                    "solid": "is binary but starts with `solid`, as text does"}[fault]
            yield where("link", link.name), shape.get("filename"), f"`{path.name}` {text}", {"kind": fault, "name": path.name, "of": kind}


@rule("LNT034", "stl-refused")
def stl_refused(robot):
    """An STL in text, or one that is shorter than its number of triangles says."""
    yield from once(stl_faults(robot, ("ascii", "truncated")))


@rule("LNT039", "stl-starts-with-solid")
def stl_starts_with_solid(robot):
    """A binary STL whose first five bytes are `solid`."""
    yield from once(stl_faults(robot, ("solid",)))


@rule("LNT038", "mesh-format-not-read")
def mesh_format_not_read(robot):
    """Once an ending: a collision mesh that is neither STL nor OBJ; MuJoCo refuses the robot (it has no decoder for COLLADA, glTF or PLY)."""
    endings = {}
    for link, kind, index, element, shape in robot.meshes("collision"):
        ending = Path(shape.get("filename")).suffix.lower()
        if ending not in (".stl", ".obj", ".msh"):
            endings.setdefault(ending, []).append(link.name)
    for ending, links in sorted(endings.items()):
        yield where("link", links[0]), f"{len(links)} collision meshes end in `{ending}`, which MuJoCo does not read", {"ending": ending, "links": len(links)}


@rule("LNT035", "mesh-not-readable")
def mesh_not_readable(robot):
    """A mesh that is there, but without a triangle that can be read."""
    def findings():
        for link, kind, index, element, shape in robot.meshes():
            path, _ = robot.find(shape.get("filename"))
            if path is not None and not summary(path)["ok"]:
                yield where("link", link.name), shape.get("filename"), f"`{path.name}` cannot be read: {summary(path)['error']}", {"error": summary(path)["error"], "name": path.name}
    yield from once(findings())
