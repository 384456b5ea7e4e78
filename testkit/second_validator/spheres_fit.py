"""How spheres of a link lie to its pieces (8.9.4, 8.9.5)."""

from __future__ import annotations

import functools
import itertools
import math

from .geometry import Point, Triangle, area, closest_on_triangle, longest_side, normal
from .numeric import add, cross, distance, dot, norm, scaled, sub

Ball = tuple[Point, float]
Plane = tuple[Point, float]
Least = tuple[float, float]  # and most, by what is undecided
POINTS = 64  # 8.9.5
TURN = 0.6180339887498949  # 8.9.5
INSIDE = 1 - 1e-6  # 8.9.5
PARTS = 15.7  # 8.9.5
BEYOND = 1e-6  # 8.9.5
UNDECIDED = 1e-10  # 8.9.5
MOST_CORNERS = 2_000_000  # 8.9.7: beyond this, a piece is not verified


def height(ball: Ball, point: Point) -> float:
    """How far a point is outside of a sphere; negative inside."""
    return distance(point, ball[0]) - ball[1]


def planes_of_piece(piece: tuple[Triangle, ...]) -> list[Plane]:
    """The planes of all triangles with an area, outward normal and level."""
    with_area = [triangle for triangle in piece if area(triangle) > 0]
    return [(normal(t), dot(normal(t), t[0])) for t in with_area]


def distinct(planes: list[Plane], size: float) -> list[Plane]:
    """The planes without those that are one with another."""
    found: list[Plane] = []
    for n, level in planes:
        near = (norm(sub(n, other)) < 1e-7 and abs(level - at) < 1e-7 * size for other, at in found)
        if not any(near):
            found.append((n, level))
    return found


def meeting(a: Plane, b: Plane, c: Plane) -> Point | None:
    """The point of three planes."""
    bc = cross(b[0], c[0])
    volume = dot(a[0], bc)
    if abs(volume) < 1e-9:
        return None
    ca, ab = cross(c[0], a[0]), cross(a[0], b[0])
    total = add(add(scaled(bc, a[1]), scaled(ca, b[1])), scaled(ab, c[1]))
    return scaled(total, 1 / volume)


def bisectors(balls: list[Ball], place: int) -> list[Plane] | None:
    """The planes that cut out the part of a sphere; None where another one has all of it."""
    centre, radius = balls[place]
    found = []
    for other, (at, its) in enumerate(balls):
        apart = distance(at, centre)
        if apart > 0:
            n = scaled(sub(at, centre), 1 / apart)
            along = (apart**2 + radius**2 - its**2) / (2 * apart)
            found.append((n, dot(n, centre) + along))
        elif its > radius or (its == radius and other < place):
            return None
    return found


@functools.lru_cache(maxsize=4096)
def uncovered_points(
    piece: tuple[Triangle, ...], balls: tuple[Ball, ...], tolerance: float
) -> list[Point]:
    """8.9.4: corners of the parts of a piece that are outside of all spheres."""
    corners = list({corner for triangle in piece for corner in triangle})
    size = max(distance(corner, corners[0]) for corner in corners)
    if not balls:
        return corners
    larger = [(centre, radius + tolerance) for centre, radius in balls]
    faces = distinct(planes_of_piece(piece), size)
    if any(all(height(ball, corner) <= 0 for corner in corners) for ball in larger):
        return []
    found = []
    for place in range(len(larger)):
        cuts = bisectors(larger, place)
        if cuts is None:
            continue
        planes = faces + cuts
        if len(planes) ** 3 * len(larger) > 6 * MOST_CORNERS:
            return []
        for three in itertools.combinations(planes, 3):
            corner = meeting(*three)
            if corner and all(dot(n, corner) - level <= 1e-9 * size for n, level in planes):
                if min(height(ball, corner) for ball in balls) > tolerance:
                    found.append(corner)
    return found


def points_on(ball: Ball) -> list[Point]:
    """8.9.5: the points of a sphere."""
    centre, radius = ball
    found = []
    for k in range(POINTS):
        z = 1 - (2 * k + 1) / POINTS
        s = math.sqrt(1 - z * z)
        a = 2 * math.pi * math.modf(TURN * k)[0]
        found.append(add(centre, scaled((s * math.cos(a), s * math.sin(a), z), radius)))
    return found


