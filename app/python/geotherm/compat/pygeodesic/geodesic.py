# SPDX-License-Identifier: MIT
"""The names of pygeodesic.geodesic: exact distances and paths by geotherm."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray, whole_in
from geotherm._library import Error, InputError
from geotherm._models import Mesh
from geotherm._solver import Solver

__all__ = ["PyGeodesicAlgorithmExact", "read_mesh_from_file"]


class PyGeodesicAlgorithmExact:
    """Exact geodesic distance on the mesh points (n, 3), faces (m, 3)."""

    def __init__(self, _points: Any, _faces: Any) -> None:
        self._solver = Solver(Mesh(_points, _faces), method="exact")

    def geodesicDistance(self, sourceIndex: int, targetIndex: int) -> tuple[float, AnyArray]:
        """The length of the shortest path, and its points (k, 3) from target to source."""
        ends = whole_in(targetIndex, "targetIndex"), whole_in(sourceIndex, "sourceIndex")
        path = self._solver.path(*ends)
        return path.length, np.array(path.points)

    def geodesicDistances(
        self,
        source_indices: Any = None,
        target_indices: Any = None,
        max_distance: float = float("inf"),
    ) -> tuple[AnyArray, AnyArray]:
        """Distances of the targets (all vertices) from the nearest of the sources (vertex 0), and
        the number of that source among them. Farther than max_distance is infinite."""
        sources = np.array([0]) if source_indices is None else np.asarray(source_indices)
        if sources.ndim != 1 or sources.dtype.kind not in "iu":
            raise InputError("source_indices is no list of vertex numbers")
        reach = max_distance if max_distance > 0 else float("inf")
        answer = self._solver.solve(sources, labels=True, check="off", max_distance=reach)
        # Sources that are named twice are one there, numbered where they first stand.
        first = np.sort(np.unique(sources, return_index=True)[1])
        distances, nearest = answer.distances, np.append(first, -1)[answer.nearest]
        if target_indices is not None:
            targets = np.asarray(target_indices)
            if targets.ndim != 1 or targets.dtype.kind not in "iu":
                raise InputError("target_indices is no list of vertex numbers")
            if targets.size and not 0 <= targets.min() <= targets.max() < len(distances):
                raise InputError("target_indices has a number that is no vertex")
            distances, nearest = distances[targets], nearest[targets]
        distances = np.where(distances > max_distance, np.inf, distances)
        return distances, nearest.astype(np.int32)


def read_mesh_from_file(filename: str | os.PathLike[str]) -> tuple[AnyArray, AnyArray]:
    """points (n, 3), faces (m, 3) of a text file: their numbers, then a line for each."""
    try:
        with open(filename, encoding="utf-8") as file:
            words = file.read().split()
        points, faces = (int(word) for word in words[:2])
        numbers = np.array(words[2:], dtype=np.float64)
    except OSError as why:
        raise Error(f"{filename}: {why.strerror}", "bad-file") from None
    except ValueError as why:
        raise Error(f"{filename} is no list of numbers ({why})", "bad-file") from None
    if points < 0 or faces < 0 or numbers.size < 3 * (points + faces):
        raise InputError(f"{filename} ends before its {points} points and {faces} faces")
    return (
        numbers[: 3 * points].reshape(-1, 3),
        numbers[3 * points : 3 * (points + faces)].reshape(-1, 3).astype(np.int64),
    )
