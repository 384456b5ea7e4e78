"""The package itself: what it says of itself, its types, its documentation."""

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
import urdd._robot
import urdd._validate
import urdd._world
from conftest import REPOSITORY
from urdd._options import MakingOptions, options_of

PYTHON = REPOSITORY / "python"


def version_of(manifest: Path) -> str:
    found = re.search(r'^version = "(.+)"$', manifest.read_text(encoding="utf-8"), re.MULTILINE)
    assert found is not None
    return found[1]


def test_versions_are_equal() -> None:
    crate = version_of(REPOSITORY / "Cargo.toml")
    assert version_of(PYTHON / "Cargo.toml") == crate
    assert urdd.__version__ == crate
    assert importlib.metadata.version("urdd") == crate


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


def test_every_public_name_is_documented() -> None:
    for name in urdd.__all__:
        thing = getattr(urdd, name)
        if isinstance(thing, (type, FunctionType)):
            assert (thing.__doc__ or "").strip(), name
    for kind in (
        *urdd.Robot.__mro__[:-1],
        urdd.Proximity,
        urdd.CollisionModel,
        urdd.Among,
        urdd.World,
        urdd.Skips,
        urdd.modules.Modules,
    ):
        for name, member in vars(kind).items():
            if not name.startswith("_") and (callable(member) or hasattr(member, "__get__")):
                assert (getattr(member, "__doc__", None) or "").strip(), f"{kind.__name__}.{name}"


@pytest.mark.parametrize("module", [urdd, urdd._robot, urdd._validate, urdd._world], ids=lambda module: module.__name__)
def test_examples_in_the_documentation(module: object, urdds: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(urdds)
    results = doctest.testmod(module)  # type: ignore[arg-type]
    assert results.attempted > 0
    assert results.failed == 0


def test_the_readme(learned: urdd.Robot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each block of Python is run as it stands, one after the other, where a URDD and a URDF lie."""
    (tmp_path / "my_robot").symlink_to(learned.path)
    robots = REPOSITORY / "conformance" / "robots"
    for name in ("welding_arm.urdf", "gripper.urdf", "meshes", "package.xml"):
        (tmp_path / name).symlink_to(robots / name)
    monkeypatch.chdir(tmp_path)
    text = (PYTHON / "README.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(blocks) >= 3
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)


def test_options_are_as_usual() -> None:
    """What `generate` shows as usual, and what the others take where nothing is said, is one and the same."""
    shown = inspect.signature(urdd.generate).parameters
    usual = options_of({}, "generate")
    for name in MakingOptions.__annotations__:
        expected: object = shown[name].default
        found: object = getattr(usual, name)
        assert found == (list(expected) if isinstance(expected, tuple) else [] if name == "packages" else expected), (
            name
        )
    assert set(shown) - set(MakingOptions.__annotations__) == {"source", "output", "xacro_arguments", "progress"}


def test_the_import_is_light() -> None:
    heavy = "{'trimesh', 'pinocchio', 'mujoco', 'scipy'}"
    code = f"import sys, urdd; print(sorted({{name.split('.')[0] for name in sys.modules}} & {heavy}))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout == "[]\n"
