// SPDX-License-Identifier: MIT
// Surfaces whose distances are known in closed form.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/polyhedral/exact_fixture.h"

namespace geotherm::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Expects known(p, q) between each source and every vertex.
void expect_known(const Draft& draft, const std::vector<Index>& sources,
                  const std::function<double(const Vec3&, const Vec3&)>& known) {
  const auto method = exact_method(finish(draft));
  for (const Index source : sources) {
    const auto d = solve_exactly(*method, SourceSet::of_vertices({source})).distances;
    double largest = 0;
    for (const double x : d) largest = std::max(largest, std::isfinite(x) ? x : 0);
    for (std::size_t v = 0; v < d.size(); ++v) {
      const double expected = known(draft.positions[source], draft.positions[v]);
      if (d[v] == expected) continue;  // infinities too
      ASSERT_NEAR(d[v], expected, kRoundOff * largest)
          << "from " << source << " to " << v << " at " << draft.positions[v].transpose();
    }
  }
}

double straight(const Vec3& p, const Vec3& q) { return (p - q).norm(); }

/// A square without its quarter x > 1/2, y > 1/2; n even.
Draft ell(Index n) {
  Draft draft = plane_grid(n, n, 1, 1);
  std::erase_if(draft.faces, [&](const Face& face) {
    Vec3 sum = Vec3::Zero();
    for (const Index v : face) sum += draft.positions[v];
    return sum.x() > 1.5 && sum.y() > 1.5;
  });
  return draft;
}

/// The surface of the unit cube, n x n squares a side; vertex 0 is the origin.
Draft cube(Index n) {
  Draft draft;
  std::vector<Index> number(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), kNoIndex);
  const auto vertex = [&](Index i, Index j, Index k) {
    Index& v = number[static_cast<std::size_t>((i * (n + 1) + j) * (n + 1) + k)];
    if (v == kNoIndex) v = draft.add(Vec3(i, j, k) / n);
    return v;
  };
  const auto square = [&](Index a, Index b, Index c, Index d) {
    draft.faces.insert(draft.faces.end(), {{a, b, c}, {a, c, d}});
  };
  vertex(0, 0, 0);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      for (const Index at : {Index{0}, n}) {
        square(vertex(at, i, j), vertex(at, i + 1, j), vertex(at, i + 1, j + 1),
               vertex(at, i, j + 1));
        square(vertex(i, at, j), vertex(i + 1, at, j), vertex(i + 1, at, j + 1),
               vertex(i, at, j + 1));
        square(vertex(i, j, at), vertex(i + 1, j, at), vertex(i + 1, j + 1, at),
               vertex(i, j + 1, at));
      }
    }
  }
  return draft;
}

/// Equal flat sectors about vertex 0 with ends at distance 1, as a fan that rises and falls: a cone
/// of more than 2 pi. `spread` is the height of the ends.
Draft saddle(Index sectors, double spread) {
  Draft draft;
  draft.add(Vec3::Zero());
  const double radius = std::sqrt(1 - spread * spread);
  for (Index s = 0; s < sectors; ++s) {
    const double u = 2 * kPi * s / sectors;
    draft.add({radius * std::cos(u), radius * std::sin(u), s % 2 == 0 ? spread : -spread});
    draft.faces.push_back({0, s + 1, (s + 1) % sectors + 1});
  }
  return draft;
}

