"""How many single changes of right URDDs the validator notices: `urdd-kill-rate` (conformance/kill_rate.md says what it does).

    python benches/evaluation/kill_rate.py [--limit 3000] [--urdd PROGRAM]

The robots of `conformance/robots` except the hand and the quadruped, with `--deep`; an hour on two cores. Standard library alone.
"""

from __future__ import annotations

import json
import tempfile
from collections import Counter
from pathlib import Path

from robots import ROOT, arguments, generated, printed, program, version_of
from results import write

#: Robots that are left out: their URDDs take most of the time, and hold nothing that the others do not.
WITHOUT = {"hand", "quadruped"}


def percent(share: float) -> str:
    """With one digit, rounded down: 100 % is all of them."""
    return "100 %" if share == 1.0 else f"{int(1000 * share) / 10:.1f} %"


def main() -> None:
    parser = arguments(__doc__, robots=False)
    parser.add_argument("--limit", type=int, default=3000, help="changes of a URDD")
    given = parser.parse_args()
    urdd = program(given.urdd)
    robots = [path for path in sorted((ROOT / "conformance" / "robots").glob("*.urdf")) if path.stem not in WITHOUT]
    options = ["--deep", "--limit", str(given.limit), "--per-field", "12", "--seed", "7"]
    with tempfile.TemporaryDirectory() as folder:
        made = [
            generated(urdd, urdf, Path(folder) / urdf.stem, "--package", f"urdd_robots={urdf.parent}") for urdf in robots
        ]
        command = ["cargo", "run", "--release", "--locked", "--quiet", "--package", "urdd-kill-rate", "--"]
        text = printed([*command, *options, "--format", "json", "--min-rate", "0", *made])
    modules: dict[str, Counter[str]] = {}
    for one in (module for robot in json.loads(text)["urdds"] for module in robot["modules"]):
        modules.setdefault(one["module"], Counter()).update(
            {key: (one["deep"] or one["plain"])[key] for key in ("changes", "noticed", "warned", "missed")}
        )
    every = sum(modules.values(), Counter())
    rows = [
        [f"`{name}`" if name != "source" else "source URDF", *(str(count[key]) for key in ("changes", "noticed", "warned"))]
        + [percent(1 - count["missed"] / count["changes"])]
        for name, count in modules.items()
    ]
    items = {
        "all": {"columns": ["module", "changes", "noticed", "warned", "rate"], "rows": rows},
        "changes": f"{every['changes']:,}",
        "survivors": str(every["missed"]),
        "rate": percent(1 - every["missed"] / every["changes"]),
        "least": percent(min(1 - count["missed"] / count["changes"] for count in modules.values())),
    }
    write("kill_rate", items, version_of(urdd, given.urdd is not None), how=f"`{' '.join(options)}`")


if __name__ == "__main__":
    main()
