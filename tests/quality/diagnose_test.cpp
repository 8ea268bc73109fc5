// SPDX-License-Identifier: MIT
#include "solver/quality/diagnose.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

// That the causes are the right ones is tested where they are said, in
// tests/app/program_cause_test.cpp.

const SourceSet kSource = SourceSet::of_vertices({0});

TEST(DiagnoseTest, AnAnswerWithoutErrorHasNoCause) {
  const MeshPtr mesh = finish(sphere(1));
  const std::vector<double> same(mesh->positions().size(), 1);
  const auto diagnosis = diagnose(mesh, {}, kSource, same, same);
  ASSERT_TRUE(diagnosis);
  EXPECT_FALSE(diagnosis->cause || diagnosis->skipped || diagnosis->refined);
}

TEST(DiagnoseTest, WhatNoChangeLowersHasNoCause) {
  const MeshPtr mesh = finish(sphere(1));
  const std::size_t vertices = mesh->positions().size();
  // Distances that no method gives: all changes leave nearly the whole error.
  const std::vector<double> distances(vertices, 1), better(vertices, 1e6);
  MethodOptions options;
  options.variant = Variant::kClassic;
  const auto diagnosis = diagnose(mesh, options, kSource, distances, better);
  ASSERT_TRUE(diagnosis) << diagnosis.error().message;
  EXPECT_FALSE(diagnosis->cause);
  EXPECT_TRUE(diagnosis->refined);
}

TEST(DiagnoseTest, LargeMeshesAreNotSolvedAgain) {
  const MeshPtr mesh = finish(plane_grid(400, 400, 1, 1));
  ASSERT_GT(mesh->face_count(), kMostFacesDiagnosed);
  const std::size_t vertices = mesh->positions().size();
  const std::vector<double> distances(vertices, 1), better(vertices, 2);
  const auto never = [](std::string_view, double) { return false; };
  const auto diagnosis = diagnose(mesh, {}, kSource, distances, better, never);
  ASSERT_TRUE(diagnosis) << "there was nothing to cancel";
  EXPECT_TRUE(diagnosis->skipped);
}

TEST(DiagnoseTest, CanBeCancelled) {
  const MeshPtr mesh = finish(sphere(2));
  const std::size_t vertices = mesh->positions().size();
  const std::vector<double> distances(vertices, 1), better(vertices, 2);
  const auto never = [](std::string_view, double) { return false; };
  const auto diagnosis = diagnose(mesh, {}, kSource, distances, better, never);
  ASSERT_FALSE(diagnosis);
  EXPECT_EQ(diagnosis.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace geotherm::test
