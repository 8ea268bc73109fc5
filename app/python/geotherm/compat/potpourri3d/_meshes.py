# SPDX-License-Identifier: MIT
"""Distances, areas and the Laplacian of triangle meshes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray
from geotherm._models import Mesh
from geotherm._solver import Solver


class MeshHeatMethodDistanceSolver:
    """Distances on the mesh V (n, 3), F (m, 3). t_coef: the time factor of the heat method;
    use_robust False: on the mesh's own edges, without flips."""

    def __init__(
        self, V: Any, F: Any, t_coef: float = 1.0, use_robust: bool = True
    ) -> None:
        laplacian = None if use_robust else "cotan"
        self._solver = Solver(Mesh(V, F), time_factor=float(t_coef), laplacian=laplacian)

    def compute_distance(self, v_ind: int) -> AnyArray:
        """(n,) distances from a vertex."""
        return self._solver.distance(v_ind)

    def compute_distance_multisource(self, v_inds: Sequence[int]) -> AnyArray:
        """(n,) distances from the nearest of several vertices."""
        return self._solver.distance(v_inds)


def compute_distance(V: Any, F: Any, v_ind: int) -> AnyArray:
    """MeshHeatMethodDistanceSolver(V, F).compute_distance(v_ind)."""
    return MeshHeatMethodDistanceSolver(V, F).compute_distance(v_ind)


def compute_distance_multisource(V: Any, F: Any, v_inds: Sequence[int]) -> AnyArray:
    """MeshHeatMethodDistanceSolver(V, F).compute_distance_multisource(v_inds)."""
    return MeshHeatMethodDistanceSolver(V, F).compute_distance_multisource(v_inds)


def face_areas(V: Any, F: Any) -> AnyArray:
    """(m,) areas."""
    points, faces = np.asarray(V, dtype=np.float64), np.asarray(F)
    sides = points[faces[:, 1:]] - points[faces[:, :1]]
    areas: AnyArray = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    return areas


def vertex_areas(V: Any, F: Any) -> AnyArray:
    """(n,) a third of the areas of the faces at each vertex."""
    shares = np.repeat(face_areas(V, F) / 3, 3)
    areas: AnyArray = np.bincount(np.asarray(F).reshape(-1), shares, minlength=len(V))
    return areas


def cotan_laplacian(V: Any, F: Any, denom_eps: float = 0.0) -> Any:
    """The cotan Laplacian as a scipy.sparse matrix (n, n), positive semidefinite; needs scipy."""
    import scipy.sparse  # type: ignore[import]

    points, faces = np.asarray(V, dtype=np.float64), np.asarray(F)
    total = scipy.sparse.coo_matrix((len(points), len(points)))
    for k in range(3):
        apex, i, j = (faces[:, (k + step) % 3] for step in range(3))
        a, b = points[i] - points[apex], points[j] - points[apex]
        area = np.linalg.norm(np.cross(a, b), axis=1) + denom_eps
        weight = np.einsum("fk,fk->f", a, b) / area / 2
        rows = np.concatenate([i, j, i, j])
        columns = np.concatenate([i, j, j, i])
        values = np.concatenate([weight, weight, -weight, -weight])
        total = total + scipy.sparse.coo_matrix((values, (rows, columns)), shape=total.shape)
    return total.tocsr()
