"""The suite's own kill rate: how many small mistakes in a validator its cases notice.

    python benches/evaluation/suite_kill_rate.py [--check] [--only 3 17] [--target DIR] [--min-rate 0.95]

Copies the sources, puts the mistakes of `suite_mistakes.py` into the copy, each behind a switch at run time, and builds
it once (`URDD_MISTAKE=17` switches the mistake 17 on). The shipped sources hold nothing of it. Then it exports the suite
and has every mistaken validator judge every URDD in it. A mistake is noticed by *verdict* where a URDD is accepted that
must be rejected, or the other way round, or where the program fails; and by *codes* where also the printed code of the
case's rule is missing, or is printed where it must not be.
`--check` only looks whether each text is still in its file. Standard library alone.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from robots import ROOT
from results import write
from suite_mistakes import MISTAKES, Mistake

#: Added to the root of each crate that has a mistake.
SWITCH = """

/// Whether this mistake is switched on.
#[doc(hidden)]
pub fn mistake(number: u32) -> bool {
    static ON: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    let on = || std::env::var("URDD_MISTAKE").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    *ON.get_or_init(on) == number
}
"""

#: Seconds for all URDDs of the suite.
LIMIT = 1800


def crate_of(file: str) -> Path:
    return Path(*Path(file).parts[:2])


def declared(text: str, name: str) -> re.Match[str] | None:
    return re.search(rf"((?:pub(?:\([a-z: ]+\))? )?)const {name}: (\w+) = ([^;]+);", text)


def stale() -> list[str]:
    """The mistakes whose text is not in its file, or more than once."""
    faults = []
    for number, mistake in enumerate(MISTAKES, 1):
        file = ROOT / mistake.file
        text = file.read_text() if file.is_file() else ""
        count = len(re.findall(rf"const {mistake.right}: ", text)) if mistake.is_constant else text.count(mistake.right)
        if count != 1:
            faults.append(f"{number} ({mistake.what}): {count} times in {mistake.file}")
    return faults


def make_function(sources: dict[Path, str], number: int, mistake: Mistake) -> None:
    """Turns a constant into a function, and its uses into calls."""
    name = mistake.right
    home = Path(mistake.file)
    found = declared(sources[home], name)
    assert found, name
    function = (
        f"#[allow(non_snake_case, missing_docs)]\n{found[1]}fn {name}() -> {found[2]} {{\n"
        f"    if crate::mistake({number}) {{ {mistake.wrong} }} else {{ {found[3]} }}\n}}"
    )
    for path, text in sources.items():
        if not path.is_relative_to(crate_of(mistake.file) / "src"):
            continue
        if not re.search(rf"\b{name}\b", text) or (path != home and re.search(rf"const {name}: ", text)):
            continue
        if path == home:
            text = text.replace(found[0], "@DECLARATION@")
        imports = re.compile(r"^(?:pub(?:\([a-z: ]+\))? )?use [^;]+;", re.M)
        kept: list[str] = imports.findall(text)
        text = imports.sub("@IMPORT@", text)
        lines = [
            line if line.lstrip().startswith("//") else re.sub(rf"(?<!\{{)\b{name}\b(?!\(|\}})", f"{name}()", line)
            for line in text.split("\n")
        ]
        text = "\n".join(lines)
        # In a format string a name stands for its value, and a call does not.
        text = text.replace(f"{{{name}}}", "…")
        for line in kept:
            text = text.replace("@IMPORT@", line, 1)
        sources[path] = text.replace("@DECLARATION@", function)


def build(tree: Path, target: Path) -> Path:
    """A copy of the sources with all mistakes in it, built; the program. Files that are right already stay untouched, so
    that a second build compiles what changed."""
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True, capture_output=True
    ).stdout.decode()
    files = {Path(name): (ROOT / name).read_bytes() for name in filter(None, listed.split("\0")) if (ROOT / name).is_file()}
    sources = {path: files.pop(path).decode() for path in list(files) if path.suffix == ".rs"}
    for number, mistake in enumerate(MISTAKES, 1):
        if not mistake.is_constant:
            wrong = f"(if crate::mistake({number}) {{ {mistake.wrong} }} else {{ {mistake.right} }})"
            path = Path(mistake.file)
            sources[path] = sources[path].replace(mistake.right, wrong, 1)
    for number, mistake in enumerate(MISTAKES, 1):
        if mistake.is_constant:
            make_function(sources, number, mistake)
    for crate in {crate_of(mistake.file) for mistake in MISTAKES}:
        sources[crate / "src" / "lib.rs"] += SWITCH
    files.update((path, text.encode()) for path, text in sources.items())
    for path in [path for path in tree.rglob("*") if path.is_file() or path.is_symlink()]:
        if path.relative_to(tree) not in files:
            path.unlink()
    for name, content in files.items():
        path = tree / name
        if not path.is_file() or path.read_bytes() != content:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    command = ["cargo", "build", "--locked", "--quiet", "--bin", "urdd"]
    environment = {**os.environ, "CARGO_TARGET_DIR": str(target), "RUSTFLAGS": ""}
    run = subprocess.run(command, cwd=tree, env=environment, stderr=subprocess.PIPE, text=True)
    if run.returncode != 0:  # Only then: a mistake is written in brackets, which not every place needs.
        sys.exit(run.stderr)
    return target / "debug" / "urdd"


def judged(urdd: Path, suite: Path, cases: list[dict], number: int) -> dict[str, tuple[str, set[str]]] | None:
    """Verdict and codes of each case; nothing if the program fails."""
    folders = [case["folder"] for case in cases]
    command = [str(urdd), "validate", "--quiet", "--format", "json", *folders]
    environment = {**os.environ, "URDD_MISTAKE": str(number)}
    try:
        run = subprocess.run(command, cwd=suite, capture_output=True, env=environment, timeout=LIMIT)
        report = json.loads(run.stdout)
    except (subprocess.TimeoutExpired, json.JSONDecodeError):
        return None
    if run.returncode not in (0, 1) or len(report["urdds"]) != len(cases):
        return None
    # In the order in which they were given; the run without a mistake would show any other.
    return {
        case["id"]: (
            "reject" if any(finding["severity"] == "error" for finding in urdd["findings"]) else "accept",
            {finding["code"] for finding in urdd["findings"]},
        )
        for case, urdd in zip(cases, report["urdds"])
    }


def faults(cases: list[dict], found: dict[str, tuple[str, set[str]]] | None) -> tuple[list[str], list[str]]:
    """The cases whose verdict is wrong, and those whose code or verdict is."""
    if found is None:
        return ["the program failed"], ["the program failed"]
    by_verdict, by_code = [], []
    for case in cases:
        verdict, codes = found[case["id"]]
        wrong = verdict != case["verdict"]
        if wrong:
            by_verdict.append(case["id"])
        if wrong or (case["code"] and (case["code"] in codes) != (case["kind"] == "invalid")):
            by_code.append(case["id"])
    return by_verdict, by_code


def stage(case: dict, family: str) -> int:
    """When a case is tried: those of the mistake's family first, those that take most of the time last."""
    if (case["code"] or "").startswith(family):
        return 0
    return 2 if case["id"].startswith(("LRN", "DIR030")) or "urdf-bytes" in case["id"] else 1


