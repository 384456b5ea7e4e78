"""Putting robots together."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from numpy.typing import ArrayLike

from . import _urdd
from ._generate import Generated, generated
from ._inverse import three
from ._options import MakingOptions, options_of
from ._robot import Robot
from .errors import CombineError

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["CombineNote", "Combined", "combine"]

_Source: TypeAlias = str | os.PathLike[str]


@dataclass(frozen=True)
class CombineNote:
    """Something to know of robots that were put together."""

    kind: str
    """What kind of note it is, such as ``left-alone`` or ``unequal-modules``."""
    message: str
    """What it is, with the part."""

    def __str__(self) -> str:
        return self.message


@dataclass(frozen=True)
class Combined(Generated):
    """A URDD of robots that were put together. ``load().modules.composition`` says which link and joint came from which
    part."""

    combine_notes: list[CombineNote]
    """What there is to say of the parts; ``notes`` is of the URDF that they became."""


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
    """Puts robots together: makes one URDD of several, in the folder ``output``. It is there as a whole afterwards, or
    as it was.

    Either by a recipe, a TOML file that names the parts and what each hangs on (``docs/combine.md`` has its keys)::

        urdd.combine("cell.toml", "cell")

    or of two robots, of which the second is fixed to a link of the first::

        urdd.combine(["arm", "gripper.urdf"], "arm_gripper", at="tool0", xyz=[0, 0, 0.1])

    A part is a URDD (a folder or a zip archive), or a URDF or xacro file; of two robots also a :class:`Robot`. Parts
    that are URDDs are validated first, and one with errors is refused, unless ``force``. What the parts' URDDs hold of
    their links is taken over, and not computed again.

    Args:
        source: the recipe; or two robots.
        output: the folder of the URDD.
        at: of two robots, the link of the first that the second hangs on.
        xyz: (3,): of two robots, the position of the second's root in that link's frame, metres.
        rpy: (3,): of two robots, its fixed-axis roll, pitch and yaw there, radians.
        name: of two robots, the name of what is made; without it, the names of both.
        progress: as that of :func:`generate`.
        options: as of :func:`generate`: ``modules``, ``packages``, ``pieces``, ``force``, and so on. ``force`` also
            takes parts that fail validation, and then nothing from their URDDs but the URDF and its meshes.

    Raises:
        CombineError: where the recipe cannot be followed, a part is no robot or does not pass validation, or the URDD
            cannot be written.
        KeyboardInterrupt: after Ctrl-C; nothing was changed then.
    """
    position, turn = three(xyz, "xyz"), three(rpy, "rpy")
    made = options_of(options, "combine")
    target = Path(output)
    if isinstance(source, (str, os.PathLike)):
        recipe = Path(source)
        if recipe.suffix != ".toml" or recipe.is_dir():
            raise CombineError(
                f"{recipe}: a recipe is a .toml file; to put two robots together: "
                f"urdd.combine([{str(recipe)!r}, other], {str(target)!r}, at=link)",
                "unreadable",
            )
        if at is not None or name is not None or any(position) or any(turn):
            raise ValueError("at, xyz, rpy and name are for two robots; a recipe says these itself")
        found, notes = _urdd.combine(recipe, None, target, made, progress)
    else:
        if len(source) != 2:
            raise ValueError(f"source must be a recipe, or two robots, and is {len(source)}; of more, write a recipe")
        if at is None:
            raise ValueError("of two robots, at names the link of the first that the second hangs on")
        holder, held = (part.path if isinstance(part, Robot) else Path(part) for part in source)
        found, notes = _urdd.combine(holder, (held, (at, (position, turn), name)), target, made, progress)
    whole = generated(target, found)
    return Combined(**vars(whole), combine_notes=[CombineNote(*note) for note in notes])
