"""The learned self-collision model."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from . import _urdd
from ._answers import LearnedPair, Rate
from ._arrays import Bools, Floats, Indices, configurations, scalar
from .errors import ModuleMissingError, UnknownNameError

if TYPE_CHECKING:
    # It takes time to import.
    from .modules import ModelEvaluation

MODULE = "self_collision_model_module"


class CollisionModel:
    """A network that estimates how near pairs of links are to each other: ``robot.collision_model()``.

    It is for passing over configurations that are far from any contact; the others are checked exactly. **It is an
    estimate, not a guarantee**: :attr:`miss_rate` says how many collisions it misses among configurations that it was
    not trained on.

    A *clearance* is in metres; 0 or less means that the pair may be in contact. Distances from :attr:`clip_distance` on
    were all the same in training, so a large clearance says that the links are apart, and not how far.

    >>> import urdd
    >>> robot = urdd.load("welding_arm_with_a_model")
    >>> model = robot.collision_model()
    >>> q = robot.sample(10_000)
    >>> collides = model.may_collide(q)
    >>> collides[collides] = robot.in_collision(q[collides])
    """

    def __init__(
        self, core: _urdd.CollisionModel, path: str, link_names: tuple[str, ...], dof_names: tuple[str, ...]
    ) -> None:
        self._core = core
        self._path = path
        self._link_names = link_names
        self._dof_names = dof_names

    # What it is.

    @property
    def num_pairs(self) -> int:
        """Number of pairs of links that it has an output for."""
        return self._core.num_pairs

    @cached_property
    def pair_indices(self) -> Indices:
        """(pairs, 2): the links of each of :attr:`pairs`."""
        return self._core.pairs()

    @cached_property
    def pairs(self) -> list[LearnedPair]:
        """The pairs of links that it has an output for, in the order of :meth:`clearances`."""
        margins = self._core.margins().tolist()
        return [
            LearnedPair(links, margin) for links, margin in zip(self._names(self.pair_indices), margins, strict=True)
        ]

    @cached_property
    def other_pairs(self) -> list[tuple[str, str]]:
        """The pairs of links that are not skipped and have no output: they were never near in training, and it takes
        them to be apart always."""
        return self._names(self._core.other_pairs())

    @property
    def clip_distance(self) -> float:
        """Distances from here on were all the same to it, metres."""
        return self._core.clip_distance

    @property
    def num_parameters(self) -> int:
        """Number of weights and biases."""
        return self._core.num_parameters

    @property
    def evaluation(self) -> ModelEvaluation:
        """How often it is right on 50,000 configurations that no model is made on (SPEC 8.8.9), as its module says. Of
        the ``num_colliding`` in collision it clears ``num_missed``; of those that are also within a step of 0.05 rad or
        m of being free, ``num_near_contact``, it clears ``num_near_contact_missed``; of the ``num_free`` others it
        clears ``num_cleared``. ``urdd validate`` counts again."""
        from .modules import ModelEvaluation

        return ModelEvaluation(*self._core.evaluation)

    @property
    def miss_rate(self) -> Rate:
        """The share of collisions that it misses, with its 95 % interval."""
        return Rate(*self._core.rates[0])

    @property
    def near_contact_miss_rate(self) -> Rate:
        """The share of collisions within a step of 0.05 rad or m of being free that it misses."""
        return Rate(*self._core.rates[1])

    @property
    def clear_rate(self) -> Rate:
        """The share of free configurations that it clears."""
        return Rate(*self._core.rates[2])

    # What it says.

    def clearances(self, q: ArrayLike) -> Floats:
        """(..., pairs): the clearance of each of :attr:`pairs`, metres. An estimate."""
        rows, batch = configurations(q, self._dof_names)
        return self._core.clearances(rows).reshape(*batch, self.num_pairs)

    def least(self, q: ArrayLike) -> Floats:
        """(...): the least of all clearances, metres. An estimate."""
        rows, batch = configurations(q, self._dof_names)
        return scalar(self._core.least(rows).reshape(batch))

    def may_collide(self, q: ArrayLike) -> Bools:
        """(...): whether a clearance is 0 or less, or not known. Where not, the configuration is *cleared*: most likely
        free of collisions, and not surely (:attr:`miss_rate`). Where so, :meth:`Robot.in_collision` says what is right.
        """
        rows, batch = configurations(q, self._dof_names)
        return scalar(self._core.may_collide(rows).reshape(batch))

    def gradient(self, q: ArrayLike, pair: int | tuple[str, str] | None = None) -> Floats:
        """(..., dofs): the derivative of the least clearance by each DOF, m/rad or m/m; with ``pair`` that of the
        clearance of this pair, by its place in :attr:`pairs` or its links' names.

        The derivative of the least clearance is that of the pair that has it: where two pairs have it, there is no one
        derivative.

        Raises:
            IndexError: for a place that is not there.
            UnknownNameError: for names of links that are no pair of the model.
        """
        rows, batch = configurations(q, self._dof_names)
        place = None if pair is None else self._place(pair)
        return self._core.gradient(rows, place).reshape(*batch, len(self._dof_names))

    # Habits.

    def _names(self, pairs: Indices) -> list[tuple[str, str]]:
        return [(self._link_names[a], self._link_names[b]) for a, b in pairs.tolist()]

    def _place(self, pair: int | tuple[str, str]) -> int:
        """The place of a pair, which may count from the end."""
        if isinstance(pair, tuple):
            wanted = set(pair)
            for place, own in enumerate(self.pairs):
                if set(own.links) == wanted:
                    return place
            words = " and ".join(f"`{name}`" for name in pair)
            raise UnknownNameError(
                f"the model has no output for a pair of links {words}: `pairs` has those that it has one for",
                "pair",
                words,
            )
        place = int(pair)
        if not -self.num_pairs <= place < self.num_pairs:
            raise IndexError(f"there is no pair {place}: their number is {self.num_pairs}")
        return place % self.num_pairs

    def __reduce__(self) -> tuple[object, tuple[str]]:
        return at, (self._path,)

    def __repr__(self) -> str:
        return (
            f"<urdd.CollisionModel: an estimate for {self.num_pairs} pairs of links, "
            f"{self.num_parameters:,} parameters; misses {self.miss_rate} collisions>"
        )


def at(path: str) -> CollisionModel:
    """The model of the robot in a folder or a zip archive."""
    from ._robot import load

    return load(path).collision_model()


def missing(error: ModuleMissingError) -> ModuleMissingError:
    """The same error; of the model's module with what to do, since it is made for those alone who ask for it."""
    if error.module != MODULE:
        return error
    return ModuleMissingError(
        f'{MODULE} is missing: it is made where it is asked for: urdd.generate(urdf, folder, modules=["all", '
        f'"self_collision_model"]). That trains a network, and notes where one would be of no use',
        error.module,
    )
