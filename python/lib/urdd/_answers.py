"""Results of queries on a robot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ._arrays import Bools, Floats, Indices

ShapeKind: TypeAlias = Literal["hulls", "boxes", "spheres", "pieces", "piece-boxes", "piece-spheres"]
"""A kind of collision shapes: the convex hulls of links, their convex pieces, and the bounding boxes and spheres of
both."""

ExportShapes: TypeAlias = ShapeKind | Literal["source"]
"""The shapes of an export: of a kind, or the collision elements of the source as it has them."""

MeshKind: TypeAlias = Literal["plain", "hulls", "pieces"]
"""A kind of meshes: a link's appearance, its convex hull, its convex pieces."""

SkipReason: TypeAlias = Literal["same-link", "always", "adjacent", "default", "never", "none"]
"""Why a pair of shapes is skipped, or not: both are on one link, always in contact, on links that a joint connects, in
contact in the default configuration, never in contact in the sampled configurations, or none of these."""

SKIP_REASONS: tuple[SkipReason, ...] = ("same-link", "always", "adjacent", "default", "never", "none")
"""All reasons, by priority: the first that applies counts."""


@dataclass(frozen=True)
class Pair:
    """Two shapes of different links."""

    links: tuple[str, str]
    """The names of the two links, or of attached objects."""
    pieces: tuple[int, int]
    """The indices of the pieces; 0 for hulls and their bounding volumes. For an attached object, of its parts."""


@dataclass(frozen=True)
class PairDistance(Pair):
    """The distance between two shapes, and their closest points."""

    distance: float
    """Metres; 0 if they touch or overlap."""
    relative: float | None
    """The distance divided by the pair's mean distance in ``link_shapes_distance_statistics_module``, which makes large
    and small links comparable. None if that module has no mean for the pair, or a mean of 0."""
    points: Floats
    """(2, 3): the closest points of the two shapes, in the root link's frame, metres."""


@dataclass(frozen=True)
class PairGradient(PairDistance):
    """The distance between two shapes, and how it changes with the configuration."""

    gradient: Floats | None
    """(dofs,): the derivative of the distance for each DOF, m/rad or m/m. None if the shapes touch or overlap.

    It is that of the closest points as they are. Where other points are as close (parallel faces), the distance is not
    differentiable, and this is one of its directional derivatives."""


@dataclass(frozen=True)
class PairOverlap(PairDistance):
    """Two shapes that touch or overlap. The points are those that touch once the second shape has moved, before it
    moves."""

    depth: float
    """Metres: the length of the least translation that separates the two; 0 if they touch."""
    direction: Floats
    """(3,): the unit vector along which the second shape would move, in the root link's frame."""
    gradient: Floats
    """(dofs,): the derivative of the depth for each DOF, m/rad or m/m. Where another translation is as short, the depth
    is not differentiable, and this is one of its directional derivatives."""


@dataclass(frozen=True)
class LearnedPair:
    """A pair of links that a learned self-collision model has an output for."""

    links: tuple[str, str]
    """The names of the two links."""
    margin: float
    """The clearance is the network's output minus this margin, metres, which makes misses rare."""


@dataclass(frozen=True)
class Rate:
    """A fraction of configurations, with its 95 % interval (Wilson's, SPEC 8.8.11)."""

    count: int
    """The numerator."""
    of: int
    """The denominator."""
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
    """The name of the shape's link, or of the attached object."""
    piece: int
    """The index of the link's piece; 0 for a hull and its bounding volumes. For an attached object, of its part."""
    obstacle: str
    """The name of the obstacle."""


@dataclass(frozen=True)
class ObstacleDistance(ObstaclePair):
    """The distance between a shape of a robot and an obstacle, and their closest points."""

    distance: float
    """Metres; 0 if they touch or overlap."""
    points: Floats
    """(2, 3): the closest points of the shape and of the obstacle, in the root link's frame, metres. If the two
    overlap, both are the same point, which is in both."""


@dataclass(frozen=True)
class ObstacleGradient(ObstacleDistance):
    """The distance between a shape of a robot and an obstacle, and how it changes with the configuration."""

    gradient: Floats | None
    """(dofs,): the derivative of the distance for each DOF, m/rad or m/m, as in :class:`PairGradient`. None if the two
    touch or overlap."""


