#!/usr/bin/env python3
"""How often each rule of `urdd lint` finds something on a corpus of URDFs (corpus.md), and how often it is right.

    python3 benches/evaluation/lint/corpus.py target/release/urdd FOLDER [FINDINGS.jsonl]

FOLDER has a folder for each package. Verdicts and their intervals are those of evidence.md, which were given on the findings
of prototype.py; those of the second judge are of second_judge.jsonl, as far as the program still has the finding. Writes benches/results/lint.json, and every finding as a JSON line if a file is named.
"""

from __future__ import annotations

import collections
import json
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import results  # noqa: E402

HERE = Path(__file__).resolve().parent
ROW = re.compile(r"\| (LNT\d{3}) \| \S+ \| .* \| (\d+ of \d+ \(\d+\)|none) \| ?(\d+ to \d+)? ?\|")


def verdicts() -> dict[str, tuple[str, str]]:
    """Rule -> how many of the judged findings are right, of how many packages, and the interval in percent."""
    rows = ROW.finditer((HERE / "evidence.md").read_text("utf-8"))
    return {row[1]: (row[2], row[3] or "") for row in rows}


# Findings that stand at another place of the file since they were judged.
MOVED = {"LNT003", "LNT020", "LNT050"}


def second_verdicts(lines: list[dict[str, str | None]]) -> dict[str, str]:
    """Rule -> how many of the findings that the second judge saw, and that are still found, are right."""
    # Findings in other files than the URDF have no subject.
    now = {(line["code"], line["file"], line["subject"]) for line in lines}
    said = {(line["code"], line["file"], line["message"]) for line in lines}
    files = {(line["code"], line["file"]) for line in lines}
    counts: dict[str, collections.Counter[str]] = collections.defaultdict(collections.Counter)
    for row in (HERE / "second_judge.jsonl").read_text("utf-8").splitlines():
        judged = json.loads(row)
        code, file = judged["code"], judged["file"]
        if "message" in judged:
            is_there = (code, file, judged["message"]) in said
        else:
            is_there = (code, file, judged["subject"]) in now
        if is_there or (code in MOVED and (code, file) in files):
            counts[code][judged["verdict"]] += 1

    def text(count: collections.Counter[str]) -> str:
        rest = [f"{count[kind]} {kind}" for kind in ("wrong", "unsure") if count[kind]]
        return ", ".join([f"{count['right']} of {count.total()}", *rest])

    return {code: text(count) for code, count in counts.items()}


def processor_time() -> float:
    """Seconds that the programs that were run have used. Unlike those on the clock, they hardly depend on what else runs."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    program, corpus = sys.argv[1], Path(sys.argv[2])
    explained = subprocess.run([program, "explain", "LNT", "--format", "json"], check=True, capture_output=True)
    rules = json.loads(explained.stdout)
    found: dict[str, list[tuple[str, str]]] = collections.defaultdict(list)
    files, lines, seconds = [], [], 0.0
    with tempfile.TemporaryDirectory() as folder:
        settings = Path(folder) / "urdd.toml"
        off = [rule["code"] for rule in rules if not rule["on_by_default"]]
        settings.write_text("[severity]\n" + "".join(f'{code} = "info"\n' for code in off))
        for package in sorted(path for path in corpus.iterdir() if path.is_dir()):
            began = processor_time()
            command = [program, "lint", "--format", "json", "--config", str(settings), str(package)]
            ran = subprocess.run(command, capture_output=True, text=True)
            if not ran.stdout:
                continue  # no URDF
            seconds += processor_time() - began
            for urdf in json.loads(ran.stdout)["urdds"]:
                if urdf["verdict"] == "incomplete":
                    sys.exit(f"{package.name}/{urdf['path']}: {urdf['reason'] or 'a rule crashed'}")
                file = f"{package.name}/{urdf['path']}"
                files.append(file)
                for finding in urdf["findings"]:
                    for place in finding["places"]:
                        found[finding["code"]].append((package.name, file))
                        message = place["message"] or finding["message"]
                        lines.append({"file": file, "code": finding["code"], "subject": place["subject"], "message": message})
    judged, second = verdicts(), second_verdicts(lines)
    rows = []
    for rule in rules:
        of = found[rule["code"]]
        right, interval = judged.get(rule["code"], ("none", ""))
        rows.append([
            f"{rule['code']} {rule['name']}",
            rule["severity"] if rule["on_by_default"] else "off",
            f"{len(of):,}",
            f"{len({file for _, file in of}):,}",
            str(len({package for package, _ in of})),
            right,
            f"{interval} %" if interval else "none",
            second.get(rule["code"], "none"),
        ])
    columns = ["rule", "default", "findings", "URDFs", "packages", "right of judged (packages)", "95 % interval", "right, second judge"]
    packages = len({file.split("/")[0] for file in files})
    items: dict[str, results.Table | str] = {
        "rules": {"columns": columns, "rows": rows},
        "corpus": f"{len(files):,} URDFs of {packages} packages",
        "time": f"{seconds:.0f} s of processor time",
    }
    results.write("lint", items, "urdd " + subprocess.check_output([program, "--version"], text=True).split()[-1])
    if len(sys.argv) > 3:
        Path(sys.argv[3]).write_text("".join(json.dumps(line) + "\n" for line in lines))


if __name__ == "__main__":
    main()
