"""Measures everything that README.md and docs/evaluation.md state, and writes these pages again.

    python benches/evaluation/all.py --robots FOLDER [--quick] [--urdd PROGRAM] [--corpus FOLDER] [--sources FOLDER] [--peers FOLDER]

Builds the bench programs first (`cargo bench --no-run`), then measures, times first, on a machine that does nothing else.
`--quick` leaves out what takes long and hardly depends on the machine (learned models, lines of code, convex pieces
by CoACD, the kill rate), and repeats less: some minutes. A script that fails leaves its results, and the pages, as they are; the
run ends with 1.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from pathlib import Path

#: Each script: which arguments of ours it takes, what `--quick` adds; none is left out then.
SCRIPTS: dict[str, tuple[list[str], list[str] | None]] = {
    "conversion.py": (["robots", "urdd"], ["--runs", "3"]),
    "stages.py": (["robots", "urdd"], None),
    "kinematics.py": (["robots", "urdd"], []),
    "proximity.py": (["robots", "urdd"], ["--configurations", "50"]),
    "validation.py": (["corpus"], []),
    "learned.py": (["robots", "urdd"], None),
    "lines.py": (["sources", "urdd"], None),
    "decomposition.py": (["robots", "peers", "urdd"], None),
    "kill_rate.py": (["urdd"], None),
    "suite_kill_rate.py": ([], None),
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=Path, required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--corpus", type=Path, help="published URDDs, for validation.py")
    parser.add_argument("--sources", type=Path, help="sources in C++, which fetch_sources.sh gets")
    parser.add_argument("--peers", type=Path, help="where convex pieces by others are kept")
    parser.add_argument("--urdd", type=Path, help="instead of one that is built of these sources")
    given = vars(parser.parse_args())
    here = Path(__file__).resolve().parent
    benches = ["kinematics", "learned", "proximity", "validate"]
    build = ["cargo", "bench", "--locked", "--no-run", *(word for bench in benches for word in ("--bench", bench))]
    subprocess.run(build, cwd=here, check=True)
    failed = []
    for script, (takes, quick) in SCRIPTS.items():
        if given["quick"] and quick is None:
            continue
        words = [word for name in takes if given[name] for word in (f"--{name}", str(given[name].resolve()))]
        words += quick or [] if given["quick"] else []
        print(f"== {script}", flush=True)
        begin = time.monotonic()
        if subprocess.run([sys.executable, str(here / script), *words], check=False).returncode != 0:
            failed.append(script)
        print(f"== {script}: {time.monotonic() - begin:.0f} s", flush=True)
    if failed:
        print(f"not measured: {', '.join(failed)}", file=sys.stderr)
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
