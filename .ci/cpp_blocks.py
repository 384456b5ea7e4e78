#!/usr/bin/env python3
"""Writes each block of C++ in a page of docs into a file of its own.

.ci/cpp_blocks.py PAGE FOLDER
"""

from __future__ import annotations

import pathlib
import re
import sys


def main() -> int:
    """Fails where the page has no block."""
    page, folder = map(pathlib.Path, sys.argv[1:])
    blocks = re.findall(r"^```cpp\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)
    folder.mkdir()
    for number, block in enumerate(blocks):
        (folder / f"{number}.cpp").write_text(block)
    print(f"{len(blocks)} blocks")
    return 0 if blocks else 1


if __name__ == "__main__":
    sys.exit(main())
