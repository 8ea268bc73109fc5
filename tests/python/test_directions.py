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
    assert geotherm.trace(square, 4, 0.0, 9.0).length == pytest.approx(2**0.5)
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
    assert np.all(np.isfinite(geotherm.signed_distance(bunny, [[17, 900]], closed=False)))
    with pytest.raises(geotherm.InputError, match="do not separate"):
        geotherm.signed_distance(bunny, [[17, 900]], closed=False, rule="sides")
