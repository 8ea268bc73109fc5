# SPDX-License-Identifier: MIT
"""Log maps, lines, vectors, values and signed distances from Python."""

import numpy as np
import pytest

import geotherm


@pytest.fixture
def square():
    """A square of side 2 whose middle is vertex 4."""
    corners = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 0]]
    return geotherm.Mesh(corners, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])


def test_a_log_map_of_the_plane_is_the_plane(square):
    here = geotherm.log_map(square, 4)
    places = here.coordinates @ here.frame[:2] + square.vertices[4]
    assert np.allclose(places, square.vertices, rtol=0, atol=1e-12)
    assert np.allclose(here.distances, [2**0.5] * 4 + [0])


def test_lines_are_straight(square):
    line = geotherm.trace(square, (0, [0.3, 0.3, 0.4]), 0.0, 0.5)
    assert np.allclose(line.points[-1] - line.points[0], [0.5, 0, 0]) and line.length == 0.5
    assert line.end == "length"
    ends = geotherm.trace(square, 4, 0.0, 9.0)
    assert ends.length == pytest.approx(2**0.5) and ends.end == "border"
    with pytest.raises(geotherm.InputError, match="leaves the surface"):
        geotherm.trace(square, 0, -1.0, 1.0)


def test_vectors_stay_parallel_on_the_plane(square):
    field = geotherm.transport(square, [4], [[3, 0]])
    assert np.allclose(field.vectors, 3 * field.frames[4, 0], rtol=0, atol=1e-9)
    assert np.allclose(np.linalg.norm(field.components, axis=1), 3)
    with pytest.raises(geotherm.InputError, match="rows"):
        geotherm.transport(square, [4, 3], [[3, 0]])


def test_values_are_those_of_the_nearest(bunny):
    values = geotherm.extend(bunny, [17, 900], [1, 5], backend="cholmod")
    assert values[17] == pytest.approx(1, abs=1e-3) and values[900] == pytest.approx(5, abs=1e-3)
    assert values.min() >= 1 - 1e-9 and values.max() <= 5 + 1e-9


def test_signed_distances_are_distances_with_sides(bunny):
    corners = [17, 900, 1500]
    signed = geotherm.signed_distance(bunny, [corners])
    turned = geotherm.signed_distance(bunny, [corners[::-1]], rule="sides")
    assert np.allclose(signed, -turned, rtol=0, atol=1e-9)
    assert np.allclose(signed[corners], 0) and signed.min() < 0 < signed.max()
    with pytest.warns(geotherm.ResultWarning, match="signed heat method answers"):
        heat = geotherm.signed_distance(bunny, [[17, 900]], closed=False)
    assert np.all(np.isfinite(heat))
    with pytest.raises(geotherm.InputError, match="each of the curves has one point"):
        geotherm.signed_distance(bunny, corners)
    with pytest.raises(geotherm.InputError, match="not sources as text"):
        geotherm.signed_distance(bunny, [corners, "curve:17,900,1500"])
    with pytest.raises(geotherm.InputError, match="do not separate"):
        geotherm.signed_distance(bunny, [[17, 900]], closed=False, rule="sides")


def test_lines_are_curves(bunny):
    distances = geotherm.Solver(bunny, method="exact").distance(840)
    rings = geotherm.isolines(bunny, distances, levels=[0.3])
    signed = geotherm.signed_distance(bunny, rings, rule="sides")
    again = geotherm.signed_distance(bunny, [rings[0]], closed=False, rule="sides")
    assert np.array_equal(signed, again)
    assert np.allclose(np.abs(signed), np.abs(distances - 0.3), rtol=0, atol=0.02)


def test_what_a_model_needs_is_made_once(bunny):
    first = geotherm.transport(bunny, [17], [[1, 0]])
    assert first.warnings == []
    again = geotherm.transport(bunny, [17], [[1, 0]])
    assert np.array_equal(first.vectors, again.vectors)
    other = geotherm.transport(bunny, [17], [[1, 0]], time_factor=4)
    assert not np.array_equal(first.vectors, other.vectors)


@pytest.fixture
def grid():
    """The square from 0 to 1 with 21 x 21 vertices, the inner ones moved a little."""
    random = np.random.default_rng(3)
    n = 20
    x, y = np.meshgrid(np.arange(n + 1) / n, np.arange(n + 1) / n)
    inner = (x > 0) & (x < 1) & (y > 0) & (y < 1)
    x, y = (c + inner * random.uniform(-0.2, 0.2, c.shape) / n for c in (x, y))
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).reshape(-1)
    faces = [(corner, corner + 1, corner + n + 2), (corner, corner + n + 2, corner + n + 1)]
    return geotherm.Mesh(
        np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3),
        np.concatenate([np.stack(f, axis=1) for f in faces]),
    )


