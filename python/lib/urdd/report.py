"""The reports of a validation and of a comparison, as dataclasses.

Written by `python/scripts/make_types.py` from `schema/`. Do not edit.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

__all__ = [
    "Cause",
    "CheckStatus",
    "Consequence",
    "Deed",
    "DiffBox",
    "DiffReport",
    "DiffSide",
    "Does",
    "DofDifference",
    "Finding",
    "FindingDifference",
    "Fix",
    "GeometryDifference",
    "GeometryKind",
    "ImportedFrom",
    "ImportedPart",
    "Kind",
    "LinkDifference",
    "LinkNotVerified",
    "MacroPlace",
    "Magnitude",
    "ModelNotVerified",
    "Module",
    "ModuleDifference",
    "NotChecked",
    "NotExamined",
    "PairChange",
    "PairDifference",
    "PartDifference",
    "Place",
    "PoseDifference",
    "Presence",
    "ProgramEffect",
    "ProgramResult",
    "Report",
    "Severity",
    "Size",
    "Skipped",
    "StaleIgnore",
    "Status",
    "TextEdit",
    "Tool",
    "Totals",
    "Urdd",
    "ValueChange",
    "Verdict",
    "WrittenAt",
    "read_diff_report",
    "read_report",
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

Cause: TypeAlias = Literal["unreadable", "arguments", "limit", "crash", "no-rule"]
"""What keeps a URDD or URDF from being examined.
- `unreadable`: It cannot be read.
- `arguments`: It is a xacro file that needs arguments, or does not take one that is declared of it.
- `limit`: It takes more time or memory than it may.
- `crash`: The program crashed: a bug in it.
- `no-rule`: No rule that was selected could look at it.
"""

Status: TypeAlias = Literal["passed", "failed", "skipped", "crashed"]
"""What became of a rule.
- `passed`: It found nothing.
- `failed`: It found something.
- `skipped`: It did not run.
- `crashed`: It ran into a fault of its own.
"""

Skipped: TypeAlias = Literal["absent", "other-format", "ignored", "not-verified"]
"""Why a rule did not run.
- `absent`: What it is about is not there.
- `other-format`: It is for another family of URDDs.
- `ignored`: The settings say to leave it out.
- `not-verified`: Something that it needs is wrong or missing: what it checks is not verified.
"""

Severity: TypeAlias = Literal["info", "warning", "error"]
"""How bad a finding is; the worst is the greatest.
- `info`: A convention of old, or something worth knowing.
- `warning`: A violated SHOULD of the specification, or an unusual robot.
- `error`: A violated MUST of the specification.
"""

Consequence: TypeAlias = Literal[
    "looseness",
    "appearance",
    "format",
    "collisions",
    "missing-geometry",
    "wrong-place",
    "wrong-motion",
]
"""What a fault does to users of the URDD, in ascending order of harm.
- `looseness`: Nothing is wrong, but it could be tighter, or the robot itself is unusual.
- `appearance`: The robot is shown in other colours or textures.
- `format`: A reader may refuse it, or read it in another way.
- `collisions`: Collision checking misses contacts, or sees some that are not there.
- `missing-geometry`: Geometry is not there, or cannot be read.
- `wrong-place`: Something is in another place than the robot has it.
- `wrong-motion`: The robot moves otherwise than it says.
"""

Deed: TypeAlias = Literal["reads", "drops", "refuses", "crashes"]
"""What a program does with a part of a URDF, or with the whole.
- `reads`: It reads the part otherwise than the file says.
- `drops`: It leaves the part out.
- `refuses`: It refuses the file.
- `crashes`: It crashes.
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


@dataclass(frozen=True)
class Tool:
    """The program that wrote a report."""

    name: str
    """Its name."""

    version: str
    """Its version."""


