// SPDX-License-Identifier: MIT
// Directions from C: on a square, where everything is known.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "app/c/geotherm.h"

namespace {

class CDirections : public testing::Test {
 protected:
  void SetUp() override {
    shape.positions = {positions, GEOTHERM_FLOAT64, 5, 3, 0, 0};
    shape.cells = {faces, GEOTHERM_INT32, 4, 3, 0, 0};
    ASSERT_EQ(geotherm_model_build(&shape, nullptr, nullptr, &model), GEOTHERM_OK);
  }
  void TearDown() override {
    geotherm_free(model);
    geotherm_free(answer);
  }
  const double* array(const char* name, std::int64_t rows, std::int64_t columns) {
    geotherm_array found = {};
    EXPECT_EQ(geotherm_array_of(answer, name, &found), GEOTHERM_OK) << name;
    EXPECT_EQ(found.rows, rows);
    EXPECT_EQ(found.columns, columns);
    return static_cast<const double*>(found.data);
  }

  double positions[15] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 0};
  std::int32_t faces[12] = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  geotherm_shape shape = {};
  geotherm_model* model = nullptr;
  geotherm_answer* answer = nullptr;
  geotherm_source middle = {GEOTHERM_VERTEX, 4, {}, 0};
  geotherm_sources point = {&middle, 1, nullptr, 0, nullptr};
};

TEST_F(CDirections, LogMapIsWhereVerticesAre) {
  ASSERT_EQ(geotherm_log_map(model, &point, nullptr, INFINITY, nullptr, &answer), GEOTHERM_OK);
  const double* const distances = array("distances", 5, 1);
  const double* const directions = array("directions", 5, 1);
  const double* const frame = array("frame", 1, 9);
  for (int v = 0; v < 4; ++v) {
    for (int k = 0; k < 3; ++k) {
      const double offset =
          std::cos(directions[v]) * frame[k] + std::sin(directions[v]) * frame[3 + k];
      EXPECT_NEAR(1 - (k == 2) + distances[v] * offset, positions[3 * v + k], 1e-12);
    }
  }
}

TEST_F(CDirections, TraceEndsAtTheBorder) {
  ASSERT_EQ(geotherm_trace(model, &point, 0, 9, nullptr, &answer), GEOTHERM_OK);
  EXPECT_NEAR(*array("lengths", 1, 1), std::sqrt(2), 1e-12);
  const char* end = nullptr;
  ASSERT_EQ(geotherm_text_of(answer, "end", &end), GEOTHERM_OK);
  EXPECT_STREQ(end, "border");
}

TEST_F(CDirections, VectorsAndValuesReachEveryVertex) {
  std::int64_t at[] = {4};
  double vector[] = {3, 4}, value[] = {7};
  const geotherm_array vertices = {at, GEOTHERM_INT64, 1, 1, 0, 0};
  const geotherm_array vectors = {vector, GEOTHERM_FLOAT64, 1, 2, 0, 0};
  const geotherm_array values = {value, GEOTHERM_FLOAT64, 1, 1, 0, 0};
  ASSERT_EQ(geotherm_transport(model, nullptr, &vertices, &vectors, nullptr, &answer), GEOTHERM_OK);
  const double* const found = array("vectors", 5, 3);
  for (int i = 0; i < 15; ++i) EXPECT_NEAR(found[i], found[12 + i % 3], 1e-9);
  EXPECT_NEAR(std::hypot(found[0], found[1]), 5, 1e-9);
  array("frames", 5, 9);
  geotherm_free(answer);
  ASSERT_EQ(geotherm_extend(model, nullptr, &vertices, &values, nullptr, &answer), GEOTHERM_OK);
  for (int v = 0; v < 5; ++v) EXPECT_NEAR(array("values", 5, 1)[v], 7, 1e-9);
  EXPECT_EQ(geotherm_transport(model, nullptr, &vertices, &values, nullptr, &answer),
            GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_extend(model, nullptr, nullptr, &values, nullptr, &answer),
            GEOTHERM_BAD_INPUT);
}

