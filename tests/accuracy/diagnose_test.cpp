// SPDX-License-Identifier: MIT
#include "geotherm/accuracy.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geotherm/mesh.h"
#include "geotherm/mesh_report.h"
#include "geotherm/options.h"
#include "solver/accuracy/candidates.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

// That the causes are the right ones is tested where they are said, in
// tests/app/program_cause_test.cpp.

using Distances = std::vector<double>;

const SourceSet kSource = SourceSet::of_vertices({0});

/// What is found for distances that someone claims to be those of a method.
Result<Diagnosis> diagnosis_of(const MeshPtr& mesh, const MethodOptions& options,
                               const Distances& distances, MethodKind reference,
                               const Distances& better, Index most_faces = kMaxFacesDiagnosed,
                               const Progress& progress = {}) {
  const auto method = build_method(mesh, options);
  if (!method) return method.error();
  return diagnose(mesh, {**method, options, {&kSource, 1}, {&distances, 1}}, reference,
                  {&better, 1}, most_faces, progress);
}

Distances distances_of(const MeshPtr& mesh, const MethodOptions& options) {
  const auto method = build_method(mesh, options);
  EXPECT_TRUE(method) << method.error().message;
  return (*method)->solve(kSource)->distances;
}

MethodOptions of_method(MethodKind kind) {
  MethodOptions options;
  options.method = kind;
  return options;
}

bool tried(const Diagnosis& found, const std::string& setting) {
  return std::ranges::any_of(
      found.tried, [&](const auto& each) { return hint_text({setting_of(each)}) == setting; });
}

TEST(DiagnoseTest, AnAnswerWithoutErrorHasNoCause) {
  const MeshPtr mesh = finish(sphere(1));
  const Distances same(mesh->positions().size(), 1);
  const auto found = diagnosis_of(mesh, {}, same, MethodKind::kExact, same);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->cause || found->remedy);
  EXPECT_TRUE(found->tried.empty());
}

TEST(DiagnoseTest, WhatNoOptionLowersIsLeftToTheMethodsAndAllOptionsWereTried) {
  const MeshPtr mesh = finish(plane_grid(6, 6, 1, 1));
  const Distances better = distances_of(mesh, of_method(MethodKind::kExact));
  // A reference that the heat method is far from on this mesh, whatever its options are.
  Distances scaled = better;
  for (double& d : scaled) d *= 4;
  const auto found = diagnosis_of(mesh, {}, distances_of(mesh, {}), MethodKind::kExact, scaled);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_FALSE(found->cause);
  for (const char* setting :
       {"time-factor 2", "time-factor 4", "variant classic", "boundary average",
        "boundary dirichlet", "laplacian tufted", "refine 1", "method wavefront"}) {
    EXPECT_TRUE(tried(*found, setting)) << setting;
  }
}

TEST(DiagnoseTest, TheCheapestGoodSettingEndsTheSearch) {
  const MeshPtr mesh = finish(sphere(3));
  const Distances better = distances_of(mesh, {});
  MethodOptions wrong;
  wrong.time_step.factor = 1000;
  const auto found =
      diagnosis_of(mesh, wrong, distances_of(mesh, wrong), MethodKind::kExact, better);
  ASSERT_TRUE(found && found->remedy);
  EXPECT_EQ(hint_text({setting_of(*found->remedy)}), "time-factor 1");
  EXPECT_EQ(found->tried.size(), 1U);
  EXPECT_LT(found->remedy->mean_relative, 1e-6) << "the remedy is what the reference was made with";
}

/// Distances of which all but one are those of the heat method with its usual options, and that one
/// is wrong by `share` of the largest.
Distances wrong_at_one_vertex(Distances distances, double share) {
  const double largest = *std::ranges::max_element(distances);
  distances.back() += share * largest;
  return distances;
}

TEST(DiagnoseTest, AGoodSettingIsTheCureHoweverLittleItLowersTheError) {
  const MeshPtr mesh = finish(sphere(3));
  const Distances usual = distances_of(mesh, {});
  // Both are a little too long at one vertex: as much as is good, and a tenth more.
  const Distances better = wrong_at_one_vertex(usual, -0.95 * kMaxOfRange);
  const Distances poor = wrong_at_one_vertex(usual, 0.15 * kMaxOfRange);
  MethodOptions wrong;
  wrong.time_step.factor = 1.5;
  const auto found = diagnosis_of(mesh, wrong, poor, MethodKind::kExact, better);
  ASSERT_TRUE(found && found->remedy);
  EXPECT_EQ(hint_text({setting_of(*found->remedy)}), "time-factor 1");
  EXPECT_EQ(found->tried.size(), 1U);
}

