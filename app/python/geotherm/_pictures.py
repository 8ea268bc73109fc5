# SPDX-License-Identifier: MIT
"""Pictures of answers, drawn by the program `geotherm` where it is installed."""

from __future__ import annotations

import html
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray, given
from geotherm._library import Error, InputError
from geotherm._models import Mesh, Model


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


def _model_file(model: Model, folder: Path) -> str:
    if isinstance(model, Mesh):
        path = folder / f"{model.name}.ply"
        model.write(path)
        return str(path)
    raise Error(f"a picture of {model.domain} is drawn by geotherm render alone", "not-available")


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
        command = [_program(), "render", _model_file(model, folder)]
        if values is not None:
            np.save(folder / "values.npy", values)
            command += ["--field", str(folder / "values.npy")]
        for source in sources:
            command += ["-s", source]
        for key, value in settings.items():
            option = f"--{key.replace('_', '-')}"
            if value is None or key == "check":
                continue
            if key in ("strict", "reverse", "curve"):  # they stand alone
                command += [option] if value else []
            elif key in ("bar", "caption", "markers"):  # they are there
                command += [] if value else [f"--no-{key}"]
            else:
                command += [option, {True: "on", False: "off"}.get(value, str(value))]
        target = folder / f"picture{ending}"
        run = subprocess.run(
            [*command, "--quiet", "-o", str(target)], capture_output=True, text=True, check=False
        )
        if run.returncode != 0:
            said = run.stderr.strip().removeprefix("geotherm: error: ").splitlines() or ["it failed"]
            raise Error(f"geotherm render: {said[-1]}", "no-device")
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
