"""One page a rule, and the list of all."""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import Any

import cases
import trials
from spec import with_links
from text import table

Rule = dict[str, Any]


def badge(severity: str) -> str:
    return f'<span class="severity {severity}">{severity}</span>'


def pages(rules: list[Rule], known: set[str], root: Path) -> dict[str, str]:
    """All pages by name."""
    codes = {rule["code"] for rule in rules}
    made = {f"rules/{rule['code']}.md": page(rule, known, codes, root) for rule in rules}
    made["rules/README.md"] = index(rules)
    return made


def page(rule: Rule, known: set[str], codes: set[str], root: Path) -> str:
    explanation = with_links(rule["explanation"], known, codes - {rule["code"]}, "../SPEC.md", "")
    number = rule["clause"]
    clause = f"[SPEC {number}](../SPEC.md#{number})" if number in known else f"SPEC {number}"
    if number is None:
        clause = "[about URDFs](../docs/lint.md)" + ("" if rule["on_by_default"] else ", off by default")
    effect = f"; concerns *{rule['consequence']}*" if rule["consequence"] else ""
    found = cases.section(root / "conformance", rule["code"])
    head = f"---\ntitle: {rule['code']} {rule['name']}\nsearch:\n  boost: 4\n---\n"
    facts = f"{badge(rule['severity'])} {clause}; since urdd {rule['since']}{effect}"
    family = rule["family"]
    belongs = f"[{family['code']}, {family['name']}](README.md#{anchor(family)})"
    what = f"{facts}; of the family {belongs}\n\n{explanation}\n{trials.link(root, rule['code'])}"
    text = f"{head}\n# {rule['code']} {rule['name']}\n\n{what}"
    if found:
        text += (
            "\n## Cases\n\nFrom the [conformance suite](../conformance/README.md): a base, which is a valid URDD, and "
            f"what is changed in it.\n\n{found}"
        )
    return text


def title(family: dict[str, str]) -> str:
    """The heading of a family."""
    name = family["name"]
    return f"{name[0].upper()}{name[1:]} ({family['code']})"


def anchor(family: dict[str, str]) -> str:
    """That of its heading."""
    return re.sub(r"[^\w-]", "", title(family).lower().replace(" ", "-"))


def index(rules: list[Rule]) -> str:
    parts = [
        "# Rules\n\nEvery rule of `urdd validate` and `urdd lint`, by family. `urdd explain DOF003` prints the same. A "
        "*MUST* of the specification that fails is an error, a *SHOULD* that fails is a warning.\n"
    ]
    for family, members in itertools.groupby(rules, key=lambda rule: rule["family"]):
        rows = [
            [f"[{rule['code']}]({rule['code']}.md)", badge(rule["severity"]), f"`{rule['name']}`", rule["summary"]]
            for rule in members
        ]
        parts.append(
            f"\n## {title(family)}\n\n{family['about']}\n\n" + table(["code", "severity", "name", "what"], rows)
        )
    return "".join(parts)
