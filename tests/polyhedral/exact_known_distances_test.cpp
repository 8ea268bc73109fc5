// SPDX-License-Identifier: MIT
// Against distances that other programs computed by windows (libigl, and checked by a second one).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "geotherm/io.h"
#include "tests/polyhedral/exact_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/exact_distances.h"

namespace geotherm::test {
namespace {

// The references' own round-off is up to 1e-8 of the largest distance.
constexpr double kReference = 1e-7;

struct KnownCase {
  const char* name;
  const char* file;
  std::vector<Index> sources;
};
void PrintTo(const KnownCase& c, std::ostream* out) { *out << c.name; }

const KnownCase kCases[] = {
    {"3holes.s0", "3holes.off", {0}},     {"cheburashka.s3000", "cheburashka.obj", {3000}},
    {"fandisk.s17", "fandisk.obj", {17}}, {"homer.s4000", "homer.obj", {4000}},
    {"spot.s0", "spot.obj", {0}},         {"spot.s100_1500_2800", "spot.obj", {100, 1500, 2800}},
};
const KnownCase kLargeCases[] = {
    {"armadillo.s20000", "armadillo.obj", {20000}},
    {"camelhead.s5000", "camelhead.off", {5000}},
    {"rocker-arm.s1000", "rocker-arm.obj", {1000}},
    {"rocker-arm.s10_2500_5000_7500", "rocker-arm.obj", {10, 2500, 5000, 7500}},
    {"stanford-bunny.s5000", "stanford-bunny.obj", {5000}},
};

class KnownDistances : public testing::TestWithParam<KnownCase> {};

TEST_P(KnownDistances, AreFound) {
  const auto folders = data_folders();
  if (!folders) {
    GTEST_SKIP() << "GEOTHERM_TEST_MESHES and GEOTHERM_TEST_EXACT name no folders with data";
  }
  const auto known = read_npy(folders->exact + "/" + GetParam().name + ".npy");
  auto file = read_mesh(folders->meshes + "/" + GetParam().file);
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(static_cast<Index>(known.size()), file->mesh.vertex_count()) << GetParam().name;
  const auto found = exact_distances(std::make_shared<const TriangleMesh>(std::move(file->mesh)),
                                     GetParam().sources);
  EXPECT_LE(relative_difference(found, known), kReference);
}

std::string case_name(const testing::TestParamInfo<KnownCase>& info) {
  std::string name = info.param.name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Meshes, KnownDistances, testing::ValuesIn(kCases), case_name);
INSTANTIATE_TEST_SUITE_P(SlowMeshes, KnownDistances, testing::ValuesIn(kLargeCases), case_name);

}  // namespace
}  // namespace geotherm::test
