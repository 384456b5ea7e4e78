"""Faulty examples of rules about descriptions, for the page: the invalid cases of the linter's own tests."""

from __future__ import annotations

import zipfile
from pathlib import Path

CASES = "crates/urdd-lint/tests/cases"
# A .zip of the same files has the same bytes.
TIME = (1980, 1, 1, 0, 0, 0)


def example(root: Path, code: str) -> tuple[str, Path] | None:
    """The name of a rule's example beside the page, and its URDF."""
    found = sorted((root / CASES / code).glob("invalid*.urdf"))
    if not found:
        return None
    is_alone = all(path.suffix == ".urdf" for path in found[0].parent.iterdir())
    return f"examples/{code}.{'urdf' if is_alone else 'zip'}", found[0]


def write(root: Path, codes: list[str], gallery: Path) -> None:
    """Writes the examples into the gallery."""
    for code in codes:
        if (known := example(root, code)) is None:
            continue
        name, urdf = known
        target = gallery / name
        target.parent.mkdir(exist_ok=True)
        if target.suffix == ".urdf":
            target.write_bytes(urdf.read_bytes())
            continue
        with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as packed:
            for path in sorted(urdf.parent.rglob("*")):
                is_other = path.suffix == ".urdf" and path.parent == urdf.parent and path != urdf
                if path.is_file() and not is_other:
                    entry = zipfile.ZipInfo(f"{code}/{path.relative_to(urdf.parent).as_posix()}", TIME)
                    packed.writestr(entry, path.read_bytes(), zipfile.ZIP_DEFLATED)


def link(root: Path, code: str) -> str:
    """A link that opens the page with the example of a rule; empty without one."""
    known = example(root, code)
    if known is None:
        return ""
    return (
        f"\n[Try it in the page](../gallery/index.html#from={known[0]}){{ .md-button }} opens an example with this "
        "fault: its text, to mend, beside the robot.\n"
    )