TEST_F(CDirections, SignedDistanceHasTheSideOfALoop) {
  const geotherm_source corners[] = {{GEOTHERM_XYZ, 0, {0.5, 0.5, 0}, 0},
                                     {GEOTHERM_XYZ, 0, {1.5, 0.5, 0}, 0},
                                     {GEOTHERM_XYZ, 0, {1.5, 1.5, 0}, 0},
                                     {GEOTHERM_XYZ, 0, {0.5, 1.5, 0}, 0}};
  const std::int64_t starts[] = {0, 4};
  const geotherm_sources loop = {corners, 4, starts, 1, nullptr};
  ASSERT_EQ(geotherm_signed_distance(model, nullptr, &loop, 1, nullptr, nullptr, &answer),
            GEOTHERM_OK);
  const double* const distances = array("distances", 5, 1);
  EXPECT_NEAR(distances[4], -0.5, 1e-9);
  for (int v = 0; v < 4; ++v) EXPECT_NEAR(distances[v], std::sqrt(0.5), 1e-9);
  const char* rule = nullptr;
  ASSERT_EQ(geotherm_text_of(answer, "rule", &rule), GEOTHERM_OK);
  EXPECT_STREQ(rule, "sides");
}

/// The second call of a model finds all that it needs set up; only queries are left.
TEST_F(CDirections, SignedDistanceIsSetUpOnce) {
  const geotherm_source points[] = {{GEOTHERM_VERTEX, 0, {}, 0}, {GEOTHERM_VERTEX, 2, {}, 0}};
  const std::int64_t starts[] = {0, 2};
  const geotherm_sources line = {points, 2, starts, 1, nullptr};
  for (const char* rule : {"sides", "heat"}) {
    for (const bool first : {true, false}) {
      int stages = 0;
      const geotherm_watch watch = {[](void* data, const char* stage, double) {
                                      const std::string name = stage;
                                      *static_cast<int*>(data) +=
                                          name == "operators" || name == "analyze";
                                      return 0;
                                    },
                                    &stages, 0};
      ASSERT_EQ(geotherm_signed_distance(model, nullptr, &line, 0, rule, &watch, &answer),
                GEOTHERM_OK);
      geotherm_free(answer);
      EXPECT_EQ(stages > 0, first) << rule;
    }
  }
}

TEST_F(CDirections, MeansAndMediansOfTheCornersAreTheMiddle) {
  geotherm_source corners[4];
  for (int v = 0; v < 4; ++v) corners[v] = {GEOTHERM_VERTEX, v, {}, 0};
  const geotherm_sources points = {corners, 4, nullptr, 0, nullptr};
  for (const char* kind : {"mean", "median"}) {
    ASSERT_EQ(geotherm_centres(model, &points, nullptr, kind, nullptr, nullptr, &answer),
              GEOTHERM_OK);
    const double* const place = array("points", 1, 3);
    EXPECT_NEAR(std::hypot(place[0] - 1, place[1] - 1), 0, 1e-9);
    EXPECT_NEAR(array("energies", 1, 1)[0], kind[3] == 'n' ? 2 : std::sqrt(2), 1e-9);
    for (int v = 0; v < 4; ++v) EXPECT_NEAR(array("distances", 1, 4)[v], std::sqrt(2), 1e-9);
    geotherm_free(answer);
  }
  double weight[] = {3, 1, 0, 0};
  const geotherm_array weights = {weight, GEOTHERM_FLOAT64, 4, 1, 0, 0};
  ASSERT_EQ(geotherm_centres(model, &points, &weights, nullptr, "exact", nullptr, &answer),
            GEOTHERM_OK);
  EXPECT_NEAR(array("points", 1, 3)[0], 0.5, 1e-9);
  EXPECT_NEAR(array("points", 1, 3)[1], 0, 1e-9);
}

