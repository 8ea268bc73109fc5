# SPDX-License-Identifier: MIT
"""Answers are those of the program, and hold what they say."""

import inspect
import pickle

import numpy as np
import pytest

import geotherm


def test_a_distance_has_the_bits_of_the_command_line(solver, program, tmp_path):
    for sources, words in [(17, ["-s", 17]), ([3, 99], ["-s", "3,99"]), ("boundary", None)]:
        if words is None:
            with pytest.raises(geotherm.Error, match="no boundary"):
                solver.distance(sources)
            continue
        path = tmp_path / "d.npy"
        program("solve", "bunny", *words, "--no-check", "-o", path)
        assert np.array_equal(solver.distance(sources), np.load(path))


def test_rows_have_the_bits_of_the_command_line(solver, program, tmp_path):
    path = tmp_path / "rows.npy"
    program("solve", "bunny", "-s", "random:50:1", "--each", "--float32", "--no-check", "-o", path)
    rows = solver.distances("random:50:1", dtype="f4")
    assert rows.dtype == np.float32 and np.array_equal(rows, np.load(path))


@pytest.mark.parametrize(
    "method", ["heat", "wavefront", "wavefront-fine", "fast-marching", "exact"]
)
def test_every_method_answers(bunny, solver, method):
    exact = geotherm.Solver(bunny, method="exact").distance(17)
    d = geotherm.Solver(bunny, method=method).distance(17)
    assert d[17] == 0 and abs(d - exact).max() < 0.05 * exact.max()


def test_sources_of_every_kind(bunny, solver):
    corner = bunny.vertices[17]
    assert np.array_equal(solver.distance(corner), solver.distance(17))
    assert np.array_equal(solver.distance(list(corner)), solver.distance(17))
    face = int(np.flatnonzero((bunny.faces == 17).any(axis=1))[0])
    weights = (bunny.faces[face] == 17).astype(float)
    assert np.array_equal(solver.distance((face, weights)), solver.distance(17))
    assert np.array_equal(solver.distance("17"), solver.distance(17))
    many = [17, (face, [0.2, 0.3, 0.5]), corner, "99", np.array([3, 4])]
    exact = geotherm.Solver(bunny, method="exact")
    single = exact.distances([17, (face, [0.2, 0.3, 0.5]), 99, 3, 4])
    assert np.allclose(exact.distance(many), single.min(axis=0), rtol=0, atol=1e-9)


def test_sets_are_rows(solver):
    rows = solver.distances([17, [17, 99], np.array([3, 4])])
    expected = [solver.distance(17), solver.distance([17, 99]), solver.distance([3, 4])]
    assert np.allclose(rows, expected, rtol=0, atol=1e-12)


def test_an_answer_says_how_right_it_is(solver):
    answer = solver.solve([17, 99], labels=True, fields=True)
    assert 0 < answer.error["mean_relative"] < 0.03
    assert set(answer.nearest) == {0, 1} and answer.nearest[99] == 1
    assert answer.field("error").shape == (2000,)
    assert answer.field("gradient-angle").shape == (3996,)
    assert answer.heat.max() == 1
    assert "bunny" in str(answer) and "error" in repr(answer)
    assert answer.warnings == answer.report["warnings"]
    assert np.array_equal(answer.distances, solver.distance([17, 99]))
    assert solver.solve(17, check="off").error is None
    with pytest.raises(geotherm.Error, match="there is no array 'no'.*distances"):
        answer.field("no")


def test_an_answer_is_written(solver, tmp_path):
    solver.solve(17).write(tmp_path / "d.npy")
    assert np.array_equal(np.load(tmp_path / "d.npy"), solver.distance(17))
    with pytest.raises(geotherm.Error, match="obj"):
        solver.solve(17).write(tmp_path / "d.obj")


def test_a_path_is_as_long_as_the_distance(bunny, solver):
    path = solver.path(17, 900)
    exact = geotherm.Solver(bunny, method="exact")
    assert path.length == pytest.approx(exact.distance(17)[900], rel=1e-6)
    assert np.array_equal(path.points[[0, -1]], bunny.vertices[[17, 900]])
    steps = np.linalg.norm(np.diff(path.points, axis=0), axis=1)
    assert steps.sum() == pytest.approx(path.length)
    corners = bunny.vertices[bunny.faces[path.faces]]
    assert np.allclose(np.einsum("nk,nkd->nd", path.weights, corners), path.points)
    assert solver.path(17, 900, field="distance").length >= path.length


def test_a_loop_round_a_handle_is_as_long_as_the_handle_is_thick(torus):
    V, F, through, length = torus
    loop = geotherm.Solver(geotherm.Mesh(V, F)).path(*through, closed=True)
    assert loop.closed and loop.length == pytest.approx(length, rel=1e-6)
    assert np.array_equal(loop.points[0], loop.points[-1])


def test_what_lines_cannot_say_is_a_warning(solver):
    with pytest.warns(geotherm.ResultWarning, match="drawn together to a point"):
        loop = solver.path(17, 900, closed=True)
    assert loop.length == 0 and loop.closed


def test_isolines_lie_at_their_levels(bunny, solver, tmp_path):
    d = solver.distance(17)
    lines = geotherm.isolines(bunny, d, spacing=0.5)
    assert {line.value for line in lines} == {0.5, 1.0, 1.5, 2.0, 2.5}
    line = lines[0]
    at = np.einsum("nk,nk->n", line.weights, d[bunny.faces[line.faces]])
    assert np.allclose(at, 0.5)
    lines.write(tmp_path / "lines.csv")
    assert (tmp_path / "lines.csv").stat().st_size > 0
    assert len(lines[:2]) == 2 and lines[-1].value == 2.5


