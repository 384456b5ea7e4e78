"""What a plain scalar of YAML means to readers of 1.1 and of 1.2 (3.2.3)."""

from __future__ import annotations

import re
from typing import Any

from .jsontext import TextFault

NULL = re.compile(r"~|null|Null|NULL|")
TRUE = re.compile(r"true|True|TRUE")
FALSE = re.compile(r"false|False|FALSE")
INT_12 = re.compile(r"[-+]?[0-9]+")
FLOAT_12 = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
HEXADECIMAL = re.compile(r"0x[0-9a-fA-F]+")
OCTAL_12 = re.compile(r"0o[0-7]+")
INFINITE = re.compile(r"[-+]?\.(inf|Inf|INF)")
NOT_A_NUMBER = re.compile(r"\.(nan|NaN|NAN)")
INT_11 = re.compile(r"[-+]?(0|[1-9][0-9]*)")
OCTAL_11 = re.compile(r"[-+]?0[0-7]+")
FLOAT_11 = re.compile(r"([-+]?[0-9]+\.[0-9]*|\.[0-9]+)([eE][-+][0-9]+)?")
# To readers of 1.1 these are booleans, binary, sexagesimal or underscored numbers, dates, merge
# keys and default values: none of them means the same to a reader of 1.2.
ONLY_11 = re.compile(
    r"[yYnN]|yes|Yes|YES|no|No|NO|on|On|ON|off|Off|OFF|<<|="
    r"|[-+]?0b[01_]+|[-+]0x[0-9a-fA-F_]+|0x[0-9a-fA-F_]*_[0-9a-fA-F_]*"
    r"|[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+(\.[0-9_]*)?"
    r"|[-+]?[0-9][0-9_]*_[0-9_]*|[-+]?[0-9][0-9_]*\.[0-9_]*_[0-9_]*([eE][-+][0-9]+)?"
    r"|[-+]?[0-9][0-9]*_[0-9_]*\.[0-9_]*([eE][-+][0-9]+)?"
    r"|\.[0-9_]*_[0-9_]*([eE][-+][0-9]+)?"
    r"|[0-9]{4}-[0-9]{2}-[0-9]{2}"
    r"|[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}([Tt]|[ \t]+)[0-9]{1,2}:[0-9]{2}:[0-9]{2}(\.[0-9]*)?"
    r"([ \t]*(Z|[-+][0-9]{1,2}(:[0-9]{2})?))?"
)


def meaning_12(text: str) -> Any:
    """The value to a reader of YAML 1.2, by its core schema."""
    if NULL.fullmatch(text):
        return None
    if TRUE.fullmatch(text) or FALSE.fullmatch(text):
        return bool(TRUE.fullmatch(text))
    if HEXADECIMAL.fullmatch(text):
        return int(text, 16)
    if OCTAL_12.fullmatch(text):
        return int(text, 8)
    if INT_12.fullmatch(text):
        return int(text)
    if FLOAT_12.fullmatch(text):
        return float(text)
    if INFINITE.fullmatch(text) or NOT_A_NUMBER.fullmatch(text):
        return float(text.replace(".", ""))
    return text


def meaning_11(text: str) -> Any:
    """The value to PyYAML's `SafeLoader`, of what ONLY_11 does not have."""
    if NULL.fullmatch(text) or TRUE.fullmatch(text) or FALSE.fullmatch(text):
        return meaning_12(text)
    if HEXADECIMAL.fullmatch(text):
        return int(text, 16)
    if INT_11.fullmatch(text):
        return int(text)
    if OCTAL_11.fullmatch(text):
        return int(text, 8)
    if FLOAT_11.fullmatch(text):
        return float(text)
    if INFINITE.fullmatch(text) or NOT_A_NUMBER.fullmatch(text):
        return meaning_12(text)
    return text


def plain_value(text: str) -> Any:
    """The value of a plain scalar, the same to all readers (YML006 otherwise)."""
    if ONLY_11.fullmatch(text):
        raise TextFault("YML006")
    value = meaning_12(text)
    other = meaning_11(text)
    if repr(value) != repr(other):
        raise TextFault("YML006")
    return value
