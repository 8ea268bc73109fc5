# SPDX-License-Identifier: MIT
"""Models of arrays, of files, and of other packages' objects."""

import pickle
from types import SimpleNamespace

import numpy as np
import pytest

import geotherm


def grid_of(n):
    """A square cut into triangles."""
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    V = np.column_stack([x.ravel(), y.ravel(), np.zeros(n * n)]) / (n - 1)
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    quads = np.column_stack([i, i + 1, i + n + 1, i + n])
    return V, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]), quads


def cube_of_tets(n):
    """A cube cut into tets."""
    at = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), -1).reshape(-1, 3)
    number = lambda p: (p[:, 0] * n + p[:, 1]) * n + p[:, 2]
    low = at[(at < n - 1).all(axis=1)]
    tets = []
    for order in [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]:
        corners = [low]
        for axis in order:
            corners.append(corners[-1] + np.eye(3, dtype=int)[axis])
        tets.append(np.column_stack([number(c) for c in corners]))
    return at / (n - 1), np.concatenate(tets)


def sphere_points(n):
    k = np.arange(n) + 0.5
    z, turn = 1 - 2 * k / n, np.pi * (1 + 5**0.5) * k
    r = np.sqrt(1 - z * z)
    return np.column_stack([r * np.cos(turn), r * np.sin(turn), z])


def check(model, source, expected, within):
    d = geotherm.Solver(model).distance(source)
    assert abs(d - expected).max() < within * expected.max()
    again = pickle.loads(pickle.dumps(model))
    assert type(again) is type(model)
    assert np.array_equal(geotherm.Solver(again).distance(source), d)


def test_polygons():
    V, _, quads = grid_of(20)
    # The far corner, where two borders reflect heat, is off by one and a half edges.
    check(geotherm.Polygons(V, quads), 0, np.linalg.norm(V, axis=1), 0.06)


def test_tets():
    V, tets = cube_of_tets(9)
    check(geotherm.TetMesh(V, tets), 0, np.linalg.norm(V, axis=1), 0.12)


def test_points():
    P = sphere_points(1500)
    angle = np.arccos(np.clip(P @ P[0], -1, 1))
    check(geotherm.PointCloud(P), 0, angle, 0.06)
    check(geotherm.PointCloud(P, normals=P), 0, angle, 0.06)


def test_grids():
    speeds = np.full((31, 41), 2.0)
    y, x = np.mgrid[:31, :41]
    expected = np.hypot(x, y).ravel() * 0.5 / 2
    check(geotherm.Grid(speeds, spacing=(0.5, 0.5)), 0, expected, 0.04)


def test_edge_lengths(bunny, tmp_path):
    V, F, _ = grid_of(30)
    sides = np.linalg.norm(V[F[:, [1, 2, 0]]] - V[F[:, [2, 0, 1]]], axis=2)
    check(geotherm.Mesh.from_edge_lengths(F, sides), 0, np.linalg.norm(V, axis=1), 0.04)
    V, F = bunny.vertices, bunny.faces
    sides = np.linalg.norm(V[F[:, [1, 2, 0]]] - V[F[:, [2, 0, 1]]], axis=2)
    solver = geotherm.Solver(geotherm.Mesh.from_edge_lengths(F, sides))
    exact = geotherm.Solver(bunny, method="exact").distance(17)
    assert abs(solver.distance(17) - exact).mean() < 0.03 * exact.mean()
    assert solver.solve(17).error is None
    for wrong, named in (
        ([[1, 1, 3]], "no triangle"),
        ([[1, 1, -1]], "length -1"),
        ([[1, 1, float("nan")]], "length nan"),
        ([[1, 1]], "lengths"),
        ([[1, 1, 1]] * 2, "rows"),
    ):
        with pytest.raises(ValueError, match=named):
            geotherm.Mesh.from_edge_lengths([[0, 1, 2]], wrong)
    with pytest.raises(ValueError, match="another face"):
        geotherm.Mesh.from_edge_lengths([[0, 1, 2], [1, 0, 3]], [[1, 1, 1], [1, 1, 1.1]])
    with pytest.raises(geotherm.Error, match="heat method alone"):
        geotherm.Solver(solver.model, method="exact")
    with pytest.raises(geotherm.Error, match="nowhere"):
        solver.distance([0.0, 0.0, 0.0])
    with pytest.raises(geotherm.Error, match="nearest source"):
        solver.solve([17, 99], labels=True)
    assert not solver.solve(17, labels=True).nearest.any()
    for has_no_places in (solver.model, solver.solve(17)):
        with pytest.raises(geotherm.InputError, match="no places"):
            has_no_places.write(tmp_path / "x.ply")
    with pytest.raises(geotherm.InputError, match="no places"):
        geotherm.isolines(solver.model, solver.distance(17), count=3)
    said = solver.solve(17).report["model"]
    assert said["area"] == pytest.approx(solver.model.info()["model"]["area"])
    assert said["mean_edge_length"] is None and said["degenerate_faces"] == 0
    solver.solve(17).write(tmp_path / "x.npy")
    assert "where another one lies" not in solver.model.report()
    assert "box" not in solver.model.report()
    assert not {"box_min", "box_max", "duplicate_positions"} & set(solver.model.info()["model"])


