// SPDX-License-Identifier: MIT
// A query on several threads, alone and in a block, on a mesh large enough that steps share their
// rows and faces out.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "solver/heat/surface.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Several ranges of faces, and more values than one thread takes at once.
constexpr Index kCells = kSanitized ? 260 : 300;
// Several ranges of faces.
constexpr Index kFewerCells = kSanitized ? 190 : kCells;

struct ThreadCase {
  const char* name;
  void (*set)(HeatOptions&);
  std::size_t sets;
  Index cells = kCells;
};

const ThreadCase kThreadCases[] = {
    {"one_set", [](HeatOptions&) {}, 1},
    {"four_sets", [](HeatOptions&) {}, 4, kFewerCells},
    {"refined", [](HeatOptions& o) { o.precision = Precision::kRefined; }, 1, kFewerCells},
    {"pin_vertex", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPinVertex; }, 1,
     kFewerCells},
    {"large_time", [](HeatOptions& o) { o.time_step.factor = 5000; }, 1, kFewerCells},
    {"blocks", [](HeatOptions&) {}, 33, 80},
};

void PrintTo(const ThreadCase& c, std::ostream* out) { *out << c.name; }

class QueryThreads : public testing::TestWithParam<ThreadCase> {
 protected:
  static HeatOptions options() {
    HeatOptions options = with_backend(direct_backends().front());
    options.threads = 1;
    GetParam().set(options);
    return options;
  }
  HeatMethod alone =
      method_of(finish(plane_grid(GetParam().cells, GetParam().cells, 1, 1)), options());

  std::vector<std::vector<double>> distances(int threads) const {
    HeatOptions options = alone.options();
    options.threads = threads;
    const auto method = alone.with(options);  // the same factors: libraries that make them differ
    if (!method) {
      ADD_FAILURE() << method.error().message;
      return {};
    }
    std::vector<SourceSet> sets;
    for (std::size_t k = 0; k < GetParam().sets; ++k) {
      const Index vertices = GetParam().cells * GetParam().cells;
      const auto first = static_cast<Index>(k * 991);
      sets.push_back(SourceSet::of_vertices({first % vertices, (3 * first + 7000) % vertices}));
    }
    const auto results = method->solve_each(sets);
    std::vector<std::vector<double>> out;
    if (!results) {
      ADD_FAILURE() << results.error().message;
      return out;
    }
    for (const DistanceResult& result : *results) out.push_back(result.distances);
    return out;
  }
};

TEST_P(QueryThreads, DoNotChangeABit) {
  const auto of_five = distances(5);
  if (kSanitized) return;  // a sanitizer looks at the threads alone
  EXPECT_EQ(distances(1), of_five);
  EXPECT_EQ(distances(2), of_five);
}

INSTANTIATE_TEST_SUITE_P(Cases, QueryThreads, testing::ValuesIn(kThreadCases),
                         [](const auto& each) { return each.param.name; });

std::ptrdiff_t threads_of_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

/// The most threads there are during set-up, a query and a block beside those that were there,
/// where sixteen are allowed.
std::ptrdiff_t threads_started_for(const MeshPtr& mesh) {
  const std::ptrdiff_t before = threads_of_process();
  std::ptrdiff_t most = before;
  const Progress count = [&](std::string_view, double) {
    most = std::max(most, threads_of_process());
    return true;
  };
  HeatOptions options = with_backend("native");
  options.threads = 16;
  const auto method = HeatMethod::build(mesh, options, count);
  EXPECT_TRUE(method);
  const std::vector<SourceSet> sets{SourceSet::of_vertices({0}), SourceSet::of_vertices({5})};
  EXPECT_TRUE(method->solve(sets[0], {}, count));
  EXPECT_TRUE(method->solve_each(sets, {}, count));
  most = std::max(most, threads_of_process());  // helpers of queries stay for a while
  return most - before;
}

TEST(ThreadsOfSmallWork, AreTheCallersAlone) {
  EXPECT_EQ(threads_started_for(finish(plane_grid(50, 60, 1, 1))), 0);  // 6,000 faces
  const Index rows = kSanitized ? 100 : 250;
  EXPECT_GT(threads_started_for(finish(plane_grid(rows, 400, 1, 1))), 1);  // up to 200,000
}

class FaceRanges : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const Surface> surface =
      *build_surface(finish(plane_grid(kFewerCells, kFewerCells, 1, 1)), **find_backend(GetParam()),
                     LaplacianKind::kAuto, 1);
  const OperatorMesh& mesh = *surface->operators;
};

TEST_P(FaceRanges, HoldEveryRowOnceAndFacesOfTheirRowsOnly) {
  ASSERT_GT(mesh.ranges.size(), 3U);
  Index row = 0, face = 0;
  for (const RowRange& range : mesh.ranges) {
    EXPECT_EQ(range.first_row, row);
    EXPECT_EQ(range.first_cell, face);
    for (; face < range.end_cell; ++face) {
      for (const Index corner : mesh.faces[static_cast<std::size_t>(face)]) {
        ASSERT_GE(corner, range.first_row);
        ASSERT_LT(corner, range.end_row);
      }
    }
    row = range.end_row;
  }
  EXPECT_EQ(row, mesh.size());
  EXPECT_EQ(face, mesh.crossing);
}

TEST_P(FaceRanges, LeaveFewFacesThatCross) {
  // What crosses is walked by one thread: more than this would be felt with many.
  EXPECT_LT(mesh.face_count() - mesh.crossing, mesh.face_count() / 8);
}

INSTANTIATE_TEST_SUITE_P(Backends, FaceRanges, testing::ValuesIn(direct_backends()),
                         backend_test_name);

}  // namespace
}  // namespace geotherm::test
