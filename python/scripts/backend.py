"""How pip builds the package: by maturin, after a look for Rust. Without one, maturin fetches a toolchain of its own or
ends in a trace; with one that is too old, cargo complains of a manifest."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import maturin

# The workspace's manifest: in a clone above this package, in a source distribution beside pyproject.toml.
MANIFESTS = [path.read_text(encoding="utf-8") for path in (Path("../Cargo.toml"), Path("Cargo.toml")) if path.is_file()]
WANTED = re.search(r'^rust-version = "(\d+)\.(\d+)"$', "\n".join(MANIFESTS), re.MULTILINE)


def check_rust() -> None:
    """Exits with instructions if Rust is missing or too old."""
    assert WANTED is not None
    wanted = (int(WANTED[1]), int(WANTED[2]))
    try:
        said = subprocess.run(["rustc", "--version"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        said = ""
    found = re.search(r"rustc (\d+)\.(\d+)", said)
    if found is not None and (int(found[1]), int(found[2])) >= wanted:
        return
    what = "there is none on the PATH" if found is None else f"this is {said.strip()}"
    sys.exit(
        f"\nurdd is compiled here, which needs Rust {wanted[0]}.{wanted[1]} or later: {what}. Install it from "
        f"https://rustup.rs, or update it with `rustup update`; then run this again.\n"
    )


def get_requires_for_build_wheel(config_settings: dict[str, Any] | None = None) -> list[str]:
    check_rust()
    found: list[str] = maturin.get_requires_for_build_wheel(config_settings)
    return found


def get_requires_for_build_editable(config_settings: dict[str, Any] | None = None) -> list[str]:
    check_rust()
    found: list[str] = maturin.get_requires_for_build_editable(config_settings)
    return found


get_requires_for_build_sdist = maturin.get_requires_for_build_sdist
prepare_metadata_for_build_wheel = maturin.prepare_metadata_for_build_wheel
prepare_metadata_for_build_editable = maturin.prepare_metadata_for_build_editable
build_wheel = maturin.build_wheel
build_editable = maturin.build_editable
build_sdist = maturin.build_sdist
