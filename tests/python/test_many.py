# SPDX-License-Identifier: MIT
"""Batches into memory, maps and files."""

import resource

import numpy as np
import pytest

import geotherm


@pytest.mark.parametrize("dtype", ["f8", "f4"])
def test_a_path_is_a_whole_file_or_none(solver, tmp_path, dtype):
    path = tmp_path / "rows.npy"
    rows = solver.distances("random:40:2", out=path, dtype=dtype)
    assert isinstance(rows, np.memmap) and rows.dtype == dtype
    assert np.array_equal(rows, solver.distances("random:40:2", dtype=dtype))
    with pytest.raises(geotherm.Error):
        solver.distances("random:40:2", out=tmp_path / "no.npy", progress=lambda *_: False)
    assert [file.name for file in tmp_path.iterdir()] == ["rows.npy"]


def test_a_memory_map_is_written_in_place(solver, tmp_path):
    shape = (40, solver.model.n_vertices)
    out = np.lib.format.open_memmap(tmp_path / "m.npy", "w+", np.float32, shape)
    assert solver.distances(np.arange(40), out=out) is out
    out.flush()
    assert np.array_equal(np.load(tmp_path / "m.npy"), solver.distances(np.arange(40), dtype="f4"))


def test_memory_does_not_grow_with_the_rows(solver, tmp_path):
    solver.distances(np.arange(200) % 2000, out=tmp_path / "few.npy", dtype="f4")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    solver.distances(np.arange(6000) % 2000, out=tmp_path / "many.npy", dtype="f4")
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert (tmp_path / "many.npy").stat().st_size > 45 << 20
    assert grown < 12 << 10, f"{grown} kB"


def test_targets_and_the_largest_distance(solver):
    rows = solver.distances([17, 99])
    assert np.array_equal(solver.distances([17, 99], targets=[5, 17]), rows[:, [5, 17]])
    near = solver.distances([17, 99], max_distance=0.5)
    assert np.array_equal(near, np.where(rows > 0.5, np.inf, rows))


def test_texts_are_the_rows_of_the_command_line(solver):
    assert solver.distances("3,99,512").shape == (3, 2000)
    assert solver.distances(["random:5", "7"]).shape == (6, 2000)
    assert np.array_equal(solver.distances([17, "99"])[1], solver.distances([17, 99])[1])


def test_numbers_beyond_float32_are_refused(bunny):
    large = geotherm.Solver(geotherm.Mesh(bunny.vertices * 1e40, bunny.faces))
    with pytest.raises(geotherm.Error, match="float32"):
        large.distances([17], dtype="f4")
    assert large.distances([17]).max() > 1e40


def test_numbers_below_float32_are_refused_in_memory_as_in_files(bunny, tmp_path):
    small = geotherm.Solver(geotherm.Mesh(bunny.vertices * 1e-42, bunny.faces))
    words = r"the values lie beyond the range of float32 \(1.2e-38 to 3.4e38\); write float64"
    for ask in (
        lambda: small.distance(17, dtype="f4"),
        lambda: small.distances([17, 99], dtype="f4"),
        lambda: small.distances([17, 99], dtype="f4", out=tmp_path / "rows.npy"),
    ):
        with pytest.raises(geotherm.InputError, match=words):
            ask()
    assert 0 < small.distance(17).max() < 1e-41
