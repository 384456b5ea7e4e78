"""How two robots differ, as dataclasses.

Written by `python/scripts/make_types.py` from `schema/`. Do not edit.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

__all__ = [
    "DiffBox",
    "DiffReport",
    "DiffSide",
    "DofDifference",
    "FindingDifference",
    "GeometryDifference",
    "GeometryKind",
    "Kind",
    "LinkDifference",
    "ModuleDifference",
    "PairChange",
    "PairDifference",
    "PartDifference",
    "PoseDifference",
    "Presence",
    "Severity",
    "Tool",
    "ValueChange",
    "Verdict",
    "read_diff_report",
]

Kind: TypeAlias = Literal["urdd", "urdf"]
"""What was examined.
- `urdd`: A URDD.
- `urdf`: A URDF by itself, judged by the rules that need nothing else.
"""

Verdict: TypeAlias = Literal["pass", "fail", "unreadable", "incomplete"]
"""What came of examining a URDD.
- `pass`: Nothing found at or above the severity at which a run fails.
- `fail`: Something found.
- `unreadable`: The folder could not be read.
- `incomplete`: A rule crashed: a bug in this program. The URDD is not fully examined.
"""

Presence: TypeAlias = Literal["added", "removed", "changed"]
"""What became of a part.
- `added`: Only the second robot has it.
- `removed`: Only the first robot has it.
- `changed`: Both have it, and it differs.
"""

GeometryKind: TypeAlias = Literal["Visual", "Collision"]
"""Which of a link's two geometries a mesh was made from.
- `Visual`: The `visual` elements.
- `Collision`: The `collision` elements.
"""

PairChange: TypeAlias = Literal["gained", "lost", "pieces"]
"""What becomes of a pair of links in collision checks.
- `gained`: It was skipped and is checked now.
- `lost`: It was checked and is skipped now.
- `pieces`: Other pieces of the two links are checked.
"""

Severity: TypeAlias = Literal["info", "warning", "error"]
"""How bad a finding is; the worst is the greatest.
- `info`: A convention of old, or something worth knowing.
- `warning`: A violated SHOULD of the specification, or an unusual robot.
- `error`: A violated MUST of the specification.
"""


@dataclass(frozen=True)
class Tool:
    """The program that wrote a report."""

    name: str
    """Its name."""

    version: str
    """Its version."""


@dataclass(frozen=True)
class DiffSide:
    """One of the two robots."""

    path: str
    """Its path as given."""

    kind: Kind
    """Whether it is a URDD or a URDF."""

    name: str
    """Name of the robot."""

    links: int
    """Number of links."""

    joints: int
    """Number of joints."""

    dofs: int
    """Number of degrees of freedom."""

    verdict: Verdict | None
    """What came of validating it; null where findings were not asked for."""


@dataclass(frozen=True)
class ValueChange:
    """A value that differs."""

    field: str
    """Which value: `limit.lower`, `origin.xyz`, `visual[0].scale`. An index is that of the first robot, or of the
    second where only that has the element."""

    before: str | None
    """The value of the first robot; null where it has none."""

    after: str | None
    """The value of the second robot; null where it has none."""

    unit: str
    """Unit of both; empty for texts and ratios."""


@dataclass(frozen=True)
class LinkDifference:
    """A link that differs."""

    name: str
    """Its name."""

    presence: Presence
    """What became of it."""

    changes: list[ValueChange]
    """The values that differ, except for those of geometry."""

    geometry: list[GeometryDifference]
    """Its visual geometry and its collision geometry, if they differ."""


@dataclass(frozen=True)
class GeometryDifference:
    """The visual or the collision geometry of a link that differs."""

    geometry: GeometryKind
    """Which of the two."""

    changes: list[ValueChange]
    """The values that differ."""

    bounds_before: DiffBox | None
    """Bounding box in the first robot; null without geometry, or where a mesh could not be read."""

    bounds_after: DiffBox | None
    """Bounding box in the second robot."""


@dataclass(frozen=True)
class DiffBox:
    """A box along the axes of the link's frame, metres."""

    min: list[float]
    """Smallest x, y, z."""

    max: list[float]
    """Largest x, y, z."""


