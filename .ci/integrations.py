"""Tries what other programs run `urdd` by: `integrations.py URDD WHEELS`.

The steps of action.yml, the hooks of pre-commit (also with the wheel, as docs/ci.md has them), and
cmake/UrddLint.cmake.
WHEELS is a folder with the wheel of this version. Each accepts a right robot, and refuses a wrong one.
`.ci/integrations` makes the environment: pre-commit, CMake, PyYAML, shellcheck, git.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import xml.etree.ElementTree
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[1]
VERSION = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["package"]["version"]
RIGHT = '<?xml version="1.0"?>\n<robot name="right">\n  <link name="base"/>\n</robot>\n'
WRONG = '<?xml version="1.0"?>\n<robot name="wrong">\n  <link name="base"/>\n  <link name="base"/>\n</robot>\n'

MACRO = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="part" params="name"/></robot>\n'


class Tried:
    """A folder with a git repository of two robots, and programs that run there."""

    def __init__(self, folder: Path, urdd: Path, wheels: Path) -> None:
        self.folder = folder / "robots of mine"
        self.folder.mkdir()
        (self.folder / "right.urdf").write_text(RIGHT, encoding="utf-8")
        (self.folder / "wrong one.urdf").write_text(WRONG, encoding="utf-8")
        shutil.copytree(ROOT / "examples/urdds/arm", self.folder / "arm")
        (folder / "bin").mkdir()
        (folder / "bin/urdd").symlink_to(urdd)
        self.environment = {
            **os.environ,
            "PATH": f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}",
            "PIP_FIND_LINKS": str(wheels),
            "PRE_COMMIT_HOME": str(folder / "pre-commit"),
            "RUNNER_TEMP": str(folder),
        }
        self.run(0, "git", "init", "--quiet")
        self.run(0, "git", "add", "--all")

    def run(self, status: int, *command: str, folder: Path | None = None, **more: str) -> str:
        """What a command printed; it has to end with this status."""
        environment = {**self.environment, **more}
        done = subprocess.run(
            command, cwd=folder or self.folder, env=environment, capture_output=True, text=True, check=False
        )
        if done.returncode != status:
            sys.exit(f"{' '.join(command)}: status {done.returncode}, not {status}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr


def action(tried: Tried) -> None:
    """The steps of action.yml, as a runner would run them."""
    manifest = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    defaults = {name: given["default"] for name, given in manifest["inputs"].items()}
    for step in manifest["runs"]["steps"]:
        assert "${{" not in step["run"], f"{step['name']}: an input in the text of a script can become a command"
        tried.run(0, "shellcheck", "--shell=bash", "--severity=warning", script(tried, step["run"]))

    def steps(status: int, only: slice = slice(None), **inputs: str) -> str:
        said = ""
        for step in manifest["runs"]["steps"][only]:
            values = {**defaults, **{name.replace("_", "-"): value for name, value in inputs.items()}}

            def value(found: re.Match[str], values: dict[str, str] = values) -> str:
                return str(ROOT) if found[1] == "github.action_path" else values[found[1].removeprefix("inputs.")]

            env = {name: re.sub(r"\$\{\{ (\S+) \}\}", value, text) for name, text in step["env"].items()}
            last = step is manifest["runs"]["steps"][-1]
            said += tried.run(status if last else 0, "bash", "-eo", "pipefail", script(tried, step["run"]), **env)
        return said

    steps(0, paths="right.urdf")
    run = slice(1, None)
    steps(1, run, paths="right.urdf\nwrong one.urdf\n", sarif="urdd.sarif")
    assert '"2.1.0"' in (tried.folder / "urdd.sarif").read_text(encoding="utf-8")
    assert "::error" in steps(1, run)
    steps(1, run, paths="wrong one.urdf", arguments="--max-places\n1")
    steps(0, run, command="validate", paths="arm", fail_on="info")
    steps(2, run, command="validate; true")
    steps(2, run, paths="\n")
    assert not (tried.folder / "pwned").exists()
    steps(2, run, paths="$(touch pwned)")
    assert not (tried.folder / "pwned").exists()


def script(tried: Tried, text: str) -> str:
    path = tried.folder.parent / "step.sh"
    path.write_text(text, encoding="utf-8")
    return str(path)


def pre_commit(tried: Tried) -> None:
    """The hooks of this repository, with the program on PATH; and with the wheel, as docs/ci.md has them."""
    tried.run(0, "pre-commit", "validate-manifest", str(ROOT / ".pre-commit-hooks.yaml"))
    # As it is now, committed or not.
    clone = tried.folder.parent / "clone"
    clone.mkdir()
    shutil.copy(ROOT / ".pre-commit-hooks.yaml", clone)
    identity = ("-c", "user.name=x", "-c", "user.email=x@example.org")
    for words in (("init", "--quiet"), ("add", "--all"), (*identity, "commit", "--quiet", "--message", "x")):
        tried.run(0, "git", *words, folder=clone)
    revision = tried.run(0, "git", "rev-parse", "HEAD", folder=clone).strip()
    hooks: list[dict[str, object]] = [
        {"id": "urdd-lint", "language": "system"},
        {"id": "urdd-validate", "language": "system", "args": ["arm"]},
    ]
    hook(tried, {"repo": str(clone), "rev": revision, "hooks": hooks})
    page = (ROOT / "docs/ci.md").read_text(encoding="utf-8")
    local = [yaml.safe_load(text) for text in re.findall(r"```yaml\n(repos:.*?)```", page, re.DOTALL)]
    local = [found for found in local if found["repos"][0]["repo"] == "local"]
    assert len(local) == 1, "docs/ci.md has one example of pre-commit with the wheel"
    for one in local[0]["repos"][0]["hooks"]:
        one["additional_dependencies"] = [f"urdd=={VERSION}"]
        one["additional_dependencies"] += ["xacro==2.1.1"] if one["id"] == "urdd-lint" else []
        one["args"] = ["arm"] if one["id"] == "urdd-validate" else ["."]
    hook(tried, local[0]["repos"][0])


def hook(tried: Tried, repository: dict[str, object]) -> None:
    configuration = tried.folder.parent / "hooks.yaml"
    configuration.write_text(yaml.safe_dump({"repos": [repository]}), encoding="utf-8")
    run = ("pre-commit", "run", "--color=never", "--config", str(configuration))
    # All robots of the repository are checked, whichever file changed: a macro or a YAML file is one of each robot.
    (tried.folder / "macro.xacro").write_text(MACRO, encoding="utf-8")
    for changed in ("right.urdf", "macro.xacro"):
        said = tried.run(1, *run, "--files", changed)
        assert re.search(r"urdd lint\.+Failed", said) and "wrong one.urdf" in said, said
    settings = tried.folder / "urdd.toml"
    settings.write_text('exclude = ["wrong one.urdf"]\n', encoding="utf-8")
    said = tried.run(0, *run, "--files", "right.urdf")
    assert said.count("Passed") == 2, said
    settings.unlink()
    (tried.folder / "macro.xacro").unlink()
    said = tried.run(0, *run, "--files", "arm/dof_module/module.json")
    assert re.search(r"urdd lint\.+.*Skipped", said), said
    assert re.search(r"urdd validate\.+Passed", said), said


def cmake(tried: Tried) -> None:
    """A project with two tests, of which one fails, with CTest alone and where ament wants results."""
    project = tried.folder / "CMakeLists.txt"
    tests = 'urdd_add_lint_test(lint_right right.urdf)\nurdd_add_lint_test(lint_wrong "wrong one.urdf" right.urdf)\n'
    head = "cmake_minimum_required(VERSION 3.16)\nproject(tried NONE)\nenable_testing()\n"
    head += f'include("{ROOT}/cmake/UrddLint.cmake")\n'
    project.write_text(head + tests, encoding="utf-8")
    build, ament = (str(tried.folder.parent / name) for name in ("build", "ament"))
    for folder, results, words in (
        (build, f"{build}/test_results", ()),
        (ament, f"{ament}/results/tried", (f"-DAMENT_TEST_RESULTS_DIR={ament}/results",)),
    ):
        tried.run(0, "cmake", "-S", ".", "-B", folder, *words)
        said = tried.run(8, "ctest", "--test-dir", folder)
        assert "1 tests failed out of 2" in said, said
        for name in ("lint_right", "lint_wrong"):
            xml.etree.ElementTree.parse(f"{results}/{name}.xunit.xml")
    for wrong, expected in (("lint_none", "name the files"), ("lint_gone gone.urdf", "does not exist")):
        project.write_text(f"{head}urdd_add_lint_test({wrong})\n", encoding="utf-8")
        assert expected in tried.run(1, "cmake", "-S", ".", "-B", build)
    project.write_text(head + tests, encoding="utf-8")
    missing = f"{tried.folder.parent}/missing"
    said = tried.run(1, "cmake", "-S", ".", "-B", missing, "-DURDD_PROGRAM=URDD_PROGRAM-NOTFOUND", PATH=bare(tried))
    assert "pip install urdd" in " ".join(said.split()), said


def bare(tried: Tried) -> str:
    """A PATH without `urdd`."""
    folders = tried.environment["PATH"].split(os.pathsep)
    return os.pathsep.join(folder for folder in folders if not (Path(folder) / "urdd").exists())


def main(words: list[str]) -> None:
    if len(words) != 2:
        sys.exit(__doc__)
    urdd, wheels = (Path(word).resolve() for word in words)
    for part in (action, pre_commit, cmake):
        with tempfile.TemporaryDirectory() as folder:
            part(Tried(Path(folder), urdd, wheels))
        print(f"{part.__name__}: {(part.__doc__ or '').splitlines()[0]}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
