"""Reading of modules; `urdd.modules` has a property for each."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, TypeVar

from . import _urdd
from .errors import ModuleUnusableError

_T = TypeVar("_T")


class Reading:
    """The modules of a URDD as documents. Each is read on first use."""

    def __init__(self, core: _urdd.Robot) -> None:
        self._core = core
        self._known: dict[str, Any] = {}

    def names(self) -> list[str]:
        """The names of the modules in the URDD, in the order of the specification."""
        return self._core.module_names()

    def version(self, name: str) -> str:
        """The version of a module."""
        return self._core.module(name)[0]

    def json(self, name: str) -> Any:
        """The unmodified document of a module of any version: dictionaries, lists, numbers, texts."""
        return json.loads(self._core.module(name)[2])

    def _read(self, name: str, make: Callable[[Any], _T]) -> _T:
        if name not in self._known:
            version, is_legacy, text = self._core.module(name)
            if is_legacy:
                raise ModuleUnusableError(
                    f"{name} has version {version}, from before version 1, which has no type here: "
                    f"`modules.json({name!r})` returns its document",
                    name,
                )
            self._known[name] = make(json.loads(text))
        found: _T = self._known[name]
        return found

    def __repr__(self) -> str:
        return f"<urdd.Modules: {', '.join(self.names())}>"
