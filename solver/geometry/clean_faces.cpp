// SPDX-License-Identifier: MIT
#include "solver/geometry/clean_faces.h"

#include <algorithm>
#include <utility>

#include "solver/mesh/edge_table.h"

namespace geotherm {
namespace {

Face sorted(Face face) {
  std::sort(face.begin(), face.end());
  return face;
}

/// Duplicates can only hide where an edge has several faces; most meshes have no such edge.
std::vector<char> find_duplicates(const std::vector<Face>& faces, const EdgeTable& edges) {
  std::vector<char> duplicate(faces.size(), 0);
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const auto sides = edges.sides(e);
    for (std::size_t j = 1; j < sides.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const Index f = face_of(sides[i]);
        const Index g = face_of(sides[j]);
        if (sorted(faces[f]) == sorted(faces[g])) {
          duplicate[std::max(f, g)] = 1;
          break;
        }
      }
      if (sides.size() > 64 && j > 64) break;  // a fan of hundreds: quadratic work is not worth it
    }
  }
  return duplicate;
}

/// Turns faces so that neighbours agree, walking each patch from its first face. On a surface
/// that cannot be oriented some edges stay in disagreement.
Index orient(std::vector<Face>& faces, const EdgeTable& edges) {
  bool consistent = true;
  for (Index e = 0; e < edges.edge_count() && consistent; ++e) {
    const auto sides = edges.sides(e);
    consistent = sides.size() != 2 || sides_agree(faces, sides[0], sides[1]);
  }
  if (consistent) return 0;

  std::vector<Side> twin(3 * faces.size(), kNoSide);
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const auto sides = edges.sides(e);
    if (sides.size() != 2) continue;
    twin[sides[0]] = sides[1];
    twin[sides[1]] = sides[0];
  }
  std::vector<signed char> turned(faces.size(), -1);
  std::vector<Index> stack;
  for (std::size_t seed = 0; seed < faces.size(); ++seed) {
    if (turned[seed] >= 0) continue;
    turned[seed] = 0;
    stack.push_back(static_cast<Index>(seed));
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const Side other = twin[3 * f + k];
        if (other == kNoSide || turned[face_of(other)] >= 0) continue;
        const bool disagree = !sides_agree(faces, 3 * f + k, other);
        turned[face_of(other)] = static_cast<signed char>(turned[f] ^ static_cast<int>(disagree));
        stack.push_back(face_of(other));
      }
    }
  }
  Index count = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (turned[f] == 1) {
      std::swap(faces[f][1], faces[f][2]);
      ++count;
    }
  }
  return count;
}

}  // namespace

CleanFaces clean_faces(const TriangleMesh& mesh) {
  CleanFaces out;
  out.faces.reserve(mesh.faces().size());
  out.original.reserve(mesh.faces().size());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces()[f];
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) {
      ++out.repeated_corner;
      continue;
    }
    out.faces.push_back(face);
    out.original.push_back(f);
  }
  out.edges = EdgeTable(mesh.vertex_count(), out.faces);
  const std::vector<char> duplicate = find_duplicates(out.faces, out.edges);
  if (std::find(duplicate.begin(), duplicate.end(), 1) != duplicate.end()) {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < out.faces.size(); ++f) {
      if (duplicate[f]) continue;
      out.faces[kept] = out.faces[f];
      out.original[kept++] = out.original[f];
    }
    out.duplicate = static_cast<Index>(out.faces.size() - kept);
    out.faces.resize(kept);
    out.original.resize(kept);
    out.edges = EdgeTable(mesh.vertex_count(), out.faces);
  }
  out.reoriented = orient(out.faces, out.edges);
  if (out.reoriented > 0) out.edges = EdgeTable(mesh.vertex_count(), out.faces);
  return out;
}

}  // namespace geotherm
