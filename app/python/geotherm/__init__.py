# SPDX-License-Identifier: MIT
"""Geodesic distance on triangle meshes, polygons, tets, points and grids by the heat method.

>>> import geotherm
>>> mesh = geotherm.read("bunny")           # or geotherm.Mesh(V, F)
>>> solver = geotherm.Solver(mesh)
>>> d = solver.distance(17)                 # (V,), model units
>>> rows = solver.distances([17, 99])       # (2, V)

Lengths are in the model's own units; vertices and faces are numbered from 0; a distance is
infinite where no source can be reached. What cannot be done is an Error.
"""

from geotherm._answers import Line, Lines, Relaxed, Result, Samples, isolines
from geotherm._centres import Centres, centres
from geotherm._directions import (
    LogMap,
    Vectors,
    extend,
    log_map,
    signed_distance,
    trace,
    transport,
)
from geotherm._domains import Grid, PointCloud, Polygons, TetMesh, read
from geotherm._library import Error, InputError, ResultWarning
from geotherm._models import Mesh, Model
from geotherm._options import features, options
from geotherm._solver import Solver, farthest_points


def __getattr__(name: str) -> str:
    if name == "__version__":
        return str(features()["version"])
    raise AttributeError(f"module 'geotherm' has no attribute {name!r}")


__all__ = [
    "Centres",
    "Error",
    "Grid",
    "InputError",
    "Line",
    "Lines",
    "LogMap",
    "Mesh",
    "Model",
    "PointCloud",
    "Polygons",
    "Relaxed",
    "Result",
    "ResultWarning",
    "Samples",
    "Solver",
    "TetMesh",
    "Vectors",
    "centres",
    "extend",
    "farthest_points",
    "features",
    "isolines",
    "log_map",
    "options",
    "read",
    "signed_distance",
    "trace",
    "transport",
]
