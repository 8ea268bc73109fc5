# SPDX-License-Identifier: MIT
"""Points as potpourri3d writes them: (vertex, []), (edge, [t]), (face, [a, b]) or (face, [a, b, c])."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from geotherm._answers import isolines
from geotherm._arrays import AnyArray
from geotherm._library import InputError
from geotherm._models import Mesh, Model


def edges(V: Any, F: Any) -> AnyArray:
    """(e, 2) vertices of the edges, in the order in which the faces first have them."""
    faces = np.asarray(F)
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    first = np.unique(np.sort(sides, axis=1), axis=0, return_index=True)[1]
    found: AnyArray = sides[np.sort(first)]
    return found


class Barycentric:
    """Points on a mesh to and from geotherm's."""

    def __init__(self, model: Model) -> None:
        self._faces = np.asarray(model.faces)
        self._ends = edges(None, self._faces)
        self._edge_of = {frozenset(ends): e for e, ends in enumerate(self._ends.tolist())}

    def point(self, one: Any) -> Any:
        """A vertex number, or (face, weights)."""
        number, *rest = one if isinstance(one, (tuple, list)) else (one,)
        weights = [float(x) for x in (rest[0] if rest else [])]
        if not weights:
            return number
        if len(weights) == 1:
            return self._on_edge(number, weights[0])
        return number, [*weights[:2], 1 - weights[0] - weights[1]]

    def _on_edge(self, edge: int, share: float) -> Any:
        if not 0 <= edge < len(self._ends):
            raise InputError(f"edge {edge} is none: there are {len(self._ends)}")
        start, end = self._ends[edge]
        has_both = (self._faces == start).any(axis=1) & (self._faces == end).any(axis=1)
        face = int(np.flatnonzero(has_both)[0])
        corners = self._faces[face]
        weights = np.where(corners == end, share, np.where(corners == start, 1 - share, 0.0))
        return face, weights.tolist()

    def points(self, many: Iterable[Any]) -> list[Any]:
        """All of a curve."""
        return [self.point(one) for one in many]

    def told(self, face: int, weights: AnyArray) -> tuple[int, list[float]]:
        """A point of geotherm's as potpourri3d writes it."""
        corners = self._faces[face]
        on = np.flatnonzero(weights > 0)
        if len(on) == 1:
            return int(corners[on[0]]), []
        if len(on) == 2:
            edge = self._edge_of[frozenset(corners[on].tolist())]
            end = self._ends[edge][1]
            return edge, [float(weights[corners == end][0])]
        return int(face), [float(x) for x in weights[:2]]


class MarchingTrianglesSolver:
    """Level sets on the mesh V (n, 3), F (m, 3)."""

    def __init__(self, V: Any, F: Any) -> None:
        self._mesh = Mesh(V, F)
        self._places = Barycentric(self._mesh)

    def marching_triangles(self, u: Any, isoval: float = 0.0) -> list[list[Any]]:
        """The lines on which u, (n,), is isoval: a list of points each."""
        lines = isolines(self._mesh, u, levels=[isoval])
        return [
            [self._places.told(face, weights) for face, weights in zip(line.faces, line.weights)]
            for line in lines
        ]


def marching_triangles(V: Any, F: Any, u: Any, isoval: float = 0.0) -> list[list[Any]]:
    """MarchingTrianglesSolver(V, F).marching_triangles(u, isoval)."""
    return MarchingTrianglesSolver(V, F).marching_triangles(u, isoval)
