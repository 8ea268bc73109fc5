# SPDX-License-Identifier: MIT
"""The documented examples of other packages, with one line changed."""

import numpy as np
import pytest

import geotherm
import geotherm.compat.potpourri3d as pp3d
import geotherm.compat.pygeodesic.geodesic as geodesic


@pytest.fixture(scope="module")
def arrays(bunny):
    return np.array(bunny.vertices), np.array(bunny.faces)


def test_distances(arrays, solver):
    V, F = arrays
    other = pp3d.MeshHeatMethodDistanceSolver(V, F)
    assert np.array_equal(other.compute_distance(7), solver.distance(7))
    assert np.array_equal(other.compute_distance_multisource([1, 2, 3]), solver.distance([1, 2, 3]))
    assert np.array_equal(pp3d.compute_distance(V, F, 7), solver.distance(7))
    dist = pp3d.compute_distance_multisource(V, F, [1, 3, 4])
    assert np.array_equal(dist, solver.distance([1, 3, 4]))


def test_options_of_the_solver(arrays, solver):
    V, F = arrays
    smooth = pp3d.MeshHeatMethodDistanceSolver(V, F, t_coef=100.0, use_robust=False)
    assert abs(smooth.compute_distance(7) - solver.distance(7)).max() > 1e-3


def length_of(points):
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum()


def test_paths(arrays, bunny):
    V, F = arrays
    exact = geotherm.Solver(bunny, method="exact")
    path_solver = pp3d.EdgeFlipGeodesicSolver(V, F)
    points = path_solver.find_geodesic_path(v_start=14, v_end=22)
    assert length_of(points) == pytest.approx(exact.distance(14)[22], rel=1e-6)
    assert np.array_equal(points[[0, -1]], V[[14, 22]])
    poly = path_solver.find_geodesic_path_poly([14, 600, 22])  # pulled straight past 600
    assert length_of(poly) == pytest.approx(exact.distance(14)[22], rel=1e-6)
    assert np.array_equal(poly[[0, -1]], V[[14, 22]])
    with pytest.warns(geotherm.ResultWarning, match="drawn together to a point"):
        assert path_solver.find_geodesic_loop([14, 400, 900]).shape == (1, 3)
    with pytest.raises(NotImplementedError):
        path_solver.find_geodesic_path(14, 22, max_iterations=3)


def test_loops_go_round_handles(torus):
    V, F, through, length = torus
    loop = pp3d.EdgeFlipGeodesicSolver(V, F).find_geodesic_loop(through)
    assert length_of(loop) == pytest.approx(length, rel=1e-6)
    assert np.array_equal(loop[0], loop[-1])


def test_straightest_lines(arrays, bunny):
    V, F = arrays
    tracer = pp3d.GeodesicTracer(V, F)
    direction = np.array((0.3, 0.5, 0.4))
    trace_pts = tracer.trace_geodesic_from_vertex(22, direction)
    assert np.array_equal(trace_pts[0], V[22])
    assert length_of(trace_pts) == pytest.approx(np.linalg.norm(direction))
    _, _, normal = geotherm.log_map(bunny, 22).frame
    flat = direction - (direction @ normal) * normal
    begin = trace_pts[1] - trace_pts[0]
    assert begin @ flat > 0.9 * np.linalg.norm(begin) * np.linalg.norm(flat)
    from_face = tracer.trace_geodesic_from_face(31, np.array((0.1, 0.4, 0.5)), direction)
    assert from_face[0] == pytest.approx([0.1, 0.4, 0.5] @ V[F[31]])
    with pytest.raises(geotherm.InputError, match="along the normal at the start"):
        tracer.trace_geodesic_from_vertex(22, 3 * normal)
    few = tracer.trace_geodesic_from_face(31, [0.1, 0.4, 0.5], direction, max_iterations=3)
    assert np.array_equal(few, from_face[:4])


