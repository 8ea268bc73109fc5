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

from geotherm._library import Error
from geotherm._models import Mesh, Model


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
) -> bytes:
    """What `geotherm render` makes of sources on the model: the bytes of a .png or .html file.
    Raises: Error, with what the program says."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        command = [_program(), "render", _model_file(model, folder)]
        for source in sources:
            command += ["-s", source]
        for key, value in settings.items():
            option = f"--{key.replace('_', '-')}"
            if value is None or key == "check":
                continue
            if key == "strict":  # it stands alone
                command += [option] if value else []
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
