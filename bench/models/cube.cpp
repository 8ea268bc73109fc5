// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "bench/models/models.h"

namespace geotherm::generate {
namespace {

using Counts = std::array<int, 3>;

/// Squares along each edge direction: as equal as they can be with 4 (ab + bc + ca) nearest to
/// the faces asked for.
Counts best_counts(Index faces) {
  const int side = static_cast<int>(std::sqrt(faces / 12.0));
  Counts best{};
  double best_error = std::numeric_limits<double>::infinity();
  for (int a = side; a <= side + 2; ++a) {
    for (int b = a; b <= side + 2; ++b) {
      for (int c = b; c <= side + 2; ++c) {
        const double count = 4.0 * (static_cast<double>(a) * b + static_cast<double>(b) * c +
                                    static_cast<double>(c) * a);
        const double error = std::abs(count - faces) + (c - a);  // of equals the most even
        if (error >= best_error) continue;
        best_error = error;
        best = {a, b, c};
      }
    }
  }
  return best;
}

/// Numbers the points of the box's surface in the order in which they are first asked for.
class BoxSurface {
 public:
  explicit BoxSurface(const Counts& counts) : counts_(counts) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t points = static_cast<std::size_t>(counts[(axis + 1) % 3] + 1) *
                                 static_cast<std::size_t>(counts[(axis + 2) % 3] + 1);
      numbers_[2 * axis].assign(points, kNoIndex);
      numbers_[2 * axis + 1].assign(points, kNoIndex);
    }
  }

  Index number(const Counts& p) {
    Index found = kNoIndex;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (on_side(p, axis)) found = std::max(found, slot(p, axis));
    }
    if (found == kNoIndex) {
      found = static_cast<Index>(mesh.positions.size());
      mesh.positions.emplace_back(place(p, 0), place(p, 1), place(p, 2));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (on_side(p, axis)) slot(p, axis) = found;
    }
    return found;
  }

  /// The side where `axis` has its largest (`high`) or smallest value.
  void add_side(std::size_t axis, bool high) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (int j = 0; j < counts_[v]; ++j) {
      for (int i = 0; i < counts_[u]; ++i) {
        const auto corner = [&](int di, int dj) {
          Counts p{};
          p[axis] = high ? counts_[axis] : 0;
          p[u] = i + di;
          p[v] = j + dj;
          return number(p);
        };
        std::array<Index, 4> ring = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        if (!high) std::swap(ring[1], ring[3]);
        // The diagonals change direction from square to square, so that none is preferred.
        const std::size_t k = (i + j) % 2 == 0 ? 0 : 1;
        mesh.faces.push_back({ring[k], ring[k + 1], ring[k + 2]});
        mesh.faces.push_back({ring[k], ring[k + 2], ring[(k + 3) % 4]});
      }
    }
  }

  DraftMesh mesh;

 private:
  bool on_side(const Counts& p, std::size_t axis) const {
    return p[axis] == 0 || p[axis] == counts_[axis];
  }
  double place(const Counts& p, std::size_t axis) const {
    return 2.0 * p[axis] / counts_[axis] - 1;
  }
  Index& slot(const Counts& p, std::size_t axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const auto width = static_cast<std::size_t>(counts_[u] + 1);
    return numbers_[2 * axis + (p[axis] == 0 ? 0 : 1)]
                   [static_cast<std::size_t>(p[u]) + width * static_cast<std::size_t>(p[v])];
  }

  Counts counts_;
  std::array<std::vector<Index>, 6> numbers_;  ///< per side, point by point
};

}  // namespace

Result<DraftMesh> make_cube(Index faces, const Progress& progress) {
  BoxSurface box(best_counts(faces));
  for (std::size_t side = 0; side < 6; ++side) {
    if (!report(progress, "building", static_cast<double>(side) / 6)) {
      return cancelled_error();
    }
    box.add_side(side / 2, side % 2 == 1);
  }
  return std::move(box.mesh);
}

}  // namespace geotherm::generate