def check_vectors(solver, axes):
    """The documented example of vector heat, on a mesh, polygons or points."""
    ext = solver.extend_scalar([12, 17], [0.0, 1.0])
    assert abs(ext[12]) < 0.2 and abs(ext[17] - 1) < 0.2 and -0.01 < ext.min() <= ext.max() < 1.01
    basisX, basisY, basisN = solver.get_tangent_frames()
    assert np.allclose(np.cross(basisX, basisY), basisN)
    ext = solver.transport_tangent_vector(22, [6.0, 6.0])
    assert ext[22] == pytest.approx([6, 6], rel=1e-4)
    assert np.allclose(np.linalg.norm(ext, axis=1), np.hypot(6, 6), rtol=1e-6)
    ext = solver.transport_tangent_vectors([axes, 22], [[1, 0], [0, 2]])
    assert np.linalg.norm(ext, axis=1).min() > 0.99 and ext[axes] == pytest.approx([1, 0], abs=0.2)


def test_vectors_on_meshes(arrays, bunny):
    V, F = arrays
    solver = pp3d.MeshVectorHeatSolver(V, F)
    check_vectors(solver, 900)
    logmap = solver.compute_log_map(22)
    far = geotherm.Solver(bunny, method="exact").distance(22)
    assert np.allclose(np.linalg.norm(logmap, axis=1), far, rtol=1e-3)
    pytest.importorskip("scipy")
    L = solver.get_connection_laplacian()
    assert L.shape == (len(V), len(V)) and abs(L - L.getH()).max() < 1e-12
    some = np.random.default_rng(1).normal(size=(2, len(V))).T @ [1, 1j]
    assert np.vdot(some, L @ some).real > 0 and abs(L.diagonal().imag).max() == 0


def test_vectors_on_polygons(arrays):
    V, F = arrays
    solver = pp3d.PolygonMeshHeatSolver(V, F.tolist())
    check_vectors(solver, 900)
    dist = solver.compute_distance([12, 17])
    assert dist[12] == dist[17] == 0 and dist.max() > 1
    signed_dist = solver.compute_signed_distance([[14, 600, 1500, 14]])
    assert signed_dist.min() < 0 < signed_dist.max()


def test_points(arrays):
    pytest.importorskip("scipy")
    V, F = arrays
    solver = pp3d.PointCloudHeatSolver(V)
    assert solver.compute_distance(4)[4] == 0
    assert solver.compute_distance_multisource([4, 9])[9] == 0
    check_vectors(solver, 900)
    mesh = pp3d.MeshVectorHeatSolver(V, F)
    first, second, normal = mesh.get_tangent_frames()
    x, y, _ = solver.get_tangent_frames()

    def in_space(components, axes):
        return components[..., :1] * axes[0] + components[..., 1:] * axes[1]

    start = in_space(np.array([6.0, 6.0]), (x[22], y[22]))
    there = mesh.transport_tangent_vector(22, [start @ first[22], start @ second[22]])
    here = solver.transport_tangent_vector(22, [6.0, 6.0])
    cosine = (in_space(there, (first, second)) * in_space(here, (x, y))).sum(axis=1) / 72
    assert np.median(np.degrees(np.arccos(np.clip(cosine, -1, 1)))) < 6
    off = in_space(solver.compute_log_map(22), (x[22], y[22])) - in_space(
        mesh.compute_log_map(22), (first[22], second[22])
    )
    assert np.median(np.linalg.norm(off, axis=1)) < 0.1
    loop = [100, 900, 1800, 100]
    signed = solver.compute_signed_distance([loop], normal)
    expected = pp3d.MeshSignedHeatSolver(V, F).compute_distance([[(v, []) for v in loop]])
    assert (np.sign(signed) == np.sign(expected)).mean() > 0.95
    assert np.corrcoef(signed, expected)[0, 1] > 0.99
    for wrong in ([], [2000], [-1], [0.5]):
        with pytest.raises(geotherm.InputError):
            solver.transport_tangent_vectors(wrong, [[1, 0]] * len(wrong))
    for curves in ([], [[17]], [[1, 2], []]):
        with pytest.raises(geotherm.InputError, match="give each two or more"):
            solver.compute_signed_distance(curves, normal)


