"""The package itself: its metadata, its types, its documentation."""

from __future__ import annotations

import doctest
import importlib.metadata
import inspect
import re
import subprocess
import sys
from pathlib import Path
from types import FunctionType

import pytest

import urdd
import urdd._diff
import urdd._lint
import urdd._robot
import urdd._validate
import urdd._world
from conftest import REPOSITORY
from urdd._options import MakingOptions, options_of

PYTHON = REPOSITORY / "python"

#: What a program may import from `urdd` until 2.0.0.
PUBLIC = [
    "Box",
    "Closed",
    "CollisionModel",
    "CombineError",
    "CombineNote",
    "Combined",
    "ConfigurationError",
    "ConvexMesh",
    "Export",
    "ExportError",
    "Frame",
    "FreeDofs",
    "GenerateError",
    "Generated",
    "Imported",
    "InverseSolution",
    "Job",
    "LearnedPair",
    "LoopErrors",
    "MeshError",
    "MeshKind",
    "ModuleMissingError",
    "ModuleUnusableError",
    "MujocoRobot",
    "NewtonRobot",
    "Note",
    "ObstacleDistance",
    "ObstacleError",
    "ObstacleGradient",
    "ObstacleOverlap",
    "ObstaclePair",
    "OpenError",
    "Pair",
    "PairDistance",
    "PairGradient",
    "PairOverlap",
    "PinocchioRobot",
    "Proximity",
    "PybulletRobot",
    "Rate",
    "Robot",
    "Rule",
    "SKIP_REASONS",
    "ShapeKind",
    "Shown",
    "ShownByViser",
    "SkipReason",
    "Skips",
    "SphereChecker",
    "Spheres",
    "UnknownNameError",
    "UrddError",
    "ValidationError",
    "Visual",
    "World",
    "WorldProximity",
    "__version__",
    "combine",
    "diff",
    "errors",
    "explain",
    "export",
    "find_urdfs",
    "generate",
    "generate_text",
    "import_robot",
    "lint",
    "load",
    "modules",
    "num_threads",
    "report",
    "set_num_threads",
    "validate",
]


def version_of(manifest: Path, key: str = "version") -> str:
    found = re.search(rf'^{key} = "(.+)"$', manifest.read_text(encoding="utf-8"), re.MULTILINE)
    assert found is not None
    return found[1]


def test_versions_are_equal() -> None:
    program = version_of(REPOSITORY / "Cargo.toml")
    assert version_of(PYTHON / "Cargo.toml") == program
    assert urdd.__version__ == program
    assert importlib.metadata.version("urdd") == program


def test_licences_are_those_of_the_repository() -> None:
    for name in ("LICENSE-APACHE", "LICENSE-MIT"):
        assert (PYTHON / name).read_bytes() == (REPOSITORY / name).read_bytes()
    names = [str(file) for file in importlib.metadata.files("urdd") or []]
    assert any(name.endswith("LICENSE-MIT") for name in names)
    package = Path(urdd.__file__).parent
    assert (package / "py.typed").is_file()
    assert (package / "_urdd.pyi").is_file()


def test_the_typed_modules_are_made_of_the_schemas() -> None:
    script = PYTHON / "scripts" / "make_types.py"
    made = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True, check=False)
    assert made.returncode == 0, made.stderr


def test_the_public_names_are_these() -> None:
    assert sorted(urdd.__all__) == PUBLIC


def test_every_public_name_is_documented() -> None:
    for name in urdd.__all__:
        thing = getattr(urdd, name)
        if isinstance(thing, (type, FunctionType)):
            assert (thing.__doc__ or "").strip(), name
    for kind in (
        *urdd.Robot.__mro__[:-1],
        urdd.Proximity,
        urdd.CollisionModel,
        urdd.WorldProximity,
        urdd._queries.Queries,
        urdd.World,
        urdd.Skips,
        urdd.modules.Modules,
    ):
        for name, member in vars(kind).items():
            if not name.startswith("_") and (callable(member) or hasattr(member, "__get__")):
                assert (getattr(member, "__doc__", None) or "").strip(), f"{kind.__name__}.{name}"


@pytest.mark.parametrize(
    "module",
    [urdd, urdd._diff, urdd._lint, urdd._robot, urdd._validate, urdd._world],
    ids=lambda module: module.__name__,
)
def test_examples_in_the_documentation(module: object, urdds: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(urdds)
    results = doctest.testmod(module)  # type: ignore[arg-type]
    assert results.attempted > 0
    assert results.failed == 0


def test_the_readme(learned: urdd.Robot, urdds: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs each block of Python unchanged, one after another, as in a clone in which its robots were generated."""
    (tmp_path / "welding_arm").symlink_to(urdds / "welding_arm")
    (tmp_path / learned.path.name).symlink_to(learned.path)
    (tmp_path / "conformance").symlink_to(REPOSITORY / "conformance")
    monkeypatch.chdir(tmp_path)
    text = (PYTHON / "README.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(blocks) >= 3
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for rustc is a script of a shell")
@pytest.mark.parametrize(
    ("rustc", "words"),
    [
        (None, "there is none on the PATH"),
        ("echo 'rustc 1.63.0 (4b91a6ea7 2022-08-08)'", "this is rustc 1.63.0"),
        ("echo 'error: rustup has no default toolchain' >&2; exit 1", "there is none on the PATH"),
        ("echo 'rustc 9.0.0-nightly (abc 2030-01-01)'", None),
    ],
)
def test_pip_says_that_it_needs_rust(rustc: str | None, words: str | None, tmp_path: Path) -> None:
    if rustc is not None:
        (tmp_path / "rustc").write_text(f"#!/bin/sh\n{rustc}\n", encoding="utf-8")
        (tmp_path / "rustc").chmod(0o755)
    code = "import sys; sys.path.insert(0, 'scripts'); import backend; backend.get_requires_for_build_wheel()"
    found = subprocess.run(
        [sys.executable, "-c", code],
        cwd=PYTHON,
        env={"PATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    if words is None:
        assert found.returncode == 0, found.stderr
    else:
        assert found.returncode == 1
        # Not a traceback: one sentence.
        assert found.stderr.strip().count("\n") == 0
        needed = version_of(REPOSITORY / "Cargo.toml", "rust-version").removesuffix(".0")
        assert found.stderr.strip().startswith(f"urdd is compiled here, which needs Rust {needed} or later: {words}")


def test_options_are_as_usual() -> None:
    """The defaults that `generate` shows are those that the others use."""
    shown = inspect.signature(urdd.generate).parameters
    usual = options_of({}, "generate")
    for name in MakingOptions.__annotations__:
        expected: object = shown[name].default
        found: object = getattr(usual if hasattr(usual, name) else usual.source, name)
        assert found == (list(expected) if isinstance(expected, tuple) else [] if name == "packages" else expected), (
            name
        )
    assert set(shown) - set(MakingOptions.__annotations__) == {"source", "output", "xacro_arguments", "progress"}


def test_the_import_is_light() -> None:
    heavy = "{'trimesh', 'pinocchio', 'mujoco', 'scipy'}"
    code = f"import sys, urdd; print(sorted({{name.split('.')[0] for name in sys.modules}} & {heavy}))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout == "[]\n"
