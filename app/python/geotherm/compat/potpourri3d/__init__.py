# SPDX-License-Identifier: MIT
"""The names of potpourri3d, computed by geotherm.

Distances and values need neither manifold nor oriented meshes. Vector heat on points and the
connection Laplacian need scipy. What is computed is geotherm's: paths and log maps are those of the
faces themselves, not approximations that their options speak of.
"""

from geotherm.compat.potpourri3d._barycentric import (
    MarchingTrianglesSolver,
    edges,
    marching_triangles,
)
from geotherm.compat.potpourri3d._clouds import PointCloudHeatSolver, PointCloudLocalTriangulation
from geotherm.compat.potpourri3d._curves import (
    EdgeFlipGeodesicSolver,
    GeodesicTracer,
    MeshFastMarchingDistanceSolver,
    MeshSignedHeatSolver,
)
from geotherm.compat.potpourri3d._files import (
    read_mesh,
    read_point_cloud,
    read_polygon_mesh,
    write_mesh,
    write_point_cloud,
)
from geotherm.compat.potpourri3d._meshes import (
    MeshHeatMethodDistanceSolver,
    compute_distance,
    compute_distance_multisource,
    cotan_laplacian,
    face_areas,
    vertex_areas,
)
from geotherm.compat.potpourri3d._vectors import MeshVectorHeatSolver, PolygonMeshHeatSolver

__all__ = [
    "EdgeFlipGeodesicSolver",
    "GeodesicTracer",
    "MarchingTrianglesSolver",
    "MeshFastMarchingDistanceSolver",
    "MeshHeatMethodDistanceSolver",
    "MeshSignedHeatSolver",
    "MeshVectorHeatSolver",
    "PointCloudHeatSolver",
    "PointCloudLocalTriangulation",
    "PolygonMeshHeatSolver",
    "compute_distance",
    "compute_distance_multisource",
    "cotan_laplacian",
    "edges",
    "face_areas",
    "marching_triangles",
    "read_mesh",
    "read_point_cloud",
    "read_polygon_mesh",
    "vertex_areas",
    "write_mesh",
    "write_point_cloud",
]