@dataclass(frozen=True)
class Urdd:
    """One URDD, or a URDF by itself."""

    kind: Kind
    """Which of them it is."""

    path: str
    """Its folder's path from the path that was given, with forward slashes; its own name where that path was the
    URDD itself."""

    name: str | None
    """Name of the robot; null where no module says it."""

    xacro_arguments: list[str]
    """The arguments, each as `name:=value`, with which xacro expanded it, where settings declare robots of the
    file."""

    verdict: Verdict
    """What came of it."""

    reason: str | None
    """Why it is unreadable; else null."""

    not_examined: NotExamined | None
    """Why nothing was examined, so that it neither passes nor fails; null where something was. The verdict is then
    `unreadable`, or `incomplete` after a crash."""

    size: Size
    """How large the robot is."""

    modules: list[Module]
    """Its modules."""

    checks: list[CheckStatus]
    """Every rule, in order of code."""

    findings: list[Finding]
    """What was found: by module, then by severity and code."""

    not_checked: list[NotChecked]
    """What was not verified, by reason."""

    geometry_not_verified: list[LinkNotVerified]
    """Links whose geometry was not verified by every rule, in order of index."""

    model_not_verified: ModelNotVerified | None
    """Why the rates of `self_collision_model_module` were not verified; null where they were, and where there is no
    such module."""

    programs: list[ProgramResult]
    """What programs do with a URDF, by their readers; empty where none was asked."""

    imported: ImportedFrom | None
    """The description that the URDF was imported from; null where it was written as a URDF."""


@dataclass(frozen=True)
class NotExamined:
    """Why a URDD or URDF was not examined."""

    cause: Cause
    """What kind of reason it is."""

    reason: str
    """Why, and what to do."""

    is_asked_for: bool
    """Whether a person names or declares it, so that the run fails. A xacro file that was found in a folder and
    needs arguments is not asked for."""

    file: str | None
    """The file with the reason, as seen from the folder of what was to be examined, with forward slashes; null
    where it is not known."""

    line: int | None
    """Line in the file, from 1."""

    column: int | None
    """Column in the line, in characters, from 1."""


@dataclass(frozen=True)
class Size:
    """How large a robot is; null where no module says it."""

    links: int | None
    """Number of links."""

    joints: int | None
    """Number of joints."""

    dofs: int | None
    """Number of degrees of freedom."""


@dataclass(frozen=True)
class Module:
    """A module of a URDD."""

    name: str
    """Its name."""

    path: str
    """Its folder, relative to the URDD's root."""

    version: str | None
    """Its version; null where it has none."""

    profile: str | None
    """`1.0` or `legacy`; null for extensions and unknown modules."""


@dataclass(frozen=True)
class CheckStatus:
    """What became of a rule."""

    code: str
    """Its code."""

    status: Status
    """What became of it."""

    reason: str | None
    """Why it was skipped, or how it crashed; else null."""

    skipped: Skipped | None
    """What kind of reason a skip has; null where it was not skipped."""


@dataclass(frozen=True)
class Finding:
    """Something that was found, or several of the same."""

    code: str
    """Code of the rule."""

    name: str
    """Name of the rule."""

    severity: Severity
    """How bad it is, settings applied."""

    default_severity: Severity
    """The severity that the rule has without settings."""

    clause: str | None
    """Clause of the specification; null where the rule is about robots and not about URDDs."""

    consequence: Consequence
    """What it does to users of the URDD."""

    module: str | None
    """The module; null where it is about none."""

    file: str | None
    """The file, relative to the URDD's root, with forward slashes."""

    pointer: str | None
    """JSON Pointer into the document."""

    line: int | None
    """Line in the file, from 1."""

    column: int | None
    """Column in the line, in characters, from 1."""

    subject: str | None
    """What the pointer refers to, by the names of links, joints or DOFs."""

    message: str
    """What is wrong, and what to do."""

    expected: str | None
    """What should be there."""

    actual: str | None
    """What is there."""

    tolerance: float | None
    """Where numbers were compared: the tolerance, in their unit."""

    magnitude: Magnitude | None
    """Where numbers were compared: by how much they differ."""

    count: int
    """How many findings this one stands for."""

    places: list[Place]
    """All places, the worst first; the first is the finding's own."""

    places_cut: int
    """How many of the counted places are not listed here, because there are too many."""

    programs: list[Does]
    """The programs that refuse the file, or read it otherwise than it says, because of it."""


@dataclass(frozen=True)
class Magnitude:
    """By how much something is off."""

    value: float | None
    """How much; null where it is no finite number."""

    unit: str
    """Its unit; empty for a ratio."""