def test_triangles_between_points(arrays):
    V, _ = arrays
    found = pp3d.PointCloudLocalTriangulation(V).get_local_triangulation()
    assert found.shape[::2] == (len(V), 3) and (found[:, 0, 0] == np.arange(len(V))).all()
    assert ((found == -1).all(axis=2) | (found >= 0).all(axis=2)).all()
    assert (found[:, :, 0] >= 0).sum() == 3 * geotherm.PointCloud(V).n_faces


CURVES = [[(61, [0.3, 0.3]), (7, []), (16, [0.3, 0.3, 0.4]), (11, [0.4]), (71, []), (13,)]]


def test_distances_to_curves(arrays, solver):
    V, F = arrays
    signed = pp3d.MeshSignedHeatSolver(V, F)
    dist = signed.compute_distance(CURVES, [], [5, (900, [])])
    assert dist.min() < 0 < dist.max() and dist[900] == dist[5] == 0
    plain = signed.compute_distance(CURVES, [False])
    assert plain.min() >= 0 and plain[7] == plain[13] == 0
    marching = pp3d.MeshFastMarchingDistanceSolver(V, F)
    assert marching.compute_distance(CURVES, sign=True).min() < 0
    unsigned_dist = marching.compute_distance([[(71, []), (18, [0.5])]], sign=False)
    on_edge = pp3d.edges(V, F)[18]
    side = np.linalg.norm(V[on_edge[0]] - V[on_edge[1]])
    assert unsigned_dist[71] == 0 and unsigned_dist[on_edge] == pytest.approx(side / 2)
    assert marching.compute_distance([[(71, [])]], [[0.5]]).min() == 0.5
    for call in (
        lambda: signed.compute_distance(CURVES, preserve_source_normals=True),
        lambda: signed.compute_distance(CURVES, level_set_constraint="None"),
        lambda: marching.compute_distance(CURVES, [[1] * 6], sign=True),
    ):
        with pytest.raises(NotImplementedError):
            call()


def test_level_sets(arrays):
    V, F = arrays
    E = pp3d.edges(V, F)
    assert len(E) == 5994 and E[0].tolist() == F[0, :2].tolist()
    assert len(np.unique(np.sort(E, axis=1), axis=0)) == len(E)
    (line,) = pp3d.marching_triangles(V, F, V[:, 0], 0.1)
    for number, (share,) in line:  # all on edges
        start, end = V[E[number], 0]
        assert start + share * (end - start) == pytest.approx(0.1)
    assert pp3d.MarchingTrianglesSolver(V, F).marching_triangles(V[:, 0], 0.1) == [line]


def test_files(arrays, tmp_path):
    V, F = arrays
    pp3d.write_mesh(V, F, str(tmp_path / "m.ply"))
    read_V, read_F = pp3d.read_mesh(str(tmp_path / "m.ply"))
    assert np.array_equal(read_V, V) and np.array_equal(read_F, F)
    for name in ("p.xyz", "p.ply"):
        pp3d.write_point_cloud(V, str(tmp_path / name))
        assert np.array_equal(pp3d.read_point_cloud(str(tmp_path / name)), V)
    quads = [[0, 1, 2, 3], [0, 1, 4]]
    pp3d.write_mesh(V[:5], quads, str(tmp_path / "q.obj"))
    read_V, read_F = pp3d.read_polygon_mesh(str(tmp_path / "q.obj"))
    assert np.array_equal(read_V, V[:5]) and read_F == quads
    pp3d.write_mesh(V[:5], [np.array(face, float) for face in quads], str(tmp_path / "f.obj"))
    assert (tmp_path / "f.obj").read_bytes() == (tmp_path / "q.obj").read_bytes()
    for call in (
        lambda: pp3d.write_mesh(V[:5], quads, str(tmp_path / "q.ply")),
        lambda: pp3d.write_mesh(V, F, str(tmp_path / "m.obj"), UV_coords=V[:, :2]),
        lambda: pp3d.write_point_cloud(V, str(tmp_path / "p.off")),
    ):
        with pytest.raises(NotImplementedError):
            call()


