# SPDX-License-Identifier: MIT
"""Whatever is given: an answer, or one error that names the argument."""

import random

import numpy as np
import pytest

import geotherm

V = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
F = [[0, 1, 2], [0, 2, 3]]
NAN = float("nan")


@pytest.mark.parametrize(
    "vertices, faces, named",
    [
        ([], F, "vert"),
        ([[0, 0]], F, "vertices"),
        ("text", F, "vertices"),
        (None, F, "vertices"),
        ([[0, 0, NAN], [1, 0, 0], [1, 1, 0], [0, 1, 0]], F, "vertex 0"),
        ([[0, 0, 0], [1, 0], [1, 1, 0]], F, "vertices"),
        (np.array(V, object), F, "vertices"),
        (np.array(V, complex), F, "vertices"),
        (V, [], "face"),
        (V, [[0, 1, 4]], "face 0"),
        (V, [[0, 1, -1]], "face 0"),
        (V, [[0, 1, 2**40]], "faces"),
        (V, [[0, 1, 0.5]], "faces"),
        (V, [[0, 1, NAN]], "faces"),
        (V, [[0, 1]], "faces"),
        (V, [0, 1, 2], "faces"),
        (V, np.zeros((1, 3), "U1"), "faces"),
        (V, np.full((1, 3), 2**64 - 1, np.uint64), "faces"),
        (V, {"a": 1}, "faces"),
        (7, None, "faces"),
    ],
)
def test_a_wrong_mesh_is_one_error(vertices, faces, named):
    with pytest.raises(ValueError, match=named) as caught:
        geotherm.Mesh(vertices, faces)
    assert isinstance(caught.value, geotherm.Error)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "sources",
    [
        [],
        np.empty(0, int),
        -1,
        2000,
        2**70,
        1.5,
        None,
        "nonsense",
        "17\n18",
        "17\0",
        [17, None],
        True,
        np.ones(2000, bool),
        np.zeros((2, 2)),
        [NAN, 0, 0],
        (7, [0.5, 0.6, 0.7]),
        (7, [1, 0]),
        (99999, [1, 0, 0]),
        ("x", [1, 0, 0]),
        {"a": 1},
        object(),
        b"17",
        [bytearray(b"17")],
        [[[1, 0, 0], [0, 1, 0]]],
        [17, [3, [99, 5]]],
        "\ud800",
    ],
)
def test_wrong_sources_are_one_error(solver, sources):
    for ask in (solver.distance, solver.distances, solver.solve):
        with pytest.raises(ValueError, match="source|coordinate|'17|random") as caught:
            ask(sources)
        assert isinstance(caught.value, geotherm.Error)