@dataclass(frozen=True)
class Place:
    """A place of a finding."""

    file: str | None
    """The file."""

    pointer: str | None
    """JSON Pointer into the document."""

    line: int | None
    """Line in the file, from 1."""

    column: int | None
    """Column in the line, in characters, from 1."""

    written_at: WrittenAt | None
    """The place that xacro made it from; null where that is not known."""

    expected: str | None
    """What should be there."""

    actual: str | None
    """What is there."""

    subject: str | None
    """What the pointer refers to, by the names of links, joints or DOFs."""

    message: str | None
    """What is wrong at this place, where that differs from the finding's message."""

    magnitude: Magnitude | None
    """By how much it is off."""

    related: list[Place]
    """Other places to look at, such as the first of two elements of which one is too many; `message` says what is
    there."""

    fixes: list[Fix]
    """Changes that mend it, each by itself, the best first."""

    programs: list[Does]
    """The programs that refuse the file, or read it otherwise than it says, because of what is at this place."""


@dataclass(frozen=True)
class WrittenAt:
    """The place that xacro made a part of a URDF from: the one literal that decides it, such as an attribute of a
    macro's call, a property or a line of a YAML; without one, the element or the attribute in a .xacro file."""

    file: str
    """The file, as seen from the URDF's folder, with forward slashes."""

    line: int | None
    """Line in the file, from 1; null where only the file is known."""

    column: int | None
    """Column in the line, in characters, from 1."""

    macro_name: str | None
    """The macro that holds it; null outside of macros."""

    used_at: MacroPlace | None
    """The element or the attribute that has the value, and the macro that holds that; null where that is the place
    itself."""

    calls: list[MacroPlace]
    """The calls of macros that it was made by, innermost first, with the macros that they call; of more than 16,
    the innermost 15 and the outermost."""


@dataclass(frozen=True)
class MacroPlace:
    """A place in a .xacro file."""

    file: str
    """The file, as seen from the URDF's folder, with forward slashes."""

    line: int
    """Line in the file, from 1."""

    column: int
    """Column in the line, in characters, from 1."""

    macro_name: str | None
    """The macro; null outside of macros."""


@dataclass(frozen=True)
class Fix:
    """A change of files that mends a place of a finding."""

    message: str
    """What it does, as a command: "remove the second `<axis>`"."""

    is_safe: bool
    """Whether it is the one right answer, so that a program may make it without asking."""

    edits: list[TextEdit]
    """What to change. No two of them overlap."""


@dataclass(frozen=True)
class TextEdit:
    """A text in place of another."""

    file: str
    """The file, relative to the URDD's root or the URDF's folder, with forward slashes."""

    line: int
    """Line of the first character that goes, from 1."""

    column: int
    """Its column in the line, in characters, from 1."""

    end_line: int
    """Line of the first character that stays."""

    end_column: int
    """Its column."""

    text: str
    """What is put there; empty to remove only."""


@dataclass(frozen=True)
class Does:
    """What a program does because of a finding."""

    program: str
    """The program."""

    does: Deed
    """What it does."""

    is_supposed: bool
    """Whether the program refuses the file for something else before. It is so once that is mended."""


@dataclass(frozen=True)
class NotChecked:
    """What was not verified."""

    codes: list[str]
    """Codes of the rules that were to verify it."""

    reason: str
    """Why they could not."""


@dataclass(frozen=True)
class LinkNotVerified:
    """A link of which some mesh or shape was not verified."""

    link: int
    """Index of the link."""

    codes: list[str]
    """Codes of the rules that were to verify it."""

    reasons: list[str]
    """Why they could not."""


@dataclass(frozen=True)
class ModelNotVerified:
    """Why the rates of the self-collision model were not verified."""

    codes: list[str]
    """The rules that did not verify them."""

    reasons: list[str]
    """Why not."""


