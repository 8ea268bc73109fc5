# SPDX-License-Identifier: MIT
"""Inside of what shares work out, and under the type checker; each where Debian's package is."""

import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "app/python/geotherm"


def test_joblib(solver):
    joblib = pytest.importorskip("joblib")
    work = joblib.Parallel(n_jobs=2)(joblib.delayed(solver.distance)(v) for v in range(4))
    assert np.array_equal(work, [solver.distance(v) for v in range(4)])


def test_dask(solver):
    dask = pytest.importorskip("dask")
    rows = dask.compute(*[dask.delayed(solver.distance)(v) for v in range(4)])
    assert np.array_equal(rows, [solver.distance(v) for v in range(4)])


MPI = """
from mpi4py import MPI
import geotherm, numpy
world = MPI.COMM_WORLD
solver = world.bcast(geotherm.Solver(geotherm.read("bunny"), threads=1) if world.rank == 0 else None)
mine = solver.distances(numpy.arange(world.rank, 8, world.size))
parts = world.gather(mine)
if world.rank == 0:
    print(sum(len(part) for part in parts), max(part[i, world.size * i + rank]
          for rank, part in enumerate(parts) for i in range(len(part))))
"""


def test_mpi4py(tmp_path):
    if importlib.util.find_spec("mpi4py") is None or shutil.which("mpiexec") is None:
        pytest.skip("mpi4py or mpiexec is not installed")
    script = tmp_path / "work.py"
    script.write_text(MPI)
    command = ["mpiexec", "--allow-run-as-root", "--oversubscribe", "-n", "2", sys.executable, script]
    said = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert said.stdout.split() == ["8", "0.0"], said.stderr


def test_annotations_are_strict():
    mypy = shutil.which("mypy", path="/usr/bin")
    if mypy is None:
        pytest.skip("mypy is not installed")
    command = [mypy, "--strict", "--python-executable", sys.executable, "--cache-dir=/dev/null"]
    said = subprocess.run([*command, PACKAGE], capture_output=True, text=True)
    assert said.returncode == 0, said.stdout
