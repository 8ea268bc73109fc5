// SPDX-License-Identifier: MIT
#include "app/session/wording.h"

#include <gtest/gtest.h>

#include "geotherm/accuracy.h"

namespace geotherm::app {
namespace {

const Error kMemory{ErrorCode::kOutOfMemory,
                    "ran out of memory",
                    {"try ", SettingHint{"backend", {"cg"}}, ", which needs no factor"},
                    "native"};

TEST(Wording, NamesSettingsAsOptionsOfTheCommandLine) {
  EXPECT_EQ(to_text(kMemory), "native: ran out of memory; try --backend cg, which needs no factor");
  const Warning warning{"it is wrong", {"use ", SettingHint{"method", {"wavefront"}}}};
  EXPECT_EQ(to_text(warning), "it is wrong; use --method wavefront");
  EXPECT_EQ(to_text(std::vector<Warning>{warning}),
            std::vector<std::string>{"it is wrong; use --method wavefront"});
  AccuracyReport report;
  report.verdict = "poor: 9 %";
  report.advice = {"with ", SettingHint{"time-factor", {"1"}}, " it is 1 %"};
  EXPECT_EQ(to_text(report), "poor: 9 %; with --time-factor 1 it is 1 %");
}

TEST(Wording, SaysWhereItHappenedInFront) {
  const Error placed = about("bunny", about("--weld", kMemory), ErrorCode::kBadFile);
  EXPECT_EQ(placed.code, ErrorCode::kBadFile);
  EXPECT_EQ(to_text(placed),
            "bunny: --weld: native: ran out of memory; try --backend cg, which needs no factor");
}

TEST(Wording, GivesAHintToWhatHasNone) {
  EXPECT_EQ(
      to_text(with_hint({ErrorCode::kBadFile, "a;b.obj; c: no such file"}, {"check the path"})),
      "a;b.obj; c: no such file; check the path");
  EXPECT_EQ(with_hint(kMemory, {"check the path"}).hint, kMemory.hint);
}

}  // namespace
}  // namespace geotherm::app
