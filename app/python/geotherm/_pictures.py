# SPDX-License-Identifier: MIT
"""Pictures of answers, drawn by the program `geotherm` where it is installed."""

from __future__ import annotations

import html
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray, given
from geotherm._library import Error, InputError
from geotherm._domains import PointCloud, read_again
from geotherm._models import Model, moved_again
from geotherm._options import text_of

_WRITTEN = (".png", ".pdf", ".svg", ".html", ".glb")


class Picture(bytes):
    """The bytes of a .png, which notebooks show."""

    def _repr_png_(self) -> bytes:
        return bytes(self)


def _program() -> str:
    found = os.environ.get("GEOTHERM_PROGRAM") or shutil.which("geotherm")
    if not found:
        raise Error(
            "the program geotherm, which draws, was not found",
            "not-available",
            "install it, or set GEOTHERM_PROGRAM to where it is",
        )
    return found


_DOMAIN_ENDINGS = {
    "triangles": "ply",
    "tets": "vtu",
    "points": "xyz",
    "polygons": "obj",
    "grid": "nrrd",
}


def _model_words(model: Model, folder: Path, with_values: bool) -> list[str]:
    """The model as `geotherm render` takes it, in a file whose vertices have the same numbers. Values
    are drawn on its triangles, and so is what has moved: points would be joined anew."""
    maker, *recipe = model._recipe or (None,)
    if maker is read_again and not with_values:
        name = os.fsdecode(recipe[0])
        words = ["./" + name if name.startswith("-") else name]
        for option, value in recipe[1].items():
            words += [] if value is None else [f"--{option}", text_of(value)]
        return words
    if model.domain == "lengths":
        raise Error(
            "a surface of edge lengths has no places, so that it cannot be drawn", "not-available"
        )
    domain = "triangles" if with_values or maker is moved_again else model.domain
    path = folder / f"{model.name}.{_DOMAIN_ENDINGS[domain]}"
    if domain == "points":
        normals = recipe[1] if maker is PointCloud else None
        _write_points(path, model.vertices, normals)
    elif domain == "polygons":
        _write_polygons(path, model.vertices, recipe[1])
    elif domain == "grid":
        _write_grid(path, *recipe)
    else:
        model.write(path)
    return [str(path), "--domain", domain]


def _write_points(path: Path, points: AnyArray, normals: AnyArray | None) -> None:
    columns = [points]
    if normals is not None:
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        columns.append(normals / np.where(lengths > 0, lengths, 1))
    np.savetxt(path, np.hstack(columns), fmt="%.17g")


def _write_polygons(path: Path, points: AnyArray, faces: Sequence[Sequence[int]]) -> None:
    lines = ["v " + " ".join(repr(float(x)) for x in point) for point in points]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")


def _write_grid(
    path: Path, speeds: AnyArray, spacing: Sequence[float], origin: Sequence[float]
) -> None:
    axes = speeds.ndim
    samples = np.ascontiguousarray(speeds, dtype="<f8")
    steps = [f"({','.join(map(repr, row))})" for row in np.diag(spacing[:axes]).tolist()]
    head = (
        f"NRRD0004\ntype: double\ndimension: {axes}\nspace dimension: {axes}\n"
        f"sizes: {' '.join(map(str, samples.shape[::-1]))}\n"
        f"space directions: {' '.join(steps)}\n"
        f"space origin: ({','.join(repr(float(x)) for x in origin[:axes])})\n"
        "encoding: raw\nendian: little\n\n"
    )
    path.write_bytes(head.encode() + samples.tobytes())


def _source_words(sources: Sequence[str], folder: Path) -> list[str]:
    """Many points go into a file, which a command line would not hold."""
    words: list[str] = []
    listed: list[str] = []
    for source in sources:
        if len(sources) > 100 and re.match(r"\d+$|face:|xyz:", source):
            listed.append(source)
        else:
            words += ["-s", source]
    if listed:
        (folder / "sources.txt").write_text("\n".join(listed) + "\n")
        words += ["--source-file", str(folder / "sources.txt")]
    return words


def _option_words(settings: Mapping[str, Any]) -> list[str]:
    words = []
    for key, value in settings.items():
        option = f"--{key.replace('_', '-')}"
        if value is None or key == "check":
            continue
        if key in ("strict", "reverse", "curve"):  # they stand alone
            words += [option] if value else []
        elif key in ("bar", "caption", "markers"):  # they are there
            words += [] if value else [f"--no-{key}"]
        else:
            words += [option, text_of(value)]
    return words


def _failure(message: str) -> Error:
    devices = subprocess.run([_program(), "devices"], capture_output=True, check=False)
    return Error(message, "no-device") if devices.returncode != 0 else InputError(message)


def drawn(
    model: Model,
    sources: Sequence[str],
    settings: Mapping[str, Any],
    ending: str,
    values: AnyArray | None = None,
) -> bytes:
    """What `geotherm render` makes of sources on the model, or of values of its vertices: the bytes
    of a .png or .html file. Raises: Error, with what the program says."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        command = [_program(), "render", *_model_words(model, folder, values is not None)]
        if values is not None:
            np.save(folder / "values.npy", values)
            command += ["--field", str(folder / "values.npy")]
        command += _source_words(sources, folder) + _option_words(settings)
        target = folder / f"picture{ending}"
        run = subprocess.run(
            [*command, "--quiet", "-o", str(target)], capture_output=True, text=True, check=False
        )
        if run.returncode != 0:
            said = run.stderr.strip().removeprefix("geotherm: error: ").splitlines() or ["it failed"]
            raise _failure(f"geotherm render: {said[-1]}")
        return target.read_bytes()


def plotted(
    model: Model,
    sources: Sequence[str],
    settings: Mapping[str, Any],
    size: tuple[int, int],
    path: str | os.PathLike[str] | None,
    values: Any = None,
) -> Picture:
    """A picture, which is written, too, where there is a path."""
    numbers = None
    if values is not None:
        numbers = given(values, "values", 1)[1]
        if len(numbers) != model.n_vertices:
            raise InputError(f"values has {len(numbers)} numbers for {model.n_vertices} vertices")
    try:
        width, height = size
    except (TypeError, ValueError):
        raise InputError(f"size is {size!r}", hint="give width and height in pixels") from None
    settings = {"size": f"{width}x{height}", **settings}
    ending = ".png" if path is None else Path(os.fspath(path)).suffix.lower()
    if ending not in _WRITTEN:
        raise InputError(f"path ends in {ending!r}", hint="write " + " ".join(_WRITTEN))
    made = drawn(model, sources, settings, ending, numbers)
    if path is not None:
        try:
            Path(path).write_bytes(made)
        except OSError as why:
            raise Error(f"{path}: {why.strerror}", "bad-file") from None
    if ending == ".png":
        return Picture(made)
    return Picture(drawn(model, sources, settings, ".png", numbers))


def as_html(model: Model, sources: Sequence[str], settings: Mapping[str, Any], report: str) -> str:
    """The picture that turns, else a still one, else the report alone."""
    import base64

    text = f"<pre>{html.escape(report)}</pre>"
    try:
        page = drawn(model, sources, settings, ".html").decode()
        frame = f'<iframe srcdoc="{html.escape(page)}" width="100%" height="560"></iframe>'
        return frame + text
    except Error:
        pass
    try:
        data = base64.b64encode(drawn(model, sources, settings, ".png")).decode()
        return f'<img src="data:image/png;base64,{data}">{text}'
    except Error:
        return text
