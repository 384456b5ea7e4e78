"""Rules about mass and inertia."""
from shapes import *


def reach(link, points, margin=0.0):
    """(principal moments, largest possible moments): no mass inside of the points' hull, with this centre, can have more."""
    moments, axes = np.linalg.eigh((link.tensor + link.tensor.T) / 2)
    p = (points - link.centre) @ axes
    low, high = p.min(axis=0) - margin, p.max(axis=0) + margin
    spread = np.where((low < 0) & (high > 0), -low * high, np.maximum(abs(low), abs(high)) ** 2)   # Bhatia and Davis
    bounds = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        cylinder = (np.hypot(p[:, j], p[:, k]).max() + margin) ** 2
        bounds.append(link.mass * min(cylinder, spread[j] + spread[k]))
    return moments, np.array(bounds)


@rule("LNT001", "inertia-beyond-geometry")
def inertia_beyond_geometry(robot):
    """A principal moment is larger than any mass inside of the body's hull, widened on all sides by 5 % of its size and 5 mm, can have.
    Only links whose trace is 1 % or more of the sum of the traces in their body."""
    top, sums = robot.body_of(), {}
    for name, link in robot.links.items():
        if link.tensor is not None:
            sums[top[name]] = sums.get(top[name], 0.0) + float(np.trace(link.tensor))
    for link, points, _ in massive_links(robot):
        if link.tensor is None or not np.any(link.tensor) or np.trace(link.tensor) < 0.01 * sums[top[link.name]]:
            continue
        size = np.linalg.norm(points.max(axis=0) - points.min(axis=0))
        moments, bounds = reach(link, points, 0.05 * size + 0.005)
        ratio = float((moments / bounds).max())
        if ratio > 1:
            i = int((moments / bounds).argmax())
            yield where("link", link.name), (
                f"moment {moments[i]:.4g} kg m2 with {link.mass:.4g} kg is a radius of gyration of {math.sqrt(moments[i] / link.mass):.3f} m; "
                f"the link's geometry allows {math.sqrt(bounds[i] / link.mass):.3f} m"), {
                "ratio": ratio, "mass": link.mass, "moments": moments.tolist(), "size": float(size), "strict": float((moments / np.maximum(reach(link, points)[1], 1e-30)).max())}


@rule("LNT002", "centre-of-mass-outside")
def centre_of_mass_outside(robot):
    """In a robot with a joint that moves: a link of more than 10 g and with a shape of its own has its centre of mass outside of the body's hull by more than
    10 % of the body's size and 5 mm. Not where the link has more than 4,000 kg/m3 of the hull: its shapes are not all of it."""
    for link, points, _ in massive_links(robot) if moves(robot) else []:
        hull = hull_of(points) if link.mass > 0.01 and (link.visuals or link.collisions) else None
        if hull is None or link.mass > 4000 * hull.volume:
            continue
        size = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
        out = float((hull.equations[:, :3] @ link.centre + hull.equations[:, 3]).max())
        if out > 0.1 * size + 0.005:
            yield where("link", link.name), f"the centre of mass is {out * 1000:.0f} mm outside of the link's geometry, which is {size * 1000:.0f} mm long", {
                "out": out, "size": size, "mass": link.mass}


