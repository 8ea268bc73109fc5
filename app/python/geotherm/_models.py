# SPDX-License-Identifier: MIT
"""What distance is computed in, and meshes."""

from __future__ import annotations

import ctypes
import functools
import json
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

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

if TYPE_CHECKING:
    from geotherm._pictures import Picture

TRIANGLES, POLYGONS, TETS, POINTS, GRID, LENGTHS = range(6)


def handle_of(model: Any) -> Any:
    """That of a model. Errors: InputError, where it is something else."""
    if not isinstance(model, Model):
        raise InputError(
            f"model is {type(model).__name__}, and no model", hint="geotherm.Mesh() makes one"
        )
    return model._handle.value


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
        """The model with its vertices elsewhere, which is made again by moving the first one."""
        first = earlier._recipe[1] if earlier._recipe[0] is moved_again else earlier
        return cls._around(handle, (moved_again, first))

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
        """"triangles", "polygons", "tets", "points", "grid" or "lengths"."""
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
        """Writes .ply, .obj, .off, .stl, of tets .mesh and .vtu: whole or not at all. Of points,
        polygons and grids it is the triangles that they are drawn as."""
        call("write", self._handle.value, path_bytes(path, "path"))

    def __repr__(self) -> str:
        kind = type(self).__name__
        size = self._summary["size"]
        return f"<geotherm.{kind} {self.name!r}: {self.n_vertices} vertices, {size}>"

    def __reduce__(self) -> tuple[Any, ...]:
        maker, *arguments = self._recipe
        if maker is moved_again:
            arguments.append(np.array(self.vertices))
        return maker, tuple(arguments)

    def plot(
        self,
        values: Any = None,
        path: str | os.PathLike[str] | None = None,
        *,
        size: tuple[int, int] = (900, 700),
        **options: Any,
    ) -> Picture:
        """A picture by the program geotherm, which must be installed; notebooks show it.

        Args:
            values: (V,) numbers that its colours show; not finite: none. None: the model alone.
            path: of a file that is written, too: .png, .pdf, .svg, .html or .glb.
            size: pixels.
            options: those of `geotherm render`, with _ in place of -: bar_label="curvature".

        Raises: InputError, Error ("not-available", "no-device").
        """
        from geotherm._pictures import plotted  # it imports much

        settings = {"view": "smooth", **options} if values is None else options
        return plotted(self, [], settings, size, path, values)


def attributes(thing: Any, *names: str) -> Any:
    """The first of the attributes that it has, else None."""
    for name in names:
        if hasattr(thing, name):
            return getattr(thing, name)
    return None


_VTK_CELLS = {
    1: "vertex",
    2: "vertex",
    3: "line",
    4: "line",
    5: "triangle",
    6: "triangle_strip",
    7: "polygon",
    8: "quad",
    9: "quad",
    10: "tetra",
    11: "hexahedron",
    12: "hexahedron",
    13: "wedge",
    14: "pyramid",
    21: "line3",
    22: "triangle6",
    23: "quad8",
    24: "tetra10",
    25: "hexahedron20",
    26: "wedge15",
    27: "pyramid13",
    42: "polyhedron",
}


OF_SURFACES = ("triangle", "quad", "polygon")  # beginnings of the kinds of cells


def cells_of(thing: Any) -> dict[str, list[Any]]:
    """The cells of a meshio mesh or of pyvista's UnstructuredGrid, by their kind."""
    cells = getattr(thing, "cells", None)
    if not isinstance(cells, (Mapping, list, tuple)):
        cells = getattr(thing, "cells_dict", None)
    if isinstance(cells, Mapping):
        named = [(_VTK_CELLS.get(kind, str(kind)), array) for kind, array in cells.items()]
    else:
        blocks = cells if isinstance(cells, (list, tuple)) else ()
        named = [(b.type, b.data) for b in blocks if hasattr(b, "type") and hasattr(b, "data")]
    found: dict[str, list[Any]] = {}
    for kind, array in named:
        found.setdefault(kind, []).append(array)
    return found


