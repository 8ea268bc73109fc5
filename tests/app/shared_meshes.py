# SPDX-License-Identifier: MIT
"""shared_meshes.py make: binary .ply files of the shapes below in this folder.
shared_meshes.py compare A.npy B.npy SHARE: fails where distances differ by more than this share of
the largest, or one is reached and the other is not."""
import array
import math
import random
import struct
import sys


def plane(nx, ny, stretch=1.0, shear=0.0, at=(0.0, 0.0), size=1.0, repeated=0):
    chance = random.Random(1)
    points = []
    for y in range(ny):
        for x in range(nx):
            u, v = x + chance.uniform(-0.2, 0.2), y + chance.uniform(-0.2, 0.2)
            points.append((at[0] + size * (stretch * u + shear * v), at[1] + size * v, 0.0))
    faces = []
    for y in range(ny - 1):
        for x in range(nx - 1):
            i = y * nx + x
            faces += [(i, i + 1, i + nx + 1), (i, i + nx + 1, i + nx)]
    return points, faces + faces[100:100 + repeated]


def sphere(rings, around):
    points = [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    for r in range(1, rings):
        a = math.pi * r / rings
        for k in range(around):
            b = 2 * math.pi * (k + 0.5 * (r % 2)) / around
            points.append((math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)))
    at = lambda r, k: 2 + (r - 1) * around + k % around
    faces = []
    for k in range(around):
        faces += [(0, at(1, k), at(1, k + 1)), (1, at(rings - 1, k + 1), at(rings - 1, k))]
        for r in range(1, rings - 1):
            turn = r % 2
            faces += [(at(r, k), at(r + 1, k + turn), at(r, k + 1)),
                      (at(r, k + 1 - turn), at(r + 1, k), at(r + 1, k + 1))]
    return points, faces


def together(*parts):
    points, faces = [], []
    for more, corners in parts:
        faces += [tuple(len(points) + c for c in face) for face in corners]
        points += more
    return points, faces


def write(path, points, faces, last=None):
    with open(path, "wb") as out:
        out.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
                   "property double x\nproperty double y\nproperty double z\n"
                   f"element face {len(faces)}\n"
                   "property list uchar int vertex_indices\nend_header\n").encode())
        for p in points:
            out.write(struct.pack("<3d", *p))
        for face in faces[:-1] + [last or faces[-1]]:
            out.write(struct.pack("<B3i", 3, *face))


def numbers(path):
    with open(path, "rb") as file:
        bytes_of = file.read()
    begin = 10 + struct.unpack("<H", bytes_of[8:10])[0]
    return array.array("d", bytes_of[begin:])


if sys.argv[1] == "make":
    write("plane.ply", *plane(90, 70))
    write("sphere.ply", *sphere(60, 90))
    write("three.ply", *together(plane(60, 50), plane(50, 40, at=(100.0, 0.0), size=0.1),
                                 sphere(20, 30)))
    write("obtuse.ply", *plane(90, 70, shear=2.3))
    write("stretched.ply", *plane(90, 70, stretch=10.0))
    write("strip.ply", *plane(1500, 3))
    write("little.ply", *plane(5, 5))
    write("wide.ply", *plane(90, 70, size=1e200))
    write("twice.ply", *plane(90, 70, repeated=50))
    # A sheet that stands on another: edges with three faces.
    points, faces = plane(60, 50)
    sheet = len(points)
    points += [(x, y, z) for z in range(1, 20) for x, y, _ in points[25 * 60:26 * 60]]
    at = lambda x, z: 25 * 60 + x if z == 0 else sheet + (z - 1) * 60 + x
    for z in range(19):
        for x in range(59):
            faces += [(at(x, z), at(x + 1, z), at(x + 1, z + 1)), (at(x, z), at(x + 1, z + 1), at(x, z + 1))]
    write("book.ply", points, faces)
    write("range.ply", *plane(90, 70), last=(0, 1, 6300))
    write("square.ply", *plane(30, 20))
else:
    a, b, share = numbers(sys.argv[2]), numbers(sys.argv[3]), float(sys.argv[4])
    assert len(a) == len(b), f"{len(a)} and {len(b)} distances"
    assert all(not math.isnan(x) for x in b), "not a number"
    assert all(math.isinf(x) == math.isinf(y) for x, y in zip(a, b)), "others are reached"
    most = max(x for x in a if not math.isinf(x))
    off = max(abs(x - y) for x, y in zip(a, b) if not math.isinf(x)) / most
    assert off <= share, f"off by {off:.2g} of the largest distance, {share:g} is allowed"
