// SPDX-License-Identifier: MIT
// Inserted vertices: what they must mend, and that the surface stays what it is.
#include "solver/geometry/intrinsic_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geotherm/heat_method.h"
#include "solver/geometry/intrinsic_surface.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

constexpr double kRefinedRoundOff = 1e-9;  // of lengths that are computed a few dozen times
// As intrinsic_refinement.h states them: the longest edge over sqrt(t), the cotangent of 96
// degrees.
constexpr double kLongest = 2.6, kObtuse = -0.1;

Draft stretched_delaunay() {
  Draft draft = random_delaunay(300, 2);
  for (Vec3& p : draft.positions) p.x() *= 40;
  return draft;
}

struct RefinedCase {
  const char* name;
  Draft (*draft)();
  bool planar = false, border = false;
};
void PrintTo(const RefinedCase& c, std::ostream* out) { *out << c.name; }

const RefinedCase kCases[] = {
    {"delaunay", [] { return random_delaunay(400, 1); }, true, true},
    {"stretched", stretched_delaunay, true, true},
    {"graded", [] { return graded_plane(20, 200); }, true, true},
    {"spiky", spiky_sphere},
    {"book", [] { return graded_book(12); }},
};

constexpr SurfaceRules kRefine = {FlipRule::kWhereNeeded, CoverRule::kWhereNeeded,
                                  RefineRule::kWhereNeeded};

double area(const std::vector<std::array<double, 3>>& lengths) {
  double sum = 0;
  for (const auto& l : lengths) {
    const FaceLayout p = lay_out(l);
    sum += p.base * p.height / 2;
  }
  return sum;
}

class Refinements : public testing::TestWithParam<RefinedCase> {
 protected:
  MeshPtr mesh = finish(GetParam().draft());
  IntrinsicSurface flipped =
      *build_intrinsic_surface(mesh, {FlipRule::kWhereNeeded, CoverRule::kWhereNeeded});
  IntrinsicSurface refined = *build_intrinsic_surface(mesh, kRefine);
  const IntrinsicMesh& after = refined.intrinsic;

  Vec3 position(Index v) const {
    const Index own = mesh->vertex_count();
    return v < own ? mesh->positions()[v] : refined.refinement.positions[v - own];
  }
  Vec3 place(const Face& face, const std::array<double, 3>& weights) const {
    Vec3 p = Vec3::Zero();
    for (int k = 0; k < 3; ++k) p += weights[k] * position(face[k]);
    return p;
  }
};

TEST_P(Refinements, InsertWhereNeeded) {
  const Refinement& counts = refined.refinement;
  EXPECT_GT(counts.points, 0);
  EXPECT_GT(counts.large_faces + counts.obtuse_boundary, 0);
  EXPECT_EQ(GetParam().border, counts.boundary_splits > 0);
  EXPECT_TRUE(counts.complete);
  EXPECT_TRUE(refined.warnings == flipped.warnings);
}

TEST_P(Refinements, LeaveNoFaceTooLargeForTheTime) {
  for (Index f = 0; f < after.face_count(); ++f) {
    const Index part = refined.parts.of[after.faces[f][0]];
    const double root_t = refined.part_edge[part] * std::sqrt(refined.refinement.grading[part]);
    EXPECT_LE(std::ranges::max(after.lengths[f]), kLongest * root_t * (1 + kRefinedRoundOff)) << f;
  }
}

TEST_P(Refinements, LeaveNoObtuseBorder) {
  for (Side side = 0; side < 3 * after.face_count(); ++side) {
    if (after.twin[side] != kNoSide) continue;
    const auto& lengths = after.lengths[face_of(side)];
    const double root_t = std::sqrt(refined.refinement.grading[0]);  // one part, of mean edge 1
    if (lengths[corner_of(side)] < 0.02 * root_t) continue;          // too short to matter
    EXPECT_GE(opposite_cotangent(lengths, corner_of(side)), kObtuse) << side;
  }
}

TEST_P(Refinements, LeaveADelaunayTriangulation) { EXPECT_EQ(count_non_delaunay(after), 0); }

TEST_P(Refinements, KeepTheSurface) {
  EXPECT_NEAR(area(after.lengths), area(flipped.intrinsic.lengths),
              kRefinedRoundOff * area(after.lengths));
  // Each inserted vertex brings two faces, on the border one.
  const Refinement& counts = refined.refinement;
  EXPECT_EQ(after.face_count() - flipped.intrinsic.face_count(),
            2 * counts.points - counts.boundary_splits);
  for (Side side = 0; side < 3 * after.face_count(); ++side) {
    const Side twin = after.twin[side];
    if (twin == kNoSide) continue;
    ASSERT_EQ(after.twin[twin], side);
    EXPECT_EQ(after.lengths[face_of(side)][corner_of(side)],
              after.lengths[face_of(twin)][corner_of(twin)]);
    EXPECT_EQ(after.faces[face_of(side)][corner_of(side)],
              after.faces[face_of(twin)][next_corner(corner_of(twin))]);
  }
}

TEST_P(Refinements, AreTheSameWithAnyNumberOfThreads) {
  const IntrinsicSurface many = *build_intrinsic_surface(mesh, kRefine, {}, 3);
  EXPECT_EQ(many.intrinsic.faces, after.faces);
  EXPECT_EQ(many.intrinsic.lengths, after.lengths);
}

TEST_P(Refinements, EndAtTheLimit) {
  IntrinsicSurface part = flipped;
  const IntrinsicSurface named = *build_intrinsic_surface(
      mesh, {.flip = FlipRule::kWhereNeeded, .cover = CoverRule::kWhereNeeded, .parts = true});
  Components parts = named.parts;
  const auto counts = refine_triangulation(part.intrinsic, part.edits, parts, named.part_edge,
                                           mesh->positions(), 3, 1);
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->points, 3);
  EXPECT_FALSE(counts->complete);
}

