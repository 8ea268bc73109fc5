# SPDX-License-Identifier: MIT
"""NumPy in and out: types, strides, copies."""

import numpy as np
import pytest

import geotherm

V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
F = np.array([[0, 1, 2], [0, 2, 3]])


@pytest.mark.parametrize("dtype", ["f8", "f4", "f2", "i8", "i4", "i2", "u1", ">f8", "longdouble"])
def test_vertices_of_any_type_are_one_mesh(dtype):
    mesh = geotherm.Mesh(V.astype(dtype), F)
    assert np.array_equal(mesh.vertices, V)


@pytest.mark.parametrize("dtype", ["i8", "i4", "u4", "u8", "i2", ">i4", "f8"])
def test_faces_of_any_type_are_one_mesh(dtype):
    assert np.array_equal(geotherm.Mesh(V, F.astype(dtype)).faces, F)


@pytest.mark.parametrize(
    "strided",
    [
        lambda a: np.asfortranarray(a),
        lambda a: np.repeat(a, 2, axis=0)[::2],
        lambda a: np.repeat(a, 3, axis=1)[:, ::3],
        lambda a: a[::-1].copy()[::-1],
        lambda a: a.tolist(),
        lambda a: memoryview(np.ascontiguousarray(a)),
    ],
)
def test_strides_do_not_matter(strided):
    mesh = geotherm.Mesh(strided(V.astype(float)), strided(F))
    assert np.array_equal(mesh.vertices, V) and np.array_equal(mesh.faces, F)


def test_strides_of_zero_are_not_taken_for_none():
    points = np.broadcast_to(np.zeros(3), (4, 3))
    values = np.broadcast_to(2.0, 4)
    mesh = geotherm.Mesh(V, F)
    assert len(geotherm.isolines(mesh, values, levels=[1.0])) == 0
    with pytest.raises(geotherm.Error):  # a mesh whose vertices are one has no area
        geotherm.Solver(geotherm.Mesh(points, F))


def test_arrays_of_a_model_are_views_that_outlive_it():
    mesh = geotherm.Mesh(V, F)
    assert mesh.vertices.ctypes.data == mesh.vertices.ctypes.data
    view = mesh.vertices
    assert not view.flags.writeable and not view.flags.owndata
    del mesh
    assert np.array_equal(view, V)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_out_is_used_and_returned(solver, dtype):
    out = np.full(solver.model.n_vertices, -1, dtype)
    assert solver.distance(17, out=out) is out
    assert np.array_equal(out, solver.distance(17).astype(dtype))
    wide = np.full((solver.model.n_vertices, 2), -1, dtype)
    solver.distance(17, out=wide[:, 1])
    assert np.array_equal(wide[:, 1], out) and (wide[:, 0] == -1).all()


def test_rows_go_into_strided_memory(solver):
    expected = solver.distances([17, 99])
    transposed = np.empty((solver.model.n_vertices, 2)).T
    assert solver.distances([17, 99], out=transposed) is transposed
    assert np.array_equal(transposed, expected)


@pytest.mark.parametrize(
    "out",
    [
        np.empty(3),
        np.empty((2000, 1)),
        np.empty(2000, int),
        np.empty(2000, ">f8"),
        np.empty(2000, object),
        np.broadcast_to(np.empty(1), 2000),
        list(range(2000)),
        np.lib.stride_tricks.as_strided(np.empty(1), (2000,), (0,)),
    ],
)
def test_an_output_that_does_not_fit_is_named(solver, out):
    with pytest.raises(ValueError, match="^out"):
        solver.distance(17, out=out)
