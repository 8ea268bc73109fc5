# SPDX-License-Identifier: MIT
"""Every example of the documentation runs: docstrings, and the Python of the pages."""

import doctest
import importlib
import re
from pathlib import Path

import numpy
import pytest

import geotherm

ROOT = Path(__file__).resolve().parents[2]


MODULES = ["", "._answers", "._directions", "._domains", "._models", "._options", "._solver"]


@pytest.mark.parametrize("module", MODULES)
def test_docstrings(module, solver):
    known = {"geotherm": geotherm, "numpy": numpy, "solver": solver, "mesh": solver.model}
    tested = importlib.import_module("geotherm" + module)
    failed, tried = doctest.testmod(tested, extraglobs=known)
    assert tried > 0 and failed == 0


def blocks(page):
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


def test_the_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    geotherm.read("bunny").write("bunny.ply")
    names = {"__name__": "__page__"}
    assert len(blocks("python.md")) >= 5
    for block in blocks("python.md"):
        exec(compile(block, "docs/python.md", "exec"), names)


def test_every_public_name_has_a_docstring():
    for name in geotherm.__all__:
        thing = getattr(geotherm, name)
        assert thing.__doc__, name
        for part, value in vars(thing).items() if isinstance(thing, type) else ():
            if not part.startswith("_") and callable(value):
                assert value.__doc__, f"{name}.{part}"