@dataclass(frozen=True)
class ProgramResult:
    """What a program does with a URDF."""

    program: str
    """The program, as `--for` and `Does` name it: `mujoco`, `urdfdom6`."""

    name: str
    """Its name for people."""

    family: str
    """Its name whatever its version."""

    version: str
    """The version that its reader was held to."""

    is_chosen: bool
    """Whether the settings name it."""

    does: Deed | None
    """The worst that it does; null where it reads all as it is written, but for what is usual."""

    effects: list[ProgramEffect]
    """All that it does otherwise than the file says, in order of place."""

    effects_cut: int
    """How many effects are not listed here, because there are too many."""


@dataclass(frozen=True)
class ProgramEffect:
    """Something that a program does otherwise than the file says."""

    does: Deed
    """What it does."""

    line: int | None
    """Line in the file, from 1; null where it is no text."""

    column: int | None
    """Column in the line, in characters, from 1."""

    part: str | None
    """What is lost or read otherwise, such as `joint/elbow/limit`; null for the whole file."""

    reason: str
    """Why."""

    makes: str | None
    """What the program makes of the part, where it reads it otherwise."""

    is_usual: bool
    """Whether the program does so with every robot, or because of another fault: nothing is wrong there."""

    is_supposed: bool
    """Whether the program refuses the file for something else before. It is so once that is mended."""


@dataclass(frozen=True)
class ImportedFrom:
    """What an import made of a description that is no URDF."""

    format: str
    """The format: `mjcf`, `sdf`."""

    otherwise: list[ImportedPart]
    """What the URDF has in another way."""

    lost: list[ImportedPart]
    """What is lost."""

    notes: list[str]
    """What else was assumed or left out, each with its place."""


@dataclass(frozen=True)
class ImportedPart:
    """Something that a description has."""

    what: str
    """What it is."""

    count: int
    """How many there are."""

    how: str | None
    """How it is carried otherwise; null where it is lost."""


@dataclass(frozen=True)
class StaleIgnore:
    """An ignore of the settings that matched nothing."""

    code: str | None
    """Code of the rule; null where it is for all."""

    path: str
    """The pattern."""


@dataclass(frozen=True)
class Totals:
    """Sums over all URDDs."""

    urdds: int
    """Number of URDDs."""

    passed: int
    """Number of those that pass."""

    failed: int
    """Number of those that fail, or of which a rule crashed."""

    not_examined: int
    """Number of those that were not examined."""

    error: int
    """Number of errors."""

    warning: int
    """Number of warnings."""

    info: int
    """Number of informations."""


@dataclass(frozen=True)
class Report:
    """What a run of `urdd validate` found."""

    tool: Tool
    """The program."""

    spec_version: str
    """Version of the specification that was checked against."""

    urdds: list[Urdd]
    """Every URDD, in the order of the paths given, then by name."""

    stale_ignores: list[StaleIgnore]
    """Ignores of the settings that matched nothing."""

    totals: Totals
    """Sums over all URDDs."""


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

    loops: list[PartDifference]
    """What closes kinematic loops, couplings between DOFs, and which DOFs move freely. Since 1.3.0."""

    poses: PoseDifference | None
    """Where the links are with all joints at zero; null if no link that both have is elsewhere, or where the joints
    of one robot form no tree."""

    dofs: list[DofDifference]
    """DOFs that are new, gone or at another index, or whose bounds do not follow from their joints."""

    pairs: list[PairDifference] | None
    """Pairs of links that collision checks gain or lose; null where one robot states no skips."""

    configurations: list[PartDifference] | None
    """Named configurations that are new or gone, or have other positions (fields named as their DOFs); null where
    neither is a URDD, or one is a URDF that was not imported. Since 1.1.0."""

    srdf: list[PartDifference] | None
    """What the SRDFs beside two URDFs, or those of imports, say differently: pairs that are not checked, named
    configurations, groups; null where one of the two is a URDD, or an SRDF cannot be read. Since 1.2.0."""

    setup: list[PartDifference] | None
    """What the files `NAME.export.toml` beside the robots, or those of imports, say differently: gains, the base,
    frictions; null where that of a URDD is missing, or one cannot be read. Since 1.2.0."""

    lost: list[PartDifference] | None
    """What the imports of two descriptions lose in another number; null unless both are imported. Since 1.2.0."""

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


