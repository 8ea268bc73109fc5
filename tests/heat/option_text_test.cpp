// SPDX-License-Identifier: MIT
#include "geotherm/options.h"

#include <gtest/gtest.h>

namespace geotherm::test {
namespace {

TEST(OptionText, OfTimeStepsReadsBack) {
  for (const TimeStep& step :
       {TimeStep{}, TimeStep{TimeRule::kMeanFaceArea, 1, 0},
        TimeStep{TimeRule::kAbsolute, 1, 0.1 + 0.2}, TimeStep{TimeRule::kAbsolute, 1, 3e-300}}) {
    const auto parsed = parse_time_step(to_text(step));
    ASSERT_TRUE(parsed) << to_text(step);
    EXPECT_EQ(*parsed, step);
  }
  EXPECT_EQ(parse_time_step("mean-edge", 2.5)->factor, 2.5);
}

TEST(OptionText, OfConstraintsReadsBack) {
  for (const Constraint& constraint :
       {Constraint{}, Constraint{ConstraintMode::kPinVertex, kNoIndex, 10},
        Constraint{ConstraintMode::kPinVertex, 0, 10},
        Constraint{ConstraintMode::kPinVertex, 812, 10},
        Constraint{ConstraintMode::kPenalty, kNoIndex, 1.0 / 3},
        Constraint{ConstraintMode::kConserveEnergy, kNoIndex, 10},
        Constraint{ConstraintMode::kPseudoInverse, kNoIndex, 10}}) {
    const auto parsed = parse_constraint(to_text(constraint));
    ASSERT_TRUE(parsed) << to_text(constraint);
    EXPECT_EQ(*parsed, constraint) << to_text(constraint);
  }
}

TEST(OptionText, OfModesReadsBack) {
  for (const auto mode : {HeatMode::kUnit, HeatMode::kDiffuse, HeatMode::kHold}) {
    EXPECT_EQ(*parse<HeatMode>(to_text(mode)), mode);
  }
  for (const auto rule :
       {BoundaryRule::kNeumann, BoundaryRule::kDirichlet, BoundaryRule::kAverage}) {
    EXPECT_EQ(*parse<BoundaryRule>(to_text(rule)), rule);
  }
  for (const auto kind : {LaplacianKind::kAuto, LaplacianKind::kCotan,
                          LaplacianKind::kIntrinsicDelaunay, LaplacianKind::kTufted}) {
    EXPECT_EQ(*parse<LaplacianKind>(to_text(kind)), kind);
  }
  for (const auto variant : {Variant::kCorrected, Variant::kClassic}) {
    EXPECT_EQ(*parse<Variant>(to_text(variant)), variant);
  }
  for (const auto precision : {Precision::kCompact, Precision::kRefined, Precision::kFull}) {
    EXPECT_EQ(*parse<Precision>(to_text(precision)), precision);
  }
}

template <class T>
void expect_refused(const Result<T>& parsed, const std::string& says) {
  ASSERT_FALSE(parsed);
  EXPECT_EQ(parsed.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(parsed.error()).find(says), std::string::npos) << parsed.error().message;
}

TEST(OptionText, ThatIsUnknownIsRefusedWithTheNamesThereAre) {
  expect_refused(parse<HeatMode>("warm"), "diffuse");
  expect_refused(parse<BoundaryRule>("robin"), "average");
  expect_refused(parse<LaplacianKind>(""), "intrinsic-delaunay");
  expect_refused(parse<Variant>("Classic"), "classic");
  expect_refused(parse<Precision>("double"), "refined");
  expect_refused(parse_constraint("pin"), "pseudo-inverse");
  expect_refused(parse_time_step("mean"), "mean-edge");
}

class RefusedConstraint : public testing::TestWithParam<const char*> {};
TEST_P(RefusedConstraint, IsBadInput) { expect_refused(parse_constraint(GetParam()), ""); }
INSTANTIATE_TEST_SUITE_P(Texts, RefusedConstraint,
                         testing::Values("penalty:0", "penalty:-1", "penalty:nan", "penalty:inf",
                                         "penalty:", "penalty:1x", "pin-vertex:", "pin-vertex:1.5",
                                         "pin-vertex:-1", "pin-vertex:99999999999", "pin-sources:3",
                                         "pseudo-inverse:1", ":", ""));

class RefusedTimeStep : public testing::TestWithParam<const char*> {};
TEST_P(RefusedTimeStep, IsBadInput) { expect_refused(parse_time_step(GetParam()), ""); }
INSTANTIATE_TEST_SUITE_P(Texts, RefusedTimeStep,
                         testing::Values("absolute", "absolute:", "absolute:0", "absolute:-1",
                                         "absolute:nan", "absolute:inf", "absolute:1e999",
                                         "absolute:1 ", "mean-edge:2", "mean-edge:", ""));

}  // namespace
}  // namespace geotherm::test