/// Pieces of the mesh's faces end where they are, in any triangulation of the plane.
class RefinementsOfThePlane : public Refinements {
 protected:
  /// A thin face that is made strict by 1e-5 of its longest edge grows in height by up to
  /// sqrt(2e-5) of it; elsewhere the last digits of the flips are lost.
  double tolerance() const {
    const double thin = std::sqrt(2e-5) * (mesh->positions().back() - mesh->positions()[0]).norm();
    return after.mollified.most > 0 ? thin : 1e-6 * refined.mean_edge;
  }
  std::vector<FacePiece> carried(Index face, const std::array<double, 3>& from,
                                 const std::array<double, 3>& to) const {
    return carry_pieces(refined.edits, after.face_count(), {{face, from, to}});
  }
};

TEST_P(RefinementsOfThePlane, CarryPointsToTheirPlace) {
  const std::array<double, 3> weights[] = {{0.2, 0.5, 0.3}, {0.4, 0, 0.6}, {0, 1, 0}};
  for (Index f = 0; f < mesh->face_count(); f += 3) {
    for (const auto& w : weights) {
      const auto pieces = carried(f, w, w);
      ASSERT_EQ(pieces.size(), 1u);
      EXPECT_LE(
          (place(after.faces[pieces[0].face], pieces[0].from) - place(refined.kept->faces[f], w))
              .norm(),
          tolerance());
    }
  }
}

TEST_P(RefinementsOfThePlane, CarrySegmentsToTheirPlaceInAll) {
  const std::array<double, 3> from = {1, 0, 0}, to = {0, 0.3, 0.7};
  for (Index f = 0; f < mesh->face_count(); f += 3) {
    const Vec3 begin = place(refined.kept->faces[f], from), end = place(refined.kept->faces[f], to);
    double length = 0;
    for (const FacePiece& piece : carried(f, from, to)) {
      const Face& face = after.faces[piece.face];
      const Vec3 a = place(face, piece.from), b = place(face, piece.to);
      length += (b - a).norm();
      for (const Vec3& p : {a, b}) {  // on the segment
        EXPECT_NEAR((p - begin).norm() + (p - end).norm(), (end - begin).norm(), tolerance());
      }
    }
    EXPECT_NEAR(length, (end - begin).norm(), tolerance());
  }
}

std::string case_name(const testing::TestParamInfo<RefinedCase>& info) { return info.param.name; }

std::vector<RefinedCase> planar_cases() {
  std::vector<RefinedCase> out;
  for (const RefinedCase& c : kCases) {
    if (c.planar) out.push_back(c);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Meshes, Refinements, testing::ValuesIn(kCases), case_name);
INSTANTIATE_TEST_SUITE_P(Meshes, RefinementsOfThePlane, testing::ValuesIn(planar_cases()),
                         case_name);

TEST(RefinementsOfGoodMeshes, DoNothing) {
  for (const auto& draft : {torus(40, 20, 0.4), plane_grid(20, 20, 1, 1), sphere(3)}) {
    const IntrinsicSurface surface = *build_intrinsic_surface(finish(draft), kRefine);
    EXPECT_EQ(surface.refinement.points, 0);
    EXPECT_EQ(surface.refinement.grading, std::vector<double>{1});
  }
}

/// A ribbon whose border edges need two vertices each: opposite corners stand nearly over an end.
TEST(RefinementsOfRibbons, EndAtTheLimitWithAWarning) {
  Draft ribbon = plane_grid(1500, 1, 1500, 0.002);
  for (Vec3& p : ribbon.positions) p.x() += p.y() > 0 ? 0.05 : 0;
  const MeshPtr mesh = finish(ribbon);
  const auto heat = HeatMethod::build(mesh);
  ASSERT_TRUE(heat);
  const RefinementCounts& inserted = heat->refinement();
  EXPECT_FALSE(inserted.complete);
  EXPECT_EQ(inserted.points, mesh->vertex_count() + 1000);
  const std::string number = std::to_string(inserted.points) + " vertices were inserted";
  EXPECT_TRUE(std::ranges::any_of(heat->warnings(), [&](const Warning& warning) {
    return warning.message.find(number) != std::string::npos;
  }));
}

/// Parts share what may be inserted, whatever their order.
TEST(RefinementsOfManyParts, AreTheSameForEach) {
  const Draft one = graded_plane(4, 40);
  Draft many;
  for (int i = 0; i < 200; ++i) append(many, one);
  const IntrinsicSurface surface = *build_intrinsic_surface(finish(many), kRefine);
  EXPECT_TRUE(surface.refinement.complete);
  const std::vector<double>& grading = surface.refinement.grading;
  EXPECT_LE(std::ranges::max(grading), std::ranges::min(grading) * (1 + kRefinedRoundOff));
}

TEST(RefinementsWithProgress, EndWhenCancelled) {
  const auto mesh = finish(random_delaunay(400, 1));
  int most = 0;  // calls that are let pass
  for (bool cancelled = true; cancelled; ++most) {
    int calls = 0;
    const auto surface = build_intrinsic_surface(
        mesh, kRefine, [&](std::string_view, double) { return calls++ < most; });
    cancelled = !surface;
    if (cancelled) {
      ASSERT_EQ(surface.error().code, ErrorCode::kCancelled);
    }
  }
  EXPECT_GT(most, 4);
}

}  // namespace
}  // namespace geotherm::test