def _urdd(v: Any) -> Urdd:
    return Urdd(
        kind=v["kind"],
        path=v["path"],
        name=v["name"],
        xacro_arguments=v["xacro_arguments"],
        verdict=v["verdict"],
        reason=v["reason"],
        not_examined=None if v.get("not_examined") is None else _not_examined(v.get("not_examined")),
        size=_size(v["size"]),
        modules=[_module(x) for x in v["modules"]],
        checks=[_check_status(x) for x in v["checks"]],
        findings=[_finding(x) for x in v["findings"]],
        not_checked=[_not_checked(x) for x in v["not_checked"]],
        geometry_not_verified=[_link_not_verified(x) for x in v["geometry_not_verified"]],
        model_not_verified=None if v["model_not_verified"] is None else _model_not_verified(v["model_not_verified"]),
        programs=[_program_result(x) for x in v.get("programs", [])],
        imported=None if v["imported"] is None else _imported_from(v["imported"]),
    )


def _not_examined(v: Any) -> NotExamined:
    return NotExamined(
        cause=v["cause"],
        reason=v["reason"],
        is_asked_for=v["is_asked_for"],
        file=v["file"],
        line=None if v["line"] is None else int(v["line"]),
        column=None if v["column"] is None else int(v["column"]),
    )


def _size(v: Any) -> Size:
    return Size(
        links=None if v["links"] is None else int(v["links"]),
        joints=None if v["joints"] is None else int(v["joints"]),
        dofs=None if v["dofs"] is None else int(v["dofs"]),
    )


def _module(v: Any) -> Module:
    return Module(
        name=v["name"],
        path=v["path"],
        version=v["version"],
        profile=v["profile"],
    )


def _check_status(v: Any) -> CheckStatus:
    return CheckStatus(
        code=v["code"],
        status=v["status"],
        reason=v["reason"],
        skipped=v["skipped"],
    )


def _finding(v: Any) -> Finding:
    return Finding(
        code=v["code"],
        name=v["name"],
        severity=v["severity"],
        default_severity=v["default_severity"],
        clause=v["clause"],
        consequence=v["consequence"],
        module=v["module"],
        file=v["file"],
        pointer=v["pointer"],
        line=None if v["line"] is None else int(v["line"]),
        column=None if v["column"] is None else int(v["column"]),
        subject=v["subject"],
        message=v["message"],
        expected=v["expected"],
        actual=v["actual"],
        tolerance=v["tolerance"],
        magnitude=None if v["magnitude"] is None else _magnitude(v["magnitude"]),
        count=int(v["count"]),
        places=[_place(x) for x in v["places"]],
        places_cut=int(v["places_cut"]),
        programs=[_does(x) for x in v.get("programs", [])],
    )


def _magnitude(v: Any) -> Magnitude:
    return Magnitude(
        value=v["value"],
        unit=v["unit"],
    )


def _place(v: Any) -> Place:
    return Place(
        file=v["file"],
        pointer=v["pointer"],
        line=None if v["line"] is None else int(v["line"]),
        column=None if v["column"] is None else int(v["column"]),
        written_at=None if v["written_at"] is None else _written_at(v["written_at"]),
        expected=v["expected"],
        actual=v["actual"],
        subject=v["subject"],
        message=v["message"],
        magnitude=None if v["magnitude"] is None else _magnitude(v["magnitude"]),
        related=[_place(x) for x in v["related"]],
        fixes=[_fix(x) for x in v["fixes"]],
        programs=[_does(x) for x in v.get("programs", [])],
    )


def _written_at(v: Any) -> WrittenAt:
    return WrittenAt(
        file=v["file"],
        line=None if v["line"] is None else int(v["line"]),
        column=None if v["column"] is None else int(v["column"]),
        macro_name=v["macro_name"],
        used_at=None if v.get("used_at") is None else _macro_place(v.get("used_at")),
        calls=[_macro_place(x) for x in v.get("calls", [])],
    )


def _macro_place(v: Any) -> MacroPlace:
    return MacroPlace(
        file=v["file"],
        line=int(v["line"]),
        column=int(v["column"]),
        macro_name=v["macro_name"],
    )


