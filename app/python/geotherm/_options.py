# SPDX-License-Identifier: MIT
"""Options by name, and what the build has."""

from __future__ import annotations

import ctypes
import difflib
import functools
import inspect
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from geotherm._library import Handle, call, create, text_bytes


def text_of(value: Any) -> str:
    """A value as the program reads it."""
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    return repr(value) if type(value) is float else str(value)


def options_of(settings: Mapping[str, Any]) -> Handle:
    """geotherm_options with the settings that are not None; names have _ in place of -."""
    options = create("options_new")
    for name, value in settings.items():
        if value is None:
            continue
        text = text_of(value)
        name = name.replace("_", "-")
        call("options_set", options.value, text_bytes(name, "option"), text_bytes(text, name))
    return options


@functools.lru_cache(maxsize=None)
def _features_text() -> str:
    text = ctypes.c_char_p()
    call("features", ctypes.byref(text))
    return (text.value or b"").decode()


def features() -> dict[str, Any]:
    """What this build has: version, methods, backends, formats, bundled models, settings.

    >>> "heat" in geotherm.features()["methods"]
    True
    """
    found: dict[str, Any] = json.loads(_features_text())
    return found


_OF_SOLVER = ("method", "check")


def options() -> dict[str, dict[str, Any]]:
    """The options of Solver() (groups "method" and "check") and of read() ("model") by keyword:
    group, help, default, values.

    >>> geotherm.options()["heat"]["values"]
    ['unit', 'diffuse', 'hold']
    """
    return {setting["name"].replace("-", "_"): setting for setting in features()["settings"]}


def given_options(function: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """Those of read() or Solver() that are not None. Raises: TypeError (no such option)."""
    groups = ("model",) if function == "read" else _OF_SOLVER
    names = [name for name, setting in options().items() if setting["group"] in groups]
    for name in given:
        if name not in names:
            near = difflib.get_close_matches(name, names, 1)
            hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(names)}"
            raise TypeError(f"{function}() has no option {name!r}; {hint}")
    return {name: value for name, value in given.items() if value is not None}


class SolverSignature:
    """What inspect and help() show of Solver(): the options by name, with their defaults."""

    def __get__(self, instance: object, owner: type) -> inspect.Signature:
        keyword, Parameter = inspect.Parameter.KEYWORD_ONLY, inspect.Parameter
        shown = [Parameter("model", Parameter.POSITIONAL_OR_KEYWORD)]
        for name, setting in options().items():
            if setting["group"] in _OF_SOLVER:
                shown.append(Parameter(name, keyword, default=setting["default"]))
        return inspect.Signature([*shown, Parameter("progress", keyword, default=None)])