/// Each face cut into four, in its plane.
Draft refined(const Draft& draft) {
  Draft fine;
  const Index corners = draft.vertex_count();
  fine.positions = draft.positions;
  std::vector<Index> middle(static_cast<std::size_t>(corners * corners), kNoIndex);
  const auto between = [&](Index a, Index b) {
    Index& v = middle[static_cast<std::size_t>(std::min(a, b) * corners + std::max(a, b))];
    if (v == kNoIndex) v = fine.add((draft.positions[a] + draft.positions[b]) / 2);
    return v;
  };
  for (const auto& [a, b, c] : draft.faces) {
    const Index ab = between(a, b), bc = between(b, c), ca = between(c, a);
    fine.faces.insert(fine.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

/// On a cone: radii and the angle between, the other way round if that is shorter.
double on_cone(double r, double s, double between, double total) {
  const double angle = std::min(between, total - between);
  if (angle >= kPi) return r + s;
  return std::sqrt(std::max(0.0, r * r + s * s - 2 * r * s * std::cos(angle)));
}

TEST(ExactOnAPlane, IsTheStraightLine) {
  const Draft draft = jittered_plane(14, 0.3, 5);
  expect_known(draft, {0, 7, 100, draft.vertex_count() - 1}, straight);
}

TEST(ExactOnAGrid, IsTheStraightLineAlsoAlongRowsOfVertices) {
  expect_known(plane_grid(12, 9, 1.2, 0.9), {0, 6, 58, 70}, straight);
}

TEST(ExactOnAPlane, GoesRoundAReentrantCorner) {
  const Vec3 corner(0.5, 0.5, 0);
  constexpr Index kN = 10;
  expect_known(ell(kN), {grid_vertex(kN, 10, 0), grid_vertex(kN, 8, 2), grid_vertex(kN, 0, 10)},
               [&](const Vec3& p, const Vec3& q) {
                 if (q.x() > 0.5 && q.y() > 0.5) return kUnreached;  // what was cut out
                 const Vec3 &right = p.x() > q.x() ? p : q, &left = p.x() > q.x() ? q : p;
                 const Vec3 a = right - corner, b = left - corner;
                 const bool behind =
                     right.x() > 0.5 && left.y() > 0.5 && a.x() * b.y() - a.y() * b.x() > 0;
                 return behind ? a.norm() + b.norm() : (p - q).norm();
               });
}

TEST(ExactOnACube, FromACornerUnfoldsTwoSides) {
  expect_known(cube(6), {0}, [](const Vec3&, const Vec3& q) {
    const double most = q.maxCoeff();
    if (most < 1 || q.minCoeff() == 0) return q.norm();
    // On a side away from the corner: over either of the two sides between.
    double best = kUnreached;
    for (int far = 0; far < 3; ++far) {
      if (q[far] != 1) continue;
      const double a = q[(far + 1) % 3], b = q[(far + 2) % 3];
      best = std::min({best, std::hypot(1 + a, b), std::hypot(1 + b, a)});
    }
    return best;
  });
}

TEST(ExactOnACube, FromTheMiddleOfASideToTheOppositeOneIsTwo) {
  const Draft draft = cube(4);
  const auto at = [&](const Vec3& p) {
    const auto found =
        std::ranges::find_if(draft.positions, [&](const Vec3& q) { return (p - q).norm() < 1e-9; });
    return static_cast<Index>(found - draft.positions.begin());
  };
  const auto d = exact_distances(finish(draft), std::vector<Index>{at({0.5, 0.5, 0})});
  EXPECT_NEAR(d[at({0.5, 0.5, 1})], 2, kRoundOff);
  EXPECT_NEAR(d[at({0, 0, 1})], std::hypot(0.5, 1.5), kRoundOff);
}

TEST(ExactOnACylinder, WindsTheShorterWay) {
  constexpr Index kAround = 17;
  const Draft draft = prism(kAround, 9, 0.7);
  const auto angle = [](const Vec3& p) { return std::atan2(p.y(), p.x()) / (2 * kPi); };
  expect_known(draft, {0, 3 * kAround + 4, 9 * kAround + 2}, [&](const Vec3& p, const Vec3& q) {
    const double turn = angle(p) - angle(q);
    return std::hypot(turn - std::round(turn), p.z() - q.z());
  });
}

TEST(ExactOnACone, IsThatOfItsUnfolding) {
  // Sectors of 50 degrees, five of them; the vertices of sector s at ring r are 1/r of it apart.
  constexpr Index kSectors = 5, kRings = 7;
  const double sector = 50 * kPi / 180;
  const Draft draft = pyramid(kSectors, kRings, sector);
  struct Polar {
    double radius, angle;
  };
  std::vector<Polar> polar = {{0, 0}};
  for (Index r = 1; r <= kRings; ++r) {
    for (Index s = 0; s < kSectors; ++s) {
      for (Index k = 0; k < r; ++k) {
        const double x = r - k + k * std::cos(sector), y = k * std::sin(sector);
        polar.push_back({std::hypot(x, y) / kRings, s * sector + std::atan2(y, x)});
      }
    }
  }
  for (const Index source : {Index{0}, Index{1}, Index{40}, draft.vertex_count() - 3}) {
    const auto d = exact_distances(finish(draft), std::vector<Index>{source});
    for (std::size_t v = 0; v < d.size(); ++v) {
      const double between = std::abs(polar[v].angle - polar[source].angle);
      EXPECT_NEAR(d[v], on_cone(polar[v].radius, polar[source].radius, between, kSectors * sector),
                  kRoundOff)
          << "from " << source << " to " << v;
    }
  }
}

TEST(ExactAtASaddle, BendsRoundTheVertex) {
  constexpr Index kSectors = 8;
  const Draft draft = saddle(kSectors, 0.6);
  const double sector = std::acos(draft.positions[1].dot(draft.positions[2]));
  ASSERT_GT(kSectors * sector, 2.5 * kPi);
  const auto d = exact_distances(finish(refined(refined(draft))), std::vector<Index>{1});
  for (Index s = 0; s < kSectors; ++s) {
    // Distances in the surface, which ends at the chords between the sectors' corners.
    const double shorter = std::min(s, kSectors - s) * sector;
    if (shorter >= kPi) {
      EXPECT_NEAR(d[s + 1], 2, kRoundOff) << "corner " << s;
    } else if (s == 1) {
      EXPECT_NEAR(d[s + 1], 2 * std::sin(sector / 2), kRoundOff);
    }
  }
  EXPECT_NEAR(d[0], 1, kRoundOff);
}

TEST(ExactOnAFlatTorus, TakesTheNearestOfItsCopies) {
  constexpr Index kCells = 12;
  const Draft draft = folded_flat_torus(kCells, 0, 1);
  const auto d = exact_distances(finish(draft), std::vector<Index>{2 * kCells + 3});
  for (Index j = 0; j < kCells; ++j) {
    for (Index i = 0; i < kCells; ++i) {
      const auto apart = [](Index a) {
        return static_cast<double>(std::min(a, kCells - a)) / kCells;
      };
      const double expected = std::hypot(apart(std::abs(i - 3)), apart(std::abs(j - 2)));
      EXPECT_NEAR(d[j * kCells + i], expected, kRoundOff) << i << ", " << j;
    }
  }
}

}  // namespace
}  // namespace geotherm::test
