// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/sources.h"
#include "solver/geometry/clean_faces.h"
#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {

/// Whether flips may pass an edge: it has one face, or two that agree in orientation.
bool is_oriented_manifold(const CleanFaces& clean, Index edge);

/// For each clean face 1 where its component has an edge that is_oriented_manifold() denies; empty
/// where no component has. Cost: O(F), nothing on an oriented manifold.
std::vector<char> faces_that_need_cover(const CleanFaces& clean, Index vertex_count);

/// Makes the tufted cover (Sharp, Crane 2020, section 3): every face with `doubled[face] != 0` gets
/// a back, numbered after all faces in IntrinsicMesh::back; round each edge the copies that face
/// each other are glued, a boundary's front to its own back. Each side of such a face then has a
/// twin, and orientations agree: an oriented manifold without boundary whose vertices are those of
/// the surface. Its operators are twice the surface's where no edge is flipped, and flips make all
/// weights positive whatever the mesh.
/// Preconditions: `mesh` is that of build_intrinsic_mesh(), without flips; whole components are
/// doubled. Cost: O(F).
void make_tufted_cover(IntrinsicMesh& mesh, std::span<const Vec3> positions,
                       const CleanFaces& clean, const std::vector<char>& doubled);

}  // namespace geotherm
