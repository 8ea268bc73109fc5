# SPDX-License-Identifier: MIT
"""What the tests share: the bundled rabbit and a solver on it."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import geotherm


@pytest.fixture(scope="session")
def bunny():
    return geotherm.read("bunny")


@pytest.fixture(scope="session")
def solver(bunny):
    return geotherm.Solver(bunny)


@pytest.fixture(scope="session")
def torus():
    """V and F of a torus of 24 x 12 planar quads in triangles, three vertices round its tube, and the
    length of the shortest loop there: the section midway between two rings of vertices, where the
    surface is its own mirror image; a loop's length is convex in where it crosses the edges."""
    around, tube = 24, 12
    a, b = np.meshgrid(np.arange(around), np.arange(tube), indexing="ij")
    phi, theta = 2 * np.pi * a / around, 2 * np.pi * b / tube
    out = 2 + np.cos(theta)
    V = np.stack([out * np.cos(phi), out * np.sin(phi), np.sin(theta)], axis=-1).reshape(-1, 3)
    here, right = a * tube + b, (a + 1) % around * tube + b
    up, both = a * tube + (b + 1) % tube, (a + 1) % around * tube + (b + 1) % tube
    F = np.concatenate([np.stack(f, -1).reshape(-1, 3) for f in ((here, right, both), (here, both, up))])
    section = np.stack([np.cos(np.pi / around) * np.cos(theta[0]), np.sin(theta[0])])
    length = np.linalg.norm(section - np.roll(section, 1, axis=1), axis=0).sum()
    return V, F, [0, tube // 3, 2 * tube // 3], length


@pytest.fixture(scope="session")
def program():
    """Runs the command line of this build; skips where there is none."""
    path = Path(os.environ["GEOTHERM_BUILD"]) / "geotherm"
    if not path.exists():
        pytest.skip("this build has no command line")

    def run(*arguments):
        subprocess.run([path, *map(str, arguments), "--quiet"], check=True, capture_output=True)

    return run
