# SPDX-License-Identifier: MIT
"""pip install without an index, in a virtual environment of its own."""

import importlib.util
import os
import re
import subprocess
import sys
import tarfile
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


@pytest.fixture
def builder():
    spec = importlib.util.spec_from_file_location("builder", ROOT / "app/python/wheel_builder.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_wheel_is_built_without_what_systems_lack(builder, monkeypatch):
    commands = []
    monkeypatch.setattr(builder.subprocess, "run", lambda command, **_: commands.append(command))
    builder._built_library({})
    configure, build = commands
    off = ("WITH_CHOLMOD", "WITH_ASSIMP", "BUILD_ENGINE", "BUILD_APP", "BUILD_TESTS", "BUILD_BENCH")
    assert {f"-DGEOTHERM_{name}=OFF" for name in off} <= {*configure}
    assert "-DGEOTHERM_FOR_WHEEL=ON" in configure and "geotherm_c" in build
    options = (ROOT / "docs/installing.md").read_text() + (ROOT / "docs/architecture.md").read_text()
    assert all(f"GEOTHERM_{name}" in options for name in off)


def test_an_sdist_has_nothing_that_was_built_or_is_hidden(builder, monkeypatch, tmp_path):
    kept = ["CMakeLists.txt", "pyproject.toml", "README.md", "LICENSE", "cmake/a.cmake", "solver/a.cpp"]
    kept += ["app/python/geotherm/__init__.py", "bench/models/a.cpp", "assets/models/a.ply"]
    strays = [".env", "__pycache__/a.pyc", "libgeotherm.so.0", "a.so", ".a.cpp.swp"]
    for name in kept + [f"{top}/{stray}" for top in ("solver", "app/python/geotherm") for stray in strays]:
        (tmp_path / "tree" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "tree" / name).write_text("project(geotherm VERSION 1.2.3\n")
    monkeypatch.setattr(builder, "_ROOT", tmp_path / "tree")
    with tarfile.open(tmp_path / builder.build_sdist(str(tmp_path))) as archive:
        files = {entry.name for entry in archive if entry.isfile()}
    assert files == {f"geotherm-1.2.3/{name}" for name in [*kept, "PKG-INFO"]}


def test_a_wheel_that_needs_more_is_refused(builder):
    every = """\tlinux-vdso.so.1 (0x1)
\tlibpng16.so.16 => /lib/x86_64-linux-gnu/libpng16.so.16 (0x2)
\tlibz.so.1 => /lib/x86_64-linux-gnu/libz.so.1 (0x3)
\tlibm.so.6 => /lib/x86_64-linux-gnu/libm.so.6 (0x4)
\tlibc.so.6 => /lib/x86_64-linux-gnu/libc.so.6 (0x5)
\t/lib64/ld-linux-x86-64.so.2 (0x6)
"""
    assert builder._not_everywhere(every) == []
    more = every + "\tlibassimp.so.5 => not found\n\tlibstdc++.so.6 => /lib/libstdc++.so.6 (0x7)\n"
    assert builder._not_everywhere(more) == ["libassimp.so.5", "libstdc++.so.6"]


def test_the_recipe_has_headers_that_are_new_enough():
    recipe = (ROOT / "scripts/wheels.sh").read_text()
    brought = dict(re.findall(r"^  headers (\w+) ([\d.]+) ", recipe, flags=re.M))
    wanted = {}
    for part in ("solver", "app"):
        text = (ROOT / part / "CMakeLists.txt").read_text()
        wanted.update(re.findall(r"find_package\((\w+) (\d[\d.]*)", text))
    assert set(wanted) == {"Eigen3", "nanoflann", "nlohmann_json"} == set(brought)
    for name, least in wanted.items():
        assert [*map(int, brought[name].split("."))] >= [*map(int, least.split("."))], name
