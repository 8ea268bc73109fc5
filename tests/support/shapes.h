// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/mesh.h"

namespace geotherm::test {

using MeshPtr = std::shared_ptr<const TriangleMesh>;

/// A mesh under construction.
struct Draft {
  std::vector<Vec3> positions;
  std::vector<Face> faces;

  Index add(const Vec3& p);
  Index vertex_count() const { return static_cast<Index>(positions.size()); }
};

/// The mesh of a draft, which must be valid.
MeshPtr finish(Draft draft);

/// Appends another draft; its vertices and faces follow.
void append(Draft& draft, const Draft& other);

/// A rectangle in the plane z = 0 from the origin: nx x ny squares of two triangles. Vertex (i, j)
/// is grid_vertex(nx, i, j).
Draft plane_grid(Index nx, Index ny, double width, double height);
inline Index grid_vertex(Index nx, Index i, Index j) { return j * (nx + 1) + i; }

/// The unit square as n x n cells, inner vertices moved at random by up to `amount` cells, the
/// diagonal of each cell at random.
Draft jittered_plane(Index n, double amount, unsigned seed);

/// The Delaunay triangulation of `count` random points in the unit square: thin obtuse faces lie
/// along its border. Source: Bowyer, Watson 1981.
Draft random_delaunay(Index count, unsigned seed);

/// A rectangle of n x n cells whose widths and heights grow from one corner to the other, `ratio`
/// times in all.
Draft graded_plane(Index n, double ratio);

/// Three pages of n x n cells along one edge, which grow sixty times in width and height.
Draft graded_book(Index n);

/// A sphere of 1,280 faces with two spikes, 15 times as far out.
Draft spiky_sphere();

/// Icosahedron, each triangle cut into 4^level, vertices on the unit sphere.
Draft sphere(int level);

/// Torus about the z axis with radii 1 and `minor`.
Draft torus(Index around, Index across, double minor);

/// Side of a prism over a regular polygon (perimeter 1), open at both ends; intrinsically a flat
/// cylinder of circumference 1. Vertex (i, j) = j * around + i at height j / along * height.
Draft prism(Index around, Index along, double height);

/// Side of a pyramid over a regular polygon, cut into rings: intrinsically a flat cone about vertex
/// 0 of total angle `sectors` * sector_angle and slant height 1 at the corners. Every sector is
/// divided into rings^2 triangles.
Draft pyramid(Index sectors, Index rings, double sector_angle);

/// The flat torus of size 1 x 1, folded flat onto a quarter of itself, which keeps all lengths:
/// cells x cells squares (`cells` even) of two triangles. Vertex (i, j) = j * cells + i. `jitter`
/// moves vertices off the folds by up to that many cells.
Draft folded_flat_torus(Index cells, double jitter, unsigned seed);

/// A strip with a half turn; one-sided.
Draft moebius(Index around, Index across);

/// Rotates by a fixed general rotation, scales, moves.
Draft transformed(const Draft& draft, double scale, const Vec3& shift, bool rotate);

/// Another numbering of vertices and faces; new_number[v] is the number that vertex v gets.
Draft renumbered(const Draft& draft, unsigned seed, std::vector<Index>& new_number);

}  // namespace geotherm::test
