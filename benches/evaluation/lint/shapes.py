"""Points of shapes, and hulls."""
from paths import *


def circle(n=32):
    """Corners of a polygon that encloses the unit circle."""
    a = np.arange(n) * 2 * math.pi / n
    return np.stack([np.cos(a), np.sin(a)], axis=1) / math.cos(math.pi / n)


def primitive_points(shape):
    """Points whose convex hull is the shape, or encloses it within 2 %; None where its numbers cannot be read."""
    what = tag(shape)
    if what == "box":
        size = numbers(shape.get("size"), 3)
        return None if size is None else np.array([[x, y, z] for x in (-.5, .5) for y in (-.5, .5) for z in (-.5, .5)]) * size
    radius = number(shape.get("radius"))
    if radius is None:
        return None
    ring = circle()
    if what == "sphere":
        return radius * np.array([[*(ring[i] * math.cos(p)), math.sin(p)] for p in np.linspace(-math.pi / 2, math.pi / 2, 17) for i in range(32)])
    length = number(shape.get("length"))
    if length is None:
        return None
    if what == "capsule":
        length += 2 * radius
    return np.array([[radius * x, radius * y, z] for x, y in ring for z in (-length / 2, length / 2)])


def mesh_of(robot, shape):
    """The summary of a mesh that is found and readable, else None."""
    path, _ = robot.find(shape.get("filename"))
    if path is None:
        return None
    found = summary(path)
    return found if found["ok"] else None


def shape_points(robot, element, shape):
    """Points in the link's frame, or None where the shape cannot be had."""
    if tag(shape) == "mesh":
        mesh = mesh_of(robot, shape) if shape.get("filename") else None
        if mesh is None:
            return None
        points = mesh["hull"] * (numbers(shape.get("scale"), 3) or [1, 1, 1])
    else:
        points = primitive_points(shape)
        if points is None:
            return None
    t = pose(element)
    return points @ t[:3, :3].T + t[:3, 3]


def link_shapes(robot):
    """Link name -> list of (kind, points or None). Kept with the robot."""
    if not hasattr(robot, "_shapes"):
        robot._shapes = {name: [] for name in robot.links}
        for link, kind, index, element, shape in robot.geometries():
            robot._shapes[link.name].append((kind, shape_points(robot, element, shape)))
    return robot._shapes


def body_shapes(robot):
    """Topmost link -> (list of (kind, points in its frame), whether every shape could be had)."""
    if not hasattr(robot, "_body_shapes"):
        robot._body_shapes = {}
        shapes = link_shapes(robot)
        for top, members in robot.bodies().items():
            found, whole = [], True
            for name, t in members:
                for kind, points in shapes[name]:
                    if points is None:
                        whole = False
                    else:
                        found.append((kind, points @ t[:3, :3].T + t[:3, 3]))
            robot._body_shapes[top] = (found, whole)
    return robot._body_shapes


_hulls = {}


def hull_of(points):
    """The convex hull, or None for points without volume."""
    key = hash(points.tobytes())
    if key not in _hulls:
        if len(_hulls) > 300:
            _hulls.clear()
        try:
            _hulls[key] = ConvexHull(points) if len(points) >= 4 else None
        except (QhullError, ValueError):
            _hulls[key] = None
    return _hulls[key]


def moves(robot):
    """Whether a joint of the robot moves. Scenery (walls, tables) is judged less strictly."""
    return any(j.type in MOVING for j in robot.joints.values())


def massive_links(robot):
    """(link, points of its body in the link's frame, list of (kind, points)) of every link with a mass, whose body's shapes are all there."""
    if not hasattr(robot, "_massive"):
        robot._massive = []
        shapes = body_shapes(robot)
        for top, members in robot.bodies().items():
            found, whole = shapes[top]
            if not found or not whole:
                continue
            for name, t in members:
                link = robot.links[name]
                if link.mass and link.mass > 0:
                    inverse = np.linalg.inv(t)
                    own = [(k, p @ inverse[:3, :3].T + inverse[:3, 3]) for k, p in found]
                    robot._massive.append((link, np.concatenate([p for _, p in own]), own))
    return robot._massive