@dataclass(frozen=True)
class ObstacleOverlap(ObstacleDistance):
    """A shape of a robot and an obstacle that touch or overlap. The points are those that touch once the obstacle has
    moved, before it moves."""

    depth: float
    """Metres: the length of the least translation that separates the two; 0 if they touch."""
    direction: Floats
    """(3,): the unit vector along which the obstacle would move, in the root link's frame."""
    gradient: Floats
    """(dofs,): the derivative of the depth for each DOF, m/rad or m/m, as in :class:`PairOverlap`."""


@dataclass(frozen=True)
class InverseSolution:
    """Configurations, and how near they are to their targets. One target gives scalars, many give arrays that begin
    with the targets' axes."""

    q: Floats
    """(..., dofs), rad or m, within the bounds. DOFs that do not move the link keep their start value."""
    reached: Bools
    """(...): whether both errors are within the tolerances. If false, this is the nearest that was found."""
    verdict: NDArray[np.str_]
    """(...): why. ``reached``; ``refused``: every configuration that was found to reach the target is in collision, and
    this is one; ``limits``: only a configuration beyond the bounds was found to reach it; ``out of reach``: none was
    found, within the bounds or beyond them; ``loops``: none with closed loops, but one with open ones. This is a
    search, not a proof."""
    position_error: Floats
    """(...): the distance of the point from its target, metres."""
    rotation_error: Floats
    """(...): the angle between the link and its target rotation, radians; 0 for a target position."""
    restarts: Indices
    """(...): number of descents from random configurations."""
    iterations: Indices
    """(...): number of steps of all descents."""
    refused_by: PairDistance | ObstacleDistance | NDArray[np.object_] | None = None
    """Where the verdict is ``refused``, the nearest pair of the first of ``free_of`` that is too near in ``q``; None
    elsewhere. One target gives a pair or None, many give an array of them."""


@dataclass(frozen=True)
class LoopErrors:
    """How far configurations are from closed (SPEC 6.8). One gives scalars and arrays, many arrays that begin with
    their axes."""

    position: Floats
    """(..., loops): the position gap of each loop, metres."""
    rotation: Floats
    """(..., loops): the rotation gap of each loop, radians while small."""
    sums: Floats
    """(..., couplings): the sum of each coupling, which is 0 where it holds."""
    is_closed: Bools
    """(...): whether all loops are closed and all couplings hold, within their tolerances."""


@dataclass(frozen=True)
class Closed:
    """The closed configurations near others."""

    configuration: Floats
    """(..., dofs), rad or m: closed, or with the smallest gaps that were found from there."""
    is_closed: Bools
    """(...): whether it is closed. If false, the loops cannot close, as a rule, with what is held and bounded. This is
    a search, not a proof."""


@dataclass(frozen=True)
class FreeDofs:
    """The mobility in a configuration."""

    independent: Indices
    """The DOFs that move freely, ascending."""
    dependent: Indices
    """The DOFs that follow from these, ascending."""


@dataclass(frozen=True)
class ConvexMesh:
    """A convex mesh in its link's frame."""

    link: str
    """The link."""
    piece: int
    """The index of the link's piece; 0 for a hull."""
    vertices: Floats
    """(v, 3), metres."""
    faces: Indices
    """(f, 3): the vertices of each triangle, counter-clockwise seen from outside."""


@dataclass(frozen=True)
class Box:
    """A box in its link's frame."""

    link: str
    """The link."""
    piece: int
    """The index of the link's piece that it bounds; 0 for a hull."""
    pose: Floats
    """(4, 4): the box's frame, at its centre, along its sides."""
    half_extents: Floats
    """(3,): half of each side, metres."""


class Spheres(NamedTuple):
    """Spheres, one per row."""

    links: list[str]
    """The link of each sphere."""
    pieces: Indices
    """(n,): the index of the link's piece that each bounds; 0 for a hull."""
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
    """Red, green, blue and opacity, from 0 to 1; None if the file has none, or a texture."""
    vertices: Floats
    """(v, 3), metres."""
    faces: Indices
    """(f, 3): the vertices of each triangle."""


@dataclass(frozen=True)
class Skips:
    """The pairs of shapes of a kind that need no collision check, and the reasons: MoveIt's *allowed collision matrix*,
    for shapes instead of links."""

    kind: ShapeKind
    """The kind of shapes."""
    links: tuple[str, ...]
    """The link of each shape."""
    pieces: Indices
    """(shapes,): the index of each shape's piece."""
    skipped: Bools
    """(shapes, shapes): whether the pair is skipped. Symmetric, true on the diagonal."""
    reasons: list[list[SkipReason]] | None
    """The reason of each pair; None if the URDD does not state them. A user's edits can override them."""

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