TEST(DiagnoseTest, ExactDistancesAreOfferedWhereTheyAreTheReferenceAndNoOtherMethodIsGood) {
  const MeshPtr mesh = finish(sphere(2));
  // A reference that no other method comes near.
  Distances waves = distances_of(mesh, of_method(MethodKind::kWavefront));
  for (double& d : waves) d *= 4;
  const auto found = diagnosis_of(mesh, of_method(MethodKind::kFastMarching),
                                  Distances(waves.size(), 1), MethodKind::kExact, waves);
  ASSERT_TRUE(found && found->remedy);
  EXPECT_EQ(hint_text({setting_of(*found->remedy)}), "method exact");
}

TEST(DiagnoseTest, TheMeshIsTooCoarseOnlyWhereAFinerOneIsGood) {
  const MeshPtr mesh = finish(sphere(0));
  MethodOptions finer;
  finer.refine = 1;
  // A finer mesh is nearest to this reference: exactly it, or a little more wrong than is good.
  for (const double scale : {1.0, 1.025}) {
    Distances better = distances_of(mesh, finer);
    for (double& d : better) d *= scale;
    Distances poor = better;
    for (double& d : poor) d *= 2;
    const auto found = diagnosis_of(mesh, {}, poor, MethodKind::kExact, better);
    ASSERT_TRUE(found && found->cause);
    EXPECT_EQ(found->cause->option, "refine");
    EXPECT_EQ(found->cause->because.empty(), scale != 1) << found->cause->because;
  }
}

TEST(DiagnoseTest, TheReferenceItselfIsHeldAgainstABetterMethodBeforeItIsNamed) {
  const MeshPtr mesh = finish(jittered_plane(8, 0.3, 5));
  const Distances waves = distances_of(mesh, of_method(MethodKind::kWavefront));
  const Distances wrong(waves.size(), 3);
  const auto found = diagnosis_of(mesh, of_method(MethodKind::kFastMarching), wrong,
                                  MethodKind::kWavefront, waves);
  ASSERT_TRUE(found && found->remedy);
  EXPECT_EQ(hint_text({setting_of(*found->remedy)}), "method wavefront");
  EXPECT_EQ(found->remedy->against, MethodKind::kExact);
  const Distances exact = distances_of(mesh, of_method(MethodKind::kExact));
  EXPECT_DOUBLE_EQ(found->remedy->mean_relative, distance_error(waves, exact).mean_relative);
  EXPECT_GT(found->remedy->mean_relative, 0);
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
  const Distances better = distances_of(mesh, {});
  for (const LaplacianKind kind : {LaplacianKind::kCotan, LaplacianKind::kIntrinsicDelaunay}) {
    MethodOptions options;
    options.laplacian = kind;
    const auto found =
        diagnosis_of(mesh, options, distances_of(mesh, options), MethodKind::kExact, better);
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(found->cause) << to_text(kind);
    EXPECT_EQ(found->cause->because,
              "the Laplacian is " + to_text(kind) + " and 1 component is no oriented manifold");
  }
}

TEST(DiagnoseTest, TheWorkIsBoundedByTheFacesOfEachSetting) {
  const MeshPtr mesh = finish(jittered_plane(8, 0.3, 5));
  const Distances better = distances_of(mesh, of_method(MethodKind::kExact));
  Distances scaled = better;
  for (double& d : scaled) d *= 4;
  const Distances heat = distances_of(mesh, {});
  const auto settings = [&](double meshes) {
    const auto found = diagnosis_of(mesh, {}, heat, MethodKind::kExact, scaled,
                                    static_cast<Index>(meshes * mesh->face_count()));
    EXPECT_TRUE(found) << found.error().message;
    return *found;
  };
  const Diagnosis factors = settings(0.5), covers = settings(2), none = settings(0.1);
  EXPECT_TRUE(tried(factors, "time-factor 2"));
  EXPECT_FALSE(tried(factors, "laplacian tufted"));
  EXPECT_TRUE(tried(covers, "laplacian tufted"));
  EXPECT_FALSE(tried(covers, "refine 1"));
  EXPECT_FALSE(tried(none, "time-factor 2"));
  EXPECT_TRUE(tried(none, "method wavefront")) << "there is always something that helps";
}

TEST(DiagnoseTest, OptionsThatAreAlreadySetAreNotTriedAgain) {
  MethodOptions options;
  options.time_step.factor = 2;
  options.variant = Variant::kClassic;
  options.laplacian = LaplacianKind::kTufted;
  const MeshReport mesh = inspect_mesh(*finish(plane_grid(3, 3, 1, 1)));
  for (const Candidate& candidate : heat_candidates(options, mesh, 2)) {
    EXPECT_NE(candidate.options, options) << candidate.option << ' ' << candidate.value;
  }
}

TEST(DiagnoseTest, CanBeCancelled) {
  const MeshPtr mesh = finish(sphere(2));
  const std::size_t vertices = mesh->positions().size();
  const Distances distances(vertices, 1), better(vertices, 2);
  const auto never = [](std::string_view, double) { return false; };
  const auto found =
      diagnosis_of(mesh, {}, distances, MethodKind::kExact, better, kMaxFacesDiagnosed, never);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace geotherm::test
