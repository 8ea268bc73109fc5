// SPDX-License-Identifier: MIT
#include "bench/bench_mesh.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "bench/models/generate.h"

namespace geotherm::bench {
namespace {

/// Numbers in [0, 1), the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double next() { return static_cast<double>(engine_()) / 4294967296.0; }

 private:
  std::mt19937 engine_;
};

/// `regular` keeps the vertices on the grid and all diagonals alike: six neighbours each.
Result<TriangleMesh> make_torus(Index faces, bool regular) {
  constexpr double kTwoPi = 2 * std::numbers::pi;
  const double jitter = regular ? 0 : 0.4;  // of a cell
  const auto across = static_cast<Index>(std::lround(std::sqrt(faces / 5.0)));
  const auto along = static_cast<Index>(std::lround(faces / 2.0 / across));
  Random random(1);
  std::vector<Vec3> positions;
  for (Index i = 0; i < along; ++i) {
    for (Index j = 0; j < across; ++j) {
      const double u = kTwoPi * (i + jitter * (random.next() - 0.5)) / along;
      const double v = kTwoPi * (j + jitter * (random.next() - 0.5)) / across;
      const double bump = std::sin(7 * u + 2 * v) + 0.7 * std::sin(13 * u - 5 * v);
      const double tube = 0.4 * (1 + 0.06 * bump);
      const double ring = 1 + tube * std::cos(v);
      positions.emplace_back(ring * std::cos(u), tube * std::sin(v), ring * std::sin(u));
    }
  }
  std::vector<Face> triangles;
  for (Index i = 0; i < along; ++i) {
    for (Index j = 0; j < across; ++j) {
      const Index i1 = (i + 1) % along, j1 = (j + 1) % across;
      const Index a = i * across + j, b = i1 * across + j;
      const Index c = i1 * across + j1, d = i * across + j1;
      if (random.next() < 0.5 && !regular) {
        triangles.push_back({a, c, b});
        triangles.push_back({a, d, c});
      } else {
        triangles.push_back({a, d, b});
        triangles.push_back({b, d, c});
      }
    }
  }
  return TriangleMesh::build(std::move(positions), std::move(triangles));
}

/// An icosahedron, each face cut into four, and again, until it has at least `faces` of them.
Result<TriangleMesh> make_sphere(Index faces) {
  const double g = std::numbers::phi;
  std::vector<Vec3> positions = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                 {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                 {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  std::vector<Face> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  while (static_cast<Index>(triangles.size()) < faces) {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [entry, is_new] =
          middles.emplace(std::minmax(a, b), static_cast<Index>(positions.size()));
      if (is_new) positions.emplace_back((positions[a] + positions[b]) / 2);
      return entry->second;
    };
    std::vector<Face> finer;
    for (const auto& [a, b, c] : triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  for (Vec3& p : positions) p.normalize();
  return TriangleMesh::build(std::move(positions), std::move(triangles));
}

}  // namespace

Result<TriangleMesh> make_mesh(std::string_view name, Index faces) {
  if (name == "grid") return make_torus(faces, true);
  if (name == "torus") return make_torus(faces, false);
  if (name == "sphere") return make_sphere(faces);
  return generate_model(name, faces);
}

std::vector<Index> pick_sources(Index vertex_count, std::size_t count) {
  Random random(2);
  std::vector<Index> sources;
  for (std::size_t k = 0; k < count; ++k) {
    sources.push_back(static_cast<Index>(random.next() * vertex_count));
  }
  return sources;
}

namespace {

// Factors of 3 to 4 between sizes, up to what a machine of 24 GB can do; a regular and an irregular
// mesh of each. The torus is alike at every size, so that growth is not the shape's; the gargoyle
// is a shape that people have, with all sizes of triangles.
constexpr Case kCases[] = {
    {"grid", 30'000, true, true},        {"torus", 30'000, false, true},
    {"terrain", 33'000, false, false},   {"grid", 100'000, true, true},
    {"torus", 100'000, false, true},     {"gargoyle", 100'000, false, true},
    {"grid", 280'000, true, true},       {"torus", 280'000, false, true},
    {"gargoyle", 280'000, false, false}, {"grid", 1'100'000, true, true},
    {"torus", 1'100'000, false, true},   {"gargoyle", 1'100'000, false, false},
    {"sphere", 1'300'000, true, false},  {"grid", 4'400'000, true, false},
    {"torus", 4'400'000, false, false},
};

}  // namespace

std::span<const Case> all_cases() { return kCases; }

std::string case_name(const Case& c) {
  return std::string(c.mesh) + "-" + std::to_string(c.faces / 1000) + "k";
}

std::vector<std::string> backends_for(const Case& c, const SolvePlan& plan) {
  std::vector<std::string> out;
  if (plan.quick && !c.quick && !plan.chosen) return out;
  for (const std::string& backend : plan.backends) {
    if (std::regex_search(case_name(c) + "/" + backend, plan.only)) out.push_back(backend);
  }
  return out;
}

}  // namespace geotherm::bench
