# SPDX-License-Identifier: MIT
"""What distance is computed in: meshes, polygons, tets, points, grids."""

from __future__ import annotations

import ctypes
import functools
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray, given, no_array, view
from geotherm._library import (
    Handle,
    InputError,
    Progress,
    Shape,
    Watch,
    call,
    create,
    path_bytes,
)
from geotherm._options import options_of

_TRIANGLES, _POLYGONS, _TETS, _POINTS, _GRID = range(5)


class Model:
    """What distance is computed in; immutable. Mesh, Polygons, TetMesh, PointCloud and Grid make
    one of arrays, read() one of a file."""

    _handle: Handle
    _recipe: tuple[Any, ...]

    @classmethod
    def _around(cls, handle: Handle, recipe: tuple[Any, ...]) -> Any:
        self = cls.__new__(cls)
        self._handle = handle
        self._recipe = recipe
        return self

    @classmethod
    def _moved(cls, earlier: Model, handle: Handle) -> Any:
        """The model with its vertices elsewhere; pickled it is a mesh."""
        moved = cls._around(handle, ())
        moved._recipe = (_mesh_again, np.array(moved.vertices), np.array(moved.faces), None)
        return moved

    def _build(
        self,
        kind: int,
        *,
        positions: tuple[Any, str, int] | None = None,
        cells: tuple[Any, str, int] | None = None,
        values: tuple[Any, str, int] | None = None,
        starts: Any = None,
        grid: tuple[Sequence[int], Sequence[float], Sequence[float]] | None = None,
        options: Handle | None = None,
        progress: Progress = None,
    ) -> None:
        """Hands the arrays over; they are copied."""
        kept = []

        def take(what: tuple[Any, str, int] | None) -> Any:
            if what is None:
                return no_array()
            array, keep = given(*what)
            kept.append(keep)
            return array

        shape = Shape(
            kind=kind,
            positions=take(positions),
            cells=take(cells),
            values=take(values),
            starts=take(None if starts is None else (starts, "starts", 1)),
        )
        if grid is not None:
            size, spacing, origin = grid
            shape.size = (ctypes.c_int64 * 3)(*size)
            shape.spacing = (ctypes.c_double * 3)(*spacing)
            shape.origin = (ctypes.c_double * 3)(*origin)
        with Watch(progress) as watch:
            asked = options.value if options else None
            self._handle = create("model_build", ctypes.byref(shape), asked, watch.pointer)

    @functools.cached_property
    def _summary(self) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(self._handle.text("summary"))
        return found

    @property
    def vertices(self) -> AnyArray:
        """(V, 3) float64, model units; the library's own memory, read-only."""
        return view(self._handle, "positions")

    @property
    def faces(self) -> AnyArray:
        """(F, 3) int32: of what is drawn, which for a surface is itself; read-only."""
        return view(self._handle, "faces")

    @property
    def n_vertices(self) -> int:
        """V."""
        return int(self._summary["vertices"])

    @property
    def n_faces(self) -> int:
        """F."""
        return int(self._summary["faces"])

    @property
    def domain(self) -> str:
        """"triangles", "polygons", "tets", "points" or "grid"."""
        return str(self._summary["domain"])

    @property
    def name(self) -> str:
        """The file's name without folder and extension; "model" of arrays."""
        return str(self._summary["name"])

    def info(self) -> dict[str, Any]:
        """What the model is and what is wrong with it, as `geotherm info --json` tells it."""
        found: dict[str, Any] = json.loads(self._handle.text("json"))
        return found

    def report(self) -> str:
        """The same as a table, as `geotherm info` prints it."""
        return self._handle.text("table")

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes .ply, .obj, .off, .stl, of tets .mesh and .vtu: whole or not at all."""
        call("write", self._handle.value, path_bytes(path, "path"))

    def __repr__(self) -> str:
        kind = type(self).__name__
        return f"<geotherm.{kind} {self.name!r}: {self.n_vertices} vertices, {self._summary['size']}>"

    def __reduce__(self) -> tuple[Any, ...]:
        maker, *arguments = self._recipe
        if maker is _not_again:
            _not_again()
        return maker, tuple(arguments)


def _attributes(thing: Any, *names: str) -> Any:
    for name in names:
        if hasattr(thing, name):
            return getattr(thing, name)
    return None


def _blocks(thing: Any, kind: str) -> list[Any]:
    """The cells of a kind of a meshio mesh."""
    cells = getattr(thing, "cells", None)
    if isinstance(cells, Mapping):
        return [cells[kind]] if kind in cells else []
    if not isinstance(cells, (list, tuple)):
        return []
    return [block.data for block in cells if getattr(block, "type", None) == kind]


def _faces_of(thing: Any) -> Any:
    """Triangles of a trimesh, pyvista or meshio object."""
    blocks = _blocks(thing, "triangle")
    if blocks:
        return np.concatenate(blocks)
    if hasattr(thing, "regular_faces"):
        return thing.regular_faces
    faces = getattr(thing, "faces", None)
    if faces is None:
        return None
    faces = np.asarray(faces)
    if faces.ndim == 1 and faces.size % 4 == 0 and bool((faces[::4] == 3).all()):
        return faces.reshape(-1, 4)[:, 1:]  # VTK: 3, a, b, c
    return faces


class Mesh(Model):
    """A triangle mesh.

    Args:
        vertices: (V, 3) numbers of any type and strides, finite, model units; or an object with
            vertices or points and with faces or cells, such as those of trimesh, pyvista, meshio.
        faces: (F, 3) vertex numbers from 0. Nothing is asked of them: they may be of no area,
            disagree in orientation, share an edge three times.
        weld: vertices at most this far apart are one; 0: equal ones. All keep their numbers.

    Raises: InputError, with the number of what is out of range or not finite.

    >>> square = geotherm.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> square.n_vertices
    4
    """

    def __init__(self, vertices: Any, faces: Any = None, *, weld: float | None = None) -> None:
        if faces is None:
            faces = _faces_of(vertices)
            vertices = _attributes(vertices, "vertices", "points")
            if faces is None or vertices is None:
                raise InputError(
                    "faces is missing", hint="give vertices and faces, or an object with both"
                )
        options = None if weld is None else options_of({"weld": weld})
        self._build(
            _TRIANGLES,
            positions=(vertices, "vertices", 3),
            cells=(faces, "faces", 3),
            options=options,
        )
        # Faces of a welded mesh are others, by which it cannot be welded again.
        welded = (_mesh_again, np.array(vertices), np.array(faces), weld)
        self._recipe = () if weld is None else welded

    @classmethod
    def _moved(cls, earlier: Model, handle: Handle) -> Any:
        return cls._around(handle, (_not_again,) if earlier._recipe else ())

    def __reduce__(self) -> tuple[Any, ...]:
        if self._recipe:
            return super().__reduce__()
        return _mesh_again, (np.array(self.vertices), np.array(self.faces), None)


def _not_again() -> Any:
    raise InputError(
        "a mesh with welded vertices that was moved cannot be pickled",
        hint="pickle the mesh from before, and the vertices",
    )


def _mesh_again(vertices: AnyArray, faces: AnyArray, weld: float | None) -> Mesh:
    return Mesh(vertices, faces, weld=weld)


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
        except TypeError:
            raise InputError("faces is no list of faces") from None
        if any(row.ndim != 1 for row in rows):
            raise InputError("faces is no list of faces, each a list of vertices")
        corners = np.concatenate(rows) if rows else np.empty(0, np.int64)
        starts = np.cumsum([0, *(len(row) for row in rows)])
        self._build(
            _POLYGONS,
            positions=(vertices, "vertices", 3),
            cells=(corners, "faces", 1),
            starts=starts,
        )
        self._recipe = (Polygons, np.array(self.vertices), [row.tolist() for row in rows])


class TetMesh(Model):
    """A volume of tetrahedra.

    Args:
        vertices: (V, 3), model units; or a meshio object.
        tets: (T, 4) vertex numbers, in either orientation.
    """

    def __init__(self, vertices: Any, tets: Any = None) -> None:
        if tets is None:
            blocks = _blocks(vertices, "tetra")
            vertices = _attributes(vertices, "points", "vertices")
            if not blocks or vertices is None:
                raise InputError("tets is missing", hint="give vertices and tets")
            tets = np.concatenate(blocks)
        self._build(_TETS, positions=(vertices, "vertices", 3), cells=(tets, "tets", 4))
        self._recipe = (TetMesh, np.array(self.vertices), np.array(tets))


class PointCloud(Model):
    """Points of some surface, which is made of them: triangles between near ones.

    Args:
        points: (P, 3), model units; or an object with points or vertices.
        normals: (P, 3) of any length, or None; they keep sheets apart.
    """

    def __init__(self, points: Any, normals: Any = None, *, progress: Progress = None) -> None:
        if not isinstance(points, (np.ndarray, list, tuple)):
            points = _attributes(points, "points", "vertices")
            if points is None:
                raise InputError("points is missing")
        values = None if normals is None else (normals, "normals", 3)
        self._build(_POINTS, positions=(points, "points", 3), values=values, progress=progress)
        kept = None if normals is None else np.array(normals)
        self._recipe = (PointCloud, np.array(points), kept)


class Grid(Model):
    """Samples in a box, such as the pixels of an image or the voxels of a scan.

    Args:
        speeds: (ny, nx) or (nz, ny, nx): the speed at each sample, 0 where nothing passes; booleans
            are a mask. Distances are travel times. Vertices are numbered with x fastest, so that
            distances.reshape(speeds.shape) is the answer as an image.
        spacing, origin: along x, y, z; model units.

    >>> maze = numpy.ones((20, 30)); maze[10, 5:] = 0
    >>> d = geotherm.Solver(geotherm.Grid(maze)).distance(0).reshape(maze.shape)
    >>> bool(numpy.isinf(d[10, 7]))
    True
    """

    def __init__(
        self,
        speeds: Any,
        *,
        spacing: Sequence[float] = (1.0, 1.0, 1.0),
        origin: Sequence[float] = (0.0, 0.0, 0.0),
    ) -> None:
        samples = np.asarray(speeds)
        if samples.ndim not in (2, 3):
            raise InputError(f"speeds has the shape {samples.shape}", hint="give 2 or 3 axes")
        steps, begin = [*map(float, spacing)], [*map(float, origin)]
        steps += [1.0] * (3 - len(steps))
        begin += [0.0] * (3 - len(begin))
        if len(steps) != 3 or len(begin) != 3:
            raise InputError("spacing and origin are along x, y and z")
        size = [*samples.shape[::-1], 1][:3]
        if samples.dtype == object:
            raise InputError("speeds is an array of object", hint="give numbers")
        flat = samples.astype(np.float64).reshape(-1)
        self._build(_GRID, values=(flat, "speeds", 1), grid=(size, steps, begin))
        self._recipe = (_grid_again, np.array(samples), tuple(steps), tuple(begin))


def _grid_again(speeds: AnyArray, spacing: tuple[float, ...], origin: tuple[float, ...]) -> Grid:
    return Grid(speeds, spacing=spacing, origin=origin)


def _bundled(name: str) -> str:
    """The file of a bundled model, where it came with the package."""
    file = Path(__file__).parent / "models" / f"{name}.ply"
    return str(file) if file.exists() and not Path(name).exists() else name


def read(
    path: str | os.PathLike[str],
    *,
    domain: str | None = None,
    weld: float | None = None,
    format: str | None = None,
    grid: str | None = None,
    progress: Progress = None,
) -> Any:
    """Reads a model from a file, or a bundled one by its name: "bunny".

    Args:
        path: .obj .ply .off .stl and what else features() lists under formats.
        domain, weld, format, grid: as on the command line.

    Returns: Mesh, TetMesh, PointCloud, Polygons or Grid, by what the file holds.
    Raises: Error, with the path, the line and the cause.

    >>> geotherm.read("bunny").n_faces
    3996
    """
    settings = {"domain": domain, "weld": weld, "format": format, "grid": grid}
    name: str | os.PathLike[str] = _bundled(path) if isinstance(path, str) else path
    with Watch(progress) as watch:
        options = options_of(settings)
        handle = create("model_read", path_bytes(name, "path"), options.value, watch.pointer)
    kinds: dict[str, type[Model]] = {
        "triangles": Mesh,
        "polygons": Polygons,
        "tets": TetMesh,
        "points": PointCloud,
        "grid": Grid,
    }
    kind = kinds.get(handle.text("domain"), Model)
    by_arrays = kind is Mesh and weld is None
    return kind._around(handle, () if by_arrays else (_read_again, os.fspath(path), settings))


def _read_again(path: str, settings: dict[str, Any]) -> Any:
    return read(path, **settings)
