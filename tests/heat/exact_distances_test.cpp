// SPDX-License-Identifier: MIT
// Default options against exact polyhedral distances, held to the best of other programs.
#include "tests/support/exact_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geotherm/io.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Errors in per cent of the heat method elsewhere: libigl 2.4, the same on the intrinsic Delaunay
// triangulation, geometry-central (2024), the same on the intrinsic Delaunay triangulation; t = h^2
// each, measured against the same exact distances. Mean of |d - e| / e, largest |d - e| over the
// largest e.
constexpr double kRefused = 1e9;  // meshes with a border

struct PeerErrors {
  double mean, largest;
};
struct ExactCase {
  const char* mesh;
  std::vector<Index> sources;
  PeerErrors peers[4];
};

const ExactCase kCases[] = {
    {"3holes.off", {0}, {{2.47, 4.41}, {2.55, 4.46}, {2.45, 4.38}, {2.53, 4.41}}},
    {"armadillo.obj", {20000}, {{0.85, 1.72}, {0.79, 1.84}, {0.88, 1.51}, {0.84, 1.52}}},
    {"camelhead.off", {5000}, {{1.99, 8.06}, {1.16, 3.31}, {1.98, 8.02}, {kRefused, kRefused}}},
    {"cheburashka.obj", {3000}, {{1.97, 3.36}, {2.16, 2.88}, {1.95, 3.28}, {2.11, 2.87}}},
    {"fandisk.obj", {17}, {{0.90, 2.65}, {0.90, 2.67}, {0.89, 2.64}, {0.90, 2.67}}},
    {"homer.obj", {4000}, {{18.5, 49.8}, {2.19, 3.68}, {18.3, 49.5}, {2.19, 3.91}}},
    {"rocker-arm.obj", {1000}, {{2.34, 4.61}, {2.35, 4.70}, {2.31, 4.69}, {2.33, 4.72}}},
    {"rocker-arm.obj",
     {10, 2500, 5000, 7500},
     {{4.82, 10.1}, {2.28, 5.62}, {4.00, 8.00}, {2.37, 5.02}}},
    {"spot.obj", {0}, {{1.72, 4.50}, {1.70, 4.59}, {1.69, 4.58}, {1.69, 4.64}}},
    {"spot.obj", {100, 1500, 2800}, {{6.13, 8.07}, {6.24, 8.26}, {6.09, 8.27}, {6.17, 8.40}}},
    {"stanford-bunny.obj",
     {5000},
     {{0.90, 2.19}, {0.89, 2.20}, {0.91, 1.96}, {kRefused, kRefused}}},
};

// The largest error is one vertex's, and so may be this much above the best.
constexpr double kLargestAgainstBest = 1.1;

std::string stem_of(const ExactCase& c) {
  const std::string file = c.mesh;
  return file.substr(0, file.find('.'));
}

void PrintTo(const ExactCase& c, std::ostream* out) { *out << c.mesh; }

class ExactDistances : public testing::TestWithParam<ExactCase> {};

TEST_P(ExactDistances, AreMetAtLeastAsWellAsByTheBestHeatMethodElsewhere) {
  const auto folders = data_folders();
  if (!folders) {
    GTEST_SKIP() << "GEOTHERM_TEST_MESHES and GEOTHERM_TEST_EXACT name no folders with data";
  }
  std::string name = stem_of(GetParam()) + ".s";
  for (const Index s : GetParam().sources) {
    name += (name.back() == 's' ? "" : "_") + std::to_string(s);
  }
  const auto exact = read_npy(folders->exact + "/" + name + ".npy");
  auto file = read_mesh(folders->meshes + "/" + GetParam().mesh);
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(static_cast<Index>(exact.size()), file->mesh.vertex_count()) << name << ".npy";

  const auto result =
      solve(std::make_shared<const TriangleMesh>(std::move(file->mesh)), GetParam().sources);
  double mean = 0, most = 0;
  int count = 0;
  for (std::size_t v = 0; v < exact.size(); ++v) {
    ASSERT_EQ(std::isfinite(result.distances[v]), std::isfinite(exact[v])) << "vertex " << v;
    if (!std::isfinite(exact[v])) continue;
    const double error = std::abs(result.distances[v] - exact[v]);
    most = std::max(most, error);
    if (exact[v] <= 0) continue;
    mean += error / exact[v];
    ++count;
  }
  mean *= 100.0 / count;
  most *= 100.0 / largest(exact);
  PeerErrors best{kRefused, kRefused};
  for (const PeerErrors& peer : GetParam().peers) {
    best = {std::min(best.mean, peer.mean), std::min(best.largest, peer.largest)};
  }
  EXPECT_LE(mean, best.mean);
  EXPECT_LE(most, kLargestAgainstBest * best.largest);
  for (const Index s : GetParam().sources) EXPECT_EQ(result.distances[s], 0);
  EXPECT_EQ(*std::ranges::min_element(result.distances), 0);
}

INSTANTIATE_TEST_SUITE_P(Meshes, ExactDistances, testing::ValuesIn(kCases), [](const auto& each) {
  return test_name(stem_of(each.param) + "_from_" + std::to_string(each.param.sources.size()));
});

}  // namespace
}  // namespace geotherm::test