def test_edge_lengths_of_any_size():
    faces = [[0, 1, 2], [1, 3, 2]]
    expected = geotherm.Solver(geotherm.Mesh.from_edge_lengths(faces, np.ones((2, 3)))).distance(0)
    for unit in (1e-150, 1e150):
        model = geotherm.Mesh.from_edge_lengths(faces, np.full((2, 3), unit))
        assert np.allclose(geotherm.Solver(model).distance(0) / unit, expected, rtol=1e-12)
    for unit in (1e-160, 1e160):  # their areas are no doubles
        with pytest.raises(geotherm.InputError, match="face 0 .* beyond .*; give .* another unit"):
            geotherm.Mesh.from_edge_lengths(faces, np.full((2, 3), unit))


def test_edge_lengths_take_the_memory_of_their_faces():
    for last in (6, 2**31 - 1):
        said = f"vertex {last}, and 2 faces have at most 6 vertices; number .* without gaps"
        with pytest.raises(geotherm.InputError, match=said):
            geotherm.Mesh.from_edge_lengths([[0, 1, 2], [3, 4, last]], np.ones((2, 3)))
    loose = geotherm.Mesh.from_edge_lengths([[0, 1, 2], [3, 4, 5]], np.ones((2, 3)))
    assert loose.n_vertices == 6


def test_a_moved_model_is_pickled_as_what_it_was(bunny):
    cloud = geotherm.Solver(geotherm.PointCloud(bunny.vertices))
    moved = cloud.update(bunny.vertices * 2).update(bunny.vertices * 3).model
    again = pickle.loads(pickle.dumps(moved))
    assert isinstance(again, geotherm.PointCloud) and np.array_equal(again.vertices, moved.vertices)
    assert np.array_equal(again.faces, moved.faces)


def test_a_model_of_a_file_is_read_again_from_another_folder(program, tmp_path, monkeypatch):
    program("generate", "ball-tets", "--tets", "500", "-o", tmp_path / "ball.mesh")
    monkeypatch.chdir(tmp_path)
    kept = pickle.dumps(geotherm.read("ball.mesh"))
    (tmp_path / "bunny").mkdir()  # of the name of a bundled model, which is no path
    welded = pickle.dumps(geotherm.read("bunny", weld=0))
    (tmp_path / "other").mkdir()
    monkeypatch.chdir(tmp_path / "other")
    assert isinstance(pickle.loads(kept), geotherm.TetMesh)
    assert pickle.loads(welded).n_vertices == 2000


def test_normals_that_are_no_numbers_are_refused(bunny):
    normals = np.ones((2000, 3))
    normals[7, 1] = np.nan
    with pytest.raises(geotherm.InputError, match="normals: that of point 7"):
        geotherm.PointCloud(bunny.vertices, normals)


def test_models_of_other_packages_by_their_shape():
    V, F, _ = grid_of(5)
    vtk = np.column_stack([np.full(len(F), 3), F]).ravel()
    block = SimpleNamespace(type="triangle", data=F)
    for thing in (
        SimpleNamespace(vertices=V, faces=F),  # trimesh
        SimpleNamespace(points=V, faces=vtk),  # pyvista
        SimpleNamespace(points=V, faces=vtk, regular_faces=F),
        SimpleNamespace(points=V, cells=[block, SimpleNamespace(type="line", data=F[:, :2])]),
        SimpleNamespace(points=V, cells_dict={5: F}, cells=vtk),  # pyvista's UnstructuredGrid
    ):
        assert np.array_equal(geotherm.Mesh(thing).faces, F)
        assert np.array_equal(geotherm.Solver(thing).model.vertices, V)
    assert geotherm.PointCloud(SimpleNamespace(points=V)).n_vertices == 25
    points, tets = cube_of_tets(3)
    assert geotherm.TetMesh(SimpleNamespace(points=points, cells_dict={10: tets})).domain == "tets"
    mixed = SimpleNamespace(points=V, cells=[block, SimpleNamespace(type="quad", data=[[0, 1, 2, 3]])])
    with pytest.raises(geotherm.InputError, match="1 of the kind quad"):
        geotherm.Mesh(mixed)
    for kind, code in (("wedge", 13), ("hexahedron", 12), ("pyramid", 14), ("tetra10", 24)):
        other = SimpleNamespace(type=kind, data=[[0] * 10])
        for beside in (
            SimpleNamespace(points=points, cells=[SimpleNamespace(type="tetra", data=tets), other]),
            SimpleNamespace(points=points, cells_dict={10: tets, code: other.data}),
        ):
            with pytest.raises(geotherm.InputError, match=f"1 of the kind {kind} beside tets"):
                geotherm.TetMesh(beside)
    unknown = SimpleNamespace(points=points, cells_dict={10: tets, 72: [[0] * 10]})
    with pytest.raises(geotherm.InputError, match="1 of the kind 72 beside tets"):
        geotherm.TetMesh(unknown)
    bounded = SimpleNamespace(points=points, cells_dict={10: tets, 13: [], 5: tets[:, :3]})
    assert geotherm.TetMesh(bounded).n_vertices == len(points)


