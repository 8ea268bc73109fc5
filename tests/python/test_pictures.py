# SPDX-License-Identifier: MIT
"""Pictures by the program of this build."""

import os
from types import SimpleNamespace

import numpy as np
import pytest

import geotherm
from geotherm import _pictures
from geotherm._sources import Taken


@pytest.fixture
def answer(solver):
    return solver.solve([17, (7, [0.2, 0.3, 0.5])])


def test_a_picture_is_a_png(answer, tmp_path):
    if not os.path.exists(os.environ["GEOTHERM_PROGRAM"]):
        pytest.skip("this build has no command line")
    try:
        picture = answer.plot(tmp_path / "a.png", size=(120, 90), view="smooth")
    except geotherm.Error as why:
        if os.environ.get("GEOTHERM_REQUIRE_VULKAN"):
            raise
        pytest.skip(str(why))
    assert picture[:8] == b"\x89PNG\r\n\x1a\n" and picture._repr_png_() == picture
    assert int.from_bytes(picture[16:20], "big") == 120
    assert (tmp_path / "a.png").read_bytes() == picture
    with pytest.raises(geotherm.InputError, match="no_such|no-such|view"):
        answer.plot(view="no_such")


def test_numbers_of_vertices_are_drawn(bunny, tmp_path):
    if not os.path.exists(os.environ["GEOTHERM_PROGRAM"]):
        pytest.skip("this build has no command line")
    waves = np.sin(bunny.vertices[:, 0])
    try:
        picture = bunny.plot(waves, tmp_path / "a.png", size=(120, 90), bar=False)
        plain = bunny.plot(size=(120, 90))
        upside = bunny.plot(-waves, size=(120, 90), bar=False)
    except geotherm.Error as why:
        if os.environ.get("GEOTHERM_REQUIRE_VULKAN"):
            raise
        pytest.skip(str(why))
    assert (tmp_path / "a.png").read_bytes() == picture
    bunny.plot(waves, tmp_path / "a.html")
    assert b"<html" in (tmp_path / "a.html").read_bytes()[:200]
    assert len({bytes(picture), bytes(plain), bytes(upside)}) == 3
    with pytest.raises(geotherm.InputError, match="values has 3 numbers for"):
        bunny.plot([1, 2, 3])


def test_zero_and_one_are_numbers_to_the_program(bunny):
    assert _pictures._option_words({"threads": 1, "time_factor": 1.0, "azimuth": 0, "roll": 0.0}) == [
        *("--threads", "1", "--time-factor", "1.0", "--azimuth", "0", "--roll", "0.0")
    ]
    words = _pictures._option_words({"light": True, "strict": False, "bar": False, "markers": True})
    assert words == ["--light", "on", "--no-bar"]
    assert _pictures._option_words({"light": np.True_}) == ["--light", "on"]


V_OF_SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]


def domains():
    y, x = np.mgrid[:6, :7]
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]]
    angle = np.arange(300) * 2.399963
    z = np.linspace(-1, 1, 300)
    sphere = np.stack([np.cos(angle), np.sin(angle)]) * np.sqrt(1 - z * z)
    points = np.vstack([sphere, z]).T
    return [
        geotherm.PointCloud(points, normals=points * 2),
        geotherm.Solver(geotherm.PointCloud(points)).update(points * [1, 1, 3]).model,
        geotherm.Grid(1.0 + (x > 3), spacing=(0.5, 2), origin=(4, 5)),
        geotherm.Grid(np.ones((3, 4, 5)), spacing=(1, 2, 3), origin=(7, 8, 9)),
        geotherm.TetMesh(corners, [[0, 1, 2, 4], [0, 2, 3, 4]]),
        geotherm.Polygons(corners, [[0, 1, 2, 3], [0, 1, 4]]),
    ]


@pytest.mark.parametrize("model", domains(), ids=lambda model: model.domain)
def test_every_domain_reaches_the_program_as_it_is(model, tmp_path):
    """But for points that have moved, which are triangles: joined anew they would be others."""
    path, _, domain = _pictures._model_words(model, tmp_path, False)
    again = geotherm.read(path, domain=domain)
    moved = model._recipe[0] is geotherm._models.moved_again
    assert again.domain == ("triangles" if moved else model.domain)
    assert np.array_equal(again.vertices, model.vertices)
    assert np.array_equal(again.faces, model.faces)
    assert np.array_equal(geotherm.Solver(again).distance(1), geotherm.Solver(model).distance(1))
    path, _, domain = _pictures._model_words(model, tmp_path, True)
    assert domain == "triangles" and np.array_equal(geotherm.read(path).vertices, model.vertices)


