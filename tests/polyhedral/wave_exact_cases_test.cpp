// SPDX-License-Identifier: MIT
// Waves and fast marching against given exact polyhedral distances.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "geotherm/io.h"
#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/exact_distances.h"

namespace geotherm::test {
namespace {

struct ExactCase {
  const char* mesh;
  const char* suffix;
  std::vector<Index> sources;
};
const ExactCase kWaveCases[] = {
    {"3holes", ".off", {0}},
    {"armadillo", ".obj", {20000}},
    {"camelhead", ".off", {5000}},
    {"cheburashka", ".obj", {3000}},
    {"fandisk", ".obj", {17}},
    {"homer", ".obj", {4000}},
    {"rocker-arm", ".obj", {1000}},
    {"rocker-arm", ".obj", {10, 2500, 5000, 7500}},
    {"spot", ".obj", {0}},
    {"spot", ".obj", {100, 1500, 2800}},
    {"stanford-bunny", ".obj", {5000}},
};
void PrintTo(const ExactCase& c, std::ostream* out) { *out << c.mesh; }

// Per cent. Waves: what the project promises; the measured worst are 0.055 / 0.33 and 0.014 /
// 0.078. Fast marching is of first order: 2.5 / 3.2.
const std::map<MethodKind, ErrorPercent> kCaseBounds = {
    {MethodKind::kWavefront, {0.06, 0.4}},
    {MethodKind::kWavefrontFine, {0.015, 0.1}},
    {MethodKind::kFastMarching, {3, 4}},
};
constexpr double kWavefrontOnAverage = 0.03;

ErrorPercent errors_of(const DataFolders& folders, const ExactCase& c, MethodKind kind) {
  std::string name = std::string(c.mesh) + ".s";
  for (const Index s : c.sources) {
    name += (name.back() == 's' ? "" : "_") + std::to_string(s);
  }
  const auto exact = read_npy(folders.exact + "/" + name + ".npy");
  auto file = read_mesh(folders.meshes + "/" + c.mesh + c.suffix);
  EXPECT_TRUE(file) << c.mesh;
  if (!file) return {kUnreached, kUnreached};
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(file->mesh));
  const auto d = distances(mesh, kind, SourceSet::of_vertices(c.sources));
  for (const Index s : c.sources) EXPECT_EQ(d[s], 0);
  return errors(d, exact);
}

constexpr const char* kNoData =
    "GEOTHERM_TEST_MESHES and GEOTHERM_TEST_EXACT name no folders with data";

class ExactCases : public testing::TestWithParam<std::tuple<ExactCase, MethodKind>> {};

TEST_P(ExactCases, AreMetWithinTheMethodsBounds) {
  const auto folders = data_folders();
  if (!folders) GTEST_SKIP() << kNoData;
  const auto [mean, largest] =
      errors_of(*folders, std::get<0>(GetParam()), std::get<1>(GetParam()));
  const ErrorPercent bound = kCaseBounds.at(std::get<1>(GetParam()));
  EXPECT_LE(mean, bound.mean);
  EXPECT_LE(largest, bound.largest);
}

INSTANTIATE_TEST_SUITE_P(Meshes, ExactCases,
                         testing::Combine(testing::ValuesIn(kWaveCases),
                                          testing::ValuesIn(kWaveKinds)),
                         [](const auto& each) {
                           const ExactCase& c = std::get<0>(each.param);
                           std::string name = c.mesh +
                                              ("_from_" + std::to_string(c.sources.size())) + "_" +
                                              kind_name(std::get<1>(each.param));
                           for (char& x : name) x = x == '-' ? '_' : x;
                           return name;
                         });

TEST(ExactCasesTogether, AreMetOnAverageByTheWavefrontSlow) {
  const auto folders = data_folders();
  if (!folders) GTEST_SKIP() << kNoData;
  double sum = 0;
  for (const ExactCase& c : kWaveCases) sum += errors_of(*folders, c, MethodKind::kWavefront).mean;
  EXPECT_LE(sum / static_cast<double>(std::size(kWaveCases)), kWavefrontOnAverage);
}

}  // namespace
}  // namespace geotherm::test
