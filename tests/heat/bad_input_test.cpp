// SPDX-License-Identifier: MIT
// What cannot be answered is refused in one sentence that holds the number at fault.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/compare.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

struct BadSource {
  const char* name;
  SourceSet sources;
  const char* says;  ///< part of the message
};

SourceSet at(const SurfacePoint& point) { return {{SurfacePoint::at_vertex(0), point}, {}}; }

SourceSet with_offset(double offset) {
  SourceSet set = SourceSet::of_vertices({3});
  set.offsets = {offset};
  return set;
}

// The mesh: 162 vertices of a sphere, vertex 162 in no face, face 320 with a repeated corner.
const BadSource kBadSources[] = {
    {"none", {}, "no source"},
    {"vertex_beyond_the_last", SourceSet::of_vertices({0, 163}), "163"},
    {"negative_vertex", SourceSet::of_vertices({-5}), "-5"},
    {"vertex_in_no_face", SourceSet::of_vertices({162}), "162"},
    {"face_beyond_the_last", at(SurfacePoint::in_face(321, {0.2, 0.3, 0.5})), "321"},
    {"negative_face", at(SurfacePoint::in_face(-3, {0.2, 0.3, 0.5})), "-3"},
    {"weights_that_sum_to_two", at(SurfacePoint::in_face(7, {1, 0.5, 0.5})), "2"},
    {"negative_weight", at(SurfacePoint::in_face(7, {-0.5, 1, 0.5})), "7"},
    {"weight_that_is_no_number", at(SurfacePoint::in_face(7, {kNan, 0.5, 0.5})), "7"},
    {"face_without_an_inside", at(SurfacePoint::in_face(320, {0.2, 0.3, 0.5})), "320"},
    {"edge_with_a_vertex_beyond_the_last", {{}, {{0, 500}}}, "500"},
    {"offset", with_offset(0.25), "wavefront"},
    {"negative_offset", with_offset(-0.25), "-0.25"},
};

void PrintTo(const BadSource& bad, std::ostream* out) { *out << bad.name; }

class BadSources : public testing::TestWithParam<BadSource> {
 protected:
  static MeshPtr mesh() {
    Draft draft = sphere(2);
    draft.add({4, 4, 4});
    draft.faces.push_back({1, 2, 1});
    return finish(draft);
  }
};

TEST_P(BadSources, AreRefusedByTheirNumber) {
  const HeatMethod method = method_of(mesh());
  const auto result = method.solve(GetParam().sources);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(result.error()).find(GetParam().says), std::string::npos)
      << result.error().message;
}

TEST_P(BadSources, DoNotSpoilTheMethod) {
  const HeatMethod method = method_of(mesh());
  const SourceSet good = SourceSet::of_vertices({5});
  const auto before = solve(method, good).distances;
  const SourceSet sets[] = {good, GetParam().sources};
  EXPECT_FALSE(method.solve_each(sets));
  EXPECT_EQ(solve(method, good).distances, before);
}

INSTANTIATE_TEST_SUITE_P(Sources, BadSources, testing::ValuesIn(kBadSources),
                         [](const auto& each) { return each.param.name; });

struct BadOption {
  const char* name;
  void (*set)(HeatOptions&);
  ErrorCode code;
  const char* says;
};

const BadOption kBadOptions[] = {
    {"factor_of_zero", [](HeatOptions& o) { o.time_step.factor = 0; }, ErrorCode::kBadInput,
     "factor"},
    {"negative_factor", [](HeatOptions& o) { o.time_step.factor = -1; }, ErrorCode::kBadInput,
     "-1"},
    {"factor_that_is_no_number", [](HeatOptions& o) { o.time_step.factor = kNan; },
     ErrorCode::kBadInput, "factor"},
    {"endless_time",
     [](HeatOptions& o) {
       o.time_step = {TimeRule::kAbsolute, 1, kUnreached};
     },
     ErrorCode::kBadInput, "time"},
    {"absolute_time_of_zero", [](HeatOptions& o) { o.time_step.rule = TimeRule::kAbsolute; },
     ErrorCode::kBadInput, "time"},
    {"penalty_of_zero",
     [](HeatOptions& o) {
       o.constraint = {ConstraintMode::kPenalty, kNoIndex, 0};
     },
     ErrorCode::kBadInput, "penalty"},
    {"negative_threads", [](HeatOptions& o) { o.threads = -4; }, ErrorCode::kBadInput, "-4"},
    {"unknown_backend", [](HeatOptions& o) { o.backend = "gauss"; }, ErrorCode::kNotAvailable,
     "gauss"},
};

void PrintTo(const BadOption& bad, std::ostream* out) { *out << bad.name; }

class BadOptions : public testing::TestWithParam<BadOption> {
 protected:
  static void expect_refused(const Result<HeatMethod>& method) {
    ASSERT_FALSE(method);
    EXPECT_EQ(method.error().code, GetParam().code);
    EXPECT_NE(sentence(method.error()).find(GetParam().says), std::string::npos)
        << method.error().message;
  }
};

TEST_P(BadOptions, AreRefusedByBuildAndByWith) {
  const MeshPtr mesh = finish(sphere(2));
  HeatOptions options;
  GetParam().set(options);
  expect_refused(HeatMethod::build(mesh, options));
  expect_refused(method_of(mesh).with(options));
}

INSTANTIATE_TEST_SUITE_P(Options, BadOptions, testing::ValuesIn(kBadOptions),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace geotherm::test
