# SPDX-License-Identifier: MIT
"""Directions: log maps, straightest lines, vectors and values carried over a surface."""

from __future__ import annotations

import ctypes
import json
from typing import Any

import numpy as np

from geotherm._answers import Line, Lines
from geotherm._arrays import AnyArray, given, number_in, view
from geotherm._library import Handle, Progress, Watch, create, text_bytes, warned
from geotherm._models import Model, handle_of
from geotherm._options import options_of
from geotherm._sources import Taken


class LogMap:
    """Polar coordinates of all vertices about a point.

    Attributes:
        distances: (V,), model units, infinite where no path leads.
        directions: (V,), radians from e1 towards e2 in which the shortest path leaves the point; nan
            where there is none.
        frame: (3, 3): e1, e2 and the normal at the point.
    """

    def __init__(self, handle: Handle) -> None:
        self.distances = view(handle, "distances")
        self.directions = view(handle, "directions")
        self.frame: AnyArray = view(handle, "frame").reshape(3, 3)

    @property
    def coordinates(self) -> AnyArray:
        """(V, 2): along e1 and e2."""
        turned = np.stack([np.cos(self.directions), np.sin(self.directions)], axis=1)
        placed: AnyArray = np.where(np.isnan(turned), np.nan, turned) * self.distances[:, None]
        return placed


class Vectors:
    """Tangent vectors at all vertices.

    Attributes:
        vectors: (V, 3), in space; nan where none can be.
        components: (V, 2): along e1 and e2 of each vertex.
        frames: (V, 3, 3): e1, e2 and the normal of each vertex.
        warnings: texts: where heat took longer than asked for.
    """

    def __init__(self, handle: Handle) -> None:
        self.vectors = view(handle, "vectors")
        self.components = view(handle, "components")
        self.frames: AnyArray = view(handle, "frames").reshape(-1, 3, 3)
        self.warnings: list[str] = json.loads(handle.text("warnings"))


def _points_of(curve: Any, closed: bool) -> Any:
    """Of a Line its points in faces."""
    if not isinstance(curve, Line):
        return curve
    points = list(zip(curve.faces.tolist(), curve.weights.tolist()))
    return points[:-1] if closed and curve.closed else points


def log_map(
    model: Model,
    point: Any,
    *,
    method: str = "exact",
    max_distance: float = np.inf,
    progress: Progress = None,
) -> LogMap:
    """The logarithmic map about a point.

    Args:
        model: a mesh.
        point: a vertex, (face, weights), or a place [x, y, z].
        method: "exact" (on the faces), or "wavefront", "wavefront-fine": near exact, and fast.
        max_distance: what is farther is infinite.

    >>> here = geotherm.log_map(mesh, 17)
    >>> here.coordinates.shape, float(here.distances[17])
    ((2000, 2), 0.0)
    """
    taken = Taken([point], "point", sets=True)
    with Watch(progress) as watch:
        handle = create(
            "log_map",
            handle_of(model),
            taken.pointer,
            text_bytes(method, "method"),
            number_in(max_distance, "max_distance"),
            watch.pointer,
        )
    return LogMap(warned(handle))


def trace(
    model: Model, point: Any, direction: float, length: float, *, progress: Progress = None
) -> Line:
    """The straightest line from a point. It ends before its length at the boundary, and where three
    faces meet.

    Args:
        model: a mesh.
        point: as in log_map().
        direction: radians from e1 towards e2 of the point (LogMap.frame).
        length: model units.

    >>> geotherm.trace(mesh, 17, 0.5, 0.25).length
    0.25
    """
    taken = Taken([point], "point", sets=True)
    with Watch(progress) as watch:
        handle = create(
            "trace",
            handle_of(model),
            taken.pointer,
            number_in(direction, "direction"),
            number_in(length, "length"),
            watch.pointer,
        )
    line = Lines(warned(handle), values=False)[0]
    line.end = handle.text("end")
    return line


def _spread(
    function: str,
    model: Model,
    vertices: Any,
    numbers: Any,
    columns: int,
    settings: dict[str, Any],
    progress: Progress,
) -> Handle:
    at, kept = given(vertices, "vertices", 1)
    values, kept_values = given(numbers, "vectors" if columns == 2 else "values", columns)
    options = options_of(settings)
    with Watch(progress) as watch:
        handle = create(
            function,
            handle_of(model),
            options.value,
            ctypes.byref(at),
            ctypes.byref(values),
            watch.pointer,
        )
    del kept, kept_values
    return handle


def transport(
    model: Model,
    vertices: Any,
    vectors: Any,
    *,
    backend: str | None = None,
    time_factor: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Vectors:
    """Tangent vectors carried to all vertices by the vector heat method (Sharp, Soliman, Crane
    2019): each gets that of the nearest vertex given, without turning on the way.

    Args:
        model: an oriented manifold mesh.
        vertices: (K,) numbers.
        vectors: (K, 2): along e1 and e2 of each.

    >>> geotherm.transport(mesh, [17], [[1, 0]]).vectors.shape
    (2000, 3)
    """
    settings = {"backend": backend, "time_factor": time_factor, "threads": threads}
    return Vectors(_spread("transport", model, vertices, vectors, 2, settings, progress))


def extend(
    model: Model,
    vertices: Any,
    values: Any,
    *,
    backend: str | None = None,
    time_factor: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> AnyArray:
    """Values of some vertices carried to all, (V,): each gets that of the nearest; nan where none
    can be.

    >>> float(geotherm.extend(mesh, [17, 99], [1, 5])[17].round())
    1.0
    """
    settings = {"backend": backend, "time_factor": time_factor, "threads": threads}
    handle = _spread("extend", model, vertices, values, 1, settings, progress)
    return view(warned(handle), "values")


def signed_distance(
    model: Model,
    curves: Any,
    *,
    closed: bool = True,
    rule: str = "auto",
    backend: str | None = None,
    time_factor: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> AnyArray:
    """Distance to directed curves, (V,), negative to their left: inside a loop that runs
    counterclockwise.

    Args:
        model: a mesh.
        curves: a list of curves, each a Line or a list of points (vertices, (face, weights), places),
            joined by geodesics.
        closed: each leads back to its first point.
        rule: "sides" (exact, for curves that separate the surface), "heat" (the signed heat method,
            which closes gaps), "auto": the first of them that works; a ResultWarning says where that
            is heat.

    >>> d = geotherm.signed_distance(mesh, [[17, 900, 1500]])
    >>> d.min() < 0 < d.max()
    True
    """
    settings = {"backend": backend, "time_factor": time_factor, "threads": threads}
    if isinstance(curves, (Line, Lines)):
        curves = [curves] if isinstance(curves, Line) else list(curves)
    if isinstance(curves, (list, tuple)):
        curves = [_points_of(curve, closed) for curve in curves]
    taken = Taken(curves, "curves", sets=True)
    options = options_of(settings)
    with Watch(progress) as watch:
        handle = create(
            "signed_distance",
            handle_of(model),
            options.value,
            taken.pointer,
            int(bool(closed)),
            text_bytes(rule, "rule"),
            watch.pointer,
        )
    return view(warned(handle), "distances")
