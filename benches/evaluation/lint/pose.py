"""The rule about the default configuration."""
from shapes import *
from structure import nearest, srdf_files


def poses_at_default(robot):
    """Link name -> 4x4 in the root's frame; every joint at 0, or at the limit nearest to 0."""
    def value(joint, depth=0):
        if joint.mimic is not None and depth < 10:
            driver = robot.joints.get(joint.mimic.get("joint"))
            factor, offset = number(joint.mimic.get("multiplier")), number(joint.mimic.get("offset"))
            return (1.0 if factor is None else factor) * (value(driver, depth + 1) if driver else 0.0) + (offset or 0.0)
        if joint.type in ("revolute", "prismatic") and joint.limit is not None:
            lower, upper = joint.bound("lower") or 0.0, joint.bound("upper") or 0.0
            if lower <= upper:
                return min(max(0.0, lower), upper)
        return 0.0

    poses = {}

    def of(name, depth=0):
        if name not in poses:
            joint = robot.above.get(name)
            t = np.eye(4)
            if joint is not None and depth < 2000:
                t = of(joint.parent, depth + 1) @ joint.origin
                q = value(joint) if joint.type in ONE_DOF else 0.0
                if q:
                    a = np.array(joint.axis or [1.0, 0, 0])
                    a = a / (np.linalg.norm(a) or 1)
                    m = np.eye(4)
                    if joint.type == "prismatic":
                        m[:3, 3] = q * a
                    else:
                        k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
                        m[:3, :3] = np.eye(3) + math.sin(q) * k + (1 - math.cos(q)) * k @ k
                    t = t @ m
            poses[name] = t
        return poses[name]
    for name in robot.links:
        of(name)
    return poses


def solid(robot, shape):
    """A coal shape in the frame of the collision element, and the transform that it needs there; None where it cannot be had."""
    import coal
    what = tag(shape)
    if what == "mesh":
        mesh = mesh_of(robot, shape) if shape.get("filename") else None
        if mesh is None:
            return None
        points = mesh["hull"] * (numbers(shape.get("scale"), 3) or [1, 1, 1])
    else:
        size = numbers(shape.get("size"), 3) if what == "box" else [number(shape.get("radius")), 1.0 if what == "sphere" else number(shape.get("length"))]
        if size is None or any(v is None or v <= 0 for v in size):
            return None
        if what == "box":
            return coal.Box(*size)
        if what == "sphere":
            return coal.Sphere(size[0])
        return coal.Cylinder(*size) if what == "cylinder" else coal.Capsule(*size)
    hull = hull_of(points)
    if hull is None:
        return None
    vector = coal.StdVec_Vec3s()
    for point in points[hull.vertices]:
        vector.append(point)
    return coal.ConvexBase.convexHull(vector, False, "Qt")


def disabled_pairs(robot):
    """Pairs of links of which an SRDF of this robot says `disable_collisions`."""
    pairs = set()
    for path in srdf_files(robot):
        try:
            xml = etree.parse(str(path), etree.XMLParser(resolve_entities=False, no_network=True)).getroot()
        except (etree.XMLSyntaxError, OSError):
            continue
        if xml.get("name") == robot.name and path.stem.lower() == robot.path.stem.lower():
            pairs |= {frozenset((e.get("link1"), e.get("link2"))) for e in xml.iter("disable_collisions")}
    return pairs


@rule("LNT050", "self-collision-in-default")
def self_collision_in_default(robot):
    """At the default configuration the convex hulls of collision shapes of two bodies, neither the parent of the other, overlap by more than 1 mm;
    once a robot. Pairs that its SRDF disables are left out, and robots of more than 600 collision shapes."""
    try:
        import coal
    except ImportError:
        return
    poses, top = poses_at_default(robot), robot.body_of()
    items = []
    for link, kind, index, element, shape in robot.geometries("collision"):
        body = solid(robot, shape)
        if body is None:
            continue
        t = poses[link.name] @ pose(element)
        o = coal.CollisionObject(body, coal.Transform3s(t[:3, :3], t[:3, 3]))
        o.computeAABB()
        items.append((link.name, top[link.name], o))
    if len(items) > 600:
        return
    parent = {name: top[robot.above[name].parent] for name in set(top.values()) if name in robot.above}
    worst = {}
    request = coal.CollisionRequest()
    request.enable_contact = True
    request.num_max_contacts = 1
    for i, (a, ba, x) in enumerate(items):
        for b, bb, y in items[i + 1:]:
            if ba == bb or parent.get(ba) == bb or parent.get(bb) == ba or not x.getAABB().overlap(y.getAABB()):
                continue
            result = coal.CollisionResult()
            if coal.collide(x, y, request, result) and result.numContacts():
                depth = abs(result.getContact(0).penetration_depth)
                if depth > worst.get((ba, bb), (0, None, None))[0]:
                    worst[(ba, bb)] = (depth, a, b)
    allowed = disabled_pairs(robot)
    found = sorted(((d, a, b) for d, a, b in worst.values() if d > 0.001 and frozenset((a, b)) not in allowed), reverse=True)
    if found:
        depth, a, b = found[0]
        more = f", and {len(found) - 1} more pairs" if len(found) > 1 else ""
        yield "robot", f"in the default configuration the convex hulls of `{a}` and `{b}` overlap by {depth * 1000:.1f} mm{more}", {
            "pairs": [(x, y, d) for d, x, y in found]}
