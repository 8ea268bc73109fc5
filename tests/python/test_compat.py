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


def test_paths(arrays, bunny):
    V, F = arrays
    exact = geotherm.Solver(bunny, method="exact")
    path_solver = pp3d.EdgeFlipGeodesicSolver(V, F)
    points = path_solver.find_geodesic_path(v_start=14, v_end=22)
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert length == pytest.approx(exact.distance(14)[22], rel=1e-6)
    assert np.array_equal(points[[0, -1]], V[[14, 22]])
    poly = path_solver.find_geodesic_path_poly([14, 22, 900])
    assert np.array_equal(poly[[0, -1]], V[[14, 900]])
    loop = path_solver.find_geodesic_loop([14, 400, 900])
    assert loop.shape[1] == 3
    with pytest.raises(NotImplementedError):
        path_solver.find_geodesic_path(14, 22, max_iterations=3)


def test_points(arrays):
    V, _ = arrays
    solver = pp3d.PointCloudHeatSolver(V)
    assert solver.compute_distance(4)[4] == 0
    assert solver.compute_distance_multisource([4, 9])[9] == 0
    for name in ("extend_scalar", "get_tangent_frames", "transport_tangent_vector"):
        with pytest.raises(NotImplementedError):
            getattr(solver, name)()


def test_files(arrays, tmp_path):
    V, F = arrays
    pp3d.write_mesh(V, F, str(tmp_path / "m.ply"))
    read_V, read_F = pp3d.read_mesh(str(tmp_path / "m.ply"))
    assert np.array_equal(read_V, V) and np.array_equal(read_F, F)
    pp3d.write_point_cloud(V, str(tmp_path / "p.xyz"))
    assert np.array_equal(pp3d.read_point_cloud(str(tmp_path / "p.xyz")), V)


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


def test_what_is_not_there_says_so():
    for name in ("MeshVectorHeatSolver", "GeodesicTracer", "MeshSignedHeatSolver"):
        with pytest.raises(NotImplementedError, match=name):
            getattr(pp3d, name)
    with pytest.raises(AttributeError):
        pp3d.nothing_like_this
    assert all(hasattr(pp3d, name) for name in pp3d.__all__)


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


def test_its_text_files_are_read(tmp_path):
    (tmp_path / "m.txt").write_text("3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 2\n")
    points, faces = geodesic.read_mesh_from_file(tmp_path / "m.txt")
    assert points.shape == (3, 3) and faces.tolist() == [[0, 1, 2]]