def test_a_mean_on_the_plane_is_the_centroid(grid):
    points, weights = [30, 205, 380, 77], [1.0, 2.0, 0.5, 1.5]
    mean = geotherm.centres(grid, points, weights)
    assert np.allclose(mean.points[0], np.average(grid.vertices[points], axis=0, weights=weights))
    assert mean.converged[0] and not mean.warnings
    assert np.allclose(
        mean.distances[0], np.linalg.norm(grid.vertices[points] - mean.points[0], axis=1)
    )
    one = geotherm.centres(grid, [205])
    assert one.distances.shape == (1, 1) and one.distances[0, 0] == pytest.approx(0, abs=1e-9)
    with pytest.raises(geotherm.InputError, match="1 weight for 4 points"):
        geotherm.centres(grid, points, [1.0])


def test_a_median_is_what_scipy_finds(grid):
    optimize = pytest.importorskip("scipy.optimize")
    points = [30, 205, 380, 77, 412]
    places = grid.vertices[points, :2]
    best = optimize.minimize(
        lambda x: np.linalg.norm(places - x, axis=1).sum(), [0.4, 0.4], options={"gtol": 1e-12}
    )
    median = geotherm.centres(grid, points, kind="median")
    assert median.energies[0] == pytest.approx(best.fun / 5, rel=1e-9)
    assert np.allclose(median.points[0, :2], best.x, atol=1e-5)


def test_relaxation_on_the_plane_is_lloyds_with_scipy(grid):
    spatial = pytest.importorskip("scipy.spatial")
    corners = grid.vertices[grid.faces]
    areas = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    mass = np.bincount(grid.faces.reshape(-1), np.repeat(areas / 6, 3))
    begin = [3, 50, 120, 121, 300, 440]
    centres, energies = grid.vertices[begin], []
    for _ in range(9):
        distances, nearest = spatial.cKDTree(centres).query(grid.vertices)
        energies.append((mass * distances**2).sum())
        last = centres
        centres = np.array(
            [
                np.average(grid.vertices[nearest == k], axis=0, weights=mass[nearest == k])
                for k in range(len(begin))
            ]
        )
    relaxed = geotherm.Solver(grid, method="exact").relax(begin, 8)
    assert np.allclose(relaxed.energies, energies, rtol=1e-9)
    assert np.allclose(relaxed.points, last, atol=1e-9)
    assert np.all(np.diff(relaxed.energies) < 0)


def test_paths_of_a_tree_are_those_one_by_one(bunny):
    solver = geotherm.Solver(bunny, method="wavefront")
    ends = [99, 300, 900]
    tree = solver.paths(17, ends)
    assert [line.length for line in tree] == [solver.path(17, end).length for end in ends]
    with pytest.raises(geotherm.InputError):
        solver.paths(17, [])


def test_a_curve_may_pass_a_vertex_twice(grid):
    middle = 10 * 21 + 10
    eight = [middle, 5 * 21 + 5, 5 * 21 + 15, middle, 15 * 21 + 15, 15 * 21 + 5]
    signed = geotherm.signed_distance(grid, [eight], rule="sides")
    assert signed[7 * 21 + 10] < 0 and signed[13 * 21 + 10] < 0
    assert signed[10 * 21 + 7] > 0 and signed[10 * 21 + 13] > 0 and signed[0] > 0


def test_a_log_map_ends_at_its_largest_distance(bunny):
    whole, near = geotherm.log_map(bunny, 17), geotherm.log_map(bunny, 17, max_distance=0.4)
    inside = whole.distances <= 0.4
    assert 2 < inside.sum() < inside.size and np.array_equal(np.isfinite(near.distances), inside)
    assert np.array_equal(near.distances[inside], whole.distances[inside])
    assert np.array_equal(near.directions[inside], whole.directions[inside])
    waves = geotherm.log_map(bunny, 17, method="wavefront", max_distance=0.4)
    assert np.allclose(waves.distances[inside], near.distances[inside], rtol=1e-2)
    with pytest.raises(geotherm.InputError, match="largest distance"):
        geotherm.log_map(bunny, 17, max_distance=0)
