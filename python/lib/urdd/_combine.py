"""Combination of robots."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from numpy.typing import ArrayLike

from . import _urdd
from ._arrays import three
from ._generate import Generated, generated
from ._options import MakingOptions, options_of
from ._robot import Robot
from .errors import CombineError

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["CombineNote", "Combined", "combine"]

_Source: TypeAlias = str | os.PathLike[str]


@dataclass(frozen=True)
class CombineNote:
    """A note about combined robots."""

    kind: str
    """The kind of note, such as ``left-alone`` or ``unequal-modules``."""
    message: str
    """The note, with the part."""

    def __str__(self) -> str:
        return self.message


@dataclass(frozen=True)
class Combined(Generated):
    """A URDD of combined robots. ``load().modules.composition`` states which part each link and joint comes from."""

    combine_notes: list[CombineNote]
    """Notes about the parts; ``notes`` is about the combined URDF."""


def combine(
    source: _Source | Sequence[_Source | Robot],
    output: str | os.PathLike[str],
    *,
    at: str | None = None,
    xyz: ArrayLike = (0.0, 0.0, 0.0),
    rpy: ArrayLike = (0.0, 0.0, 0.0),
    name: str | None = None,
    progress: Callable[[str, int, int], object] | None = None,
    **options: Unpack[MakingOptions],
) -> Combined:
    """Combines robots: generates one URDD from several, in the folder ``output``, which is replaced atomically and
    unchanged on error.

    Either by a recipe, a TOML file that lists the parts and the link that each is attached to (see
    ``docs/combine.md``)::

        urdd.combine("cell.toml", "cell")

    or from two robots, of which the second is fixed to a link of the first::

        urdd.combine(["arm", "gripper.urdf"], "arm_gripper", at="tool0", xyz=[0, 0, 0.1])

    A part is a URDD (a folder or a zip archive), a URDF or a xacro file, or, of two robots, a :class:`Robot`. Parts
    that are URDDs are validated first, and one with errors is rejected, unless ``force``. Data about links are copied
    from the parts' URDDs, and not computed again.

    Args:
        source: the recipe; or two robots.
        output: the folder of the URDD.
        at: for two robots, the link of the first that the second is attached to.
        xyz: (3,): for two robots, the position of the second's root in that link's frame, metres.
        rpy: (3,): for two robots, the second's fixed-axis roll, pitch and yaw in that frame, radians.
        name: for two robots, the name of the combined robot; by default made from both names.
        progress: as in :func:`generate`.
        options: as in :func:`generate`: ``modules``, ``packages``, ``pieces``, ``force``, and so on. ``force`` also
            accepts parts that fail validation, and uses only the URDF and the meshes of their URDDs.

    Raises:
        CombineError: if the recipe cannot be followed, a part is not a robot or does not pass validation, or the URDD
            cannot be written.
        KeyboardInterrupt: after Ctrl-C; nothing has changed.
    """
    position, turn = three(xyz, "xyz"), three(rpy, "rpy")
    checked = options_of(options, "combine")
    target = Path(output)
    if isinstance(source, (str, os.PathLike)):
        recipe = Path(source)
        if recipe.suffix != ".toml" or recipe.is_dir():
            raise CombineError(
                f"{recipe}: a recipe is a .toml file; to combine two robots: "
                f"urdd.combine([{str(recipe)!r}, other], {str(target)!r}, at=link)",
                "unreadable",
            )
        if at is not None or name is not None or any(position) or any(turn):
            raise ValueError("at, xyz, rpy and name are for two robots; a recipe has its own")
        found, notes = _urdd.combine(recipe, None, target, checked, progress)
    else:
        if len(source) != 2:
            raise ValueError(f"source must be a recipe or two robots, not {len(source)}; for more, write a recipe")
        if at is None:
            raise ValueError("two robots need `at`: the link of the first that the second is attached to")
        holder, held = (part.path if isinstance(part, Robot) else Path(part) for part in source)
        found, notes = _urdd.combine(holder, (held, (at, (position, turn), name)), target, checked, progress)
    whole = generated(target, found)
    return Combined(**vars(whole), combine_notes=[CombineNote(*note) for note in notes])
