# SPDX-License-Identifier: MIT
"""What the tests share: the bundled rabbit and a solver on it."""

import os
import subprocess
from pathlib import Path

import pytest

import geotherm


@pytest.fixture(scope="session")
def bunny():
    return geotherm.read("bunny")


@pytest.fixture(scope="session")
def solver(bunny):
    return geotherm.Solver(bunny)


@pytest.fixture(scope="session")
def program():
    """Runs the command line of this build; skips where there is none."""
    path = Path(os.environ["GEOTHERM_BUILD"]) / "geotherm"
    if not path.exists():
        pytest.skip("this build has no command line")

    def run(*arguments):
        subprocess.run([path, *map(str, arguments), "--quiet"], check=True, capture_output=True)

    return run