def test_samples_cover(solver):
    samples = solver.farthest_points(20, first=17)
    assert samples.vertices[0] == 17 and len(set(samples.vertices)) == 20
    assert (np.diff(samples.radius[1:]) <= 0).all()
    assert samples.distances.max() == pytest.approx(samples.radius[-1])
    assert (samples.nearest[samples.vertices] == np.arange(20)).all()


def test_pairs_are_rows_at_their_vertices(solver):
    ids = [3, 99, 512]
    assert np.array_equal(solver.pairs(ids), solver.distances(ids)[:, ids])
    symmetric = solver.pairs(ids, symmetric=True)
    assert np.array_equal(symmetric, symmetric.T)


def test_an_update_is_a_new_solver_on_the_moved_mesh(bunny, solver):
    moved = bunny.vertices * [1, 2, 1]
    later = solver.update(moved)
    fresh = geotherm.Solver(geotherm.Mesh(moved, bunny.faces))
    assert np.allclose(later.distance(17), fresh.distance(17), atol=1e-6)
    assert np.array_equal(later.model.vertices, moved)
    assert np.array_equal(solver.model.vertices, bunny.vertices)
    assert np.array_equal(pickle.loads(pickle.dumps(later)).model.vertices, moved)


def test_isolines_of_both_signs(bunny):
    height = bunny.vertices[:, 1] - bunny.vertices[:, 1].mean()
    values = {round(line.value, 6) for line in geotherm.isolines(bunny, height, spacing=0.25)}
    assert values == {0.25 * i for i in range(-40, 40) if height.min() < 0.25 * i < height.max()}
    assert min(values) < 0 < max(values) and 0 in values
    below = {line.value for line in geotherm.isolines(bunny, height - 100, count=3)}
    assert len(below) == 3 and max(below) < 0
    assert len(geotherm.isolines(bunny, np.full(bunny.n_vertices, -100.1), count=10)) == 0
    triangle = geotherm.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    widest = geotherm.isolines(triangle, [-1.7e308, 1.7e308, 0], count=3)
    assert [round(line.value / 1.7e308, 9) for line in widest] == [-0.5, 0, 0.5]


def test_labels_are_looked_up_in_the_regions(solver):
    """Whatever the order in which sources are given."""
    for sources in ([5, 5, 700], ["700", 5], [(700, [0.2, 0.3, 0.5]), 5, [0.0, 0.0, 0.0], 900]):
        answer = solver.solve(sources, labels=True, check="off")
        regions = answer.report["regions"]
        assert [region["label"] for region in regions] == list(range(len(regions)))
        named = {one["source"]: one["label"] for one in regions if isinstance(one["source"], int)}
        assert len(named) == 2 and all(answer.nearest[v] == label for v, label in named.items())


def test_answers_and_lines_can_be_pickled(solver, tmp_path):
    answer = solver.solve(17, labels=True)
    again = pickle.loads(pickle.dumps(answer))
    assert np.array_equal(again.distances, answer.distances)
    assert np.array_equal(again.nearest, answer.nearest)
    assert str(again) == str(answer) and again.report == answer.report
    with pytest.raises(geotherm.Error, match="pickled"):
        again.write(tmp_path / "a.ply")
    path = solver.path(17, 20)
    other = pickle.loads(pickle.dumps(path))
    assert np.array_equal(other.points, path.points) and other.length == path.length


def test_a_pickled_solver_gives_the_same_bits(bunny):
    solver = geotherm.Solver(bunny, time_factor=2.0, threads=1)
    again = pickle.loads(pickle.dumps(solver))
    assert again.options == solver.options == {"time_factor": 2.0, "threads": 1}
    assert np.array_equal(again.distance(17), solver.distance(17))


def test_options_are_those_of_the_table():
    shown = inspect.signature(geotherm.Solver).parameters
    table = geotherm.options()
    of_solver = {name for name, each in table.items() if each["group"] != "model"}
    assert set(shown) == of_solver | {"model", "progress"} and "time_factor" in of_solver
    assert shown["heat"].default == "unit" and all(each["help"] for each in table.values())
    for name, each in table.items():
        for value in {each["default"], *each["values"]}:
            geotherm._options.options_of({name: value})


def test_an_option_that_is_none_is_a_wrong_keyword(bunny):
    with pytest.raises(TypeError, match="did you mean 'method'"):
        geotherm.Solver(bunny, methd="exact")
    with pytest.raises(TypeError, match="no option 'weld'; there are method, backend"):
        geotherm.Solver(bunny, weld=0)
    with pytest.raises(TypeError, match="no option 'threads'"):
        geotherm.read("bunny", threads=1)


def test_switches_are_booleans_of_numpy_too(bunny, solver):
    assert geotherm.Solver(bunny, strict=np.True_).options == {"strict": np.True_}
    with pytest.raises(geotherm.Error) as caught:
        geotherm.Solver(bunny, progress=lambda *_: np.False_)
    assert caught.value.code == "cancelled"


def test_a_solver_tells_what_it_took(solver):
    report = solver.report()
    assert report["timing_ms"]["setup"] > 0 and report["options"]["method"] == "heat"
    assert "Solver by heat" in repr(solver)
