# SPDX-License-Identifier: MIT
"""The names of potpourri3d, computed by geotherm.

Meshes need be neither manifold nor oriented. Not there are vector heat, signed heat, tracing and
polygon solvers, which raise NotImplementedError by name.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray
from geotherm._domains import PointCloud, read
from geotherm._models import Mesh, Model
from geotherm._solver import Solver

__all__ = [
    "EdgeFlipGeodesicSolver",
    "MeshHeatMethodDistanceSolver",
    "PointCloudHeatSolver",
    "compute_distance",
    "compute_distance_multisource",
    "cotan_laplacian",
    "face_areas",
    "read_mesh",
    "read_point_cloud",
    "vertex_areas",
    "write_mesh",
    "write_point_cloud",
]

_MISSING = {
    "GeodesicTracer",
    "MeshSignedHeatSolver",
    "MeshVectorHeatSolver",
    "PointCloudLocalTriangulation",
    "PolygonMeshHeatSolver",
}


def __getattr__(name: str) -> Any:
    if name in _MISSING:
        raise NotImplementedError(
            f"geotherm.compat.potpourri3d has no {name}; geotherm computes distances and paths"
        )
    raise AttributeError(f"module 'geotherm.compat.potpourri3d' has no attribute {name!r}")


def _no_transport(self: Any, *_: Any, **__: Any) -> Any:
    raise NotImplementedError("geotherm has no vector heat method: distances and paths alone")


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


class EdgeFlipGeodesicSolver:
    """Geodesic paths on the mesh V (n, 3), F (m, 3): the shortest that are found, not only
    locally shortest ones. t_coef is not used, as there."""

    def __init__(self, V: Any, F: Any, t_coef: float = 1.0) -> None:
        self._solver = Solver(Mesh(V, F), method="wavefront")

    def _path(self, vertices: Sequence[int], closed: bool, limits: tuple[Any, Any]) -> AnyArray:
        if limits != (None, None):
            raise NotImplementedError("paths are straightened to the end: leave the limits out")
        return np.array(self._solver.path(*vertices, closed=closed).points)

    def find_geodesic_path(
        self,
        v_start: int,
        v_end: int,
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> AnyArray:
        """(k, 3) points from one vertex to the other."""
        limits = (max_iterations, max_relative_length_decrease)
        return self._path([v_start, v_end], False, limits)

    def find_geodesic_path_poly(
        self,
        v_list: Sequence[int],
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> AnyArray:
        """(k, 3) points of the shortest ways from each vertex to the next."""
        return self._path(v_list, False, (max_iterations, max_relative_length_decrease))

    def find_geodesic_loop(
        self,
        v_list: Sequence[int],
        max_iterations: int | None = None,
        max_relative_length_decrease: float | None = None,
    ) -> AnyArray:
        """(k, 3) points of a closed geodesic that runs by the vertices at first."""
        return self._path(v_list, True, (max_iterations, max_relative_length_decrease))


class PointCloudHeatSolver:
    """Distances on the surface that the points P (n, 3) sample."""

    def __init__(self, P: Any, t_coef: float = 1.0) -> None:
        self._solver = Solver(PointCloud(P), time_factor=float(t_coef))

    def compute_distance(self, p_ind: int) -> AnyArray:
        """(n,) distances from a point."""
        return self._solver.distance(p_ind)

    def compute_distance_multisource(self, p_inds: Sequence[int]) -> AnyArray:
        """(n,) distances from the nearest of several points."""
        return self._solver.distance(p_inds)

    extend_scalar = get_tangent_frames = transport_tangent_vector = _no_transport
    transport_tangent_vectors = compute_log_map = _no_transport


def read_mesh(filename: str) -> tuple[AnyArray, AnyArray]:
    """V (n, 3), F (m, 3) of a file; polygons are cut into triangles."""
    mesh: Model = read(filename, domain="triangles")
    return np.array(mesh.vertices), np.array(mesh.faces)


def write_mesh(V: Any, F: Any, filename: str) -> None:
    """Writes .ply, .obj, .off or .stl."""
    Mesh(V, F).write(filename)


def read_point_cloud(filename: str) -> AnyArray:
    """The vertices (n, 3) of a file; faces are ignored."""
    model: Model = read(filename)
    return np.array(model.vertices)


def write_point_cloud(V: Any, filename: str) -> None:
    """Writes points as .xyz: a line each."""
    points = np.asarray(V, dtype=np.float64)
    if not str(filename).endswith(".xyz"):
        raise NotImplementedError("point clouds are written as .xyz")
    np.savetxt(filename, points, fmt="%.17g")


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
