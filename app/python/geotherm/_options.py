# SPDX-License-Identifier: MIT
"""Options by name, and what the build has."""

from __future__ import annotations

import ctypes
import functools
import json
from collections.abc import Mapping
from typing import Any

from geotherm._library import Handle, call, create, text_bytes


def text_of(value: Any) -> str:
    """A value as the program reads it."""
    if isinstance(value, bool):
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
