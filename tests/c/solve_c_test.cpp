// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "app/c/geotherm.h"

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class T, geotherm_type kType>
geotherm_array array_of(std::vector<T>& values, std::int64_t columns = 1) {
  return {values.data(), kType, static_cast<std::int64_t>(values.size()) / columns, columns, 0, 0};
}

/// The bundled rabbit and the heat method on it.
class CSolve : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(geotherm_model_read("bunny", nullptr, nullptr, &model), GEOTHERM_OK);
    ASSERT_EQ(geotherm_solver_new(model, nullptr, nullptr, &solver), GEOTHERM_OK);
    geotherm_array positions = {};
    ASSERT_EQ(geotherm_array_of(model, "positions", &positions), GEOTHERM_OK);
    vertices = positions.rows;
  }
  void TearDown() override {
    geotherm_free(model);
    geotherm_free(solver);
  }

  std::vector<double> distance(std::int64_t vertex) {
    std::vector<double> d(static_cast<std::size_t>(vertices));
    const geotherm_source at = {GEOTHERM_VERTEX, vertex, {}, 0};
    const geotherm_sources sources = {&at, 1, nullptr, 0, nullptr};
    const geotherm_array out = array_of<double, GEOTHERM_FLOAT64>(d);
    EXPECT_EQ(geotherm_distance(solver, &sources, &out, nullptr), GEOTHERM_OK);
    return d;
  }

  geotherm_model* model = nullptr;
  geotherm_solver* solver = nullptr;
  std::int64_t vertices = 0;
};

TEST_F(CSolve, ArraysOfEveryTypeAndStrideAreOneMesh) {
  std::vector<float> positions = {0, 0, 0, 9, 1, 0, 0, 9, 1, 1, 0, 9, 0, 1, 0, 9};  // and a column
  std::vector<std::int64_t> faces = {3, 2, 0, 2, 1, 0};  // read backwards
  geotherm_shape shape = {};
  shape.positions = {positions.data(), GEOTHERM_FLOAT32, 4, 3, 16, 4};
  shape.cells = {&faces[5], GEOTHERM_INT64, 2, 3, -24, -8};
  geotherm_model* square = nullptr;
  ASSERT_EQ(geotherm_model_build(&shape, nullptr, nullptr, &square), GEOTHERM_OK);
  geotherm_array seen = {};
  ASSERT_EQ(geotherm_array_of(square, "faces", &seen), GEOTHERM_OK);
  const auto* const corners = static_cast<const std::int32_t*>(seen.data);
  EXPECT_EQ(std::vector(corners, corners + 6), (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3}));
  ASSERT_EQ(geotherm_array_of(square, "positions", &seen), GEOTHERM_OK);
  const auto* const places = static_cast<const double*>(seen.data);
  EXPECT_EQ(std::vector(places + 3, places + 6), (std::vector<double>{1, 0, 0}));
  geotherm_free(square);
}

TEST_F(CSolve, RowsAreThoseOfEachSourceInMemoryAndInAFile) {
  const std::vector<geotherm_source> points = {{GEOTHERM_VERTEX, 17, {}, 0},
                                               {GEOTHERM_VERTEX, 99, {}, 0}};
  const geotherm_sources sources = {points.data(), 2, nullptr, 0, "3,5"};
  const std::string path = testing::TempDir() + "c_rows.npy";
  geotherm_rows rows = {{nullptr, GEOTHERM_FLOAT32, 0, 0, 0, 0}, nullptr, nullptr, 0, kInfinity};
  ASSERT_EQ(geotherm_distances(solver, &sources, &rows, nullptr), GEOTHERM_OK);
  EXPECT_EQ(rows.array.rows, 4);
  EXPECT_EQ(rows.array.columns, vertices);
  std::vector<float> values(static_cast<std::size_t>(4 * vertices));
  rows.array.data = values.data();
  ASSERT_EQ(geotherm_distances(solver, &sources, &rows, nullptr), GEOTHERM_OK);
  const std::vector<double> alone = distance(99);
  for (std::int64_t v = 0; v < vertices; ++v) {
    ASSERT_NEAR(values[static_cast<std::size_t>(vertices + v)], alone[static_cast<std::size_t>(v)],
                1e-6);
  }
  rows.path = path.c_str();
  ASSERT_EQ(geotherm_distances(solver, &sources, &rows, nullptr), GEOTHERM_OK);
  EXPECT_EQ(std::filesystem::file_size(path), 128 + 4 * values.size());
  std::filesystem::remove(path);
}

