# SPDX-License-Identifier: MIT
"""Heat methods on points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray
from geotherm._directions import extend, log_map
from geotherm._domains import PointCloud
from geotherm._library import InputError
from geotherm._solver import Solver
from geotherm.compat.potpourri3d._connection import Frames, frames_of, potential, transported


class PointCloudHeatSolver:
    """Heat methods on the surface that the points P (n, 3) sample."""

    def __init__(self, P: Any, t_coef: float = 1.0) -> None:
        self._t_coef = float(t_coef)
        self._cloud = PointCloud(P)
        self._solver = Solver(self._cloud, time_factor=self._t_coef)
        self._frames: Frames = frames_of(self._cloud)

    def compute_distance(self, p_ind: int) -> AnyArray:
        """(n,) distances from a point."""
        return self._solver.distance(p_ind)

    def compute_distance_multisource(self, p_inds: Sequence[int]) -> AnyArray:
        """(n,) distances from the nearest of several points."""
        return self._solver.distance(p_inds)

    def extend_scalar(self, p_inds: Sequence[int], values: Sequence[float]) -> AnyArray:
        """(n,) values: each point has that of the nearest one given."""
        return np.array(extend(self._cloud, p_inds, values, time_factor=self._t_coef))

    def get_tangent_frames(self) -> Frames:
        """Basis X, basis Y and normals of the points, (n, 3) each. Nothing orients the normals."""
        return self._frames

    def transport_tangent_vector(self, p_ind: int, vector: Sequence[float]) -> AnyArray:
        """(n, 2): the vector, carried to all points without turning, in their frames."""
        return self.transport_tangent_vectors([p_ind], [vector])

    def transport_tangent_vectors(
        self, p_inds: Sequence[int], vectors: Sequence[Sequence[float]]
    ) -> AnyArray:
        """(n, 2): each point has the vector of the nearest one given. Needs scipy."""
        at, given = np.asarray(p_inds), np.asarray(vectors, dtype=np.float64)
        if at.ndim != 1 or given.shape != (at.size, 2):
            raise InputError(f"vectors has the shape {given.shape} for {at.size} points")
        if at.size == 0 or at.dtype.kind not in "iu" or at.min() < 0 or at.max() >= len(self._frames[0]):
            raise InputError("p_inds is no list of numbers of points")
        return transported(self._cloud, self._frames, at, given, self._t_coef)

    def compute_log_map(self, p_ind: int) -> AnyArray:
        """(n, 2): where points are in the frame of one."""
        here = log_map(self._cloud, p_ind)
        first, second, _ = (axis[p_ind] for axis in self._frames)
        # The map has its own frame, whose normal may be another.
        places = np.nan_to_num(here.coordinates, nan=0.0) @ here.frame[:2]
        flat = np.stack([places @ first, places @ second], axis=1)
        length = np.linalg.norm(flat, axis=1)
        scale = np.where(length > 0, here.distances / np.where(length > 0, length, 1), 0)
        found: AnyArray = flat * scale[:, None]
        found[~np.isfinite(here.coordinates).all(axis=1)] = np.nan
        return found

    def compute_signed_distance(
        self,
        curves: Sequence[Sequence[int]],
        cloud_normals: Any,
        preserve_source_normals: bool = False,
        level_set_constraint: str = "ZeroSet",
        soft_level_set_weight: float = -1,
    ) -> AnyArray:
        """(n,) distances to curves of points, negative to their left as seen from where the normals
        point, by the signed heat method (Feng, Crane 2024). Others than these options raise
        NotImplementedError. Needs scipy."""
        if preserve_source_normals or soft_level_set_weight > 0 or level_set_constraint != "ZeroSet":
            raise NotImplementedError("curves are level sets, and their normals are not held")
        points, normals = np.asarray(self._cloud.vertices), np.asarray(cloud_normals, np.float64)
        if normals.shape != points.shape:
            raise InputError(
                f"cloud_normals has the shape {normals.shape}, and {points.shape} is expected"
            )
        fewest = min((len(curve) for curve in curves), default=0)
        if fewest < 2:
            what = f"the shortest of {len(curves)} curves has {fewest} points"
            raise InputError(what, hint="give each two or more")
        lines = [self._solver.path(a, b) for curve in curves for a, b in zip(curve, curve[1:])]
        on_lines = [(int(f), w) for line in lines for f, w in zip(line.faces, line.weights)]
        along = np.concatenate([np.gradient(line.points, axis=0) for line in lines])
        corners = np.array([self._cloud.faces[face][np.argmax(w)] for face, w in on_lines])
        right = np.cross(along, normals[corners])
        ids, place = np.unique(corners, return_inverse=True)
        sums = np.zeros((len(ids), 3))
        np.add.at(sums, place, right)
        size = np.linalg.norm(sums, axis=1, keepdims=True)
        right = sums / np.where(size > 0, size, 1)
        first, second, _ = self._frames
        sides = np.stack([(right * axis[ids]).sum(axis=1) for axis in (first, second)], axis=1)
        carried = transported(self._cloud, self._frames, ids, sides, self._t_coef)
        spread = carried[:, :1] * first + carried[:, 1:] * second
        found = potential(self._cloud, spread)
        return found - float(found[corners].mean())


class PointCloudLocalTriangulation:
    """Triangles between the points P (n, 3). with_degeneracy_heuristic is not used: points that
    coincide are no trouble."""

    def __init__(self, P: Any, with_degeneracy_heuristic: bool = True) -> None:
        self._cloud = PointCloud(P)

    def get_local_triangulation(self) -> AnyArray:
        """(n, most, 3): the triangles at each point, filled up with -1. Each stands at its three
        corners, and begins with the point."""
        faces = np.asarray(self._cloud.faces, dtype=np.int64)
        turned = np.concatenate([np.roll(faces, -k, axis=1) for k in range(3)])
        order = np.argsort(turned[:, 0], kind="stable")
        turned = turned[order]
        counts = np.bincount(turned[:, 0], minlength=self._cloud.n_vertices)
        place = np.arange(len(turned)) - np.repeat(np.cumsum(counts) - counts, counts)
        out = np.full((self._cloud.n_vertices, int(counts.max(initial=0)), 3), -1, dtype=np.int64)
        out[turned[:, 0], place] = turned
        return out