def _fix(v: Any) -> Fix:
    return Fix(
        message=v["message"],
        is_safe=v["is_safe"],
        edits=[_text_edit(x) for x in v["edits"]],
    )


def _text_edit(v: Any) -> TextEdit:
    return TextEdit(
        file=v["file"],
        line=int(v["line"]),
        column=int(v["column"]),
        end_line=int(v["end_line"]),
        end_column=int(v["end_column"]),
        text=v["text"],
    )


def _does(v: Any) -> Does:
    return Does(
        program=v["program"],
        does=v["does"],
        is_supposed=v.get("is_supposed"),
    )


def _not_checked(v: Any) -> NotChecked:
    return NotChecked(
        codes=v["codes"],
        reason=v["reason"],
    )


def _link_not_verified(v: Any) -> LinkNotVerified:
    return LinkNotVerified(
        link=int(v["link"]),
        codes=v["codes"],
        reasons=v["reasons"],
    )


def _model_not_verified(v: Any) -> ModelNotVerified:
    return ModelNotVerified(
        codes=v["codes"],
        reasons=v["reasons"],
    )


def _program_result(v: Any) -> ProgramResult:
    return ProgramResult(
        program=v["program"],
        name=v["name"],
        family=v["family"],
        version=v["version"],
        is_chosen=v["is_chosen"],
        does=v["does"],
        effects=[_program_effect(x) for x in v["effects"]],
        effects_cut=int(v["effects_cut"]),
    )


def _program_effect(v: Any) -> ProgramEffect:
    return ProgramEffect(
        does=v["does"],
        line=None if v["line"] is None else int(v["line"]),
        column=None if v["column"] is None else int(v["column"]),
        part=v["part"],
        reason=v["reason"],
        makes=v["makes"],
        is_usual=v["is_usual"],
        is_supposed=v.get("is_supposed"),
    )


def _imported_from(v: Any) -> ImportedFrom:
    return ImportedFrom(
        format=v["format"],
        otherwise=[_imported_part(x) for x in v["otherwise"]],
        lost=[_imported_part(x) for x in v["lost"]],
        notes=v["notes"],
    )


def _imported_part(v: Any) -> ImportedPart:
    return ImportedPart(
        what=v["what"],
        count=int(v["count"]),
        how=v["how"],
    )


def _stale_ignore(v: Any) -> StaleIgnore:
    return StaleIgnore(
        code=v["code"],
        path=v["path"],
    )


def _totals(v: Any) -> Totals:
    return Totals(
        urdds=int(v["urdds"]),
        passed=int(v.get("passed")),
        failed=int(v.get("failed")),
        not_examined=int(v.get("not_examined")),
        error=int(v["error"]),
        warning=int(v["warning"]),
        info=int(v["info"]),
    )


def _report(v: Any) -> Report:
    return Report(
        tool=_tool(v["tool"]),
        spec_version=v["spec_version"],
        urdds=[_urdd(x) for x in v["urdds"]],
        stale_ignores=[_stale_ignore(x) for x in v["stale_ignores"]],
        totals=_totals(v["totals"]),
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
        loops=[_part_difference(x) for x in v["loops"]],
        poses=None if v["poses"] is None else _pose_difference(v["poses"]),
        dofs=[_dof_difference(x) for x in v["dofs"]],
        pairs=None if v["pairs"] is None else [_pair_difference(x) for x in v["pairs"]],
        configurations=None if v["configurations"] is None else [_part_difference(x) for x in v["configurations"]],
        srdf=None if v["srdf"] is None else [_part_difference(x) for x in v["srdf"]],
        setup=None if v["setup"] is None else [_part_difference(x) for x in v["setup"]],
        lost=None if v["lost"] is None else [_part_difference(x) for x in v["lost"]],
        modules=None if v["modules"] is None else [_module_difference(x) for x in v["modules"]],
        findings=None if v["findings"] is None else [_finding_difference(x) for x in v["findings"]],
        notes=v["notes"],
    )


def read_report(text: str) -> Report:
    """A report as `urdd validate --format json` writes it."""
    return _report(json.loads(text))


def read_diff_report(text: str) -> DiffReport:
    """A report as `urdd diff --format json` writes it."""
    return _diff_report(json.loads(text))