TEST_F(CSolve, PointsInNoneOfNoSetsAreRefused) {
  const geotherm_source point = {GEOTHERM_VERTEX, 17, {}, 0};
  const std::int64_t starts[] = {0};
  const geotherm_sources sources = {&point, 1, starts, 0, "3"};
  geotherm_rows rows = {{nullptr, GEOTHERM_FLOAT64, 0, 0, 0, 0}, nullptr, nullptr, 0, kInfinity};
  EXPECT_EQ(geotherm_distances(solver, &sources, &rows, nullptr), GEOTHERM_BAD_INPUT);
  const char* message = nullptr;
  geotherm_last_error(&message, nullptr);
  EXPECT_NE(std::string(message).find("sources.starts: none of 0 sets has the 1 point"),
            std::string::npos)
      << message;
}

TEST_F(CSolve, TargetsAndTheLargestDistanceCutRows) {
  const geotherm_source at = {GEOTHERM_VERTEX, 17, {}, 0};
  const geotherm_sources sources = {&at, 1, nullptr, 0, nullptr};
  const std::vector<double> all = distance(17);
  const std::vector<std::int64_t> targets = {17, 500, 900};
  std::vector<double> values(3);
  const double most = (all[500] + all[900]) / 2;
  geotherm_rows rows = {
      {values.data(), GEOTHERM_FLOAT64, 1, 3, 0, 0}, nullptr, targets.data(), 3, most};
  ASSERT_EQ(geotherm_distances(solver, &sources, &rows, nullptr), GEOTHERM_OK);
  EXPECT_EQ(values[0], 0);
  EXPECT_EQ(std::min(values[1], values[2]), std::min(all[500], all[900]));
  EXPECT_EQ(std::max(values[1], values[2]), kInfinity);
}

TEST_F(CSolve, AnAnswerHoldsArraysAndTexts) {
  const geotherm_sources sources = {nullptr, 0, nullptr, 0, "17\n99"};
  geotherm_answer* answer = nullptr;
  ASSERT_EQ(geotherm_solve(solver, &sources, "labels fields", nullptr, &answer), GEOTHERM_OK);
  for (const char* name : {"distances", "nearest_source", "heat", "log_heat", "error"}) {
    geotherm_array array = {};
    EXPECT_EQ(geotherm_array_of(answer, name, &array), GEOTHERM_OK) << name;
    EXPECT_EQ(array.rows, vertices) << name;
  }
  const char* text = nullptr;
  ASSERT_EQ(geotherm_text_of(answer, "json", &text), GEOTHERM_OK);
  EXPECT_NE(std::string(text).find("\"mean_relative\": 0.0"), std::string::npos);
  geotherm_free(answer);
}

TEST_F(CSolve, WhatIsMovedTwiceAsFarIsTwiceAsFarAway) {
  geotherm_array positions = {};
  ASSERT_EQ(geotherm_array_of(model, "positions", &positions), GEOTHERM_OK);
  const auto* const from = static_cast<const double*>(positions.data);
  std::vector<double> twice(from, from + 3 * vertices);
  for (double& x : twice) x *= 2;
  const geotherm_array given = array_of<double, GEOTHERM_FLOAT64>(twice, 3);
  geotherm_solver* moved = nullptr;
  ASSERT_EQ(geotherm_solver_move(solver, &given, nullptr, &moved, nullptr), GEOTHERM_OK);
  const std::vector<double> before = distance(17);
  std::swap(solver, moved);
  const std::vector<double> after = distance(17);
  geotherm_free(moved);
  for (std::size_t v = 0; v < before.size(); ++v) ASSERT_NEAR(after[v], 2 * before[v], 1e-6);
}

TEST_F(CSolve, ProgressCancelsAndLeavesTheSolverAsItWas) {
  const geotherm_watch stop = {[](void* data, const char* stage, double) {
                                 EXPECT_NE(std::string(stage), "");
                                 ++*static_cast<std::atomic<int>*>(data);
                                 return 1;
                               },
                               nullptr, 0};
  std::atomic<int> calls{0};
  geotherm_watch watch = stop;
  watch.data = &calls;
  geotherm_solver* other = nullptr;
  EXPECT_EQ(geotherm_solver_new(model, nullptr, &watch, &other), GEOTHERM_CANCELLED);
  EXPECT_EQ(other, nullptr);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(distance(17)[17], 0);
}

