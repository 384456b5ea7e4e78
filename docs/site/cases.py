"""The cases of a rule, from conformance/cases and conformance/computed: what changes, and what a validator must say."""

from __future__ import annotations

import json
from base64 import b64decode
from pathlib import Path
from typing import Any

from text import code

SHOWN = 8


def section(suite: Path, rule: str) -> str:
    """The cases of a rule as Markdown: the invalid ones, then the near misses."""
    files = [suite / folder / f"{rule}.json" for folder in ("cases", "computed")]
    rules = [json.loads(path.read_text(encoding="utf-8")) for path in files if path.exists()]
    texts = [
        one(case, rule, invalid, cases["verdict"])
        for invalid in (True, False)
        for cases in rules
        for case in cases.get("invalid" if invalid else "near_misses", [])
    ]
    return "\n".join(texts)


def one(case: dict[str, Any], rule: str, invalid: bool, verdict: str) -> str:
    kind = "has the fault" if invalid else "comes near it, and is right"
    must = "must reject it" if invalid and verdict == "reject" else "must accept it"
    lines = [
        f"### {case['name'].replace('-', ' ')}",
        "",
        f"`{case['name']}` {kind}: a validator {must}. Base: `{case['base']}`.",
        "",
    ]
    if note := case.get("note"):
        lines += [note, ""]
    changes = [change for given in case.get("changes", []) for change in described(given)]
    lines += [f"- {change}" for change in changes[:SHOWN]]
    if len(changes) > SHOWN:
        lines.append(f"- and {len(changes) - SHOWN} more changes")
    if not changes:
        lines.append("- nothing is changed: the base itself is the case")
    if packed := case.get("packed"):
        lines.append("- packed as a zip archive, " + {"at_root": "at its root", "in_folder": "in a folder"}[packed])
    if kept := case.get("hashes_kept"):
        lines.append("- hashes in `urdd.json` stay as they were for " + ", ".join(map(code, kept)))
    found = [f"{rule} at {place(given)}" for given in case.get("expected", [])]
    if found:
        more = f" and {len(found) - SHOWN} more places" if len(found) > SHOWN else ""
        lines += ["", "`urdd validate` finds " + "; ".join(found[:SHOWN]) + more + "."]
    return "\n".join(lines) + "\n"


def place(finding: dict[str, Any]) -> str:
    words = [finding.get("file"), finding.get("pointer")]
    return code(" ".join(word for word in words if word)) if any(words) else "the URDD"


def described(change: dict[str, Any]) -> list[str]:
    """A change in words: those of a patch one by one."""
    # A name that is not Unicode is there as base64.
    name = change["file"]
    file = code(name if isinstance(name, str) else repr(b64decode(name["base64"])))
    match change:
        case {"patch": steps}:
            return [f"{file}: {step(given)}" for given in steps]
        case {"replace": given} | {"replace_all": given}:
            every = "every " if "replace_all" in change else ""
            return [f"{file}: {every}{code(given['from'])} becomes {code(given['by'])}"]
        case {"splice": given}:
            return [f"{file}: at byte {given['at']}, {given.get('remove', 0)} bytes are replaced"]
        case {"repeat": given}:
            return [f"{file}: {code(given['text'])}, at byte {given['at']}, is there {given['times']:,} times"]
        case {"write": text}:
            return [f"{file} becomes {code(text)}"]
        case {"write_base64": _}:
            return [f"{file} becomes other bytes"]
        case {"cut_to": size}:
            return [f"{file} is cut to {size} bytes"]
        case {"copy_of": other}:
            return [f"{file} becomes a copy of {code(other)}"]
        case {"link_to": other}:
            return [f"{file} becomes a symbolic link to {code(other)}"]
        case {"folder": _}:
            return [f"{file} becomes an empty folder"]
        case {"delete": _}:
            return [f"{file} is deleted"]
    raise ValueError(f"docs/site/cases.py does not know this change: {sorted(change)}")


def step(given: dict[str, Any]) -> str:
    where = code(given["path"])
    match given["op"]:
        case "remove":
            return f"{where} is removed"
        case "add":
            return f"{where} is added: {code(json.dumps(given['value'], ensure_ascii=False))}"
        case "replace":
            return f"{where} becomes {code(json.dumps(given['value'], ensure_ascii=False))}"
        case "move" | "copy":
            return f"{code(given['from'])} is {'moved' if given['op'] == 'move' else 'copied'} to {where}"
    raise ValueError(f"docs/site/cases.py does not know the operation {given['op']}")
