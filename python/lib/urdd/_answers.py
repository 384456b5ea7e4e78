"""What a robot answers with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

from ._arrays import Bools, Floats, Indices

ShapeKind: TypeAlias = Literal["hulls", "boxes", "spheres", "pieces", "piece-boxes", "piece-spheres"]
"""A kind of shapes that stand for links: the convex hull of each link and its convex pieces, and the boxes and spheres
about these."""

MeshKind: TypeAlias = Literal["plain", "hulls", "pieces"]
"""A kind of meshes: what a link looks like, its convex hull, its convex pieces."""

SkipReason: TypeAlias = Literal["same-link", "always", "adjacent", "default", "never", "none"]
"""Why a pair of shapes is skipped, or not: both are on one link, always in contact, on links that a joint connects, in
contact in the default configuration, in contact in no sampled configuration, or none of these."""

SKIP_REASONS: tuple[SkipReason, ...] = ("same-link", "always", "adjacent", "default", "never", "none")
"""All reasons, in the order in which the first that applies counts."""


@dataclass(frozen=True)
class Pair:
    """Two shapes of different links."""

    links: tuple[str, str]
    """The names of the two links."""
    pieces: tuple[int, int]
    """Which pieces of the links they are; 0 for hulls and what is about them."""


@dataclass(frozen=True)
class PairDistance(Pair):
    """What is nearest in a pair of shapes."""

    distance: float
    """Metres; 0 where they touch or overlap."""
    relative: float | None
    """The distance over the pair's mean distance in ``link_shapes_distance_statistics_module``: a measure of nearness
    that is alike for large links and small ones. None where that module has none, or a mean of 0."""
    points: Floats
    """(2, 3): the point of each shape at which the distance is, in the root link's frame, metres."""


@dataclass(frozen=True)
class LearnedPair:
    """Two links that a learned self-collision model has an output for."""

    links: tuple[str, str]
    """The names of the two links."""
    margin: float
    """What is taken from the network's output to give the clearance, metres: it makes misses rare."""


@dataclass(frozen=True)
class Rate:
    """A share of counted configurations, with its 95 % interval (Wilson's, SPEC 8.8.11)."""

    count: int
    """How many."""
    of: int
    """Out of how many."""
    lower: float
    """The lower end of the interval, 0 to 1."""
    upper: float
    """The upper end of the interval, 0 to 1."""

    def __str__(self) -> str:
        if self.of == 0:
            return "none of 0"
        share, lower, upper = (f"{100 * x:.2f}" for x in (self.count / self.of, self.lower, self.upper))
        return f"{share} % ({lower} to {upper} %) of {self.of:,}"


@dataclass(frozen=True)
class ObstaclePair:
    """A shape of a robot, and an obstacle."""

    link: str
    """The name of the shape's link."""
    piece: int
    """Which piece of the link it is; 0 for a hull and what is about it."""
    obstacle: str
    """The name of the obstacle."""


@dataclass(frozen=True)
class ObstacleDistance(ObstaclePair):
    """How near a shape of a robot is to an obstacle."""

    distance: float
    """Metres; 0 where they touch or overlap."""
    points: Floats
    """(2, 3): the point of the shape and that of the obstacle at which the distance is, in the root link's frame,
    metres; where they overlap, both are one point of both."""


@dataclass(frozen=True)
class InverseSolution:
    """A configuration, and how near to its target it is."""

    q: Floats
    """(dofs,), rad or m, within bounds. DOFs that do not move the link are as they were at the start."""
    reached: bool
    """Whether both errors are within the tolerances. Where not, this came nearest."""
    position_error: float
    """How far the point is from its target, metres."""
    rotation_error: float
    """The angle by which the link is turned against its target, radians; 0 where only a place is asked for."""
    restarts: int
    """Descents from random configurations that it took."""
    iterations: int
    """Steps of all descents."""


@dataclass(frozen=True)
class InverseSolutions:
    """A configuration for each of n targets: the fields of :class:`InverseSolution`, as arrays."""

    q: Floats
    """(n, dofs)."""
    reached: Bools
    """(n,)."""
    position_error: Floats
    """(n,), metres."""
    rotation_error: Floats
    """(n,), radians."""
    restarts: Indices
    """(n,)."""
    iterations: Indices
    """(n,)."""


@dataclass(frozen=True)
class ConvexMesh:
    """A convex mesh in its link's frame."""

    link: str
    """The link."""
    piece: int
    """Which of the link's pieces it is; 0 for a hull."""
    vertices: Floats
    """(v, 3), metres."""
    faces: Indices
    """(f, 3): corners of each triangle, counter-clockwise when seen from outside."""


@dataclass(frozen=True)
class Box:
    """A box in its link's frame."""

    link: str
    """The link."""
    piece: int
    """Which of the link's pieces it is about; 0 for a hull."""
    pose: Floats
    """(4, 4): the box's own frame, at its centre, along its sides."""
    half_extents: Floats
    """(3,): half of each side, metres."""


class Spheres(NamedTuple):
    """Spheres, by row."""

    links: list[str]
    """The link of each."""
    pieces: Indices
    """(n,): which of its link's pieces it is about; 0 for a hull."""
    centres: Floats
    """(n, 3), in the link's frame, metres."""
    radii: Floats
    """(n,), metres."""


@dataclass(frozen=True)
class Visual:
    """Triangles of one colour, in their link's frame."""

    link: str
    """The link."""
    color: tuple[float, float, float, float] | None
    """Red, green, blue and opacity, from 0 to 1; None where the file gives none, or a texture."""
    vertices: Floats
    """(v, 3), metres."""
    faces: Indices
    """(f, 3): corners of each triangle."""


@dataclass(frozen=True)
class Skips:
    """Which pairs of shapes of a kind a check for collisions leaves out, and why."""

    kind: ShapeKind
    """The kind of shapes."""
    links: tuple[str, ...]
    """The link of each shape."""
    pieces: Indices
    """(shapes,): which piece of its link each shape is."""
    skipped: Bools
    """(shapes, shapes): whether the pair is skipped. Symmetric, true on the diagonal."""
    reasons: list[list[SkipReason]] | None
    """The reason of each pair; None where the URDD does not say. A person's edits may decide otherwise."""

    def pairs_of_links(self) -> set[frozenset[str]]:
        """The pairs of links all of whose shapes are skipped."""
        names = sorted(set(self.links))
        rows = {name: [k for k, link in enumerate(self.links) if link == name] for name in names}
        found: set[frozenset[str]] = set()
        for k, a in enumerate(names):
            for b in names[k + 1 :]:
                if bool(self.skipped[rows[a]][:, rows[b]].all()):
                    found.add(frozenset((a, b)))
        return found