def refuse_beside(cells: dict[str, list[Any]], kinds: list[str], called: str, cure: str) -> None:
    """Errors: InputError, where cells of these kinds would be left out beside those that are kept."""
    for kind in kinds:
        if count := sum(len(part) for part in cells[kind]):
            raise InputError(f"cells hold {count} of the kind {kind} beside {called}", hint=cure)


def _faces_of(thing: Any) -> Any:
    """Triangles of a trimesh, pyvista or meshio object."""
    cells = cells_of(thing)
    if "triangle" in cells:
        others = [k for k in cells if k != "triangle" and k.startswith(OF_SURFACES)]
        cure = "cut them into triangles, or give vertices and faces to geotherm.Polygons"
        refuse_beside(cells, others, "triangles", cure)
        return np.concatenate(cells["triangle"])
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
        mask: (V,) or (F,) numbers; vertices, or faces, of other than 0 are left out. Distances are
            those on the mesh that is left, infinite at what is not; all keep their numbers.

    Raises: InputError, with the number of what is out of range or not finite.

    >>> square = geotherm.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> square.n_vertices
    4
    """

    def __init__(
        self, vertices: Any, faces: Any = None, *, weld: float | None = None, mask: Any = None
    ) -> None:
        if isinstance(vertices, (str, os.PathLike)):
            raise InputError(
                f"vertices is the name {os.fspath(vertices)!r}", hint="geotherm.read() reads files"
            )
        if faces is None:
            faces = _faces_of(vertices)
            vertices = attributes(vertices, "vertices", "points")
            if faces is None or vertices is None:
                raise InputError(
                    "faces is missing", hint="give vertices and faces, or an object with both"
                )
        marks = None if mask is None else given(mask, "mask", 1)[1]
        if marks is not None and marks.size == 0:
            raise InputError("mask is empty", hint="give a number a vertex or a face, or None")
        options = None if weld is None else options_of({"weld": weld})
        self._build(
            TRIANGLES,
            positions=(vertices, "vertices", 3),
            cells=(faces, "faces", 3),
            values=None if marks is None else (marks, "mask", 1),
            options=options,
        )
        # Faces of a welded mesh are others, by which it cannot be welded again.
        kept = None if marks is None else np.array(marks)
        welded = (_mesh_again, np.array(vertices), np.array(faces), weld, kept)
        self._recipe = () if weld is None else welded

    @classmethod
    def from_edge_lengths(cls, faces: Any, lengths: Any) -> Model:
        """A surface of which only lengths are known: the heat method measures it.

        Args:
            faces: (F, 3) vertex numbers from 0 on, below 3 F.
            lengths: (F, 3): of the side opposite each corner (as igl.edge_lengths gives them), the
                same for both faces of an edge; from 1e-150 to 1e150.

        Raises: InputError, with the face whose sides are no triangle or disagree with another's.

        >>> geotherm.Mesh.from_edge_lengths([[0, 1, 2]], [[3, 4, 5]]).domain
        'lengths'
        """
        model: Model = Model.__new__(Model)
        model._build(LENGTHS, cells=(faces, "faces", 3), values=(lengths, "lengths", 3))
        model._recipe = (_lengths_again, np.array(faces), np.array(lengths))
        return model

    @classmethod
    def _moved(cls, earlier: Model, handle: Handle) -> Any:
        return super()._moved(earlier, handle) if earlier._recipe else cls._around(handle, ())

    def __reduce__(self) -> tuple[Any, ...]:
        if self._recipe:
            return super().__reduce__()
        return _mesh_again, (np.array(self.vertices), np.array(self.faces), None)


def moved_again(first: Model, vertices: AnyArray) -> Model:
    """What Solver.update() made of a model."""
    from geotherm._solver import Solver

    return Solver(first).update(vertices).model


def _lengths_again(faces: AnyArray, lengths: AnyArray) -> Model:
    return Mesh.from_edge_lengths(faces, lengths)


def _mesh_again(
    vertices: AnyArray, faces: AnyArray, weld: float | None, mask: AnyArray | None = None
) -> Mesh:
    return Mesh(vertices, faces, weld=weld, mask=mask)
