# SPDX-License-Identifier: MIT
"""pip install without an index, in a virtual environment of its own."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CODE = """
import geotherm
assert "site-packages" in geotherm.__file__, geotherm.__file__
print(geotherm.__version__, geotherm.Solver(geotherm.read("bunny")).distance(17)[17])
"""


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    pytest.importorskip("ensurepip")
    place = tmp_path_factory.mktemp("environment")
    made = subprocess.run(
        [sys.executable, "-m", "venv", "--system-site-packages", place], capture_output=True
    )
    if made.returncode != 0:
        pytest.skip("python3-venv is not installed")
    return place


def clean():
    names = ("PYTHONPATH", "GEOTHERM_LIBRARY")
    return {key: value for key, value in os.environ.items() if key not in names}


def test_one_wheel_installs_and_runs(environment, tmp_path):
    library = f"library={os.environ['GEOTHERM_LIBRARY']}"
    pip = [environment / "bin/pip", "--disable-pip-version-check"]
    offline = ["--no-index", "--no-deps", "--config-settings", library]
    subprocess.run(
        [*pip, "wheel", *offline, "-w", tmp_path, ROOT], check=True, capture_output=True, env=clean()
    )
    (wheel,) = tmp_path.iterdir()
    assert "-py3-none-" in wheel.name
    names = zipfile.ZipFile(wheel).namelist()
    assert {"geotherm/py.typed", "geotherm/libgeotherm.so.0", "geotherm/models/bunny.ply"} <= {*names}
    assert not any("__pycache__" in name for name in names)
    subprocess.run(
        [*pip, "install", "--no-index", wheel], check=True, capture_output=True, env=clean()
    )
    said = subprocess.run(
        [environment / "bin/python", "-c", CODE],
        check=True,
        capture_output=True,
        text=True,
        env=clean(),
        cwd=tmp_path,
    )
    assert said.stdout.split()[1] == "0.0"
    check = [environment / "bin/pip", "check"]
    assert b"geotherm" not in subprocess.run(check, capture_output=True, env=clean()).stdout
