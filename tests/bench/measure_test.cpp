// SPDX-License-Identifier: MIT
#include "bench/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bench/bench_mesh.h"

namespace geotherm::test {
namespace {

using bench::Contender;
using bench::Figures;

/// What contenders do, as they tell it.
struct Track {
  std::set<std::string> set_up;
  std::size_t most_set_up = 0;
  std::vector<std::string> set_ups;
};

class FakeContender final : public Contender {
 public:
  FakeContender(std::string name, Track& track, bool fails = false)
      : name_(std::move(name)), track_(track), fails_(fails) {}

  std::string name() const override { return name_; }
  Result<void> set_up(std::shared_ptr<const TriangleMesh>) override {
    if (fails_) return Error{ErrorCode::kOutOfMemory, "no memory"};
    track_.set_ups.push_back(name_);
    track_.set_up.insert(name_);
    track_.most_set_up = std::max(track_.most_set_up, track_.set_up.size());
    return {};
  }
  void drop() override { track_.set_up.erase(name_); }
  Result<std::vector<double>> query(Index source) override {
    if (!track_.set_up.contains(name_)) return Error{ErrorCode::kBadInput, "asked, not set up"};
    return std::vector<double>{static_cast<double>(source)};
  }
  Result<void> batch(std::span<const Index>) override {
    if (!track_.set_up.contains(name_)) return Error{ErrorCode::kBadInput, "asked, not set up"};
    return {};
  }
  double factor_mb() const override { return 1; }

 private:
  std::string name_;
  Track& track_;
  bool fails_;
};

class Measuring : public ::testing::TestWithParam<bool> {
 protected:
  /// Two set-ups, four queries and two batches each.
  std::vector<Figures> measured() {
    const bench::Budget twice{0, 2, 1e9}, four_times{0, 4, 1e9};
    const bench::Race race{mesh, contenders, sources, {twice, four_times, twice}, GetParam()};
    return bench::measure(
        race, [](std::string_view) {},
        [&](std::size_t c, const std::vector<double>& answer) {
          first_answers.push_back(contenders[c]->name() + std::to_string(answer.at(0)));
        });
  }
  void add(const std::string& name, bool fails = false) {
    contenders.push_back(std::make_unique<FakeContender>(name, track, fails));
  }

  Track track;
  std::vector<std::unique_ptr<Contender>> contenders;
  std::vector<std::string> first_answers;
  std::shared_ptr<const TriangleMesh> mesh =
      std::make_shared<const TriangleMesh>(*bench::make_mesh("grid", 200));
  std::vector<Index> sources = {7, 8, 9};
};

TEST_P(Measuring, TakesTurnsAndLeavesNothingSetUp) {
  for (const char* name : {"a", "b", "c"}) add(name);
  for (const Figures& figures : measured()) {
    EXPECT_EQ(figures.failure, "") << figures.name;
    EXPECT_GE(figures.setup_ms, 0);
    EXPECT_GE(figures.query_ms, 0);
    EXPECT_GE(figures.batch_ms_per_source, 0);
    EXPECT_EQ(figures.factor_mb, 1);
  }
  EXPECT_EQ(track.set_ups, (std::vector<std::string>{"a", "b", "c", "a", "b", "c"}));
  EXPECT_TRUE(track.set_up.empty());
  EXPECT_EQ(track.most_set_up, GetParam() ? 1u : 3u);
}

TEST_P(Measuring, GoesOnWhereOneFails) {
  add("a");
  add("bad", true);
  add("c");
  const std::vector<Figures> figures = measured();
  EXPECT_EQ(figures[0].failure, "");
  EXPECT_EQ(figures[1].failure, "no memory");
  EXPECT_TRUE(std::isnan(figures[1].setup_ms));
  EXPECT_EQ(figures[2].failure, "");
  EXPECT_GE(figures[2].batch_ms_per_source, 0);
}

TEST_P(Measuring, HandsOnEachFirstAnswer) {
  add("a");
  add("b");
  measured();
  EXPECT_EQ(first_answers,
            (std::vector<std::string>{"a" + std::to_string(7.0), "b" + std::to_string(7.0)}));
}

INSTANTIATE_TEST_SUITE_P(Ways, Measuring, ::testing::Bool(),
                         [](const auto& way) { return way.param ? "OneAtATime" : "AllTogether"; });

}  // namespace
}  // namespace geotherm::test