@dataclass(frozen=True)
class PartDifference:
    """A joint, a material or another element that differs."""

    name: str
    """Its name."""

    presence: Presence
    """What became of it."""

    changes: list[ValueChange]
    """The values that differ, if both robots have it."""


@dataclass(frozen=True)
class PoseDifference:
    """Links that are elsewhere, relative to the root link, with all joints at zero."""

    links: list[str]
    """Names of the links that are in both robots and are elsewhere or turned, in the order of the first."""

    farthest: str
    """The link whose origin is the farthest from where it was."""

    distance: float
    """How far that is, metres."""

    angle: float
    """The largest angle by which a link is turned, radians."""


@dataclass(frozen=True)
class DofDifference:
    """A DOF that differs."""

    name: str
    """Its name: that of its joint, with a suffix where the joint has several."""

    presence: Presence
    """What became of it."""

    index_before: int | None
    """Its index in the first robot."""

    index_after: int | None
    """Its index in the second robot."""

    changes: list[ValueChange]
    """What differs without following from the URDF."""


@dataclass(frozen=True)
class PairDifference:
    """A pair of links whose collision checks differ."""

    links: list[str]
    """Names of the two links, in the order of the first robot."""

    change: PairChange
    """What becomes of it."""

    shapes: list[str]
    """The kinds of shapes for which this is so: `hulls`, `boxes`, `spheres`, `pieces`, `piece-boxes`,
    `piece-spheres`."""


@dataclass(frozen=True)
class ModuleDifference:
    """A module that differs."""

    name: str
    """Its name."""

    presence: Presence
    """What became of it."""

    version_before: str | None
    """Its version in the first URDD."""

    version_after: str | None
    """Its version in the second URDD."""

    document: bool
    """Whether its document differs."""

    files: bool
    """Whether its files differ, by the hashes in `urdd.json`."""


@dataclass(frozen=True)
class FindingDifference:
    """A finding that is new or gone."""

    presence: Presence
    """`added` or `removed`."""

    code: str
    """Code of the rule."""

    name: str
    """Name of the rule."""

    severity: Severity
    """How bad it is."""

    subject: str | None
    """What it is about: links, joints or DOFs by name, else the file and the place in it. The first, where it is
    about several."""

    message: str
    """What is wrong, and what to do."""

    count: int
    """How many places are new or gone."""


@dataclass(frozen=True)
class DiffReport:
    """How two robots differ in meaning. Values are texts, as a URDF would have them; numbers are in their shortest
    form that reads back as the same 64-bit number."""

    tool: Tool
    """The program."""

    before: DiffSide
    """The first robot: before."""

    after: DiffSide
    """The second robot: after."""

    same: bool
    """Whether nothing differs in meaning: every list below but `notes` is empty."""

    robot: list[ValueChange]
    """Differences of the robot itself: its name and its URDF version."""

    links: list[LinkDifference]
    """Links that differ, in the order of the first robot, then of the second."""

    joints: list[PartDifference]
    """Joints that differ, in the same order."""

    materials: list[PartDifference]
    """Materials at the top of the URDF that differ."""

    other_elements: list[PartDifference]
    """Other elements at the top of the URDF that differ (transmission, gazebo, ros2_control, …)."""

    poses: PoseDifference | None
    """Where the links are with all joints at zero; null if no link that both have is elsewhere, or where the joints
    of one robot form no tree."""

    dofs: list[DofDifference]
    """DOFs that are new, gone or at another index, or whose bounds do not follow from their joints."""

    pairs: list[PairDifference] | None
    """Pairs of links that collision checks gain or lose; null where one robot states no skips."""

    modules: list[ModuleDifference] | None
    """Modules that are new or gone, of another version, or with other content. What other lists of this report
    compare in detail is not repeated here. Null where one of the two is a URDF."""

    findings: list[FindingDifference] | None
    """Findings of `urdd validate` that are new or gone; null where they were not asked for."""

    notes: list[str]
    """What was not compared, and what differs without a difference in meaning."""


