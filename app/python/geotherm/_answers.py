# SPDX-License-Identifier: MIT
"""What solvers answer: distances, lines, samples."""

from __future__ import annotations

import ctypes
import functools
import json
import os
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from geotherm._arrays import AnyArray, given, number_in, view, whole_in
from geotherm._library import (
    Error,
    Handle,
    InputError,
    Progress,
    Watch,
    call,
    create,
    path_bytes,
    text_bytes,
)
from geotherm._models import Model, handle_of

if TYPE_CHECKING:
    from geotherm._pictures import Picture


class Result:
    """Distances from one source set and all that there is to say about them. Prints like the
    report of `geotherm solve`. Pickled it keeps distances, labels, heat and report, and cannot be
    written."""

    def __init__(
        self, handle: Handle, model: Model, sources: list[str], settings: dict[str, Any]
    ) -> None:
        self._handle: Handle | None = handle
        self._drawn_from = (model, sources, settings)
        self._kept: dict[str, AnyArray] = {}
        self._table = ""

    def _array(self, name: str) -> AnyArray:
        if self._handle is not None:
            return view(self._handle, name)
        if name not in self._kept:
            raise Error(f"an answer that was pickled has no {name}", "not-available")
        return self._kept[name]

    def __getstate__(self) -> dict[str, Any]:
        kept = {}
        for name in ("distances", "nearest_source", "heat"):
            try:
                kept[name] = np.array(self._array(name))
            except Error:  # it was not asked for
                continue
        state = {"_handle": None, "_drawn_from": self._drawn_from, "_kept": kept}
        return {**state, "_table": str(self), "report": self.report}

    @property
    def distances(self) -> AnyArray:
        """(V,) float64, model units; infinite where no source can be reached; read-only."""
        return self._array("distances")

    @property
    def nearest(self) -> AnyArray:
        """(V,) int32: the number of the nearest source, -1 where there is none; with labels. That of
        number i is report["regions"][i]["source"]: what coincides is one, and points come before
        sources as text."""
        return self._array("nearest_source")

    @property
    def heat(self) -> AnyArray:
        """(V,): u of the heat method, its largest value 1; with fields."""
        return self._array("heat")

    def field(self, name: str) -> AnyArray:
        """(V,) or (F,) numbers that say where distances are right, by the name on the command line:
        "error", "eikonal-error", "gradient-angle", "lost-gradients", ..."""
        text_bytes(name, "name")
        return self._array(name)

    @functools.cached_property
    def report(self) -> dict[str, Any]:
        """All figures, as `geotherm solve --json` tells them."""
        found: dict[str, Any] = json.loads(_there(self._handle).text("json"))
        return found

    @property
    def error(self) -> dict[str, Any] | None:
        """How wrong the distances are, against a better method: "mean_relative", "max_of_range",
        "verdict", "cure"; None where they were not checked."""
        found: dict[str, Any] | None = self.report.get("error")
        return found

    @property
    def warnings(self) -> list[str]:
        """One sentence each."""
        return list(self.report["warnings"])

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes .csv, .npy, .ply or .vtp, of tets .vtu, of grids .vti: whole or not at all."""
        call("write", _there(self._handle).value, path_bytes(path, "path"))

    def plot(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        size: tuple[int, int] = (900, 700),
        **options: Any,
    ) -> Picture:
        """A picture by the program geotherm, which must be installed; notebooks show it.

        Args:
            path: of a file that is written, too: .png, .pdf, .svg, .html or .glb.
            size: pixels.
            options: those of `geotherm render`, with _ in place of -: view="smooth", bar=False.

        Raises: Error ("not-available", "no-device").
        """
        from geotherm._pictures import plotted  # it imports much

        model, sources, settings = self._drawn_from
        return plotted(model, sources, {**settings, **options}, size, path)

    def _repr_html_(self) -> str:
        from geotherm._pictures import as_html

        return as_html(*self._drawn_from, str(self))

    def __str__(self) -> str:
        return self._table if self._handle is None else self._handle.text("table")

    __repr__ = __str__


def _there(handle: Handle | None) -> Handle:
    """What is not there in another process."""
    if handle is None:
        raise Error("what was pickled is written by the process that computed it", "not-available")
    return handle


class Line:
    """A polyline on the surface.

    Attributes:
        points: (n, 3) float64, model units.
        faces: (n,) int32: the face of each point; it holds the piece up to the next one, too.
        weights: (n, 3): barycentric weights in that face.
        length: model units.
        closed: whether it ends where it begins.
        value: of an isoline, else None.
        end: of trace(), why it ends: "length", "border", or "split" (three faces at an edge, or
            several fans at a vertex); else None.
    """

    def __init__(self, lines: Lines, number: int) -> None:
        begin, end = (int(i) for i in lines._starts[number : number + 2])
        self._lines = lines
        self.points: AnyArray = lines._points[begin:end]
        self.faces: AnyArray = lines._faces[begin:end]
        self.weights: AnyArray = lines._weights[begin:end]
        self.length = float(lines._lengths[number])
        self.closed = bool(lines._closed[number])
        self.value = None if lines._values is None else float(lines._values[number])
        self.end: str | None = None

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the lines that it is one of: .obj, .csv, .vtp."""
        self._lines.write(path)

    def __repr__(self) -> str:
        value = "" if self.value is None else f" at {self.value:g}"
        return f"<geotherm.Line{value}: length {self.length:g}, {len(self.points)} points>"