TEST_F(CSolve, ItsOwnProgressIsRefusedWhatWouldWaitForItself) {
  struct Own {
    const geotherm_solver* solver;
    std::vector<double> positions;
    std::vector<geotherm_status> found;
    std::string said;
  } own = {solver, std::vector<double>(static_cast<std::size_t>(3 * vertices)), {}, {}};
  const auto ask = [](void* data, const char*, double) {
    Own& all = *static_cast<Own*>(data);
    if (!all.found.empty()) return 0;  // once is enough
    const std::vector<geotherm_source> ends = {{GEOTHERM_VERTEX, 17, {}, 0},
                                               {GEOTHERM_VERTEX, 900, {}, 0}};
    const geotherm_sources one = {ends.data(), 1, nullptr, 0, nullptr};
    const geotherm_sources both = {ends.data(), 2, nullptr, 0, nullptr};
    const geotherm_array moved = array_of<double, GEOTHERM_FLOAT64>(all.positions, 3);
    geotherm_answer* answer = nullptr;
    geotherm_solver* next = nullptr;
    all.found = {geotherm_solve(all.solver, &one, nullptr, nullptr, &answer),
                 geotherm_path(all.solver, &both, nullptr, 0, nullptr, &answer),
                 geotherm_paths(all.solver, &one, &both, nullptr, &answer),
                 geotherm_relax(all.solver, &both, 1, nullptr, &answer),
                 geotherm_solver_move(all.solver, &moved, nullptr, &next, nullptr)};
    const char* message = nullptr;
    geotherm_last_error(&message, nullptr);
    all.said = message;
    return 0;
  };
  const geotherm_watch watch = {ask, &own, 0};
  const geotherm_sources sources = {nullptr, 0, nullptr, 0, "17"};
  geotherm_answer* answer = nullptr;
  ASSERT_EQ(geotherm_solve(solver, &sources, nullptr, &watch, &answer), GEOTHERM_OK);
  EXPECT_EQ(own.found, std::vector<geotherm_status>(5, GEOTHERM_BAD_INPUT));
  EXPECT_EQ(own.said, "the solver is at work for the call whose progress asks it");
  geotherm_free(answer);
  ASSERT_EQ(geotherm_solve(solver, &sources, nullptr, nullptr, &answer), GEOTHERM_OK);
  geotherm_free(answer);
}

std::atomic<int> interrupts{0};

TEST_F(CSolve, AnInterruptCancelsAndReachesTheProgramsOwnHandler) {
  struct sigaction own = {}, earlier = {};
  own.sa_handler = [](int) { ++interrupts; };
  sigaction(SIGINT, &own, &earlier);
  const geotherm_watch watch = {[](void*, const char*, double) {
                                  if (interrupts == 0) std::raise(SIGINT);
                                  return 0;
                                },
                                nullptr, 1};
  geotherm_solver* other = nullptr;
  EXPECT_EQ(geotherm_solver_new(model, nullptr, &watch, &other), GEOTHERM_CANCELLED);
  EXPECT_EQ(interrupts, 1);
  struct sigaction now = {};
  sigaction(SIGINT, &earlier, &now);
  EXPECT_EQ(now.sa_handler, own.sa_handler) << "the program's handler is not there again";
}

TEST_F(CSolve, PathsIsolinesAndSamplesAreArrays) {
  const std::vector<geotherm_source> ends = {{GEOTHERM_VERTEX, 17, {}, 0},
                                             {GEOTHERM_VERTEX, 900, {}, 0}};
  const geotherm_sources through = {ends.data(), 2, nullptr, 0, nullptr};
  geotherm_answer *path = nullptr, *lines = nullptr, *samples = nullptr;
  ASSERT_EQ(geotherm_path(solver, &through, nullptr, 0, nullptr, &path), GEOTHERM_OK);
  std::vector<double> d = distance(17);
  geotherm_array length = {}, starts = {};
  ASSERT_EQ(geotherm_array_of(path, "lengths", &length), GEOTHERM_OK);
  EXPECT_NEAR(*static_cast<const double*>(length.data), d[900], 0.05 * d[900]);

  std::vector<double> levels = {0.2, 0.4};
  const geotherm_array values = array_of<double, GEOTHERM_FLOAT64>(d);
  const geotherm_array at = array_of<double, GEOTHERM_FLOAT64>(levels);
  ASSERT_EQ(geotherm_isolines(model, &values, &at, nullptr, &lines), GEOTHERM_OK);
  ASSERT_EQ(geotherm_array_of(lines, "starts", &starts), GEOTHERM_OK);
  EXPECT_GE(starts.rows, 3);

  ASSERT_EQ(geotherm_samples(solver, 5, 17, nullptr, &samples), GEOTHERM_OK);
  geotherm_array chosen = {};
  ASSERT_EQ(geotherm_array_of(samples, "vertices", &chosen), GEOTHERM_OK);
  EXPECT_EQ(chosen.rows, 5);
  EXPECT_EQ(*static_cast<const std::int32_t*>(chosen.data), 17);
  for (void* handle :
       {static_cast<void*>(path), static_cast<void*>(lines), static_cast<void*>(samples)}) {
    EXPECT_EQ(geotherm_free(handle), GEOTHERM_OK);
  }
}

TEST_F(CSolve, ThreadsAskOneSolverAtOnce) {
  const std::vector<double> expected = distance(17);
  std::vector<std::jthread> threads;
  std::atomic<int> same{0};
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] { same += distance(17) == expected ? 1 : 0; });
  }
  threads.clear();
  EXPECT_EQ(same, 4);
}

}  // namespace
