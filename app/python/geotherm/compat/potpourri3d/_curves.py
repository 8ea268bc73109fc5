# SPDX-License-Identifier: MIT
"""Geodesic paths, straightest lines, and distances to curves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray
from geotherm._directions import log_map, signed_distance, trace
from geotherm._library import InputError
from geotherm._models import Mesh
from geotherm._solver import Solver
from geotherm.compat.potpourri3d._barycentric import Barycentric


class EdgeFlipGeodesicSolver:
    """Geodesic paths on the mesh V (n, 3), F (m, 3), straightened to the end: limits of that raise
    NotImplementedError. t_coef is not used, as there."""

    def __init__(self, V: Any, F: Any, t_coef: float = 1.0) -> None:
        self._solver = Solver(Mesh(V, F), method="wavefront")

    def _path(
        self,
        vertices: Sequence[int],
        limits: tuple[Any, Any],
        closed: bool = False,
        loose: bool = False,
    ) -> AnyArray:
        if limits != (None, None):
            raise NotImplementedError("paths are straightened to the end: leave the limits out")
        return np.array(self._solver.path(*vertices, closed=closed, loose=loose).points)

    def find_geodesic_path(
        self,
        v_start: int,
        v_end: int,
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> AnyArray:
        """(k, 3) points from one vertex to the other: the shortest path that is found."""
        limits = (max_iterations, max_relative_length_decrease)
        return self._path([v_start, v_end], limits)

    def find_geodesic_path_poly(
        self,
        v_list: Sequence[int],
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> AnyArray:
        """(k, 3) points of a geodesic from the first vertex to the last, which runs by the others
        at first."""
        return self._path(v_list, (max_iterations, max_relative_length_decrease), loose=True)

    def find_geodesic_loop(
        self,
        v_list: Sequence[int],
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> AnyArray:
        """(k, 3) points of a closed geodesic that runs by the vertices at first."""
        return self._path(v_list, (max_iterations, max_relative_length_decrease), closed=True)


class GeodesicTracer:
    """Straightest lines on the mesh V (n, 3), F (m, 3). t_coef is not used, as there."""

    def __init__(self, V: Any, F: Any, t_coef: float = 1.0) -> None:
        self._mesh = Mesh(V, F)
        points = np.asarray(self._mesh.vertices)
        self._near = 1e-6 * float(np.linalg.norm(np.ptp(points, axis=0)))

    def _trace(self, start: Any, direction: Any, most: int | None) -> AnyArray:
        along = np.asarray(direction, dtype=np.float64)
        if along.shape != (3,):
            raise InputError(f"direction_xyz has the shape {along.shape}, and (3,) is expected")
        e1, e2, _ = log_map(self._mesh, start, max_distance=self._near).frame
        flat = float(np.hypot(along @ e1, along @ e2))
        if flat < 1e-9 * float(np.linalg.norm(along)):
            raise InputError(
                "direction_xyz is along the normal at the start",
                hint="give one with a part along the surface",
            )
        angle = float(np.arctan2(along @ e2, along @ e1))
        line = trace(self._mesh, start, angle, float(np.linalg.norm(along)))
        return np.array(line.points if most is None else line.points[: most + 1])

    def trace_geodesic_from_vertex(
        self, start_vert: int, direction_xyz: Any, max_iterations: int | None = None
    ) -> AnyArray:
        """(k, 3) points of the line from a vertex, as long as the direction, which is laid into its
        tangent plane. max_iterations: the most pieces."""
        return self._trace(start_vert, direction_xyz, max_iterations)

    def trace_geodesic_from_face(
        self,
        start_face: int,
        bary_coords: Any,
        direction_xyz: Any,
        max_iterations: int | None = None,
    ) -> AnyArray:
        """The same from a point in a face."""
        return self._trace((start_face, list(bary_coords)), direction_xyz, max_iterations)


def signed(mesh: Mesh, curves: Sequence[list[Any]], t_coef: float, level_set: str) -> AnyArray:
    """Distances negative to the left of curves, each of which is closed where it ends at its begin."""
    if level_set != "ZeroSet":
        raise NotImplementedError('curves are level sets: leave level_set_constraint "ZeroSet"')
    closed = [len(curve) > 1 and curve[0] == curve[-1] for curve in curves]
    if any(closed) and not all(closed):
        raise NotImplementedError("curves are closed all, or none of them")
    parts = [curve[:-1] if all(closed) else curve for curve in curves]
    return np.array(signed_distance(mesh, parts, closed=all(closed), time_factor=t_coef))


class MeshSignedHeatSolver:
    """Signed distance to curves on the mesh V (n, 3), F (m, 3)."""

    def __init__(self, V: Any, F: Any, t_coef: float = 1.0) -> None:
        self._mesh = Mesh(V, F)
        self._t_coef = float(t_coef)
        self._places = Barycentric(self._mesh)

    def compute_distance(
        self,
        curves: Sequence[Any],
        curve_signs: Sequence[bool] = (),
        points: Sequence[Any] = (),
        preserve_source_normals: bool = False,
        level_set_constraint: str = "ZeroSet",
        soft_level_set_weight: float = -1,
    ) -> AnyArray:
        """(n,) distances, negative to the left of the curves.

        Args:
            curves: lists of points, joined by geodesics; closed where the last is the first.
            curve_signs: False where a curve, and so its points, is unsigned.
            points: unsigned ones: vertices, or as in curves.
            preserve_source_normals, level_set_constraint, soft_level_set_weight: others than those
                that are there raise NotImplementedError.
        """
        if preserve_source_normals or soft_level_set_weight > 0:
            raise NotImplementedError("curves are level sets, and their normals are not held")
        signs = list(curve_signs) or [True] * len(curves)
        if len(signs) != len(curves):
            raise InputError(f"curve_signs has {len(signs)} values for {len(curves)} curves")
        lines = [self._places.points(curve) for curve in curves]
        distances: AnyArray = np.full(self._mesh.n_vertices, np.inf)
        with_side = [line for line, side in zip(lines, signs) if side]
        if with_side:
            distances = signed(self._mesh, with_side, self._t_coef, level_set_constraint)
        plain = self._places.points(points)
        for line, side in zip(lines, signs):
            plain += [] if side else line
        if plain:
            others = Solver(self._mesh, time_factor=self._t_coef).distance(plain)
            distances = np.where(others < np.abs(distances), others, distances)
        return distances


class MeshFastMarchingDistanceSolver:
    """Distances by fast marching on the mesh V (n, 3), F (m, 3)."""

    def __init__(self, V: Any, F: Any) -> None:
        self._solver = Solver(Mesh(V, F), method="fast-marching")
        self._places = Barycentric(self._solver.model)

    def compute_distance(
        self,
        curves: Sequence[Any],
        distances: Sequence[Sequence[float]] = (),
        sign: bool = False,
    ) -> AnyArray:
        """(n,) distances from the points of the curves; with sign to the curves, negative to their
        left (as MeshSignedHeatSolver). distances: at the points, in place of 0."""
        lines = [self._places.points(curve) for curve in curves]
        if sign:
            if any(any(line) for line in distances):
                raise NotImplementedError("signed distances are 0 on the curves")
            mesh = self._solver.model
            assert isinstance(mesh, Mesh)
            return signed(mesh, [[*line, line[0]] for line in lines], 1.0, "ZeroSet")
        begin = distances or [[0.0] * len(line) for line in lines]
        if [len(line) for line in begin] != [len(line) for line in lines]:
            raise InputError("distances has other lengths than curves")
        texts = []
        for line, offsets in zip(lines, begin):
            for point, offset in zip(line, offsets):
                place = str(point)
                if isinstance(point, tuple):
                    place = f"face:{point[0]}:" + ":".join(repr(float(w)) for w in point[1])
                texts.append(f"{place}@{float(offset)!r}" if offset else place)
        return self._solver.distance(texts)
