# SPDX-License-Identifier: MIT
"""No farther than asked, sparse rows and masks, held against SciPy and against cut meshes."""

import numpy as np
import pytest

import geotherm

METHODS = ["wavefront", "wavefront-fine", "fast-marching", "exact", "heat"]


@pytest.fixture(scope="module")
def sparse():
    pytest.importorskip("scipy.sparse.csgraph")
    return pytest.importorskip("scipy.sparse")


def edge_graph(sparse, mesh, used=None):
    """The lengths of the edges of some faces."""
    faces = np.asarray(mesh.faces)[slice(None) if used is None else used]
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    sides = np.unique(np.sort(sides), axis=0)
    lengths = np.linalg.norm(mesh.vertices[sides[:, 0]] - mesh.vertices[sides[:, 1]], axis=1)
    shape = (mesh.n_vertices, mesh.n_vertices)
    return sparse.coo_matrix((lengths, sides.T), shape).tocsr()


@pytest.mark.parametrize("method", METHODS)
def test_what_is_near_has_the_bits_of_the_whole(bunny, method):
    solver = geotherm.Solver(bunny, method=method)
    ids = [17, 99, 900]
    rows = solver.distances(ids)
    for most in (0.05, 0.2, 0.7, 5.0):
        near = solver.distances(ids, max_distance=most)
        assert np.array_equal(near, np.where(rows > most, np.inf, rows))
        one = solver.solve(17, check="off", max_distance=most).distances
        alone = solver.distances([17], max_distance=most)[0]  # blocks of heat round otherwise
        assert np.array_equal(one, alone)
        assert method == "heat" or np.array_equal(one, near[0])
    assert np.array_equal(solver.distances(ids, targets=[5, 3, 5]), rows[:, [5, 3, 5]])


@pytest.mark.parametrize("dtype", ["f8", "f4"])
def test_sparse_rows_are_what_scipy_loads(bunny, sparse, tmp_path, dtype):
    solver = geotherm.Solver(bunny, method="wavefront")
    ids = list(range(0, 2000, 40))
    path = tmp_path / "near.npz"
    near = solver.distances(ids, max_distance=0.2, out=path, dtype=dtype)
    assert isinstance(near, sparse.csr_matrix) and near.shape == (50, 2000) and near.dtype == dtype
    near.check_format(full_check=True)
    assert near.has_sorted_indices
    rows = solver.distances(ids, dtype=dtype)
    for i, row in enumerate(solver.distances(ids)):
        held = near.indices[near.indptr[i] : near.indptr[i + 1]]
        assert np.array_equal(held, np.flatnonzero(row <= 0.2))
        assert np.array_equal(near.data[near.indptr[i] : near.indptr[i + 1]], rows[i, held])
    assert [file.name for file in tmp_path.iterdir()] == ["near.npz"]
    all_of_them = solver.distances(ids[:2], out=tmp_path / "all.npz").toarray()
    assert np.array_equal(all_of_them, solver.distances(ids[:2]))
    shouted = solver.distances(ids[:2], out=tmp_path / "ALL.NPZ").toarray()
    assert np.array_equal(shouted, all_of_them)
    (tmp_path / "ALL.NPZ").unlink()
    with pytest.raises(geotherm.Error):
        solver.distances(ids, max_distance=0.2, out=tmp_path / "no.npz", progress=lambda *_: False)
    assert not (tmp_path / "no.npz").exists()


def test_more_entries_than_are_written_at_once(bunny, sparse, tmp_path):
    solver = geotherm.Solver(bunny, method="wavefront")
    ids = np.arange(500)
    rows = solver.distances(ids, out=tmp_path / "all.npz", dtype="f4")
    assert rows.nnz == 500 * 2000
    assert np.array_equal(rows.toarray(), solver.distances(ids, dtype="f4"))


@pytest.mark.parametrize("method", METHODS)
def test_a_mask_is_a_cut_mesh(bunny, sparse, method):
    """Of the rabbit without a band round it, beside which the way is longer; as long as a way along
    edges (SciPy's) at most, and as a straight line at least."""
    vertices, faces = np.array(bunny.vertices), np.array(bunny.faces)
    height = vertices[:, 1] - np.median(vertices[:, 1])
    wall = (abs(height) < 0.03) & (vertices[:, 0] > np.median(vertices[:, 0]))
    assert 20 < wall.sum() < 1000
    left = ~wall[faces].any(axis=1)
    source = int(np.argmax(np.where(wall, -np.inf, height)))
    masked = geotherm.Mesh(vertices, faces, mask=wall)
    d = geotherm.Solver(masked, method=method).distance(source)
    ways = sparse.csgraph.dijkstra(edge_graph(sparse, bunny, left), directed=False, indices=source)
    assert np.array_equal(np.isinf(d), np.isinf(ways)) and np.isinf(d[wall]).all()
    reached = np.isfinite(d)
    lines = np.linalg.norm(vertices - vertices[source], axis=1)
    slack = 0.08 if method == "heat" else 0.02
    assert (d[reached] <= ways[reached] * (1 + slack) + slack * ways[reached].max()).all()
    assert (d[reached] >= lines[reached] * (1 - slack) - slack * lines.max()).all()
    # The same vertices without the others: another mesh to the program.
    number = np.cumsum(~wall) - 1
    cut = geotherm.Mesh(vertices[~wall], number[faces[left]])
    again = geotherm.Solver(cut, method=method).distance(int(number[source]))
    kept = np.isfinite(again)
    assert np.array_equal(kept, np.isfinite(d[~wall]))
    assert np.allclose(again[kept], d[~wall][kept], rtol=0, atol=1e-9 if method != "heat" else 2e-3)
    by_faces = geotherm.Mesh(vertices, faces, mask=~left)
    assert np.array_equal(geotherm.Solver(by_faces, method=method).distance(source), d)


def test_a_masked_vertex_is_no_source(bunny):
    mask = np.zeros(bunny.n_vertices)
    mask[17] = 1
    solver = geotherm.Solver(geotherm.Mesh(bunny.vertices, bunny.faces, mask=mask))
    with pytest.raises(geotherm.InputError, match="17"):
        solver.distance(17)
    with pytest.raises(geotherm.InputError, match="mask"):
        geotherm.Mesh(bunny.vertices, bunny.faces, mask=[1, 0])
    with pytest.raises(geotherm.InputError, match="leaves none"):
        geotherm.Mesh(bunny.vertices, bunny.faces, mask=np.ones(bunny.n_vertices))


def test_no_farther_saves_time(tmp_path):
    import time

    n = 500
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    vertices = np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
    a = (x[:-1, :-1] + n * y[:-1, :-1]).ravel()
    faces = np.concatenate([np.stack([a, a + 1, a + n + 1], 1), np.stack([a, a + n + 1, a + n], 1)])
    solver = geotherm.Solver(geotherm.Mesh(vertices, faces), method="wavefront", threads=1)
    middle = [n * n // 2 + n // 2]

    def best(**reach):
        times = []
        for _ in range(5):
            begin = time.perf_counter()
            solver.distances(middle, **reach)
            times.append(time.perf_counter() - begin)
        return min(times)

    assert best() / best(max_distance=28.2) > 10  # a disc of 1 %; the rest is the dense row
    assert best() / best(targets=[middle[0] + 20]) > 20
