// SPDX-License-Identifier: MIT
// Wrong handles, pointers and sizes are errors, and never more.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "app/c/geotherm.h"

namespace {

std::string last_message() {
  const char* message = nullptr;
  geotherm_last_error(&message, nullptr);
  return message;
}

/// A square of two triangles, by the fast exact method.
struct Square {
  std::array<double, 12> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::array<std::int32_t, 6> faces = {0, 1, 2, 0, 2, 3};
  geotherm_model* model = nullptr;
  geotherm_options* options = nullptr;
  geotherm_solver* solver = nullptr;

  Square() {
    geotherm_shape shape = {};
    shape.positions = {positions.data(), GEOTHERM_FLOAT64, 4, 3, 0, 0};
    shape.cells = {faces.data(), GEOTHERM_INT32, 2, 3, 0, 0};
    EXPECT_EQ(geotherm_model_build(&shape, nullptr, nullptr, &model), GEOTHERM_OK);
    EXPECT_EQ(geotherm_options_new(&options), GEOTHERM_OK);
    EXPECT_EQ(geotherm_options_set(options, "method", "exact"), GEOTHERM_OK);
    EXPECT_EQ(geotherm_solver_new(model, options, nullptr, &solver), GEOTHERM_OK);
  }
  ~Square() {
    geotherm_free(model);
    geotherm_free(options);
    geotherm_free(solver);
  }
};

TEST(CFuzz, AHandleThatWasFreedIsAnError) {
  Square square;
  geotherm_solver* const solver = square.solver;
  EXPECT_EQ(geotherm_free(solver), GEOTHERM_OK);
  std::array<double, 4> d{};
  const geotherm_array out = {d.data(), GEOTHERM_FLOAT64, 4, 1, 0, 0};
  const geotherm_source at = {GEOTHERM_VERTEX, 1, {}, 0};
  const geotherm_sources sources = {&at, 1, nullptr, 0, nullptr};
  EXPECT_EQ(geotherm_distance(solver, &sources, &out, nullptr), GEOTHERM_BAD_INPUT);
  EXPECT_EQ(last_message(), "solver is no handle, or was freed");
  EXPECT_EQ(geotherm_free(solver), GEOTHERM_BAD_INPUT);
  const char* text = nullptr;
  EXPECT_EQ(geotherm_text_of(solver, "json", &text), GEOTHERM_BAD_INPUT);
}

TEST(CFuzz, AModelOutlivesItsHandleInItsSolver) {
  Square square;
  EXPECT_EQ(geotherm_free(square.model), GEOTHERM_OK);
  std::array<double, 4> d{};
  const geotherm_array out = {d.data(), GEOTHERM_FLOAT64, 4, 1, 0, 0};
  const geotherm_source at = {GEOTHERM_VERTEX, 1, {}, 0};
  const geotherm_sources sources = {&at, 1, nullptr, 0, nullptr};
  EXPECT_EQ(geotherm_distance(square.solver, &sources, &out, nullptr), GEOTHERM_OK);
  EXPECT_EQ(d[0], 1);
}

TEST(CFuzz, NumbersThatAreNoNumbersOfTheModelAreErrors) {
  Square square;
  std::array<double, 4> d{};
  geotherm_array out = {d.data(), GEOTHERM_FLOAT64, 4, 1, 0, 0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<geotherm_source> wrong = {
      {GEOTHERM_VERTEX, 4, {}, 0},
      {GEOTHERM_VERTEX, -1, {}, 0},
      {GEOTHERM_VERTEX, INT64_MAX, {}, 0},
      {GEOTHERM_VERTEX, INT64_MIN, {}, 0},
      {GEOTHERM_VERTEX, 0, {}, -1},
      {GEOTHERM_VERTEX, 0, {}, nan},
      {GEOTHERM_FACE, 2, {1, 0, 0}, 0},
      {GEOTHERM_FACE, 0, {1, 1, 0}, 0},
      {GEOTHERM_FACE, 0, {nan, 0, 0}, 0},
      {GEOTHERM_XYZ, 0, {nan, 0, 0}, 0},
      {7, 0, {}, 0},
  };
  for (const geotherm_source& at : wrong) {
    const geotherm_sources sources = {&at, 1, nullptr, 0, nullptr};
    EXPECT_EQ(geotherm_distance(square.solver, &sources, &out, nullptr), GEOTHERM_BAD_INPUT)
        << at.kind << ' ' << at.id;
    EXPECT_NE(last_message().find("source 0"), std::string::npos) << last_message();
  }
  const geotherm_sources typed = {nullptr, 0, nullptr, 0, "0\n1,99"};
  EXPECT_EQ(geotherm_distance(square.solver, &typed, &out, nullptr), GEOTHERM_BAD_INPUT);
  EXPECT_NE(last_message().find("source 1,99: "), std::string::npos) << last_message();
  const geotherm_source at = {GEOTHERM_VERTEX, 0, {}, 0};
  const geotherm_sources sources = {&at, 1, nullptr, 0, nullptr};
  for (const geotherm_array& small : {geotherm_array{d.data(), GEOTHERM_FLOAT64, 3, 1, 0, 0},
                                      geotherm_array{d.data(), GEOTHERM_INT64, 4, 1, 0, 0},
                                      geotherm_array{nullptr, GEOTHERM_FLOAT64, 4, 1, 0, 0},
                                      geotherm_array{d.data(), GEOTHERM_FLOAT64, -4, 1, 0, 0}}) {
    EXPECT_EQ(geotherm_distance(square.solver, &sources, &small, nullptr), GEOTHERM_BAD_INPUT);
    EXPECT_EQ(last_message().substr(0, 3), "out");
  }
}

/// Everything that a call can be given in place of what it asks for.
class Nonsense {
 public:
  explicit Nonsense(const Square& square)
      : handles_{nullptr,
                 square.model,
                 square.options,
                 square.solver,
                 reinterpret_cast<void*>(std::uintptr_t{1}),
                 reinterpret_cast<void*>(std::uintptr_t{1} << 20),
                 &handles_} {}

  template <class T>
  T* handle() {
    return static_cast<T*>(handles_[below(handles_.size())]);
  }
  bool coin() { return below(2) == 0; }
  std::size_t below(std::size_t count) { return random_() % count; }
  std::int64_t size() {
    constexpr std::array<std::int64_t, 8> kSizes = {-1, 0, 1, 2, 3, 4, INT64_MAX, INT64_MIN};
    return kSizes[below(kSizes.size())];
  }
  /// Of sizes that are too large for the data behind it in no call that reads it.
  geotherm_array array() {
    geotherm_array out = {coin() ? data_.data() : nullptr,
                          static_cast<geotherm_type>(static_cast<int>(below(6)) - 1),
                          size(),
                          size(),
                          0,
                          0};
    if (out.rows > 4 || out.columns > 4) out.columns = coin() ? INT64_MAX : -1;
    return out;
  }
  const char* text() {
    constexpr std::array<const char*, 10> kTexts = {
        nullptr,     "",          "method", "exact",     "json",
        "distances", "positions", "17,x",   "curve:0,1", "\xff\xfe\n\x01"};
    return kTexts[below(kTexts.size())];
  }
  geotherm_sources sources() {
    for (geotherm_source& point : points_) {
      point = {static_cast<std::int64_t>(below(5)) - 1, size(), {data_[0], 1, 0}, data_[1]};
    }
    for (std::int64_t& start : starts_) start = size();
    return {coin() ? points_.data() : nullptr, std::min<std::int64_t>(size(), 4),
            coin() ? starts_.data() : nullptr, std::min<std::int64_t>(size(), 4), text()};
  }
  std::int64_t* targets() { return coin() ? starts_.data() : nullptr; }

 private:
  std::mt19937 random_{17};
  std::array<void*, 7> handles_;
  std::array<double, 64> data_{};
  std::array<geotherm_source, 5> points_{};
  std::array<std::int64_t, 6> starts_{};
};

TEST(CFuzz, NoCallIsMoreThanAnErrorWhateverItIsGiven) {
  const Square square;
  Nonsense any(square);
  int refused = 0;
  constexpr int kCalls = 20'000;
  for (int i = 0; i < kCalls; ++i) {
    geotherm_model* model = nullptr;
    geotherm_solver* solver = nullptr;
    geotherm_answer* answer = nullptr;
    geotherm_array array = any.array(), other = any.array();
    geotherm_sources sources = any.sources();
    geotherm_shape shape = {};
    const char* text = nullptr;
    geotherm_status status = GEOTHERM_OK;
    switch (any.below(12)) {
      case 0:
        shape.kind = static_cast<geotherm_kind>(static_cast<int>(any.below(8)) - 1);
        shape.positions = any.array();
        shape.cells = any.array();
        shape.values = any.array();
        shape.starts = any.array();
        for (std::int64_t& size : shape.size) size = any.size();
        status = geotherm_model_build(any.coin() ? &shape : nullptr, nullptr, nullptr,
                                      any.coin() ? &model : nullptr);
        break;
      case 1:
        status = geotherm_options_set(any.handle<geotherm_options>(), any.text(), any.text());
        geotherm_options_set(square.options, "method", "exact");
        break;
      case 2:
        status = geotherm_options_get(any.handle<geotherm_options>(), any.text(),
                                      any.coin() ? &text : nullptr);
        break;
      case 3:
        status = geotherm_solver_new(any.handle<geotherm_model>(), square.options, nullptr,
                                     any.coin() ? &solver : nullptr);
        break;
      case 4:
        status = geotherm_solver_move(any.handle<geotherm_solver>(), any.coin() ? &array : nullptr,
                                      nullptr, any.coin() ? &solver : nullptr, &model);
        break;
      case 5:
        status = geotherm_distance(any.handle<geotherm_solver>(), any.coin() ? &sources : nullptr,
                                   any.coin() ? &array : nullptr, nullptr);
        break;
      case 6: {
        geotherm_rows rows = {any.array(), nullptr, any.targets(),
                              std::min<std::int64_t>(any.size(), 6), any.coin() ? 1.0 : -1.0};
        status = geotherm_distances(any.handle<geotherm_solver>(), &sources,
                                    any.coin() ? &rows : nullptr, nullptr);
        break;
      }
      case 7:
        status = geotherm_solve(any.handle<geotherm_solver>(), &sources, any.text(), nullptr,
                                any.coin() ? &answer : nullptr);
        break;
      case 8:
        status = geotherm_path(any.handle<geotherm_solver>(), any.coin() ? &sources : nullptr,
                               any.text(), any.coin() ? 1 : 0, nullptr, &answer);
        break;
      case 9:
        status = geotherm_isolines(any.handle<geotherm_model>(), &array, &other, nullptr, &answer);
        break;
      case 10:
        status = geotherm_samples(any.handle<geotherm_solver>(), any.size(), any.size(), nullptr,
                                  &answer);
        break;
      default:
        status = any.coin() ? geotherm_array_of(any.handle<void>(), any.text(), &array)
                            : geotherm_text_of(any.handle<void>(), any.text(), &text);
    }
    ASSERT_GE(status, GEOTHERM_OK);
    ASSERT_LE(status, GEOTHERM_NO_DEVICE);
    if (status != GEOTHERM_OK) {
      ++refused;
      ASSERT_FALSE(last_message().empty());
      ASSERT_EQ(last_message().find('\n'), std::string::npos) << last_message();
    }
    ASSERT_EQ(geotherm_free(model), GEOTHERM_OK);
    ASSERT_EQ(geotherm_free(solver), GEOTHERM_OK);
    ASSERT_EQ(geotherm_free(answer), GEOTHERM_OK);
  }
  EXPECT_GT(refused, kCalls / 2);
  EXPECT_LT(refused, kCalls) << "some of it must have been right";
}

}  // namespace
