"""The learned self-collision model, compared with its consumer in numpy, with exact distances, and with its module."""

from __future__ import annotations

import doctest
import json
import pickle
import re
import runpy
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import urdd
import urdd._collision_model
from conftest import REPOSITORY
from urdd._arrays import Floats

MODULE = "self_collision_model_module"
CONSUMER = runpy.run_path(str(REPOSITORY / "examples" / "self_collision_model.py"))


def by_numpy(robot: urdd.Robot, q: Floats) -> Floats:
    """The clearances of SPEC 8.8.4 for one configuration."""
    found: Floats = CONSUMER["clearances"](robot.modules.json(MODULE), q)
    return found


def test_clearances_are_those_of_numpy(learned: urdd.Robot) -> None:
    model = learned.collision_model()
    q = np.concatenate([learned.random(50, seed=3), [learned.zero, learned.lower, learned.upper]])
    expected = np.array([by_numpy(learned, one) for one in q])
    assert expected.shape == (53, model.num_pairs)
    np.testing.assert_allclose(model.clearances(q), expected, rtol=1e-9, atol=1e-9 * model.clip_distance)
    for vector in learned.modules.self_collision_model.test_vectors:
        np.testing.assert_allclose(model.clearances(vector.configuration), vector.clearances, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("count", [7, 100])
def test_batches_give_what_each_configuration_gives(count: int, learned: urdd.Robot) -> None:
    model = learned.collision_model()
    q = learned.random(count, seed=5)
    clearances, least, may_collide, gradient = (
        ask(q) for ask in (model.clearances, model.min_clearance, model.may_collide, model.gradient)
    )
    np.testing.assert_array_equal(least, clearances.min(axis=1))
    np.testing.assert_array_equal(may_collide, least <= 0)
    assert may_collide.dtype == bool
    assert 0 < may_collide.sum() < count
    for k in range(count):
        np.testing.assert_array_equal(model.clearances(q[k]), clearances[k])
        np.testing.assert_array_equal(model.gradient(q[k]), gradient[k])
        assert model.min_clearance(q[k]) == least[k]
        assert model.may_collide(q[k]) == may_collide[k]


def test_shapes(learned: urdd.Robot) -> None:
    model, dofs = learned.collision_model(), learned.num_dofs
    for batch in ((), (0,), (3,), (2, 20), (2, 0)):
        q = np.zeros((*batch, dofs))
        assert model.clearances(q).shape == (*batch, model.num_pairs)
        assert model.min_clearance(q).shape == model.may_collide(q).shape == batch
        assert model.gradient(q).shape == model.gradient(q, 0).shape == (*batch, dofs)
    q = learned.random(20)
    single = q.astype(np.float32)
    np.testing.assert_array_equal(model.clearances(single), model.clearances(single.astype(np.float64)))
    for same in (q.tolist(), np.asfortranarray(q), q.astype(">f8")):
        np.testing.assert_array_equal(model.clearances(same), model.clearances(q))


def test_gradients_are_central_differences_of_numpy(learned: urdd.Robot) -> None:
    model, step = learned.collision_model(), 1e-6
    for q in learned.random(10, seed=8):
        differences = np.array(
            [
                (by_numpy(learned, q + step * row) - by_numpy(learned, q - step * row)) / (2 * step)
                for row in np.eye(learned.num_dofs)
            ]
        ).T
        for place, pair in enumerate(model.pairs):
            found = model.gradient(q, place)
            np.testing.assert_allclose(found, differences[place], atol=1e-7)
            a, b = pair.links
            np.testing.assert_array_equal(model.gradient(q, (b, a)), found)
            np.testing.assert_array_equal(model.gradient(q, place - model.num_pairs), found)
        np.testing.assert_array_equal(model.gradient(q), model.gradient(q, int(model.clearances(q).argmin())))


def test_it_says_what_its_module_says(learned: urdd.Robot) -> None:
    model, document = learned.collision_model(), learned.modules.json(MODULE)
    assert len(model.pairs) == model.num_pairs == len(document["pairs"]) > 0
    for pair, stated in zip(model.pairs, document["pairs"], strict=True):
        assert [learned.link(name) for name in pair.links] == [stated["link_a_idx"], stated["link_b_idx"]]
        assert pair.margin == stated["margin"]
    assert [[learned.link(name) for name in links] for links in model.other_pairs] == [
        [pair["link_a_idx"], pair["link_b_idx"]] for pair in document["other_pairs"]
    ]
    assert model.clip_distance == document["clip_distance"]
    layers = document["layers"]
    assert model.num_parameters == sum(np.size(layer["weights"]) + np.size(layer["biases"]) for layer in layers)
    assert vars(model.evaluation) == document["evaluation"]
    assert model.evaluation == learned.modules.self_collision_model.evaluation
    assert f"misses {model.miss_rate} collisions" in repr(model)


def test_rates_have_the_intervals_of_scipy(learned: urdd.Robot) -> None:
    """``conformance/vectors`` has scipy's values."""
    vectors = json.loads((REPOSITORY / "conformance/vectors/self_collision_model.json").read_text("utf-8"))
    known = {(of["count"], of["of"]): of for of in vectors["intervals"]}
    assert f"{urdd.Rate(**known[9, 903])}" == "1.00 % (0.53 to 1.88 %) of 903"
    model, counts = learned.collision_model(), learned.collision_model().evaluation
    for rate, count, of in (
        (model.miss_rate, counts.num_missed, counts.num_colliding),
        (model.near_contact_miss_rate, counts.num_near_contact_missed, counts.num_near_contact),
        (model.clear_rate, counts.num_cleared, counts.num_free),
    ):
        z, p = 1.959963984540054, count / of
        half = z * np.sqrt(p * (1 - p) / of + z**2 / (4 * of**2))
        ends = [(p + z**2 / (2 * of) + by) / (1 + z**2 / of) for by in (-half, half)]
        assert (rate.count, rate.of) == (count, of)
        np.testing.assert_allclose([rate.lower, rate.upper], np.clip(ends, 0, 1), atol=1e-12)


def u(k: int, i: int) -> float:
    """SPEC 9.3."""
    mask = 2**64 - 1
    z = (k * 2**32 + i + 1) * 0x9E3779B97F4A7C15 & mask
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 & mask
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB & mask
    return ((z ^ (z >> 31)) >> 11) * 2.0**-53


def test_the_counts_are_what_exact_checks_give(learned: urdd.Robot) -> None:
    model, counts = learned.collision_model(), learned.collision_model().evaluation
    share = np.array([[u(2**31 + k, i) for i in range(learned.num_dofs)] for k in range(50_001)])
    q = learned.lower * (1 - share) + learned.upper * share
    step = np.diff(q, axis=0)
    near = q[:-1] + np.minimum(1, 0.05 / np.abs(step).max(axis=1, keepdims=True)) * step
    q = q[:-1]
    exact, may_collide = learned.in_collision(q), model.may_collide(q)
    near_contact = exact & ~learned.in_collision(near)
    for found, stated, of in (
        (exact, counts.num_colliding, 50_000),
        (exact & ~may_collide, counts.num_missed, counts.num_colliding),
        (near_contact, counts.num_near_contact, counts.num_colliding),
        (near_contact & ~may_collide, counts.num_near_contact_missed, counts.num_near_contact),
        (~exact, counts.num_free, 50_000),
        (~exact & ~may_collide, counts.num_cleared, counts.num_free),
    ):
        off = -(-of // 10_000)  # SPEC 8.8.9: contact is judged to the last digit
        assert abs(int(found.sum()) - stated) <= off
    assert counts.num_missed < counts.num_colliding


def test_what_is_not_known_is_not_clear(learned: urdd.Robot) -> None:
    """The sine of a number beyond binary64 is NaN."""
    model = learned.collision_model()
    for q in (np.full(learned.num_dofs, 1.7e308), np.full((40, learned.num_dofs), 1.7e308)):
        assert np.all(model.may_collide(q))
        assert not np.any(model.min_clearance(q) > 0)


@pytest.mark.parametrize(
    ("q", "words"),
    [
        ([0.0] * 99, r"one value for each of the \d+ DOFs"),
        (0.0, r"not \(\)"),
        (float("nan"), r"NaN or a shape"),
        (["a"], r"array of numbers"),
        ([[0, 0], [0]], r"array of numbers"),
        (None, r"array of numbers"),
        (np.zeros(3, dtype=complex), r"not of complex128"),
    ],
)
def test_no_configurations(q: Any, words: str, learned: urdd.Robot) -> None:
    model = learned.collision_model()
    if words == "NaN or a shape":
        q, words = np.zeros((2, learned.num_dofs)), r"configuration 1: DOF `.+` is nan: every value must be finite"
        q[1, -1] = np.nan
    for ask in (model.clearances, model.min_clearance, model.may_collide, model.gradient):
        with pytest.raises(urdd.ConfigurationError, match=words):
            ask(q)


def test_no_pairs(learned: urdd.Robot) -> None:
    model = learned.collision_model()
    for place in (model.num_pairs, -model.num_pairs - 1):
        with pytest.raises(IndexError, match=f"pair index {place} is out of range"):
            model.gradient(learned.zero, place)
    with pytest.raises(urdd.UnknownNameError, match="no output for a pair of links `cheese` and `ham`"):
        model.gradient(learned.zero, ("cheese", "ham"))


def test_a_urdd_without_a_model_says_how_to_make_one(arm: urdd.Robot) -> None:
    with pytest.raises(urdd.ModuleMissingError, match=r'modules=\["all", "self_collision_model"\]') as caught:
        arm.collision_model()
    assert caught.value.module == MODULE


@pytest.mark.parametrize(
    ("pointer", "value"),
    [(("pairs", 0, "link_b_idx"), 999), (("layers", 0, "biases"), [0.5]), (("clip_distance",), "far")],
)
def test_a_model_of_no_use(pointer: tuple[Any, ...], value: Any, learned: urdd.Robot, tmp_path: Path) -> None:
    folder = shutil.copytree(learned.path, tmp_path / "robot")
    file = folder / "link_shapes_modules" / MODULE / "module.json"
    document: Any = json.loads(file.read_text(encoding="utf-8"))
    holder = document
    for key in pointer[:-1]:
        holder = holder[key]
    holder[pointer[-1]] = value
    file.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(urdd.ModuleUnusableError, match=r"urdd\.validate") as caught:
        urdd.load(folder).collision_model()
    assert caught.value.module == MODULE


def test_a_model_is_pickled_as_its_path(learned: urdd.Robot) -> None:
    model = learned.collision_model()
    text = pickle.dumps(model)
    assert len(text) < 1000
    copy = pickle.loads(text)
    q = learned.random(5)
    np.testing.assert_array_equal(copy.clearances(q), model.clearances(q))


def test_threads_share_a_model(learned: urdd.Robot) -> None:
    model, q = learned.collision_model(), learned.random(200)
    expected = model.clearances(q)
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(model.clearances, [q] * 40):
            np.testing.assert_array_equal(found, expected)


def test_progress_hears_of_the_training(training: tuple[Path, list[tuple[str, int, int]]]) -> None:
    told = training[1]
    steps = [(done, total) for what, done, total in told if what == f"{MODULE}: step"]
    total = steps[0][1]
    assert total > 5
    assert steps[0] == (0, total)
    assert steps[-1] == (total, total)
    assert len(steps) > 5
    assert [done for done, _ in steps] == sorted({done for done, _ in steps})
    begun = [what for what, _, _ in told if not what.endswith(": step")]
    assert begun[-1] == MODULE
    assert told[-1] == (MODULE, told[0][2], told[0][2])


def test_prune_then_check(learned: urdd.Robot) -> None:
    script = REPOSITORY / "python" / "examples" / "prune_then_check.py"
    found = subprocess.run(
        [sys.executable, script, learned.path, "2000"], capture_output=True, text=True, check=True, timeout=300
    )
    said, shares, missed, _ = found.stdout.splitlines()
    assert said == repr(learned.collision_model())
    q = learned.random(2000, seed=1)
    may_collide, exact = learned.collision_model().may_collide(q), learned.in_collision(q)
    assert [int(word) for word in re.findall(r"\d+", shares)] == [(~may_collide).sum(), 2000, may_collide.sum()]
    misses = (exact & ~may_collide).sum()
    assert [int(word) for word in re.findall(r"\d+", missed)] == [(exact & may_collide).sum(), exact.sum(), misses]


def test_examples_in_the_documentation(learned: urdd.Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(learned.path.parent)
    results = doctest.testmod(urdd._collision_model)
    assert results.attempted > 0
    assert results.failed == 0
