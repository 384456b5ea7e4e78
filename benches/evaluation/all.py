"""Makes every table of docs/evaluation.md again.

    python benches/evaluation/all.py --robots FOLDER [--sources FOLDER] [--peers FOLDER] [--urdd PROGRAM]

Times first, while nothing else runs. A script that fails leaves its table as it is, and the run ends with 1.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

#: Each script, and which arguments of ours it takes.
SCRIPTS = {
    "conversion.py": ["robots", "urdd"],
    "proximity.py": ["robots", "urdd"],
    "learned.py": ["robots", "urdd"],
    "sizes.py": ["robots", "urdd"],
    "lines.py": ["sources", "urdd"],
    "decomposition.py": ["robots", "peers", "urdd"],
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=Path, required=True)
    parser.add_argument("--sources", type=Path, help="sources in C++, which fetch_sources.sh gets")
    parser.add_argument("--peers", type=Path, help="where convex pieces by others are kept")
    parser.add_argument("--urdd", type=Path, help="instead of one that is built of these sources")
    given = vars(parser.parse_args())
    failed = []
    for script, takes in SCRIPTS.items():
        words = [word for name in takes if given[name] for word in (f"--{name}", str(given[name].resolve()))]
        command = [sys.executable, str(Path(__file__).resolve().parent / script), *words]
        print(f"== {script}", flush=True)
        if subprocess.run(command, check=False).returncode != 0:
            failed.append(script)
    if failed:
        print(f"not made: {', '.join(failed)}", file=sys.stderr)
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