def from_piece(piece: tuple[Triangle, ...], planes: list[Plane], point: Point) -> float:
    """The distance of a point from a piece, 0 inside."""
    if all(dot(n, point) <= level for n, level in planes):
        return 0.0
    return min(distance(closest_on_triangle(triangle, point), point) for triangle in piece)


@functools.lru_cache(maxsize=4096)
def standoff(
    pieces: tuple[tuple[Triangle, ...], ...], balls: tuple[Ball, ...], size: float
) -> tuple[Least, Least]:
    """8.9.5: the largest and the mean standoff."""
    planes = [planes_of_piece(piece) for piece in pieces]
    sure: list[tuple[float, float]] = []
    free: list[tuple[float, float]] = []
    for place, ball in enumerate(balls):
        others = balls[:place] + balls[place + 1 :]
        for point in points_on(ball):
            deep = max((INSIDE * radius - distance(point, at) for at, radius in others), default=-1)
            if deep >= UNDECIDED * size:
                continue
            apart = min(from_piece(piece, of, point) for piece, of in zip(pieces, planes))
            (sure if deep <= -UNDECIDED * size else free).append((apart, ball[1] ** 2))
    means = [mean(sure), mean(sure + free)]
    largest = max((apart for apart, _ in sure + free), default=0.0)
    weights = [sum(weight for _, weight in some) for some in (free, sure + free)]
    slack = largest * weights[0] / weights[1] if weights[0] else 0.0
    least = max((apart for apart, _ in sure), default=0.0)
    return (least, largest), (min(means) - slack, max(means) + slack)


def mean(weighted: list[tuple[float, float]]) -> float:
    weights = sum(weight for _, weight in weighted)
    return sum(value * weight for value, weight in weighted) / weights if weights else 0.0


def centroids(triangle: Triangle, size: float) -> list[Point]:
    """8.9.5: the centroids of the equal parts of a triangle."""
    a, b, c = triangle
    n = math.ceil(PARTS * longest_side(triangle) / size)
    u, v = scaled(sub(b, a), 1 / n), scaled(sub(c, a), 1 / n)
    found = []
    for i in range(n):
        for j in range(n - i):
            found.append(add(a, add(scaled(u, i + 1 / 3), scaled(v, j + 1 / 3))))
            if i + j < n - 1:
                found.append(add(a, add(scaled(u, i + 2 / 3), scaled(v, j + 2 / 3))))
    return found


@functools.lru_cache(maxsize=4096)
def counted(
    pieces: tuple[tuple[Triangle, ...], ...], size: float
) -> tuple[tuple[Point, float, bool], ...]:
    """8.9.5: the centroids that may count, each with its weight, and whether it does."""
    planes = [planes_of_piece(piece) for piece in pieces]
    found = []
    for place, piece in enumerate(pieces):
        others = planes[:place] + planes[place + 1 :]
        for triangle in piece:
            if area(triangle) == 0:
                continue
            parts = centroids(triangle, size)
            for point in parts:
                depths = [
                    min((level - dot(n, point) for n, level in of), default=-1) for of in others
                ]
                deep = max(depths, default=-1) - BEYOND * size
                if deep < UNDECIDED * size:
                    weight = area(triangle) / len(parts)
                    found.append((point, weight, deep <= -UNDECIDED * size))
    return tuple(found)


@functools.lru_cache(maxsize=4096)
def uncovered(
    pieces: tuple[tuple[Triangle, ...], ...], balls: tuple[Ball, ...], size: float
) -> tuple[Least, Least]:
    """8.9.5: the part of the surface outside of the spheres, and how far it is outside."""
    outside, weights, farthest = [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]
    for point, weight, is_sure in counted(pieces, size):
        weights[1] += weight
        weights[0] += weight if is_sure else 0
        far = min(height(ball, point) for ball in balls)
        beyond = far - BEYOND * size
        for kind in range(2):
            if beyond > UNDECIDED * size and is_sure or kind and beyond > -UNDECIDED * size:
                outside[kind] += weight
                farthest[kind] = max(farthest[kind], far)
    least = outside[0] / weights[1] if weights[1] else 0.0
    most = outside[1] / weights[0] if weights[0] else float(outside[1] > 0)
    return (least, min(most, 1.0)), (farthest[0], farthest[1])