class Lines(Sequence[Line]):
    """Polylines, one after the other."""

    def __init__(self, handle: Handle, values: bool) -> None:
        self._handle: Handle | None = handle
        self._points = view(handle, "points")
        self._faces = view(handle, "faces")
        self._weights = view(handle, "weights")
        self._starts = view(handle, "starts")
        self._lengths = view(handle, "lengths")
        self._closed = view(handle, "closed")
        self._values = view(handle, "values") if values else None

    def __getstate__(self) -> dict[str, Any]:
        state = {name: np.array(array) for name, array in vars(self).items() if array is not None}
        return {**state, "_handle": None, "_values": state.get("_values")}

    @overload
    def __getitem__(self, number: int) -> Line: ...
    @overload
    def __getitem__(self, number: slice) -> list[Line]: ...

    def __getitem__(self, number: int | slice) -> Line | list[Line]:
        if isinstance(number, slice):
            return [Line(self, i) for i in range(*number.indices(len(self)))]
        if not -len(self) <= number < len(self):
            raise IndexError(f"there are {len(self)} lines, and no number {number}")
        return Line(self, number % len(self))

    def __len__(self) -> int:
        return len(self._lengths)

    def __iter__(self) -> Iterator[Line]:
        return (Line(self, i) for i in range(len(self)))

    def __repr__(self) -> str:
        return repr(list(self))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes .obj, .csv or .vtp: whole or not at all."""
        call("write", _there(self._handle).value, path_bytes(path, "path"))


class Samples:
    """Farthest-point samples.

    Attributes:
        vertices: (K,) int32, in the order in which they were chosen.
        radius: (K,): the largest distance of a vertex to a sample once each is there.
        distances: (V,): to the nearest sample.
        nearest: (V,) int32: the number of that sample, -1 where there is none.
    """

    def __init__(self, handle: Handle) -> None:
        self.vertices = view(handle, "vertices")
        self.radius = view(handle, "radius")
        self.distances = view(handle, "distances")
        self.nearest = view(handle, "nearest_source")

    def __len__(self) -> int:
        return len(self.vertices)

    def __repr__(self) -> str:
        return f"<geotherm.Samples: {len(self)}, radius {self.radius[-1]:g}>"


class Relaxed:
    """Points moved to the means of their cells.

    Attributes:
        points: (K, 3), model units.
        faces: (K,) int32, and weights: (K, 3): the points in these.
        distances: (V,): to the nearest of them.
        nearest: (V,) int32: its number, -1 where there is none.
        energies: before the first step and after each: the sum of area times distance^2; they fall.
        moves: of each step, how far the points went at most.
        settled: whether the last step gained nothing, so that the iteration ended.
    """

    def __init__(self, handle: Handle) -> None:
        self.points = view(handle, "points")
        self.faces = view(handle, "faces")
        self.weights = view(handle, "weights")
        self.distances = view(handle, "distances")
        self.nearest = view(handle, "nearest_source")
        self.energies = view(handle, "energies")
        self.moves = view(handle, "moves")
        self.settled = bool(view(handle, "settled")[0])

    def __len__(self) -> int:
        return len(self.faces)

    def __repr__(self) -> str:
        return f"<geotherm.Relaxed: {len(self)}, energy {self.energies[-1]:g}>"


def isolines(
    model: Model,
    values: Any,
    *,
    spacing: float | None = None,
    count: int | None = None,
    levels: Any = None,
    progress: Progress = None,
) -> Lines:
    """The lines on which values, linear on each face, have a level. Sorted by level, the longest
    first.

    Args:
        model: where they are.
        values: (V,) numbers at its vertices; faces with one that is not finite have no lines.
        spacing: levels at its multiples; or `count` levels between 0, or the least value where that
            is below, and the largest one; or `levels`.

    >>> mesh = geotherm.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> geotherm.isolines(mesh, [0, 1, 1], levels=[0.5])
    [<geotherm.Line at 0.5: length 0.707107, 2 points>]
    """
    if sum(choice is not None for choice in (spacing, count, levels)) != 1:
        raise InputError("levels: give one of spacing, count and levels")
    array, kept = given(values, "values", 1)
    finite = kept[np.isfinite(kept)]
    largest = float(finite.max()) if finite.size else 0.0
    least = min(float(finite.min()), 0.0) if finite.size else 0.0
    if spacing is not None:
        apart = number_in(spacing, "spacing")
        if not apart > 0 or not (largest - least) / apart < 1e5:
            raise InputError(
                f"spacing is {apart:g}, and values run from {least:g} to {largest:g}",
                hint="give one above 0 that is at least a hundred-thousandth of that",
            )
        numbers = np.arange(np.floor(least / apart), np.ceil(largest / apart) + 1)
        # 0 is where distances begin, and a level where values have both signs.
        levels = numbers[(numbers != 0) | (least < 0)] * apart
        levels = levels[(levels > least) & (levels < largest)]
    elif count is not None:
        if not 1 <= whole_in(count, "count") <= 1e5:
            raise InputError(f"count is {count}", hint="give 1 to 100,000")
        share = np.arange(1, count + 1) / (count + 1)
        apart = largest - least  # of what doubles hold at their ends it is infinite
        beyond = not np.isfinite(apart)
        levels = least * (1 - share) + largest * share if beyond else least + apart * share
    asked, kept_levels = given(levels, "levels", 1)
    with Watch(progress) as watch:
        handle = create(
            "isolines", handle_of(model), ctypes.byref(array), ctypes.byref(asked), watch.pointer
        )
    del kept_levels
    return Lines(handle, values=True)
