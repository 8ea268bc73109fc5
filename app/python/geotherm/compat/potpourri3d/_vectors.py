# SPDX-License-Identifier: MIT
"""The vector heat method on meshes and polygons."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray
from geotherm._directions import extend, log_map, transport
from geotherm._domains import Polygons
from geotherm._models import Mesh
from geotherm._solver import Solver
from geotherm.compat.potpourri3d._curves import signed

class MeshVectorHeatSolver:
    """The vector heat method on the mesh V (n, 3), F (m, 3). useIntrinsicDelaunay is not used: edges
    are flipped where that helps."""

    def __init__(
        self, V: Any, F: Any, t_coef: float = 1.0, useIntrinsicDelaunay: bool = True
    ) -> None:
        self._mesh = Mesh(V, F)
        self._t_coef = float(t_coef)

    def extend_scalar(self, v_inds: Sequence[int], values: Sequence[float]) -> AnyArray:
        """(n,) values: each vertex has that of the nearest one given."""
        return np.array(extend(self._mesh, v_inds, values, time_factor=self._t_coef))

    def get_tangent_frames(self) -> tuple[AnyArray, AnyArray, AnyArray]:
        """Basis X, basis Y and normals of the vertices, (n, 3) each."""
        used = int(np.asarray(self._mesh.faces)[0, 0])
        frames = transport(self._mesh, [used], [[1, 0]], time_factor=self._t_coef).frames
        return np.array(frames[:, 0]), np.array(frames[:, 1]), np.array(frames[:, 2])

    def get_connection_laplacian(self) -> Any:
        """(n, n), complex, Hermitian and positive semidefinite, a scipy.sparse matrix: the cotan
        Laplacian whose entries turn frames into each other, by the least turn in space."""
        from geotherm.compat.potpourri3d._connection import connection_laplacian

        blocks = connection_laplacian(self._mesh, self.get_tangent_frames()).tocsr()
        return blocks[::2, ::2] + 1j * blocks[1::2, ::2]

    def transport_tangent_vector(self, v_ind: int, vector: Sequence[float]) -> AnyArray:
        """(n, 2): the vector, carried to all vertices without turning, in their frames."""
        return self.transport_tangent_vectors([v_ind], [vector])

    def transport_tangent_vectors(
        self, v_inds: Sequence[int], vectors: Sequence[Sequence[float]]
    ) -> AnyArray:
        """(n, 2): each vertex has the vector of the nearest one given."""
        carried = transport(self._mesh, v_inds, vectors, time_factor=self._t_coef)
        return np.array(carried.components)

    def compute_log_map(self, v_ind: int, strategy: str = "AffineLocal") -> AnyArray:
        """(n, 2): where vertices are in the frame of one. Whatever the strategy, which is a choice
        between approximations there, it is the map along shortest paths."""
        return np.array(log_map(self._mesh, v_ind).coordinates)


class PolygonMeshHeatSolver:
    """Heat methods on polygons; what needs directions is computed on their triangles."""

    def __init__(self, V: Any, F: Any, t_coef: float = 1.0) -> None:
        polygons = Polygons(V, F)
        self._solver = Solver(polygons, time_factor=float(t_coef))
        self._vectors = MeshVectorHeatSolver(polygons.vertices, polygons.faces, t_coef)
        self.extend_scalar = self._vectors.extend_scalar
        self.get_tangent_frames = self._vectors.get_tangent_frames
        self.transport_tangent_vector = self._vectors.transport_tangent_vector
        self.transport_tangent_vectors = self._vectors.transport_tangent_vectors

    def compute_distance(self, v_inds: Any) -> AnyArray:
        """(n,) distances from the nearest of several vertices."""
        return self._solver.distance(v_inds)

    def compute_signed_distance(
        self, curves: Sequence[Sequence[int]], level_set_constraint: str = "ZeroSet"
    ) -> AnyArray:
        """(n,) distances to curves of vertices, negative to their left."""
        lines = [list(curve) for curve in curves]
        return signed(self._vectors._mesh, lines, self._vectors._t_coef, level_set_constraint)