def tried(urdd: Path, suite: Path, cases: list[dict], number: int) -> tuple[list[str], list[str]]:
    """The cases that notice a mistake, by verdict and by codes. Those of its family are tried first, the rest only where
    none of them notices it: by verdict it may be more. All are tried before a mistake survives."""
    by_verdict: list[str] = []
    by_code: list[str] = []
    family = MISTAKES[number - 1].family if number else ""
    for now in range(3):
        chosen = [case for case in cases if stage(case, family) == now]
        if chosen and not by_code:
            more = faults(chosen, judged(urdd, suite, chosen, number))
            by_verdict, by_code = by_verdict + more[0], by_code + more[1]
    return by_verdict, by_code


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only look whether each text is still in its file")
    parser.add_argument("--only", type=int, nargs="+", default=[], help="numbers of mistakes; nothing is written then")
    parser.add_argument("--target", type=Path, default=ROOT / "target" / "suite_kill_rate", help="target directory")
    parser.add_argument("--min-rate", type=float, default=0.0, help="exit with 1 below this share, by codes")
    given = parser.parse_args()
    if stale():
        sys.exit("not in its file exactly once; adapt suite_mistakes.py:\n" + "\n".join(stale()))
    if given.check:
        return
    work = ROOT / "target" / "suite_kill_rate_tree"
    urdd = build(work, given.target.resolve())
    suite = ROOT / "target" / "suite_kill_rate_cases"
    shutil.rmtree(suite, ignore_errors=True)
    subprocess.run([urdd, "conformance", "export", suite], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    cases = json.loads((suite / "suite.json").read_text())["cases"]
    _, wrong = tried(urdd, suite, cases, 0)
    if wrong:
        sys.exit(f"judged wrong without any mistake: {', '.join(wrong)}")
    counts = {group: {"verdict": 0, "codes": 0, "of": 0} for group in ("before", "after")}
    survivors = []
    for number, mistake in enumerate(MISTAKES, 1):
        if given.only and number not in given.only:
            continue
        by_verdict, by_code = tried(urdd, suite, cases, number)
        how = "verdict" if by_verdict else "codes" if by_code else "survives"
        first = (by_verdict or by_code or [mistake.equivalent or "a gap"])[0]
        print(f"{number:3} {mistake.family} {mistake.what}: {how} ({len(by_verdict)}, {len(by_code)}), {first}", flush=True)
        if mistake.equivalent:
            assert not by_code, f"{number} is noticed: it is not equivalent"
            survivors.append(f"{mistake.what}: {mistake.equivalent}")
            continue
        counts[mistake.group]["of"] += 1
        counts[mistake.group]["verdict"] += bool(by_verdict)
        counts[mistake.group]["codes"] += bool(by_code)
    total = {key: sum(group[key] for group in counts.values()) for key in ("verdict", "codes", "of")}
    print(total, counts)
    if not given.only:
        items = {
            "cases": f"{len(cases):,}",
            "mistakes": str(len(MISTAKES)),
            "equivalent": str(len(survivors)),
            "by_verdict": f"{total['verdict']} of {total['of']}",
            "by_codes": f"{total['codes']} of {total['of']}",
        }
        write("suite_kill_rate", items, "urdd of these sources", how="cases of a mistake's family first, the others where none of them notices it")
    if total["codes"] < given.min_rate * total["of"]:
        sys.exit("too few mistakes are noticed")


if __name__ == "__main__":
    main()
