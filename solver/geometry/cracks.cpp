// SPDX-License-Identifier: MIT
#include "solver/geometry/clean_faces.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "geotherm/mesh.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

/// Widths of cracks that are tried, as shares of the mean edge: nothing, the rounding of 32-bit
/// floats and of printed digits, a sloppy export.
constexpr double kShares[] = {0, 1e-6, 1e-4, 1e-2};

/// The least number of one digit, such as 3e-05, that is not below x. Precondition: x > 0, finite.
double one_digit_up(double x) {
  std::array<char, 32> buffer{};
  char* const begin = buffer.data();
  char* const end =
      std::to_chars(begin, begin + buffer.size(), x, std::chars_format::scientific, 0).ptr;
  double rounded = x;
  std::from_chars(begin, end, rounded);
  if (rounded >= x) return rounded;
  const std::string up = std::to_string(*begin - '0' + 1) + std::string(begin + 1, end);
  rounded = x;
  std::from_chars(up.data(), up.data() + up.size(), rounded);
  return rounded;
}

/// Tries distances on one mesh.
class Seeker {
 public:
  explicit Seeker(const TriangleMesh& mesh) : mesh_(mesh), clean_(clean_faces(mesh)) {
    for (Index e = 0; e < clean_.edges.edge_count(); ++e) {
      if (clean_.edges.sides(e).size() == 1) boundary_.push_back(e);
    }
  }

  CrackReport run() {
    CrackReport best;
    best.boundary_edges = static_cast<Index>(boundary_.size());
    const double mean = mean_edge_length(mesh_.positions(), clean_.edges);
    if (boundary_.empty() || !std::isfinite(mean)) return best;
    for (const double share : kShares) {
      const double distance = share > 0 ? one_digit_up(share * mean) : 0;
      const auto welded = weld(mesh_, distance);
      if (!welded || collapses(welded->mesh)) break;
      const Index closed = count_closed(welded->mesh);
      if (closed > best.closed_edges) {
        best = {welded->merged, distance, best.boundary_edges, closed};
      }
    }
    return best;
  }

 private:
  /// Whether two corners lie on each other, so that any distance makes the face collapse.
  bool is_collapsed(const Face& face) const {
    const auto& p = mesh_.positions();
    return p[face[0]] == p[face[1]] || p[face[1]] == p[face[2]] || p[face[2]] == p[face[0]];
  }

  /// Whether a face repeats a corner that has three different ones, and at different places.
  bool collapses(const TriangleMesh& welded) const {
    return std::ranges::any_of(clean_.original, [&](Index f) {
      return repeats_corner(welded.faces()[f]) && !is_collapsed(mesh_.faces()[f]);
    });
  }

  /// How many edges of the boundary have two faces or more.
  Index count_closed(const TriangleMesh& welded) const {
    const CleanFaces clean = clean_faces(welded);
    std::vector<std::array<Index, 2>> inner;
    for (Index e = 0; e < clean.edges.edge_count(); ++e) {
      if (clean.edges.sides(e).size() > 1)
        inner.push_back({clean.edges.low(e), clean.edges.high(e)});
    }
    return static_cast<Index>(std::ranges::count_if(boundary_, [&](Index e) {
      const auto [low, high] = std::minmax(
          {welded.standing_for(clean_.edges.low(e)), welded.standing_for(clean_.edges.high(e))});
      return std::ranges::binary_search(inner, std::array<Index, 2>{low, high});
    }));
  }

  const TriangleMesh& mesh_;
  CleanFaces clean_;
  std::vector<Index> boundary_;  ///< edges with one face
};

}  // namespace

CrackReport find_cracks(const TriangleMesh& mesh) { return Seeker(mesh).run(); }

}  // namespace geotherm