def test_corners_count_back_from_where_they_stand_and_lines_go_on(tmp_path):
    square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    faces = "f -4 -3 -2 -1  # counted back, with no \\\nf 1/1 2//2 \\\n 3\nv 0 0 1\nf -1 1\\\n 2\n"
    (tmp_path / "q.OBJ").write_text(square + faces)
    V, F = pp3d.read_polygon_mesh(str(tmp_path / "q.OBJ"))
    assert len(V) == 5 and F == [[0, 1, 2, 3], [0, 1, 2], [4, 0, 1]]


def test_areas(arrays):
    V, F = arrays
    areas = pp3d.face_areas(V, F)
    assert areas.shape == (len(F),) and areas.sum() == pytest.approx(pp3d.vertex_areas(V, F).sum())
    info = geotherm.Mesh(V, F).info()["model"]
    assert areas.sum() == pytest.approx(info["area"])


def test_the_laplacian(arrays):
    pytest.importorskip("scipy")
    V, F = arrays
    L = pp3d.cotan_laplacian(V, F)
    assert abs(L @ np.ones(len(V))).max() < 1e-10 and abs(L - L.T).max() < 1e-12


def test_all_names_are_there():
    assert all(hasattr(pp3d, name) for name in pp3d.__all__)
    with pytest.raises(AttributeError):
        pp3d.nothing_like_this


def test_exact_distances(arrays, bunny, tmp_path):
    points, faces = arrays
    exact = geotherm.Solver(bunny, method="exact")
    geoalg = geodesic.PyGeodesicAlgorithmExact(points, faces)
    distance, path = geoalg.geodesicDistance(25, 97)
    assert distance == pytest.approx(exact.distance(25)[97], rel=1e-6)
    assert np.array_equal(path[[0, -1]], points[[97, 25]])
    distances, best_source = geoalg.geodesicDistances(np.array([25]))
    assert np.array_equal(distances, exact.distance(25)) and not best_source.any()
    distances, best_source = geoalg.geodesicDistances(np.array([25, 25, 100]), np.array([100, 25]))
    assert list(distances) == [0, 0] and list(best_source) == [2, 0]
    assert geoalg.geodesicDistances()[0][0] == 0
    near, _ = geoalg.geodesicDistances([25], None, 0.5)
    assert np.isinf(near).any() and near[np.isfinite(near)].max() <= 0.5
    with pytest.raises(geotherm.Error, match="target"):
        geoalg.geodesicDistances([25], [99999])
    with pytest.raises(geotherm.InputError, match="targetIndex is 17.9"):
        geoalg.geodesicDistance(17, 17.9)


def test_its_text_files_are_read(tmp_path):
    (tmp_path / "m.txt").write_text("3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 2\n")
    points, faces = geodesic.read_mesh_from_file(tmp_path / "m.txt")
    assert points.shape == (3, 3) and faces.tolist() == [[0, 1, 2]]
    for text in ("", "3", "3 x", "3 1\n0 0 0\n", "-3 1\n", "3 1\n0 0 zero\n"):
        (tmp_path / "m.txt").write_text(text)
        with pytest.raises(geotherm.Error, match="m.txt"):
            geodesic.read_mesh_from_file(tmp_path / "m.txt")
    with pytest.raises(geotherm.Error, match="none.txt: No such file"):
        geodesic.read_mesh_from_file(tmp_path / "none.txt")
