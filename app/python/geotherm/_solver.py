# SPDX-License-Identifier: MIT
"""Solvers."""

from __future__ import annotations

import ctypes
import importlib
import json
import os
from typing import Any

import numpy as np
import numpy.typing as npt

from geotherm._answers import Line, Lines, Relaxed, Result, Samples
from geotherm._arrays import AnyArray, described, given, number_in, output, whole_in
from geotherm._library import (
    Handle,
    InputError,
    Progress,
    Rows,
    Watch,
    call,
    create,
    path_bytes,
    text_bytes,
    warned,
)
from geotherm._models import Mesh, Model
from geotherm._options import SolverSignature, given_options, options_of
from geotherm._sources import Taken


class Solver:
    """A model made ready for sources. Immutable; several threads may ask at once, and no call holds
    the interpreter's lock.

    Args:
        model: Mesh and its like, or what Mesh() takes in their place.
        progress: a callable(stage, share), or True.
        options: the command line's, with _ in place of -; options() lists them with what they do,
            their defaults and values: method="wavefront", threads=4, check="off".

    Raises: InputError (an option's value), TypeError (no such option), Error (the model has no area,
        memory, ...).

    >>> solver = geotherm.Solver(geotherm.read("bunny"))
    >>> d = solver.distance(17)
    >>> float(d[17]), d.shape
    (0.0, (2000,))
    """

    __signature__ = SolverSignature()

    def __init__(self, model: Any, *, progress: Progress = None, **options: Any) -> None:
        # Mesh() says what is wrong with other things.
        self.model: Model = model if isinstance(model, Model) else Mesh(model)
        self._settings = given_options("Solver", options)
        chosen = options_of(self._settings)
        with Watch(progress) as watch:
            self._handle = create(
                "solver_new", self.model._handle.value, chosen.value, watch.pointer
            )

    def __reduce__(self) -> tuple[Any, ...]:
        return _solver_again, (self.model, self._settings)

    @property
    def options(self) -> dict[str, Any]:
        """Those that were given."""
        return dict(self._settings)

    def report(self) -> dict[str, Any]:
        """Options at work, times in ms, memory in MB, warnings."""
        found: dict[str, Any] = json.loads(self._handle.text("json"))
        return found

    def distance(
        self,
        sources: Any,
        *,
        out: AnyArray | None = None,
        dtype: npt.DTypeLike | None = None,
        progress: Progress = None,
    ) -> AnyArray:
        """Distances from all sources together: (V,), model units, infinite where unreached.

        Args:
            sources: a vertex number; several; (face, weights); a place [x, y, z], or places (n, 3),
                of which the nearest point of the model is taken; text as on the command line, such
                as "boundary", "curve:3,4,5", "random:5", "17@0.5"; or a list of all these. Whole
                numbers in a list are vertices; a list of lists of them, which may be places, is
                refused: give floats or numpy.array() of it.
            out: (V,) float64 or float32 that is written to and returned.
            dtype: of a new array; float64.

        No check is made; solve() makes one. The numbers are those of `geotherm solve`.

        >>> solver.distance([3, 99]).min()
        0.0
        """
        taken = Taken(sources)
        array = output(out, (self.model.n_vertices,), dtype)
        with Watch(progress) as watch:
            row = described(array)
            call("distance", self._handle.value, taken.pointer, ctypes.byref(row), watch.pointer)
        return array

    def distances(
        self,
        sources: Any,
        *,
        targets: Any = None,
        max_distance: float = float("inf"),
        out: AnyArray | str | os.PathLike[str] | None = None,
        dtype: npt.DTypeLike | None = None,
        progress: Progress = None,
    ) -> Any:
        """Distances from each source by itself: (K, V), or (K, targets).

        Args:
            sources: a list, an item a row; an item that is a list is one set. Of text each point is
                a row: "random:500".
            targets: vertex numbers whose distances are kept; all.
            max_distance: farther is infinite. The methods but heat spend no time there; nor do
                they beyond the last of the targets. What is nearer has the same bits.
            out: an array (a memory map, too), or the path of a .npy file, which is there whole or
                not at all and returned as a memory map. Memory stays flat however many rows there
                are. A path that ends in .npz gets what is within max_distance alone, as sparse
                rows, and is returned as scipy.sparse.load_npz() reads it.
            dtype: float64, or float32 for half the size.

        >>> solver.distances([3, 99, 512], targets=[7, 8], dtype="f4").shape
        (3, 2)
        >>> bool(np.isinf(solver.distances([17], max_distance=0.1)).any())
        True
        """
        taken = Taken(sources, sets=True)
        kept = None if targets is None else _vertices(targets, "targets")
        if kept is not None and kept.size == 0:
            raise InputError("targets is empty", hint="leave it out for all vertices")
        rows = Rows(path=None, max_distance=number_in(max_distance, "max_distance"))
        if kept is not None:
            rows.targets, rows.target_count = kept.ctypes.data, kept.size
        columns = self.model.n_vertices if kept is None else kept.size
        path: str | os.PathLike[str] | None = None
        array: AnyArray | None = None
        if isinstance(out, (str, os.PathLike)):
            path = out
            rows.array = described(output(None, (1, 1), dtype))
            rows.path = path_bytes(path, "out")
        else:
            count = taken.set_count
            if taken.has_text:  # what rows it stands for the library knows
                with Watch() as watch:
                    call(
                        "distances",
                        self._handle.value,
                        taken.pointer,
                        ctypes.byref(rows),
                        watch.pointer,
                    )
                count = rows.array.rows
            array = output(out, (count, columns), dtype)
            rows.array = described(array)
        with Watch(progress) as watch:
            call(
                "distances", self._handle.value, taken.pointer, ctypes.byref(rows), watch.pointer
            )
        if array is not None:
            return array
        assert path is not None
        if os.fsdecode(path).lower().endswith(".npz"):
            return importlib.import_module("scipy.sparse").load_npz(path)
        mapped: AnyArray = np.load(path, mmap_mode="r")
        return mapped

    def pairs(
        self, vertices: Any, *, symmetric: bool = False, progress: Progress = None
    ) -> AnyArray:
        """Distances between each two of the vertices: (K, K), row i from vertex i.

        By the heat method the two directions differ by its error; symmetric: both are their mean.
        """
        ids = _vertices(vertices, "vertices")
        matrix: AnyArray = self.distances(ids, targets=ids, progress=progress)
        return (matrix + matrix.T) / 2 if symmetric else matrix

    def solve(
        self,
        sources: Any,
        *,
        labels: bool = False,
        fields: bool = False,
        max_distance: float = float("inf"),
        check: str | None = None,
        progress: Progress = None,
    ) -> Result:
        """Distances with all that there is to say: how wrong they are, times, warnings.

        Args:
            sources: as in distance().
            labels: which source is the nearest (Result.nearest).
            fields: the heat and what is made of it (Result.heat, Result.field()).
            max_distance: as in distances(); a check needs all of them first.
            check: in place of the solver's own: "on", "off", "auto", "wavefront-fine", "exact".
        """
        wanted = ["labels"] * labels + ["fields"] * fields
        if check is not None:
            if " " in str(check):
                raise InputError(f"check is {check!r}", hint="give one word, such as 'off' or 'exact'")
            wanted.append(f"check={check}")
        most = number_in(max_distance, "max_distance")
        if most != float("inf"):
            wanted.append(f"max-distance={most!r}")
        taken = Taken(sources)
        with Watch(progress) as watch:
            words = text_bytes(" ".join(wanted), "check")
            handle = create("solve", self._handle.value, taken.pointer, words, watch.pointer)
        reach = {} if most == float("inf") else {"max_distance": most}
        return Result(handle, self.model, taken.texts(), {**self._settings, **reach})

    def path(
        self,
        *through: Any,
        field: str = "geodesic",
        closed: bool = False,
        loose: bool = False,
        progress: Progress = None,
    ) -> Line:
        """The shortest path through two points or more: vertices, (face, weights) or places.

        Args:
            field: "geodesic", or what is followed backwards: "distance", "heat".
            closed: leads from the last to the first, and is pulled straight all round.
            loose: of an open geodesic the points between its ends only say where it runs at first.

        A ResultWarning says where a loop was drawn together to a point, and the like.

        >>> solver.path(17, 99).length > 0
        True
        """
        taken = Taken(list(through), "points", sets=True)
        if loose and closed:
            raise InputError("loose is for open paths: a closed one is")
        with Watch(progress) as watch:
            handle = create(
                "path",
                self._handle.value,
                taken.pointer,
                text_bytes(field, "field"),
                2 if loose else int(bool(closed)),
                watch.pointer,
            )
        return Lines(warned(handle), values=False)[0]

    def paths(self, start: Any, ends: Any, *, progress: Progress = None) -> Lines:
        """The shortest paths from one point to each of others, in their order; the distances from it
        are computed once.

        >>> len(solver.paths(17, [99, 300, 900]))
        3
        """
        begin, end = Taken([start], "start", sets=True), Taken(ends, "ends", sets=True)
        with Watch(progress) as watch:
            handle = create(
                "paths", self._handle.value, begin.pointer, end.pointer, watch.pointer
            )
        return Lines(warned(handle), values=False)

    def relax(self, points: Any, steps: int, *, progress: Progress = None) -> Relaxed:
        """Lloyd's iteration: each point moves to the mean of the vertices nearest to it, `steps` times
        or until nothing is gained. By this solver's distances, in place of heat by wavefront's.

        Args:
            points: a list of vertices, (face, weights), places.

        >>> relaxed = solver.relax(solver.farthest_points(10).vertices, 5)
        >>> bool(relaxed.energies[-1] < relaxed.energies[0])
        True
        """
        taken = Taken(points, "points", sets=True)
        with Watch(progress) as watch:
            handle = create(
                "relax", self._handle.value, taken.pointer, whole_in(steps, "steps"), watch.pointer
            )
        return Relaxed(warned(handle))

    def farthest_points(
        self, count: int, *, first: int | None = None, progress: Progress = None
    ) -> Samples:
        """Vertices each of which is farthest from those before it (Gonzalez 1985).

        Args:
            count: how many; one query each.
            first: the vertex to begin with.
        """
        begin = -1 if first is None else whole_in(first, "first")
        with Watch(progress) as watch:
            handle = create(
                "samples", self._handle.value, whole_in(count, "count"), begin, watch.pointer
            )
        return Samples(warned(handle))

    def update(self, vertices: Any, *, progress: Progress = None) -> Solver:
        """The same faces and options with the vertices (V, 3) elsewhere: by heat without `refine` in
        half to three quarters of the time of a new solver. This one stays as it is."""
        array, kept = given(vertices, "vertices", 3)
        moved, model = Handle(), Handle()
        with Watch(progress) as watch:
            call(
                "solver_move",
                self._handle.value,
                ctypes.byref(array),
                watch.pointer,
                ctypes.byref(moved.value),
                ctypes.byref(model.value),
            )
        del kept
        solver = Solver.__new__(Solver)
        solver._handle = moved
        solver._settings = dict(self._settings)
        solver.model = type(self.model)._moved(self.model, model)
        return solver

    def __repr__(self) -> str:
        method = self._settings.get("method", "heat")
        return f"<geotherm.Solver by {method} on {self.model!r}>"


def _solver_again(model: Model, settings: dict[str, Any]) -> Solver:
    return Solver(model, **settings)


def _vertices(values: Any, name: str) -> npt.NDArray[np.int64]:
    """Vertex numbers. Errors: InputError."""
    try:
        array = np.asarray(values)
    except ValueError:  # lists of several lengths
        array = np.empty(0, object)
    if array.ndim != 1 or array.dtype.kind == "O" or (array.size and array.dtype.kind not in "iu"):
        raise InputError(f"{name} is no list of vertex numbers")
    if array.dtype.kind == "u" and array.size and int(array.max()) >= 2**63:
        raise InputError(f"{name} holds {array.max()}, which is no vertex")
    return np.ascontiguousarray(array, dtype=np.int64)


def farthest_points(model: Model | Solver, count: int, *, first: int | None = None) -> Samples:
    """Solver.farthest_points(), by the heat method where a model is given."""
    solver = model if isinstance(model, Solver) else Solver(model)
    return solver.farthest_points(count, first=first)
