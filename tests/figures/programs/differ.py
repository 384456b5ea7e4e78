"""What a program made of a changed file, beside what is meant: the facts that differ."""

from __future__ import annotations

import itertools
import math
import re

Facts = dict[str, str]
PART = re.compile(r"(.*/(?:visual|collision))/(\d+)(/.*)?")
COUNT = re.compile(r".*/(?:visual|collision)")
NAMED = re.compile(
    r"(link|joint)/.*?(/(?:inertial|visual|collision|parent|child|origin|axis|lower|upper|velocity|effort|acceleration"
    r"|deceleration|jerk|damping|friction|mimic|safety|calibration)(?:/.*)?)?",
    re.DOTALL,
)
SHARED = {"robot", "link", "joint", "material", "transmission", "frame"}


def differences(base: Facts, meant_base: Facts, means: dict[str, str | None], kinds: set[str], got: Facts) -> list[str]:
    """`-KEY` for what is missing, `-KEY/` with all that is below it, `KEY=VALUE` for what is otherwise or not meant.

    `base` is what the program shows of the unchanged file, `kinds` the kinds of facts that it ever shows.
    """
    base, got = shared(base), shared(got)
    expected, free = dict(base), set[str]()
    for key, value in means.items():
        if key in base and not same(key, base[key], meant_base.get(key, "")):
            free.add(key)  # the program has words of its own
            continue
        if value is None:
            expected.pop(key, None)
        elif key in base or (key not in meant_base and kind(key) in kinds):
            expected[key] = value
        else:
            free.add(key)  # the program does not show it
    # A part that is gone takes along what only the program shows of it.
    for key in [key for key, value in means.items() if value is None]:
        for below in [other for other in expected if other.startswith(f"{key}/") and other not in means]:
            if not COUNT.fullmatch(key) and key not in free:
                del expected[below]
                free.add(below)
    found, got = align(expected, got)
    missing = {key for key in expected if key not in got and key not in free}
    for key in sorted(got):
        if key in free or key in missing:
            continue
        if key in expected:
            if not same(key, expected[key], got[key]):
                found.append(f"{key}={got[key]}")
        elif (
            not is_default(got[key])
            and not is_inertial_of_nothing(key, got)
            and not (PART.fullmatch(key) and is_beyond(key, expected))
            and (key in means or kind(key) in kinds)
        ):
            found.append(f"{key}={got[key]}")
    return found + shortened(missing, expected, got)


def shared(facts: Facts) -> Facts:
    """Without counts of 0, and without what is not among the facts that all programs share."""
    return {
        key: value for key, value in facts.items() if is_shared(key) and not (value == "0" and COUNT.fullmatch(key))
    }


def is_shared(key: str) -> bool:
    part = PART.fullmatch(key)
    if part:
        return part[3] in {"/geometry", "/origin", "/name", "/color", "/texture"}
    first = key.split("/")[0]
    return first in SHARED and not (first == "material" and key.endswith("/texture"))


def kind(key: str) -> str:
    """`link/*/visual/*/origin`: the first word, and what follows the name."""
    if match := NAMED.fullmatch(key):
        return f"{match[1]}/*" + re.sub(r"/\d+(?=/|$)", "/*", match[2] or "")
    return key.split("/")[0] + ("/*" if "/" in key else "")


def is_beyond(key: str, expected: Facts) -> bool:
    match = PART.fullmatch(key)
    return bool(match) and int(match[2]) >= int(expected.get(match[1], "0"))


def is_default(value: str) -> bool:
    return value in {"", "inf", "-inf"} or all(part in {"0", "-0"} for part in value.split())


def is_inertial_of_nothing(key: str, got: Facts) -> bool:
    """Some programs have an inertial for every link: one without mass is none."""
    return key.endswith("/inertial") and is_default(got.get(f"{key}/mass", "0"))


def floats(value: str) -> list[float] | None:
    try:
        return [float(part) for part in value.split()]
    except ValueError:
        return None


