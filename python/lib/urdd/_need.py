"""Optional dependencies."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def need(module: str, extra: str, method: str) -> Any:
    """Imports a module; the error says how to install it."""
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name != module.split(".")[0]:
            raise
        raise ModuleNotFoundError(
            f"`{method}` needs the package `{module}`, which is not installed: pip install 'urdd[{extra}]'", name=module
        ) from None
