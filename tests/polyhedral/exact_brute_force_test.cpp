// SPDX-License-Identifier: MIT
#include "tests/polyhedral/brute_force.h"

#include <algorithm>
#include <random>
#include <string>

#include "tests/polyhedral/exact_fixture.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

constexpr unsigned kSeeds = 12;

/// Moves every vertex by up to `amount` in each direction.
Draft shaken(Draft draft, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-amount, amount);
  for (Vec3& p : draft.positions) p += Vec3(move(random), move(random), move(random));
  return draft;
}

/// Vertices in a box and faces between them at random: edges with any number of faces.
Draft heap_of_faces(Index vertices, int faces, unsigned seed) {
  std::mt19937 random(seed);
  Draft draft;
  std::uniform_real_distribution<double> at(0, 1);
  for (Index v = 0; v < vertices; ++v) draft.add(Vec3(at(random), at(random), at(random)));
  for (int f = 0; f < faces; ++f) {
    Face face{};
    for (Index& corner : face)
      corner = static_cast<Index>(random() % static_cast<unsigned>(vertices));
    std::ranges::sort(face);
    const bool repeats = face[0] == face[1] || face[1] == face[2];
    if (!repeats && std::ranges::count(draft.faces, face) == 0) draft.faces.push_back(face);
  }
  return draft;
}

struct Kind {
  const char* name;
  Draft (*draft)(unsigned seed);
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

const Kind kKinds[] = {
    {"hills", [](unsigned seed) { return shaken(jittered_plane(4, 0.2, seed), 0.12, seed); }},
    {"crumpled", [](unsigned seed) { return shaken(plane_grid(3, 3, 1, 1), 0.5, seed); }},
    {"icosahedron", [](unsigned seed) { return shaken(sphere(0), 0.4, seed); }},
    {"torus", [](unsigned seed) { return shaken(torus(5, 3, 0.4), 0.15, seed); }},
    {"moebius", [](unsigned seed) { return shaken(moebius(7, 1), 0.1, seed); }},
    {"heap", [](unsigned seed) { return heap_of_faces(8, 12, seed); }},
    {"sliver_heap",
     [](unsigned seed) {
       Draft draft = heap_of_faces(8, 9, seed);
       for (Vec3& p : draft.positions) p.z() *= 0.05;
       for (Vec3& p : draft.positions) p.y() *= 0.3;
       return draft;
     }},
};

class BruteForce : public testing::TestWithParam<std::tuple<Kind, unsigned>> {};

TEST_P(BruteForce, FindsNoOtherDistance) {
  const auto& [kind, seed] = GetParam();
  const MeshPtr mesh = finish(kind.draft(seed));
  for (const Index source : {mesh->faces()[0][0], mesh->faces().back()[2]}) {
    EXPECT_LE(
        relative_difference(exact_distances(mesh, {source}), brute_force_distances(*mesh, source)),
        kRoundOff)
        << "from " << source;
  }
}

INSTANTIATE_TEST_SUITE_P(SmallMeshes, BruteForce,
                         testing::Combine(testing::ValuesIn(kKinds),
                                          testing::Range(1U, kSeeds + 1)),
                         [](const auto& each) {
                           return std::string(std::get<0>(each.param).name) + "_" +
                                  std::to_string(std::get<1>(each.param));
                         });

}  // namespace
}  // namespace geotherm::test
