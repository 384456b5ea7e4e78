"""How long the validator takes beside plain parsing (serde_json and serde_yaml) of the same bytes: `benches/validate.rs`.

    python benches/evaluation/validation.py [--corpus FOLDER]

FOLDER holds URDDs whose YAML is not in the canonical emission, so that it has to be parsed: the five published ones.
"""

from __future__ import annotations

import argparse
import os
import re
from pathlib import Path

from robots import bench, printed
from results import write

#: Rows of the bench that are shown, and their names there.
ROWS = {
    "published URDDs, YAML parsed": "five published URDDs, YAML to be parsed",
    "chain of 300 links, core, canonical": "chain of 300 links, core, with all explicit paths",
    "chain of 2000 links, core, canonical": "chain of 2,000 links, core",
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--corpus", type=Path, default=Path("../shared/corpus"))
    os.environ["URDD_CORPUS"] = str(parser.parse_args().corpus.resolve())
    text = printed([bench("validate")])
    rows = []
    for title, name in ROWS.items():
        found = re.search(rf"^{title} +(.*)$", text, flags=re.MULTILINE)
        if found is None:
            raise SystemExit(f"the bench prints no row {title!r}: is the corpus there?\n{text}")
        megabytes, parse, one, _, two, *_ = (float(word) for word in found[1].split())
        rows.append([name, f"{megabytes:.1f}", *(f"{value:,.0f}" for value in (parse, one, two))])
    columns = ["what", "MB", "plain parsing, one thread, ms", "validate, one thread, ms", "validate, two threads, ms"]
    write("validation", {"all": {"columns": columns, "rows": rows}}, how="least of several runs")


if __name__ == "__main__":
    main()