def test_meshio_objects():
    meshio = pytest.importorskip("meshio")
    V, F, _ = grid_of(5)
    assert np.array_equal(geotherm.Mesh(meshio.Mesh(V, [("triangle", F)])).faces, F)
    V, tets = cube_of_tets(3)
    volume = geotherm.TetMesh(meshio.Mesh(V, [("tetra", tets)]))
    assert volume.domain == "tets"
    with pytest.raises(geotherm.Error, match="faces is missing"):
        geotherm.Mesh(meshio.Mesh(V, [("tetra", tets)]))


def test_meshio_reads_every_field(program, tmp_path):
    meshio = pytest.importorskip("meshio")
    square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"
    (tmp_path / "two.obj").write_text(square + "v 2 0 0\nv 3 0 0\nv 2 1 0\nf 5 6 7\n")
    outputs = ["-o", tmp_path / "d.ply", "-o", tmp_path / "d.npy"]
    program("solve", tmp_path / "two.obj", "-s", "0", "--fields", "all", *outputs)
    read = meshio.read(tmp_path / "d.ply")
    distances = np.load(tmp_path / "d.npy")
    assert np.isinf(distances).sum() == 3
    assert np.array_equal(read.point_data["distance"], distances)
    assert {"quality", "error"} <= set(read.point_data)
    assert np.array_equal(read.cells[0].data, [[0, 1, 2], [0, 2, 3], [4, 5, 6]])
    assert set(read.cell_data) == {
        "eikonal_error", "gradient_angle", "lost_gradients", "triangle_quality", "non_delaunay"
    }
    assert np.array_equal(geotherm.read(tmp_path / "d.ply").faces, read.cells[0].data)


def test_welded_vertices_are_one():
    V, F, _ = grid_of(6)
    soup, loose = V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3)
    cracked = geotherm.Solver(geotherm.Mesh(soup, loose)).distance(0)
    mesh = geotherm.Mesh(soup, loose, weld=0)
    assert any(f"{len(soup) - len(V)} vertices" in text for text in mesh.info()["warnings"])
    welded = geotherm.Solver(mesh).distance(0)
    assert np.isinf(cracked).any() and np.isfinite(welded).all()
    again = pickle.loads(pickle.dumps(mesh))
    assert np.array_equal(geotherm.Solver(again).distance(0), welded)
    moved = geotherm.Solver(mesh).update(soup * 2)
    assert np.allclose(moved.distance(0), 2 * welded)
    again = pickle.loads(pickle.dumps(moved))
    assert np.array_equal(again.distance(0), moved.distance(0))


def test_files_are_read_and_written(bunny, tmp_path):
    bunny.write(tmp_path / "again.obj")
    again = geotherm.read(tmp_path / "again.obj")
    assert np.array_equal(again.vertices, bunny.vertices) and again.name == "again"
    bunny.write(tmp_path / "again.ply")
    points = geotherm.read(tmp_path / "again.ply", domain="points")
    assert points.domain == pickle.loads(pickle.dumps(points)).domain == "points"
    assert np.array_equal(pickle.loads(pickle.dumps(again)).faces, bunny.faces)
    with pytest.raises(geotherm.Error) as caught:
        geotherm.read(tmp_path / "none.obj")
    assert caught.value.code == "bad-file"


def test_a_model_says_what_it_is(bunny):
    assert bunny.info()["model"]["components"] == 1
    assert "2,000 vertices" in bunny.report() or "vertices" in bunny.report()
    assert repr(bunny) == "<geotherm.Mesh 'bunny': 2000 vertices, 3,996 faces>"


def test_features_name_what_there_is():
    features = geotherm.features()
    assert features["version"] == geotherm.__version__
    assert {"heat", "exact"} <= set(features["methods"])
    assert "native" in features["backends"] and "bunny" in features["models"]
    with pytest.raises(AttributeError):
        geotherm.no_such_name
