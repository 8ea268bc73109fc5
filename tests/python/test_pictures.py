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
    with pytest.raises(geotherm.Error, match="no_such|no-such|view"):
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
