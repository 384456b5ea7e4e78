"""Arrays from users."""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from sys import maxsize
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ConfigurationError

Floats: TypeAlias = NDArray[np.float64]
Bools: TypeAlias = NDArray[np.bool_]
Indices: TypeAlias = NDArray[np.uintp]

_Array = TypeVar("_Array", NDArray[np.float64], NDArray[np.bool_], NDArray[np.uintp])


def numbers(values: ArrayLike, what: str) -> Floats:
    """An array of binary64 in row-major order. Rejects complex numbers, texts and ragged lists."""
    try:
        given: NDArray[Any] = np.asarray(values)
    except ValueError as error:
        raise ConfigurationError(f"{what} must be an array of numbers: {error}") from None
    if given.dtype.kind not in "fiu" and given.size > 0:
        raise ConfigurationError(f"{what} must be an array of numbers, not of {given.dtype}")
    return np.ascontiguousarray(given, dtype=np.float64) if given.ndim else given.astype(np.float64)


def configurations(q: ArrayLike, dof_names: tuple[str, ...]) -> tuple[Floats, tuple[int, ...]]:
    """Configurations as (n, dofs), and their shape without the last axis."""
    dofs = len(dof_names)
    given = numbers(q, "a configuration")
    if given.ndim == 0 or given.shape[-1] != dofs:
        raise ConfigurationError(
            f"a configuration has one value for each of the {dofs} DOFs: the shape must be ({dofs},) or (n, {dofs}), "
            f"not {given.shape}"
        )
    batch = given.shape[:-1]
    rows = flat(given)
    if not np.isfinite(rows).all():
        row, dof = (int(index) for index in np.argwhere(~np.isfinite(rows))[0])
        where = f"configuration {row}: " if batch else ""
        raise ConfigurationError(f"{where}DOF `{dof_names[dof]}` is {rows[row, dof]}: every value must be finite")
    return rows, batch


def batched(q: ArrayLike, dof_names: tuple[str, ...], ask: Callable[[Floats], _Array]) -> _Array:
    """The results of a query on configurations (n, dofs), with the axes that the configurations came in. A result
    without axes is a NumPy scalar, which prints and compares as a number."""
    rows, batch = configurations(q, dof_names)
    found = ask(rows)
    return scalar(found.reshape(batch + found.shape[1:]))


def edges(start: ArrayLike, end: ArrayLike, dof_names: tuple[str, ...]) -> tuple[Floats, Floats, tuple[int, ...]]:
    """Starts and ends of motions as (n, dofs) each, and the axes that they came in together."""
    both = (configurations(one, dof_names) for one in (start, end))
    dofs = len(dof_names)
    try:
        shaped = np.broadcast_arrays(*(rows.reshape(*batch, dofs) for rows, batch in both))
    except ValueError as error:
        raise ConfigurationError(f"starts and ends do not fit: {error}") from None
    starts, ends = (np.ascontiguousarray(flat(one)) for one in shaped)
    return starts, ends, shaped[0].shape[:-1]


def positions(values: ArrayLike, length: int, whose: str) -> tuple[Floats, tuple[int, ...]]:
    """Configurations of another program as (n, length), and their shape without the last axis."""
    given = numbers(values, f"a configuration of {whose}")
    if given.ndim == 0 or given.shape[-1] != length:
        raise ConfigurationError(f"{whose} configurations have {length} values, and these {given.shape}")
    return flat(given), given.shape[:-1]


def flat(given: Floats) -> Floats:
    """(n, last): all axes but the last as one, even if the last axis is empty."""
    return given.reshape(prod(given.shape[:-1]), given.shape[-1])


def one_configuration(q: ArrayLike, dof_names: tuple[str, ...]) -> Floats:
    """A single configuration as (1, dofs)."""
    rows, batch = configurations(q, dof_names)
    if batch:
        raise ConfigurationError(f"expected one configuration, of the shape ({len(dof_names)},)")
    return rows


def scalar(values: _Array) -> _Array:
    """The same values; an array without axes as a NumPy scalar."""
    found: _Array = values[()]
    return found


def optional_array(values: list[float] | None) -> Floats | None:
    """An array, or None."""
    return None if values is None else np.array(values, dtype=np.float64)


def number_of_pairs(k: int) -> int:
    """How many pairs are wanted."""
    if k < 0:
        raise ValueError(f"the number of pairs must not be negative, but is {k}")
    # The compiled part cannot read larger numbers.
    return min(k, maxsize)


def three(values: ArrayLike, what: str) -> tuple[float, float, float]:
    """Three finite numbers."""
    given = numbers(values, what)
    if given.shape != (3,) or not np.isfinite(given).all():
        raise ConfigurationError(f"{what} must be 3 finite numbers, not an array of the shape {given.shape}")
    x, y, z = given.tolist()
    return (x, y, z)


def six(values: ArrayLike, what: str) -> list[float]:
    """Six finite numbers, none of them negative."""
    given = numbers(values, what)
    if given.shape != (6,) or not (np.isfinite(given).all() and (given >= 0).all()):
        raise ConfigurationError(f"{what} must be 6 finite numbers of at least 0")
    found: list[float] = given.tolist()
    return found


def poses(values: ArrayLike, what: str) -> Floats:
    """Poses (..., 4, 4) or positions (..., 3)."""
    given = numbers(values, what)
    is_pose = given.shape[-2:] == (4, 4)
    if not is_pose and given.shape[-1:] != (3,):
        raise ConfigurationError(f"{what} must have the shape (..., 4, 4) or (..., 3), not {given.shape}")
    if not np.isfinite(given).all():
        raise ConfigurationError(f"{what} is not finite")
    if is_pose:
        rotation = given[..., :3, :3]
        unit = np.abs(rotation @ np.swapaxes(rotation, -1, -2) - np.eye(3)).max(initial=0.0) < 1e-6
        last = np.abs(given[..., 3, :] - np.array([0.0, 0.0, 0.0, 1.0])).max(initial=0.0) < 1e-9
        if not (unit and last and bool((np.linalg.det(rotation) > 0).all())):
            raise ConfigurationError(f"{what} is not a pose: a rotation, a translation, and the last row 0, 0, 0, 1")
    return given