@rule("LNT003", "odd-density")
def odd_density(robot):
    """Mass of a body over its volume: above 20,000 kg/m3 by the hull of all its shapes, from 50 g on; or, in a robot with a joint that
    moves, below 10 kg/m3 by the smaller of the sums of the hulls of its visuals and of its collisions."""
    shapes = body_shapes(robot)
    for top, members in robot.bodies().items():
        found, whole = shapes[top]
        mass = sum(robot.links[n].mass or 0 for n, _ in members)
        if not found or not whole or mass <= 0:
            continue
        hull = hull_of(np.concatenate([p for _, p in found]))
        if hull is None:
            continue
        sums = {}
        for kind, points in found:
            h = hull_of(points)
            sums[kind] = sums.get(kind, 0) + (h.volume if h is not None else 0)
        least = min([v for v in sums.values() if v > 0] or [hull.volume])
        if mass / hull.volume > 20000 and mass >= 0.05:
            yield where("link", top), f"{mass:.4g} kg in {hull.volume * 1e6:.4g} cm3 is {mass / hull.volume:.0f} kg/m3, denser than any metal", {"kind": "high", "density": mass / hull.volume, "mass": mass}
        elif mass / least < 10 and moves(robot):
            yield where("link", top), f"{mass:.4g} kg in {least * 1000:.4g} litres is {mass / least:.3g} kg/m3, lighter than foam", {"kind": "low", "density": mass / least, "mass": mass}


@rule("LNT004", "same-default-inertia")
def same_default_inertia(robot):
    """One mass and one tensor on 3 or more links whose hulls differ by more than 10 % in volume from one another."""
    groups = {}
    for name, link in robot.links.items():
        if link.mass and link.mass > 0 and link.tensor is not None and any(link.raw):
            groups.setdefault((link.mass, link.raw), []).append(link)
    shapes = link_shapes(robot)
    for (mass, raw), links in groups.items():
        if len(links) < 3:
            continue
        volumes = []
        for link in links:
            points = [p for _, p in shapes[link.name] if p is not None]
            hull = hull_of(np.concatenate(points)) if points else None
            if hull is not None:
                volumes.append(hull.volume)
        different = []
        for v in sorted(volumes):
            if not different or v > 1.1 * different[-1]:
                different.append(v)
        if len(different) >= 3:
            yield "robot", f"{len(links)} links of {len(different)} different sizes have one mass ({mass:g} kg) and one inertia ({raw[0]:g} {raw[3]:g} {raw[5]:g}): {', '.join(l.name for l in links[:4])}...", {
                "mass": mass, "raw": raw, "links": len(links), "sizes": len(different), "largest_over_smallest": different[-1] / different[0]}


def even(points, mass):
    """Principal moments of the points' hull filled evenly with this mass, in ascending order; None without volume."""
    hull = hull_of(points)
    if hull is None:
        return None
    a, b, c = np.moveaxis(points[hull.simplices] - points[hull.vertices].mean(axis=0), 1, 0)   # tetrahedra from a point inside
    v = abs(np.einsum("ij,ij->i", a, np.cross(b, c))) / 6
    s = a + b + c
    volume = v.sum()
    if volume <= 0:
        return None
    first = (v[:, None] * s).sum(axis=0) / 4
    second = sum(np.einsum("i,ij,ik->jk", v, x, x) for x in (s, a, b, c)) / 20
    cov = second / volume - np.outer(first, first) / volume ** 2
    return np.sort(mass * (np.trace(cov) - np.linalg.eigvalsh(cov)))


@rule("LNT005", "inertia-far-below-geometry")
def inertia_far_below_geometry(robot):
    """In a robot with a joint that moves: the sum of the principal moments is above 0 and less than a 1000th of what the evenly filled hull of the link's own shapes has."""
    shapes = link_shapes(robot)
    for name, link in robot.links.items() if moves(robot) else []:
        points = [p for _, p in shapes[name]]
        if not link.mass or link.mass <= 0 or link.tensor is None or not points or any(p is None for p in points):
            continue
        trace = float(np.trace(link.tensor))
        expected = even(np.concatenate(points), link.mass)
        if expected is None or trace <= 0:
            continue
        ratio = trace / float(expected.sum())
        if ratio < 1e-3:
            yield where("link", name), f"moments sum to {trace:.3g} kg m2; geometry and mass ({link.mass:.4g} kg) give {expected.sum():.3g}, {1 / ratio:.0f} times as much", {
                "ratio": ratio, "mass": link.mass, "trace": trace}
