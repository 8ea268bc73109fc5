# SPDX-License-Identifier: MIT
"""Vectors between tangent planes that nothing orients, by the vector heat method (Sharp, Soliman,
Crane 2019) with scipy."""

from __future__ import annotations

from typing import Any

import numpy as np

from geotherm._arrays import AnyArray
from geotherm._models import Model
from geotherm.compat.potpourri3d._meshes import cotan_laplacian, vertex_areas

Frames = tuple[AnyArray, AnyArray, AnyArray]


def frames_of(model: Model) -> Frames:
    """Basis X, basis Y and normals of points: normal to the plane nearest to the neighbours."""
    points, faces = np.asarray(model.vertices), np.asarray(model.faces)
    spread = np.zeros((len(points), 3, 3))
    for k in range(3):
        for other in (1, 2):
            sides = points[faces[:, (k + other) % 3]] - points[faces[:, k]]
            np.add.at(spread, faces[:, k], sides[:, :, None] * sides[:, None, :])
    axes = np.linalg.eigh(spread)[1]
    normals, first = axes[:, :, 0], axes[:, :, 2]
    return first, np.cross(normals, first), normals


def turns(frames: Frames, i: AnyArray, j: AnyArray) -> AnyArray:
    """(k, 2, 2): what takes components at j to those at i, by the least turn of the planes."""
    normals = frames[2]
    sign = np.where(np.einsum("kx,kx->k", normals[i], normals[j]) < 0, -1.0, 1.0)
    near = normals[j] * sign[:, None]  # on the side of the normal at i
    cosine = np.einsum("kx,kx->k", normals[i], near)
    turn = np.empty((len(i), 2, 2))
    for column in range(2):
        axis = frames[column][j]
        share = np.einsum("kx,kx->k", normals[i], axis) / (1 + cosine)
        moved = axis - share[:, None] * (normals[i] + near)
        for row in range(2):
            turn[:, row, column] = np.einsum("kx,kx->k", frames[row][i], moved)
    return turn


def connection_laplacian(model: Model, frames: Frames) -> Any:
    """(2n, 2n) scipy.sparse: the cotan Laplacian with a turn in place of each entry; weights below 0
    are left out, so that the method is stable."""
    import scipy.sparse  # type: ignore[import]

    edges = scipy.sparse.triu(cotan_laplacian(model.vertices, model.faces), 1).tocoo()
    kept = edges.data < 0
    i, j, weight = edges.row[kept], edges.col[kept], -edges.data[kept]
    turn = turns(frames, i, j)
    size = 2 * model.n_vertices
    sums = np.bincount(np.concatenate([i, j]), np.tile(weight, 2), minlength=size // 2)
    off = scipy.sparse.coo_matrix((size, size))
    for row in range(2):
        for column in range(2):
            part = -weight * turn[:, row, column]
            off = off + scipy.sparse.coo_matrix((part, (2 * i + row, 2 * j + column)), (size, size))
    return scipy.sparse.diags(np.repeat(sums, 2)) + off + off.T


def transported(
    model: Model, frames: Frames, vertices: AnyArray, vectors: AnyArray, t_coef: float
) -> AnyArray:
    """(n, 2): each point has the vector of the nearest one given, without turning on the way."""
    import scipy.sparse.linalg  # type: ignore[import]

    points, faces = np.asarray(model.vertices), np.asarray(model.faces)
    sides = np.linalg.norm(points[faces] - points[np.roll(faces, -1, axis=1)], axis=2)
    time = t_coef * float(sides.mean()) ** 2
    areas = vertex_areas(points, faces)
    areas[areas == 0] = 1  # of points in no triangle, which nothing reaches
    plain = connection_laplacian(model, _same_frames(len(points)))[::2, ::2]
    heat = scipy.sparse.linalg.splu((scipy.sparse.diags(areas) + time * plain).tocsc())
    turned = connection_laplacian(model, frames)
    heat_of_vectors = scipy.sparse.linalg.splu(
        (scipy.sparse.diags(np.repeat(areas, 2)) + time * turned).tocsc()
    )
    start = np.zeros((len(points), 2))
    start[vertices] = vectors
    marks, lengths = np.zeros(len(points)), np.zeros(len(points))
    marks[vertices], lengths[vertices] = 1, np.linalg.norm(vectors, axis=1)
    spread = heat_of_vectors.solve(start.reshape(-1)).reshape(-1, 2)
    found = np.linalg.norm(spread, axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        scale = heat.solve(lengths) / heat.solve(marks) / found
        carried: AnyArray = spread * scale[:, None]
    return carried


def _same_frames(count: int) -> Frames:
    axes = np.eye(3)
    first, second, third = (np.broadcast_to(axis, (count, 3)) for axis in axes)
    return first, second, third


def potential(model: Model, vectors: AnyArray) -> AnyArray:
    """(n,) values whose gradient is as near to the directions of vectors in space, (n, 3), as can
    be; up to a number."""
    import scipy.sparse.linalg

    points, faces = np.asarray(model.vertices), np.asarray(model.faces)
    field = np.nan_to_num(vectors)[faces].mean(axis=1)
    up = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    normal = up / np.maximum(np.linalg.norm(up, axis=1, keepdims=True), 1e-300)
    field -= (field * normal).sum(axis=1, keepdims=True) * normal
    field /= np.maximum(np.linalg.norm(field, axis=1, keepdims=True), 1e-300)
    right = np.zeros(len(points))
    for k in range(3):
        side = points[faces[:, (k + 2) % 3]] - points[faces[:, (k + 1) % 3]]
        part = (np.cross(normal, side) * field).sum(axis=1) / 2
        right += np.bincount(faces[:, k], part, minlength=len(points))
    areas = vertex_areas(points, faces)
    areas[areas == 0] = 1
    shift = scipy.sparse.diags(areas * (1e-9 / areas.sum()))  # which settles the number
    found: AnyArray = scipy.sparse.linalg.splu(
        (cotan_laplacian(points, faces) + shift).tocsc()
    ).solve(right - right.mean())
    return found
