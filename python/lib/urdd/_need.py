"""Packages that only a part of this one needs."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def need(module: str, extra: str, method: str) -> Any:
    """Imports a module, and says how to get it where it is not there."""
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name != module.split(".")[0]:
            raise
        raise ModuleNotFoundError(
            f"`{method}` needs the package `{module}`, which is not installed: pip install 'urdd[{extra}]'", name=module
        ) from None