TEST_F(CDirections, RelaxingOnePointLeadsToTheMiddle) {
  geotherm_solver* solver = nullptr;
  ASSERT_EQ(geotherm_solver_new(model, nullptr, nullptr, &solver), GEOTHERM_OK);
  const geotherm_source corner = {GEOTHERM_VERTEX, 0, {}, 0};
  const geotherm_sources begin = {&corner, 1, nullptr, 0, nullptr};
  ASSERT_EQ(geotherm_relax(solver, &begin, 1, nullptr, &answer), GEOTHERM_OK);
  EXPECT_NEAR(array("points", 1, 3)[0], 1, 1e-9);
  EXPECT_NEAR(array("points", 1, 3)[1], 1, 1e-9);
  EXPECT_NEAR(array("energies", 2, 1)[0], 40.0 / 3, 1e-9);
  EXPECT_NEAR(array("energies", 2, 1)[1], 16.0 / 3, 1e-9);
  EXPECT_NEAR(array("moves", 1, 1)[0], std::sqrt(2), 1e-9);
  geotherm_free(answer);

  const geotherm_source ends[] = {{GEOTHERM_VERTEX, 2, {}, 0}, {GEOTHERM_XYZ, 0, {1, 0.5, 0}, 0}};
  const geotherm_sources to = {ends, 2, nullptr, 0, nullptr};
  ASSERT_EQ(geotherm_paths(solver, &point, &to, nullptr, &answer), GEOTHERM_OK);
  EXPECT_NEAR(array("lengths", 2, 1)[0], std::sqrt(2), 1e-9);
  EXPECT_NEAR(array("lengths", 2, 1)[1], 0.5, 1e-9);
  geotherm_free(solver);
}

TEST_F(CDirections, PlacesFarFromTheModelAreWarnedOf) {
  geotherm_solver* solver = nullptr;
  ASSERT_EQ(geotherm_solver_new(model, nullptr, nullptr, &solver), GEOTHERM_OK);
  const geotherm_source places[] = {{GEOTHERM_XYZ, 0, {1, 0.5, 1e6}, 0},
                                    {GEOTHERM_VERTEX, 2, {}, 0}};
  const std::int64_t starts[] = {0, 2};
  const geotherm_sources far = {places, 1, nullptr, 0, nullptr};
  const geotherm_sources both = {places, 2, nullptr, 0, nullptr};
  const geotherm_sources line = {places, 2, starts, 1, nullptr};
  for (int call = 0; call < 7; ++call) {
    const geotherm_status status =
        call == 0   ? geotherm_path(solver, &both, nullptr, 0, nullptr, &answer)
        : call == 1 ? geotherm_paths(solver, &point, &both, nullptr, &answer)
        : call == 2 ? geotherm_relax(solver, &both, 1, nullptr, &answer)
        : call == 3 ? geotherm_log_map(model, &far, nullptr, INFINITY, nullptr, &answer)
        : call == 4 ? geotherm_trace(model, &far, 0, 0.1, nullptr, &answer)
        : call == 5 ? geotherm_centres(model, &both, nullptr, nullptr, nullptr, nullptr, &answer)
                    : geotherm_signed_distance(model, nullptr, &line, 0, "heat", nullptr, &answer);
    ASSERT_EQ(status, GEOTHERM_OK) << call;
    const char* text = nullptr;
    ASSERT_EQ(geotherm_text_of(answer, "warnings", &text), GEOTHERM_OK) << call;
    EXPECT_NE(std::string(text).find("1e+06 away"), std::string::npos) << call << ": " << text;
    geotherm_free(answer);
  }
  geotherm_free(solver);
}

TEST_F(CDirections, WhatIsNullIsAnError) {
  EXPECT_EQ(geotherm_log_map(nullptr, &point, nullptr, 1, nullptr, &answer), GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_log_map(model, &point, nullptr, 1, nullptr, nullptr), GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_log_map(model, &point, nullptr, 0, nullptr, &answer), GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_log_map(model, &point, "heat", 1, nullptr, &answer), GEOTHERM_NOT_AVAILABLE);
  EXPECT_EQ(geotherm_centres(model, nullptr, nullptr, nullptr, nullptr, nullptr, &answer),
            GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_centres(model, &point, nullptr, "middle", nullptr, nullptr, &answer),
            GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_relax(nullptr, &point, 1, nullptr, &answer), GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_paths(nullptr, &point, &point, nullptr, &answer), GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_trace(model, nullptr, 0, 1, nullptr, &answer), GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_transport(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr),
            GEOTHERM_BAD_INPUT);
  EXPECT_EQ(geotherm_signed_distance(model, nullptr, &point, 0, "none", nullptr, &answer),
            GEOTHERM_BAD_INPUT);
}

}  // namespace
