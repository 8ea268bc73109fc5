// SPDX-License-Identifier: MIT
#include "tests/broken/broken_case.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "tests/support/sanitized.h"

namespace geotherm::test {
namespace {

bool three_corners(const Face& f) { return f[0] != f[1] && f[1] != f[2] && f[2] != f[0]; }

std::array<double, 3> random_weights(Dice& dice) {
  std::array<double, 3> weights = {dice.unit(), dice.unit(), dice.unit()};
  const auto k = static_cast<std::size_t>(dice.below(3));
  if (dice.chance(0.1)) return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
  if (dice.chance(0.4)) weights[k] = 0;                     // on a side
  if (dice.chance(0.1)) weights[k] *= dice.power(-14, -6);  // beside one
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& w : weights) w /= sum;
  return weights;
}

SourceSet random_sources(const BrokenCase& test, const std::vector<Index>& numbers, Dice& dice) {
  SourceSet out;
  const bool vertices = dice.chance(0.6);
  for (Index n = dice.chance(0.5) ? 1 : dice.from(2, 5); n > 0; --n) {
    const auto f = static_cast<std::size_t>(dice.below(numbers.size()));
    if (vertices || dice.chance(0.3)) {
      out.points.push_back(SurfacePoint::at_vertex(dice.pick(test.faces[f])));
    } else {
      out.points.push_back(SurfacePoint::in_face(numbers[f], random_weights(dice)));
    }
  }
  return out;
}

}  // namespace

BrokenCase broken_case(std::uint64_t seed, const Breakage& how) {
  BrokenMesh made = broken_mesh(seed, how);
  BrokenCase out{std::move(made.recipe),
                 finish(std::move(made.draft)),
                 {},
                 {},
                 {},
                 {},
                 Dice(seed + (std::uint64_t{1} << 32U))};
  std::vector<Index> numbers;
  for (Index f = 0; f < out.mesh->face_count(); ++f) {
    if (!three_corners(out.mesh->faces()[f])) continue;
    numbers.push_back(f);
    out.faces.push_back(out.mesh->faces()[f]);
  }
  out.component = components_of(out.mesh->vertex_count(), out.faces);
  if (out.faces.empty()) return out;
  out.sources = random_sources(out, numbers, out.dice);
  std::vector<char> holds_source(out.component.size(), 0);
  for (const SurfacePoint& p : out.sources.points) {
    holds_source[out.component[p.is_vertex() ? p.vertex : out.mesh->faces()[p.face][0]]] = 1;
  }
  for (const Index c : out.component) {
    out.reached.push_back(static_cast<char>(c != kNoIndex && holds_source[c]));
  }
  return out;
}

std::vector<Index> components_of(Index vertices, const std::vector<Face>& faces) {
  std::vector<Index> parent(static_cast<std::size_t>(vertices));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<char> used(parent.size(), 0);
  for (const Face& face : faces) {
    for (const Index corner : face) {
      used[corner] = 1;
      const auto [low, high] = std::minmax({root(face[0]), root(corner)});
      parent[high] = low;
    }
  }
  std::vector<Index> out(parent.size(), kNoIndex);
  for (Index v = 0; v < vertices; ++v) {
    if (used[v]) out[v] = root(v);
  }
  return out;
}

int broken_mesh_count(int many, int few) {
  if (const char* const asked = std::getenv("GEOTHERM_BROKEN_MESHES")) {
    return static_cast<int>(std::clamp(std::strtol(asked, nullptr, 10), 0L, 1'000'000'000L));
  }
  return kSanitized ? few : many;
}

}  // namespace geotherm::test