def _tool(v: Any) -> Tool:
    return Tool(
        name=v["name"],
        version=v["version"],
    )


def _diff_side(v: Any) -> DiffSide:
    return DiffSide(
        path=v["path"],
        kind=v["kind"],
        name=v["name"],
        links=int(v["links"]),
        joints=int(v["joints"]),
        dofs=int(v["dofs"]),
        verdict=v["verdict"],
    )


def _value_change(v: Any) -> ValueChange:
    return ValueChange(
        field=v["field"],
        before=v["before"],
        after=v["after"],
        unit=v["unit"],
    )


def _link_difference(v: Any) -> LinkDifference:
    return LinkDifference(
        name=v["name"],
        presence=v["presence"],
        changes=[_value_change(x) for x in v["changes"]],
        geometry=[_geometry_difference(x) for x in v["geometry"]],
    )


def _geometry_difference(v: Any) -> GeometryDifference:
    return GeometryDifference(
        geometry=v["geometry"],
        changes=[_value_change(x) for x in v["changes"]],
        bounds_before=None if v["bounds_before"] is None else _diff_box(v["bounds_before"]),
        bounds_after=None if v["bounds_after"] is None else _diff_box(v["bounds_after"]),
    )


def _diff_box(v: Any) -> DiffBox:
    return DiffBox(
        min=v["min"],
        max=v["max"],
    )


def _part_difference(v: Any) -> PartDifference:
    return PartDifference(
        name=v["name"],
        presence=v["presence"],
        changes=[_value_change(x) for x in v["changes"]],
    )


def _pose_difference(v: Any) -> PoseDifference:
    return PoseDifference(
        links=v["links"],
        farthest=v["farthest"],
        distance=v["distance"],
        angle=v["angle"],
    )


def _dof_difference(v: Any) -> DofDifference:
    return DofDifference(
        name=v["name"],
        presence=v["presence"],
        index_before=None if v["index_before"] is None else int(v["index_before"]),
        index_after=None if v["index_after"] is None else int(v["index_after"]),
        changes=[_value_change(x) for x in v["changes"]],
    )


def _pair_difference(v: Any) -> PairDifference:
    return PairDifference(
        links=v["links"],
        change=v["change"],
        shapes=v["shapes"],
    )


def _module_difference(v: Any) -> ModuleDifference:
    return ModuleDifference(
        name=v["name"],
        presence=v["presence"],
        version_before=v["version_before"],
        version_after=v["version_after"],
        document=v["document"],
        files=v["files"],
    )


def _finding_difference(v: Any) -> FindingDifference:
    return FindingDifference(
        presence=v["presence"],
        code=v["code"],
        name=v["name"],
        severity=v["severity"],
        subject=v["subject"],
        message=v["message"],
        count=int(v["count"]),
    )


def _diff_report(v: Any) -> DiffReport:
    return DiffReport(
        tool=_tool(v["tool"]),
        before=_diff_side(v["before"]),
        after=_diff_side(v["after"]),
        same=v["same"],
        robot=[_value_change(x) for x in v["robot"]],
        links=[_link_difference(x) for x in v["links"]],
        joints=[_part_difference(x) for x in v["joints"]],
        materials=[_part_difference(x) for x in v["materials"]],
        other_elements=[_part_difference(x) for x in v["other_elements"]],
        poses=None if v["poses"] is None else _pose_difference(v["poses"]),
        dofs=[_dof_difference(x) for x in v["dofs"]],
        pairs=None if v["pairs"] is None else [_pair_difference(x) for x in v["pairs"]],
        modules=None if v["modules"] is None else [_module_difference(x) for x in v["modules"]],
        findings=None if v["findings"] is None else [_finding_difference(x) for x in v["findings"]],
        notes=v["notes"],
    )


def read_diff_report(text: str) -> DiffReport:
    """A report as `urdd diff --format json` writes it."""
    return _diff_report(json.loads(text))
