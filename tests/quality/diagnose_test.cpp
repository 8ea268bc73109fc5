// SPDX-License-Identifier: MIT
#include "solver/quality/diagnose.h"

#include <gtest/gtest.h>

#include "solver/geometry/mesh_report.h"
#include "solver/heat/option_text.h"
#include "solver/mesh/weld.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

// That the causes are the right ones is tested where they are said, in
// tests/app/program_cause_test.cpp.

const SourceSet kSource = SourceSet::of_vertices({0});

TEST(DiagnoseTest, AnAnswerWithoutErrorHasNoCause) {
  const MeshPtr mesh = finish(sphere(1));
  const std::vector<double> same(mesh->positions().size(), 1);
  const auto diagnosis = diagnose(mesh, {}, 1, kSource, same, same);
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
  const auto diagnosis = diagnose(mesh, options, 1, kSource, distances, better);
  ASSERT_TRUE(diagnosis) << diagnosis.error().message;
  EXPECT_FALSE(diagnosis->cause);
  EXPECT_TRUE(diagnosis->refined);
}

/// Three sheets that meet in one line.
MeshPtr book() {
  const Draft sheet = plane_grid(4, 4, 4, 4);
  Draft draft = sheet;
  Draft left = sheet, upright = sheet;
  for (Vec3& p : left.positions) p.x() *= -1;
  for (Vec3& p : upright.positions) p = Vec3(0, p.y(), p.x());
  append(draft, left);
  append(draft, upright);
  auto welded = weld(*finish(draft), 0);
  EXPECT_TRUE(welded);
  return std::make_shared<const TriangleMesh>(std::move(welded->mesh));
}

TEST(DiagnoseTest, SaysWhatIsWrongWithEachLaplacian) {
  const MeshPtr mesh = book();
  ASSERT_EQ(inspect_mesh(*mesh).non_delaunay_edges, 0);
  const auto distances_of = [&mesh](const MethodOptions& options) {
    const auto method = build_method(mesh, options);
    EXPECT_TRUE(method) << method.error().message;
    return (*method)->solve(kSource)->distances;
  };
  const std::vector<double> better = distances_of({});
  for (const LaplacianKind kind : {LaplacianKind::kCotan, LaplacianKind::kIntrinsicDelaunay}) {
    MethodOptions options;
    options.laplacian = kind;
    const auto diagnosis = diagnose(mesh, options, 1, kSource, distances_of(options), better);
    ASSERT_TRUE(diagnosis) << diagnosis.error().message;
    ASSERT_TRUE(diagnosis->cause) << to_text(kind);
    EXPECT_EQ(diagnosis->cause->because,
              "the Laplacian is " + to_text(kind) + " and 1 component is no oriented manifold");
  }
}

TEST(DiagnoseTest, LargeMeshesAreNotSolvedAgain) {
  const MeshPtr mesh = finish(plane_grid(400, 400, 1, 1));
  ASSERT_GT(mesh->face_count(), kMostFacesDiagnosed);
  const std::size_t vertices = mesh->positions().size();
  const std::vector<double> distances(vertices, 1), better(vertices, 2);
  const auto never = [](std::string_view, double) { return false; };
  const auto diagnosis = diagnose(mesh, {}, 1, kSource, distances, better, never);
  ASSERT_TRUE(diagnosis) << "there was nothing to cancel";
  EXPECT_TRUE(diagnosis->skipped);
}

TEST(DiagnoseTest, CanBeCancelled) {
  const MeshPtr mesh = finish(sphere(2));
  const std::size_t vertices = mesh->positions().size();
  const std::vector<double> distances(vertices, 1), better(vertices, 2);
  const auto never = [](std::string_view, double) { return false; };
  const auto diagnosis = diagnose(mesh, {}, 1, kSource, distances, better, never);
  ASSERT_FALSE(diagnosis);
  EXPECT_EQ(diagnosis.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace geotherm::test