def same(key: str, first: str, second: str) -> bool:
    if first == second:
        return True
    last = key.rsplit("/", 1)[-1]
    if last == "texture" or key.startswith("material/"):
        first, second = first.rsplit("/", 1)[-1], second.rsplit("/", 1)[-1]
    words = first.split(" ", 1), second.split(" ", 1)
    if last == "geometry" and words[0][0] == words[1][0] and len(words[0]) == len(words[1]) == 2:
        first, second = words[0][1], words[1][1]
        if words[0][0] == "mesh":
            (first_file, *first_scale), (second_file, *second_scale) = (text.rsplit(" ", 3) for text in (first, second))
            if first_file.rsplit("/", 1)[-1] != second_file.rsplit("/", 1)[-1]:
                return False
            first, second = " ".join(first_scale), " ".join(second_scale)
    if last == "mimic":
        (first_joint, *first_rest), (second_joint, *second_rest) = (text.rsplit(" ", 2) for text in (first, second))
        if first_joint != second_joint:
            return False
        first, second = " ".join(first_rest), " ".join(second_rest)
    a, b = floats(first), floats(second)
    if a is None or b is None:
        return first == second
    if len(a) != len(b):
        return False
    if last == "axis":
        a, b = unit(a), unit(b)
    if last == "origin" and len(a) == 7:
        turned = sum(x * y for x, y in zip(a[3:], b[3:], strict=True))
        return close(a[:3], b[:3]) and abs(abs(turned) - 1) < 1e-5
    return close(a, b)


def unit(values: list[float]) -> list[float]:
    norm = math.sqrt(sum(value * value for value in values))
    return [value / norm for value in values] if norm and math.isfinite(norm) else values


def close(first: list[float], second: list[float]) -> bool:
    size = max((abs(value) for value in [*first, *second] if math.isfinite(value)), default=0)
    for a, b in zip(first, second, strict=True):
        if a == b or (math.isnan(a) and math.isnan(b)):
            continue
        if not abs(a - b) <= 1e-6 + 2e-5 * size:
            return False
    return True


def align(expected: Facts, got: Facts) -> tuple[list[str], Facts]:
    """Where the program has fewer visuals or collisions of a link: which are gone, and the others as numbered here."""
    found = []
    for key in sorted(key for key in expected if COUNT.fullmatch(key)):
        many, few = expected[key], got.get(key, "0")
        if not (many.isdigit() and few.isdigit()) or not 0 < int(few) < int(many) <= 8:
            continue
        best: tuple[int, tuple[int, ...], Facts] | None = None
        for kept in itertools.combinations(range(int(many)), int(few)):
            moved = renumbered(got, key, kept)
            wrong = sum(
                not same(name, expected[name], value)
                for name, value in moved.items()
                if name in expected and name.startswith(f"{key}/")
            )
            if best is None or wrong < best[0]:
                best = wrong, kept, moved
        if best:
            got = best[2] | {key: many}
            for i in range(int(many)):
                if i not in best[1]:
                    found.append(f"-{key}/{i}/")
                    got |= {name: expected[name] for name in expected if name.startswith(f"{key}/{i}/")}
    return found, got


def renumbered(facts: Facts, key: str, numbers: tuple[int, ...]) -> Facts:
    made = {}
    for name, value in facts.items():
        match = PART.fullmatch(name)
        if match and match[1] == key and int(match[2]) < len(numbers):
            name = f"{key}/{numbers[int(match[2])]}{match[3] or ''}"
        made[name] = value
    return made


def shortened(missing: set[str], expected: Facts, got: Facts) -> list[str]:
    """Missing facts, with one `-KEY/` where all that is below KEY is missing."""
    present = {top for key in expected if key in got for top in above(key)}
    tops = {top for key in missing for top in above(key) if top in expected or PART.fullmatch(top)}
    found, left = [], set(missing)
    for top in sorted(tops - present, key=lambda top: (len(top), top)):
        below = {key for key in left if key == top or key.startswith(f"{top}/")}
        if len(below) > 1:
            found.append(f"-{top}/")
            left -= below
    return found + [f"-{key}" for key in sorted(left)]


def above(key: str) -> list[str]:
    """A key, and those that it is below."""
    parts = key.split("/")
    return ["/".join(parts[: count + 1]) for count in range(len(parts))]
