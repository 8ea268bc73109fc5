# SPDX-License-Identifier: MIT
"""Domains other than triangles, and models of files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray, number_in
from geotherm._library import InputError, Progress, Watch, create, path_bytes
from geotherm._models import (
    GRID,
    OF_SURFACES,
    POINTS,
    POLYGONS,
    TETS,
    Mesh,
    Model,
    attributes,
    cells_of,
    refuse_beside,
)
from geotherm._options import features, given_options, options_of


class Polygons(Model):
    """Faces with any number of corners, which nothing cuts into triangles.

    Args:
        vertices: (V, 3), model units.
        faces: the vertex numbers of each face: a list of lists, or an array (F, k).

    >>> geotherm.Polygons([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]]).domain
    'polygons'
    """

    def __init__(self, vertices: Any, faces: Iterable[Sequence[int]]) -> None:
        try:
            rows = [np.asarray(face) for face in faces]
        except (TypeError, ValueError):
            raise InputError("faces is no list of faces") from None
        if any(row.ndim != 1 for row in rows):
            raise InputError("faces is no list of faces, each a list of vertices")
        corners = np.concatenate(rows) if rows else np.empty(0, np.int64)
        starts = np.cumsum([0, *(len(row) for row in rows)])
        self._build(
            POLYGONS,
            positions=(vertices, "vertices", 3),
            cells=(corners, "faces", 1),
            starts=starts,
        )
        self._recipe = (Polygons, np.array(self.vertices), [[int(v) for v in row] for row in rows])


class TetMesh(Model):
    """A volume of tetrahedra.

    Args:
        vertices: (V, 3), model units; or a meshio object.
        tets: (T, 4) vertex numbers, in either orientation. Other cells of a volume are refused.
    """

    def __init__(self, vertices: Any, tets: Any = None) -> None:
        if tets is None:
            all_cells = cells_of(vertices)
            cells = all_cells.get("tetra")
            if cells:
                left_out = (*OF_SURFACES, "vertex", "line")  # what bounds tets
                others = [k for k in all_cells if k != "tetra" and not k.startswith(left_out)]
                refuse_beside(all_cells, others, "tets", "cut them into tets")
            vertices = attributes(vertices, "points", "vertices")
            if not cells or vertices is None:
                raise InputError("tets is missing", hint="give vertices and tets")
            tets = np.concatenate(cells)
        self._build(TETS, positions=(vertices, "vertices", 3), cells=(tets, "tets", 4))
        self._recipe = (TetMesh, np.array(self.vertices), np.array(tets))


class PointCloud(Model):
    """Points of some surface, which is made of them: triangles between near ones.

    Args:
        points: (P, 3), model units; or an object with points or vertices.
        normals: (P, 3) of any length, or None; they keep sheets apart.
    """

    def __init__(self, points: Any, normals: Any = None, *, progress: Progress = None) -> None:
        if not isinstance(points, (np.ndarray, list, tuple)):
            points = attributes(points, "points", "vertices")
            if points is None:
                raise InputError("points is missing")
        values = None if normals is None else (normals, "normals", 3)
        self._build(POINTS, positions=(points, "points", 3), values=values, progress=progress)
        kept = None if normals is None else np.array(normals)
        self._recipe = (PointCloud, np.array(points), kept)


class Grid(Model):
    """Samples in a box, such as the pixels of an image or the voxels of a scan.

    Args:
        speeds: (ny, nx) or (nz, ny, nx): the speed at each sample, 0 where nothing passes; booleans
            are a mask. Distances are travel times. Vertices are numbered with x fastest, so that
            distances.reshape(speeds.shape) is the answer as an image.
        spacing, origin: along x, y, z, or one number for all; model units.

    >>> maze = numpy.ones((20, 30)); maze[10, 5:] = 0
    >>> d = geotherm.Solver(geotherm.Grid(maze)).distance(0).reshape(maze.shape)
    >>> bool(numpy.isinf(d[10, 7]))
    True
    """

    def __init__(
        self,
        speeds: Any,
        *,
        spacing: float | Sequence[float] = (1.0, 1.0, 1.0),
        origin: Sequence[float] = (0.0, 0.0, 0.0),
    ) -> None:
        try:
            samples = np.asarray(speeds)
        except ValueError:
            raise InputError("speeds is no array: its rows differ in length") from None
        if samples.ndim not in (2, 3):
            raise InputError(f"speeds has the shape {samples.shape}", hint="give 2 or 3 axes")
        if samples.dtype == np.uint8 and samples.ndim == 3 and samples.shape[2] in (3, 4):
            if samples.max(initial=0) > 1:  # bytes that are no mask
                raise InputError(
                    f"speeds has the shape {samples.shape}: an image in colours",
                    hint="give a number a pixel, such as image[..., :3].mean(axis=2) > 127; "
                    "of a volume that thin, floats",
                )
        steps, begin = _along(spacing, "spacing", 1.0), _along(origin, "origin", 0.0)
        size = [*samples.shape[::-1], 1][:3]
        if samples.dtype.kind not in "biuf":
            raise InputError(f"speeds is an array of {samples.dtype}", hint="give numbers")
        flat = samples.astype(np.float64).reshape(-1)
        self._build(GRID, values=(flat, "speeds", 1), grid=(size, steps, begin))
        self._recipe = (_grid_again, np.array(samples), tuple(steps), tuple(begin))


def _along(given: Any, name: str, other: float) -> list[float]:
    """Along x, y and z; `other` along those that are not given. One number stands for all three."""
    try:
        alone = np.ndim(given) == 0
    except ValueError:  # lists of several lengths
        alone = False
    if alone:
        return [number_in(given, name)] * 3
    numbers = [number_in(each, name) for each in given]
    if not 1 <= len(numbers) <= 3:
        raise InputError(f"{name} has {len(numbers)} numbers", hint="give them along x, y and z")
    return numbers + [other] * (3 - len(numbers))


def _grid_again(speeds: AnyArray, spacing: tuple[float, ...], origin: tuple[float, ...]) -> Grid:
    return Grid(speeds, spacing=spacing, origin=origin)


def _bundled(name: str) -> str:
    """The file of a bundled model, where it came with the package."""
    file = str(Path(__file__).parent / "models" / f"{name}.ply")
    return file if os.path.exists(file) and not os.path.exists(name) else name


def read(
    path: str | os.PathLike[str],
    *,
    progress: Progress = None,
    **options: Any,
) -> Any:
    """Reads a model from a file, or a bundled one by its name: "bunny".

    Args:
        path: .obj .ply .off .stl and what else features() lists under formats.
        options: the command line's about models, which options() lists: weld=0, format="ply",
            mask="keep:lh.cortex.label".

    Returns: Mesh, TetMesh, PointCloud, Polygons or Grid, by what the file holds. Pickled, a Mesh is
    its arrays, and what is no Mesh or has been welded is the absolute path, which is read again.
    Raises: Error, with the path, the line and the cause.

    >>> geotherm.read("bunny").n_faces
    3996
    """
    settings = given_options("read", options)
    name: str | os.PathLike[str] = _bundled(path) if isinstance(path, str) else path
    with Watch(progress) as watch:
        chosen = options_of(settings)
        handle = create("model_read", path_bytes(name, "path"), chosen.value, watch.pointer)
    kinds: dict[str, type[Model]] = {
        "triangles": Mesh,
        "polygons": Polygons,
        "tets": TetMesh,
        "points": PointCloud,
        "grid": Grid,
    }
    kind = kinds.get(handle.text("domain"), Model)
    by_arrays = kind is Mesh and "weld" not in settings
    # Another process may work in another folder.
    named = os.fspath(path)
    again = named if named in features()["models"] else os.path.abspath(named)
    return kind._around(handle, () if by_arrays else (read_again, again, settings))


def read_again(path: str, settings: dict[str, Any]) -> Any:
    """What read() made of a file."""
    return read(path, **settings)