def test_lists_of_whole_numbers_in_a_list_are_no_set(solver):
    """As an array they are places; row for row they are vertices."""
    corners = [[1, 0, 0], [0, 1, 0]]
    with pytest.raises(geotherm.InputError, match="vertices or a place; give one list"):
        solver.distance(corners)
    places = solver.distance(np.array(corners))
    assert np.array_equal(places, solver.distance([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))
    rows = solver.distances(corners)
    assert rows.shape[0] == 2 and np.allclose(rows, solver.distance([0, 1]), rtol=0, atol=1e-9)


def test_text_and_numbers_are_told_apart(solver):
    for ask, said in [
        (lambda: solver.distances([["17"]]), "a set that holds the text '17'; give numbers"),
        (lambda: solver.path("17", 900), "the text '17' before what is no text; give the texts last"),
    ]:
        with pytest.raises(geotherm.InputError, match=said):
            ask()
    assert solver.path("17", "900").length == solver.path(17, 900).length
    assert np.array_equal(solver.distances([99, "17"]), solver.distances([99, 17]))


@pytest.mark.parametrize(
    "options",
    [
        {"method": "no"},
        {"time_factor": -1},
        {"time_factor": NAN},
        {"threads": -3},
        {"threads": 1.5},
        {"backend": "no"},
        {"check": "no"},
        {"refine": 99},
        {"constraint": "pin-vertex:99999"},
        {"laplacian": "\0"},
        {"progress": 7},
    ],
)
def test_wrong_options_are_one_error(bunny, options):
    with pytest.raises(geotherm.Error) as caught:
        geotherm.Solver(bunny, **options)
    assert "\n" not in str(caught.value)


def test_wrong_arguments_of_the_others_are_named(bunny, solver):
    d = solver.distance(17)
    wrong = [
        (lambda: geotherm.isolines(bunny, d[:3], count=3), "values"),
        (lambda: geotherm.isolines(bunny, d, levels=[2, 1]), "levels"),
        (lambda: geotherm.isolines(bunny, d, levels=[NAN]), "levels"),
        (lambda: geotherm.isolines(bunny, d), "levels"),
        (lambda: solver.solve(17, check="off labels"), "check is 'off labels'"),
        (lambda: solver.distances(np.array([[0, 0, 0], [1, 1, 1]])), r"shape \(2, 3\)"),
        (lambda: geotherm.isolines(bunny, d, spacing=0), "spacing"),
        (lambda: solver.path(17), "point"),
        (lambda: solver.path(17, 99999), "99999"),
        (lambda: solver.path(17, 99, field="no"), "field"),
        (lambda: solver.farthest_points(0), "count"),
        (lambda: solver.farthest_points(3, first=-7), "first"),
        (lambda: solver.update(np.zeros((3, 3))), "positions|vertices"),
        (lambda: solver.update(np.full((2000, 3), NAN)), "vertex 0"),
        (lambda: solver.distances([17], targets=[2000]), "targets"),
        (lambda: solver.distances([17], targets=[]), "targets"),
        (lambda: solver.distances([17], targets=[0.5]), "targets"),
        (lambda: solver.distances([17], max_distance=NAN), "max_distance"),
        (lambda: solver.distances([17], out="rows.txt"), "npy"),
        (lambda: solver.distances([17], dtype="i8"), "dtype"),
        (lambda: solver.distances([17], out="rows\0.npy"), "out"),
        (lambda: geotherm.read("no_such_file.ply"), "no_such_file"),
        (lambda: geotherm.read(7), "path"),
        (lambda: geotherm.Grid(np.full((3, 3), NAN)), "speed"),
        (lambda: geotherm.Grid(np.zeros(3)), "speeds"),
        (lambda: geotherm.Grid(np.full((8, 9, 3), 255, np.uint8)), "an image in colours"),
        (lambda: geotherm.Polygons(V, [[0, 1, 9]]), "9"),
        (lambda: geotherm.Polygons(V, 7), "faces"),
        (lambda: geotherm.TetMesh(V, [[0, 1, 2]]), "tets"),
        (lambda: geotherm.PointCloud([[NAN, 0, 0]]), "point 0"),
        (lambda: geotherm.PointCloud(V, normals=V[:2]), "normals"),
        (lambda: geotherm.log_map(V, 17), "model is list"),
        (lambda: geotherm.isolines(V, d, count=3), "model is list"),
        (lambda: geotherm.isolines(bunny, d, count=2.5), "count is 2.5"),
        (lambda: geotherm.centres(bunny, [1, 2], kind=5), "kind is 5"),
        (lambda: geotherm.trace(bunny, 17, "x", 1), "direction is 'x'"),
        (lambda: geotherm.Grid([[1, 2], [3]]), "speeds"),
        (lambda: geotherm.Grid(np.ones((2, 2), complex)), "speeds is an array of complex"),
        (lambda: geotherm.TetMesh(object()), "tets"),
        (lambda: solver.distances([17], max_distance="x"), "max_distance"),
        (lambda: solver.distances([17], targets=np.array([2**64 - 1])), "targets holds 1844"),
        (lambda: solver.distance(np.array([2**64 - 1])), "sources holds 1844"),
        (lambda: solver.solve(17, max_distance=None), "max_distance"),
        (lambda: solver.farthest_points(None), "count is None"),
        (lambda: solver.farthest_points("x"), "count is 'x'"),
        (lambda: solver.farthest_points(2.7), "count is 2.7"),
        (lambda: solver.farthest_points(3, first=2.5), "first is 2.5"),
        (lambda: solver.relax([1, 2], 2**64 + 1), "steps is 1844"),
        (lambda: solver.pairs([1, [2, 3]]), "vertices"),
        (lambda: geotherm.read("a" * 5000), "aaa"),
        (lambda: geotherm.read("\ud800"), "no file is called"),
        (lambda: geotherm.Grid(np.ones((2, 2)), spacing=[[1], [1, 2]]), "spacing is"),
        (lambda: geotherm.Grid(np.ones((2, 2)), spacing=[]), "spacing has 0 numbers"),
        (lambda: geotherm.Mesh(V, F, mask=[]), "mask is empty"),
        (lambda: geotherm.Mesh(V, F, mask=[[1], [1, 2]]), "mask"),
        (lambda: geotherm.Mesh(V, F, mask=[0, NAN, 0, 0]), "mask: number 1 is nan; give 0"),
        (lambda: geotherm.TetMesh(np.eye(4, 3), [[0, 0, 0, 0]]), "the volume of 1 tet has no border"),
        (lambda: geotherm.Polygons(V, []), "no face"),
        (lambda: geotherm.log_map(bunny, "17@0.5"), "point 0 has the offset 0.5"),
        (lambda: geotherm.centres(bunny, [3, (7, [0.5, 0.5, 0.5])]), "0.5, 0.5 and 0.5; give three"),
        (lambda: solver.relax(["17@0.5"], 1), "point 0 has the offset 0.5"),
        (lambda: solver.path(3, "curve:4,5"), "point 1 is several"),
        (lambda: geotherm.isolines(bunny, d, levels=[0, 2, 1]), "number 2 is 1, after 2; give"),
        (lambda: geotherm.isolines(bunny, d, levels=[0, NAN]), "number 1 is nan, after 0; give"),
        (lambda: solver.solve(17).field(5), "name is 5"),
        (lambda: solver.solve(17).field("error\0zzz"), "name holds a zero byte"),
        (lambda: solver.solve(17).field("\udc80"), "there is no array"),
    ]
    for ask, named in wrong:
        with pytest.raises(geotherm.Error, match=named):
            ask()


def test_random_nonsense_is_an_answer_or_an_error(solver):
    chance = random.Random(17)
    pool = [
        *(0, 17, -1, 2**31, 2**63, 1.5, NAN, True, None, "boundary", "3,4", "", "xyz:0:0:0", b"1"),
        *([], [1], [[1, 2], [3]], (1, [1, 0, 0]), {1}, np.array(3), np.zeros((0, 3)), np.eye(3)),
        *(np.arange(3, dtype="u1"), np.array(["a"]), np.array([None]), np.ma.masked_all(3), [[[]]]),
    ]
    for _ in range(3000):
        one = chance.choice(pool)
        if chance.random() < 0.5:
            one = [one, chance.choice(pool)]
        ask = chance.choice([solver.distance, solver.distances])
        try:
            answer = ask(one)
        except geotherm.Error as error:
            assert str(error) and "\n" not in str(error)
        else:
            given = one if isinstance(one, list) else [one]
            assert not any(isinstance(each, bytes) for each in given)
            assert not np.isnan(answer).any() and answer.shape[-1] == 2000
