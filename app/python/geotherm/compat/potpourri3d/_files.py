# SPDX-License-Identifier: MIT
"""Files of meshes and points."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from geotherm._arrays import AnyArray
from geotherm._domains import Polygons, read
from geotherm._library import InputError
from geotherm._models import Mesh, Model


def read_mesh(filename: str) -> tuple[AnyArray, AnyArray]:
    """V (n, 3), F (m, 3) of a file; polygons are cut into triangles."""
    mesh: Model = read(filename, domain="triangles")
    return np.array(mesh.vertices), np.array(mesh.faces)


def read_polygon_mesh(filename: str) -> tuple[AnyArray, list[list[int]]]:
    """V (n, 3) and the vertices of each polygon, of an .obj file."""
    if not filename.lower().endswith(".obj"):
        raise NotImplementedError("the polygons of a file are read from .obj")
    vertices = np.array(read(filename, domain="polygons").vertices)  # which looks at the faces, too
    faces: list[list[int]] = []
    seen = 0
    with open(filename, encoding="utf-8", errors="replace") as file:
        joined = re.sub(r"(?m)^([^#\n]*)\\\r?\n", r"\1 ", file.read())
    for line in joined.split("\n"):
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            seen += 1
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            faces.append([v - 1 if v > 0 else seen + v for v in corners])
    return vertices, faces


def write_mesh(
    V: Any, F: Any, filename: str, UV_coords: Any = None, UV_type: str | None = None
) -> None:
    """Writes .ply, .obj, .off or .stl; faces of more than three vertices as .obj. Texture coordinates
    raise NotImplementedError."""
    if UV_coords is not None or UV_type is not None:
        raise NotImplementedError("texture coordinates are not written")
    if all(len(face) == 3 for face in F):
        Mesh(V, F).write(filename)
        return
    if not filename.endswith(".obj"):
        raise NotImplementedError("faces of more than three vertices are written as .obj")
    polygons = Polygons(V, F)  # which looks at the numbers
    with open(filename, "w", encoding="utf-8") as file:
        np.savetxt(file, polygons.vertices, fmt="v %.17g %.17g %.17g")
        faces = polygons._recipe[2]
        file.writelines("f " + " ".join(str(v + 1) for v in face) + "\n" for face in faces)


def read_point_cloud(filename: str) -> AnyArray:
    """The vertices (n, 3) of a file; faces are ignored."""
    model: Model = read(filename)
    return np.array(model.vertices)


def write_point_cloud(V: Any, filename: str) -> None:
    """Writes points as .xyz (a line each) or .ply."""
    points = np.asarray(V, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3:
        raise InputError(f"V has the shape {points.shape}, and (n, 3) is expected")
    head = ""
    if str(filename).endswith(".ply"):
        axes = "".join(f"property double {axis}\n" for axis in "xyz")
        head = f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n{axes}end_header"
    elif not str(filename).endswith(".xyz"):
        raise NotImplementedError("point clouds are written as .xyz or .ply")
    np.savetxt(filename, points, fmt="%.17g", header=head, comments="")
