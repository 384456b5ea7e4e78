"""The learned self-collision model."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from ._answers import LearnedPair, Rate
from ._arrays import Bools, Floats, Indices, batched
from ._description import RobotDescription
from .errors import ModuleMissingError, UnknownNameError

if TYPE_CHECKING:
    # Slow to import.
    from .modules import ModelEvaluation

MODULE = "self_collision_model_module"


class CollisionModel:
    """A network that estimates the clearance between links: ``robot.collision_model()``.

    It filters out configurations that are far from contact, before an exact check of the rest. **It is an estimate, not
    a guarantee**: :attr:`miss_rate` is its measured rate of missed collisions, among configurations that it was not
    trained on.

    A *clearance* is in metres; 0 or less means that the pair may be in contact. Training clipped distances at
    :attr:`clip_distance`, so a large clearance means that the links are apart, but not how far.

    >>> import urdd
    >>> robot = urdd.load("welding_arm_with_a_model")
    >>> model = robot.collision_model()
    >>> q = robot.random(10_000)
    >>> collides = model.may_collide(q)
    >>> collides[collides] = robot.in_collision(q[collides])
    """

    def __init__(self, robot: RobotDescription) -> None:
        self._robot = robot
        try:
            self._core = robot.core.collision_model()
        except ModuleMissingError as error:
            if error.module != MODULE:
                raise
            raise ModuleMissingError(
                f"{MODULE} is missing: it is generated only on request: urdd.generate(urdf, folder, "
                f'modules=["all", "self_collision_model"]). That trains a network, and says if one would be useless',
                MODULE,
            ) from None
        self._link_names = robot.link_names
        self._dof_names = robot.dof_names

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
        """The pairs of links that are not skipped and have no output: they were never near in training. The model
        assumes that they are always apart."""
        return self._names(self._core.other_pairs())

    @property
    def clip_distance(self) -> float:
        """Training clipped distances at this value, metres."""
        return self._core.clip_distance

    @property
    def num_parameters(self) -> int:
        """Number of weights and biases."""
        return self._core.num_parameters

    @property
    def evaluation(self) -> ModelEvaluation:
        """Its accuracy on 50,000 configurations that no model is trained on (SPEC 8.8.9), as its module states. The
        model clears ``num_missed`` of the ``num_colliding`` configurations in collision, ``num_near_contact_missed`` of
        the ``num_near_contact`` ones that are also within a step of 0.05 rad or m of being free, and ``num_cleared`` of
        the ``num_free`` others. ``urdd validate`` verifies these counts."""
        from .modules import ModelEvaluation

        return ModelEvaluation(*self._core.evaluation)

    @property
    def miss_rate(self) -> Rate:
        """The fraction of collisions that it misses, with its 95 % interval."""
        return Rate(*self._core.rates[0])

    @property
    def near_contact_miss_rate(self) -> Rate:
        """The fraction of collisions that it misses among those within a step of 0.05 rad or m of being free."""
        return Rate(*self._core.rates[1])

    @property
    def clear_rate(self) -> Rate:
        """The fraction of free configurations that it clears."""
        return Rate(*self._core.rates[2])

    # Estimates.

    def clearances(self, q: ArrayLike) -> Floats:
        """(..., pairs): the clearance of each of :attr:`pairs`, metres. An estimate."""
        return batched(q, self._dof_names, self._core.clearances)

    def min_clearance(self, q: ArrayLike) -> Floats:
        """(...): the minimum of all clearances, metres. An estimate."""
        return batched(q, self._dof_names, self._core.min_clearance)

    def may_collide(self, q: ArrayLike) -> Bools:
        """(...): whether a clearance is 0 or less, or unknown. If false, the model *clears* the configuration: it is
        most likely free of collisions (:attr:`miss_rate`). If true, :meth:`Robot.in_collision` decides."""
        return batched(q, self._dof_names, self._core.may_collide)

    def gradient(self, q: ArrayLike, pair: int | tuple[str, str] | None = None) -> Floats:
        """(..., dofs): the gradient of the minimum clearance with respect to the DOFs, m/rad or m/m; with ``pair``,
        that of the clearance of this pair, given by its index in :attr:`pairs` or by its links' names.

        The gradient of the minimum clearance is that of the pair that has it. If several pairs have it, it is that of
        one of them.

        Raises:
            IndexError: for an index that is out of range.
            UnknownNameError: for names of links that are not a pair of the model.
        """
        place = None if pair is None else self._place(pair)
        return batched(q, self._dof_names, lambda rows: self._core.gradient(rows, place))

    # Python protocols.

    def _names(self, pairs: Indices) -> list[tuple[str, str]]:
        return [(self._link_names[a], self._link_names[b]) for a, b in pairs.tolist()]

    def _place(self, pair: int | tuple[str, str]) -> int:
        """The index of a pair, which may count from the end."""
        if isinstance(pair, tuple):
            wanted = set(pair)
            for place, own in enumerate(self.pairs):
                if set(own.links) == wanted:
                    return place
            words = " and ".join(f"`{name}`" for name in pair)
            raise UnknownNameError(
                f"the model has no output for a pair of links {words}: `pairs` lists the pairs that it knows",
                "pair",
                words,
            )
        place = int(pair)
        if not -self.num_pairs <= place < self.num_pairs:
            raise IndexError(f"pair index {place} is out of range: the model has {self.num_pairs} pairs")
        return place % self.num_pairs

    def __reduce__(self) -> tuple[type[CollisionModel], tuple[RobotDescription]]:
        return type(self), (self._robot,)

    def __repr__(self) -> str:
        return (
            f"<urdd.CollisionModel: an estimate for {self.num_pairs} pairs of links, "
            f"{self.num_parameters:,} parameters; misses {self.miss_rate} collisions>"
        )
