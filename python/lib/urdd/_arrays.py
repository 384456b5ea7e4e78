"""Arrays as they come from people."""

from __future__ import annotations

from math import prod
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ConfigurationError

Floats: TypeAlias = NDArray[np.float64]
Bools: TypeAlias = NDArray[np.bool_]
Indices: TypeAlias = NDArray[np.uintp]

_Array = TypeVar("_Array", NDArray[np.float64], NDArray[np.bool_])


def numbers(values: ArrayLike, what: str) -> Floats:
    """An array of binary64, row after row. Complex numbers, texts and ragged lists are refused."""
    try:
        given: NDArray[Any] = np.asarray(values)
    except ValueError as error:
        raise ConfigurationError(f"{what} must be an array of numbers: {error}") from None
    if given.dtype.kind not in "fiu" and given.size > 0:
        raise ConfigurationError(f"{what} must be an array of numbers, and is one of {given.dtype}")
    return np.ascontiguousarray(given, dtype=np.float64) if given.ndim else given.astype(np.float64)


def configurations(q: ArrayLike, dof_names: tuple[str, ...]) -> tuple[Floats, tuple[int, ...]]:
    """Configurations as (n, dofs), and the shape before the last axis that they came in."""
    dofs = len(dof_names)
    given = numbers(q, "a configuration")
    if given.ndim == 0 or given.shape[-1] != dofs:
        raise ConfigurationError(
            f"a configuration has one value for each of the {dofs} DOFs: the shape must be ({dofs},) or (n, {dofs}), "
            f"and is {given.shape}"
        )
    batch = given.shape[:-1]
    rows = flat(given)
    if not np.isfinite(rows).all():
        row, dof = (int(index) for index in np.argwhere(~np.isfinite(rows))[0])
        where = f"configuration {row}: " if batch else ""
        raise ConfigurationError(f"{where}DOF `{dof_names[dof]}` is {rows[row, dof]}: every value must be finite")
    return rows, batch


def positions(values: ArrayLike, length: int, whose: str) -> tuple[Floats, tuple[int, ...]]:
    """Configurations of another program as (n, length), and the shape before the last axis that they came in."""
    given = numbers(values, f"a configuration of {whose}")
    if given.ndim == 0 or given.shape[-1] != length:
        raise ConfigurationError(f"{whose} configurations have {length} values, and these {given.shape}")
    return flat(given), given.shape[:-1]


def flat(given: Floats) -> Floats:
    """(n, last): all axes but the last as one, also where the last has no values."""
    return given.reshape(prod(given.shape[:-1]), given.shape[-1])


def one_configuration(q: ArrayLike, dof_names: tuple[str, ...]) -> Floats:
    """A single configuration as (1, dofs)."""
    rows, batch = configurations(q, dof_names)
    if batch:
        raise ConfigurationError(f"this asks for one configuration: the shape must be ({len(dof_names)},)")
    return rows


def scalar(values: _Array) -> _Array:
    """Values as they are; one without axes as numpy's scalar, which prints and compares as a number."""
    found: _Array = values[()]
    return found


def points(values: ArrayLike, what: str, length: int) -> Floats:
    """Finite numbers, `length` of them."""
    given = numbers(values, what)
    if given.shape != (length,) or not np.isfinite(given).all():
        raise ConfigurationError(f"{what} must be {length} finite numbers, and is of shape {given.shape}")
    return given