def test_a_file_is_no_option(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.savetxt("-p.xyz", domains()[0].vertices)
    (path,) = _pictures._model_words(geotherm.read("-p.xyz"), tmp_path, False)
    assert not path.startswith("-") and os.path.samefile(path, "-p.xyz")


def test_faces_as_floats_are_drawn(tmp_path):
    model = geotherm.Polygons(V_OF_SQUARE, np.array([[0.0, 1.0, 2.0, 3.0]]))
    path, *_ = _pictures._model_words(model, tmp_path, False)
    assert geotherm.read(path, domain="polygons").n_faces == model.n_faces


def test_a_picture_ends_where_the_answer_does(solver, monkeypatch):
    asked = []

    def draws(model, sources, settings, ending, values=None):
        asked.append(_pictures._option_words(settings))
        return b"<p>"

    monkeypatch.setattr(_pictures, "drawn", draws)
    answer = solver.solve(17, max_distance=0.25)
    answer.plot(size=(60, 40))
    answer._repr_html_()
    assert len(asked) == 2 and all(words[-2:] == ["--max-distance", "0.25"] for words in asked[1:])
    assert "--max-distance" in asked[0]
    solver.solve(17).plot()
    assert "--max-distance" not in asked[2]


def test_many_sources_are_a_file(tmp_path):
    words = _pictures._source_words([*map(str, range(200)), "face:1:1:0:0", "boundary"], tmp_path)
    assert words == ["-s", "boundary", "--source-file", str(tmp_path / "sources.txt")]
    assert (tmp_path / "sources.txt").read_text().splitlines()[199:] == ["199", "face:1:1:0:0"]


def test_a_cloud_is_drawn_and_lengths_are_not(tmp_path):
    cloud = domains()[0]
    try:
        picture = geotherm.Solver(cloud, threads=1).solve([0]).plot(size=(60, 40), samples=1)
    except geotherm.Error as why:
        if why.code != "no-device" or os.environ.get("GEOTHERM_REQUIRE_VULKAN"):
            raise
        pytest.skip(str(why))
    assert picture[:4] == b"\x89PNG" and cloud.plot(cloud.vertices[:, 2], size=(60, 40)) != picture
    with pytest.raises(geotherm.Error, match="no places"):
        geotherm.Mesh.from_edge_lengths([[0, 1, 2]], [[3, 4, 5]]).plot()


def test_what_cannot_be_written_is_said(bunny, tmp_path):
    with pytest.raises(geotherm.InputError, match="path ends in '.jpg'"):
        bunny.plot(path=tmp_path / "a.jpg")
    with pytest.raises(geotherm.InputError, match="size is 'a'"):
        bunny.plot(size="a")


def test_without_the_program_the_report_is_shown(answer, monkeypatch):
    monkeypatch.setenv("GEOTHERM_PROGRAM", "")
    monkeypatch.setenv("PATH", "")
    assert answer._repr_html_().startswith("<pre>model")
    with pytest.raises(geotherm.Error) as caught:
        answer.plot()
    assert caught.value.code == "not-available"


def test_a_page_is_framed_and_a_still_picture_takes_its_place(monkeypatch):
    def draws(*endings):
        def one(model, sources, settings, ending):
            if ending not in endings:
                raise geotherm.Error("no")
            return b'<p class="a">'

        monkeypatch.setattr(_pictures, "drawn", one)
        return _pictures.as_html(SimpleNamespace(), [], {}, "<report>")

    assert 'srcdoc="&lt;p class=&quot;a&quot;&gt;"' in draws(".html", ".png")
    assert draws(".png").startswith('<img src="data:image/png;base64,PHA')
    assert draws() == "<pre>&lt;report&gt;</pre>"


def test_sources_are_told_to_the_program_as_they_were_given():
    taken = Taken([17, (7, [0.25, 0.25, 0.5]), [0.0, 1.0, 2.0], "boundary"])
    assert taken.texts() == ["17", "face:7:0.25:0.25:0.5", "xyz:0.0:1.0:2.0", "boundary"]
