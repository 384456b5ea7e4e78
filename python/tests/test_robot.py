"""The parts of a robot: names, modules, files, and Python protocols."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import shutil
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import urdd


def test_it_says_what_it_is(arm: urdd.Robot) -> None:
    text = repr(arm)
    for word in ("welding_arm", f"{arm.num_dofs} DOFs", f"{arm.num_links} links", "15 modules", "class Shapes"):
        assert word in text
    assert len(arm.joint_names) == arm.num_links - 1
    assert arm.link_names[arm.link("torch")] == "torch"
    assert arm.root_link == "base"
    assert "pairs" in repr(arm.proximity())
    assert "dof_module" in repr(arm.modules)
    assert arm.urdf_path.is_file()
    assert arm.urdf_text.startswith("<?xml")
    assert arm.folder is not None
    assert arm.metadata is not None
    assert arm.metadata.source is not None
    assert arm.read_file(arm.metadata.source.path) == arm.urdf_path.read_bytes()


def test_modules_are_typed(arm: urdd.Robot) -> None:
    modules = arm.modules
    assert modules.dof.num_dofs == arm.num_dofs
    assert [dof.name for dof in modules.dof.dofs] == list(arm.dof_names)
    assert [link.name for link in modules.chain.links_in_chain] == list(arm.link_names)
    assert modules.version("dof_module") == "1.0.0"
    assert modules.json("dof_module")["num_dofs"] == arm.num_dofs
    assert modules.dof is modules.dof
    for name in modules.names():
        short = name.removesuffix("_module")
        assert type(getattr(modules, short)).__name__.lower() == name.replace("_", "")
    (link, *_) = (link for link in modules.urdf.links if link.visual)
    geometry = link.visual[0].geometry
    assert isinstance(geometry, (urdd.modules.Mesh, urdd.modules.Cuboid, urdd.modules.Cylinder, urdd.modules.Sphere))


def test_an_archive_is_a_robot(arm: urdd.Robot, tmp_path: Path) -> None:
    archive = shutil.make_archive(str(tmp_path / "arm"), "zip", arm.path)
    robot = urdd.load(archive)
    q = robot.random(3)
    np.testing.assert_array_equal(robot.link_poses(q), arm.link_poses(q))
    np.testing.assert_array_equal(robot.distances(q), arm.distances(q))
    assert robot.urdf_text == arm.urdf_text
    assert robot.modules.dof == arm.modules.dof
    with pytest.raises(urdd.OpenError, match="urdf_text"):
        _ = robot.urdf_path


def test_it_is_pickled_as_its_path(arm: urdd.Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(arm.path.parent)
    data = pickle.dumps(urdd.load("welding_arm"))
    monkeypatch.chdir(tmp_path)
    robot: urdd.Robot = pickle.loads(data)
    np.testing.assert_array_equal(robot.link_poses(robot.zero), arm.link_poses(arm.zero))


def test_errors_are_pickled(arm: urdd.Robot) -> None:
    with pytest.raises(urdd.UnknownNameError) as caught:
        arm.link("torhc")
    error: urdd.UnknownNameError = pickle.loads(pickle.dumps(caught.value))
    assert (str(error), error.name, error.nearest) == (str(caught.value), "torhc", "torch")


def test_threads_ask_one_robot(urdds: Path) -> None:
    robot = urdd.load(urdds / "quadruped")
    q = urdd.load(urdds / "quadruped").random(300)
    barrier = threading.Barrier(8)

    def ask(number: int) -> tuple[float, float]:
        barrier.wait()
        return float(robot.link_poses(q).sum()), float(robot.distances(q[number::8]).sum())

    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(ask, range(8)))
    assert len({poses for poses, _ in answers}) == 1
    assert sum(total for _, total in answers) == pytest.approx(float(robot.distances(q).sum()), rel=1e-12)


def test_the_interpreter_is_let_go(arm: urdd.Robot) -> None:
    q = arm.random(200_000)
    done = threading.Event()
    turns = 0

    def work() -> None:
        arm.link_poses(q)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        turns += 1
    thread.join()
    assert turns > 1000


def _in_child(path: str, queue: multiprocessing.Queue[float]) -> None:
    robot = urdd.load(path)
    queue.put(float(robot.distances(robot.random(200)).sum()))


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_fork_works_on(arm: urdd.Robot) -> None:
    expected = float(arm.distances(arm.random(200)).sum())
    context = multiprocessing.get_context("fork")
    queue: multiprocessing.Queue[float] = context.Queue()
    process = context.Process(target=_in_child, args=(str(arm.path), queue))
    process.start()
    assert queue.get(timeout=60) == expected
    process.join(60)
    assert process.exitcode == 0
    # The robot that the child inherited from its parent works too.
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.write(writer, repr(float(arm.distances(arm.random(200)).sum())).encode())
        finally:
            os._exit(0)
    os.close(writer)
    with os.fdopen(reader) as answer:
        assert float(answer.read()) == expected
    os.waitpid(child, 0)


def test_the_number_of_threads_changes_no_answer(arm: urdd.Robot) -> None:
    q = arm.random(500)
    expected = arm.distances(q), arm.link_poses(q), arm.jacobian(q, "torch")
    before = urdd.num_threads()
    try:
        for count in (1, 3):
            urdd.set_num_threads(count)
            assert urdd.num_threads() == count
            for one, other in zip(
                (arm.distances(q), arm.link_poses(q), arm.jacobian(q, "torch")), expected, strict=True
            ):
                np.testing.assert_array_equal(one, other)
    finally:
        urdd.set_num_threads(None)
    assert urdd.num_threads() == before
    with pytest.raises(ValueError, match="at least 1"):
        urdd.set_num_threads(0)


@pytest.mark.parametrize("method", ["spawn", "fork"])
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_all_that_answers_can_be_sent_to_other_processes(method: str, learned: urdd.Robot) -> None:
    world = urdd.World()
    world.add_box("table", [2.0, 2.0, 0.1], [0.0, 0.0, -0.05], ignore=["base"])
    q = learned.random(60)
    asked = [
        learned.link_poses,
        learned.proximity().distances,
        learned.proximity("hulls").in_collision,
        learned.world_proximity(world).distances,
        learned.collision_model().min_clearance,
    ]
    with multiprocessing.get_context(method).Pool(2) as pool:
        for ask in asked:
            found = np.concatenate(pool.map(ask, np.split(q, 3)))
            np.testing.assert_array_equal(found, ask(q))


def test_a_copy_of_what_was_prepared_is_of_the_same_kind(arm: urdd.Robot) -> None:
    for kind in urdd.ShapeKind.__args__:  # type: ignore[attr-defined]
        proximity = arm.proximity(kind)
        again: urdd.Proximity = pickle.loads(pickle.dumps(proximity))
        assert (again.kind, again.pairs) == (kind, proximity.pairs)
