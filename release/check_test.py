"""Each reason not to release is found, in a small tree: `python3 release/check_test.py`."""

from __future__ import annotations

import contextlib
import io
import json
import subprocess
import tempfile
import unittest
from pathlib import Path

import check

CARGO = """[package]
name = "urdd"
version = "1.2.3"
edition = "2024"
[workspace]
members = ["a"]
[workspace.package]
version = "0.4.0"
[workspace.dependencies]
urdd-a = { path = "a", version = "0.4.0" }
serde = "1.0"
"""


class Refusals(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write("Cargo.toml", CARGO)
        self.write("a/Cargo.toml", '[package]\nname = "urdd-a"\nversion.workspace = true\nedition = "2024"\n')
        for library in ("src/lib.rs", "a/src/lib.rs"):
            self.write(library, "")
        for package in check.PACKAGES:
            toml = '[package]\nname = "urdd"\nversion = "1.2.3"\n'
            self.write(package, toml if package.endswith(".toml") else json.dumps({"version": "1.2.3"}))
        self.write("CHANGELOG.md", "# Changelog\n\n## 1.2.3, 2026-01-31\n\n- x\n\n## 1.2.2, 2025-01-31\n")
        self.git("init", "--quiet")
        self.cargo("generate-lockfile", "--offline")
        self.commit()

    def write(self, name: str, text: str) -> None:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def change(self, name: str, before: str, after: str, commit: bool = True) -> None:
        text = (self.root / name).read_text(encoding="utf-8")
        assert before in text
        self.write(name, text.replace(before, after, 1))
        if commit:
            self.commit()

    def git(self, *words: str) -> None:
        names = ["-c", "user.name=x", "-c", "user.email=x@example.org"]
        subprocess.run(["git", *names, *words], cwd=self.root, check=True, capture_output=True)

    def cargo(self, *words: str) -> None:
        subprocess.run(["cargo", *words], cwd=self.root, check=True, capture_output=True)

    def commit(self) -> None:
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "x")

    def said(self, *words: str) -> tuple[int, str]:
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            status = check.main(self.root, list(words))
        return status, out.getvalue() + errors.getvalue()

    def refused(self, part: str, *words: str) -> None:
        status, said = self.said(*words)
        assert status == 1, said
        assert said.count("error:") == 1, said
        assert part in said

    def test_a_tree_that_is_ready(self) -> None:
        assert self.said() == (0, "1.2.3\n")
        assert self.said("v1.2.3") == (0, "1.2.3\n")

    def test_changes_that_are_not_committed(self) -> None:
        self.write("new.txt", "x")
        self.refused("not committed (new.txt)")
        assert self.said("--draft")[0] == 0

    def test_another_tag(self) -> None:
        self.refused("tag the commit of that version as v1.2.3", "v1.2.4")

    def test_a_package_of_another_version(self) -> None:
        self.change("wasm/npm/package.json", "1.2.3", "1.2.2")
        self.refused("wasm/npm/package.json: the version is 1.2.2", "--draft")

    def test_a_python_package_of_another_version(self) -> None:
        self.change("python/Cargo.toml", "1.2.3", "0.4.0")
        self.refused("python/Cargo.toml: the version is 0.4.0", "--draft")

    def test_a_crate_of_another_version(self) -> None:
        self.change("Cargo.toml", 'path = "a", version = "0.4.0"', 'path = "a", version = "0.3.9"')
        status, said = self.said()
        assert status == 1
        assert "[workspace.dependencies] has urdd-a 0.3.9, not 0.4.0" in said

    def test_a_changelog_of_another_version(self) -> None:
        self.change("CHANGELOG.md", "## 1.2.3, 2026-01-31", "## 1.3.0, 2026-01-31")
        self.refused("CHANGELOG.md begins with 1.3.0")
        self.refused("CHANGELOG.md begins with 1.3.0", "--draft")

    def test_a_changelog_that_began_the_next_version(self) -> None:
        self.change("CHANGELOG.md", "## 1.2.3, 2026-01-31", "## 1.3.0, unreleased")
        self.refused("CHANGELOG.md begins with 1.3.0")
        assert self.said("--draft") == (0, "1.2.3\n")

    def test_a_changelog_without_a_day(self) -> None:
        self.change("CHANGELOG.md", "2026-01-31", "unreleased")
        self.refused("write the day of the release")
        assert self.said("--draft")[0] == 0

    def test_a_lock_file_that_is_stale(self) -> None:
        self.change("Cargo.lock", 'version = "0.4.0"', 'version = "0.3.9"')
        self.refused("Cargo.lock does not fit")

    def test_a_version_that_is_none(self) -> None:
        self.change("Cargo.toml", 'version = "1.2.3"', 'version = "1.2"')
        status, said = self.said()
        assert status == 1
        assert "not a semantic version" in said

    def test_wrong_usage(self) -> None:
        with contextlib.redirect_stderr(io.StringIO()):
            assert check.main(self.root, ["--daft"]) == 2


if __name__ == "__main__":
    unittest.main()
