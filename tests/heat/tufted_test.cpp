// SPDX-License-Identifier: MIT
// Distances on surfaces that are no oriented manifold: through the tufted cover.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geotherm/build_method.h"
#include "solver/mesh/connectivity.h"
#include "tests/support/compare.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Solves of systems of a thousand unknowns.
constexpr double kTuftedSolved = 1e-9;

HeatOptions of_kind(LaplacianKind kind) {
  HeatOptions options;
  options.laplacian = kind;
  return options;
}

/// Pages that share the vertices x = 0; page k is the unit square turned by its angle.
Draft book(Index pages, Index n) {
  Draft draft;
  std::vector<Index> spine;
  for (Index p = 0; p < pages; ++p) {
    const Draft page = jittered_plane(n, 0.2, 7);  // one for all: the spine's places agree
    std::vector<Index> number;
    const double angle = 5.0 * p / pages;
    for (std::size_t v = 0; v < page.positions.size(); ++v) {
      const Vec3& at = page.positions[v];
      if (at.x() == 0 && p > 0) {
        number.push_back(spine[v]);
        continue;
      }
      number.push_back(draft.add({at.x() * std::cos(angle), at.y(), at.x() * std::sin(angle)}));
    }
    if (p == 0) spine = number;
    for (const Face& f : page.faces) {
      draft.faces.push_back({number[f[0]], number[f[1]], number[f[2]]});
    }
  }
  return draft;
}

TEST(PagesOfABook, AreAsFarApartAsInTheUnfoldedPlane) {
  constexpr Index kSquares = 20;
  constexpr double kFirstOrder = 0.05;  // of the range, in corners of pages of 20 cells
  const MeshPtr mesh = finish(book(3, kSquares));
  const HeatMethod method = method_of(mesh);
  EXPECT_EQ(method.laplacian(), LaplacianKind::kTufted);
  Index source = 0;  // the middle of the first page
  const Vec3 middle(0.5, 0.5, 0);
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const auto off = [&](Index i) { return (mesh->positions()[i] - middle).norm(); };
    if (off(v) < off(source)) source = v;
  }
  const Vec3 from = mesh->positions()[source];
  const auto d = solve(method, SourceSet::of_vertices({source})).distances;
  const auto first_page = static_cast<Index>((kSquares + 1) * (kSquares + 1));
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const Vec3& p = mesh->positions()[v];
    const double from_spine = std::hypot(p.x(), p.z());
    const double x = v < first_page ? from_spine : -from_spine;
    EXPECT_NEAR(d[v], std::hypot(x - from.x(), p.y() - from.y()), kFirstOrder * largest(d)) << v;
  }
}

TEST(OrientationOfFaces, ChangesNoDistance) {
  for (const Draft& draft : {book(3, 8), moebius(24, 4)}) {
    Draft turned = draft;
    std::mt19937 random(5);
    for (Face& face : turned.faces) {
      if (random() % 2 == 0) std::swap(face[0], face[1]);
    }
    const auto d = solve(finish(draft), {3}).distances;
    EXPECT_LT(relative_difference(solve(finish(turned), {3}).distances, d), kTuftedSolved);
  }
}

/// Heat distances against shortest paths, mean of the differences over the range.
double mean_error(const MeshPtr& mesh, const SourceSet& sources, LaplacianKind kind) {
  MethodOptions exact;
  exact.method = MethodKind::kExact;
  const auto better = build_method(mesh, exact);
  const auto reference = (*better)->solve(sources);
  const auto d = solve(method_of(mesh, of_kind(kind)), sources).distances;
  double sum = 0;
  for (std::size_t v = 0; v < d.size(); ++v) sum += std::abs(d[v] - reference->distances[v]);
  return sum / static_cast<double>(d.size()) / largest(reference->distances);
}

TEST(MoebiusStrip, HasDistancesThatComeNearShortestPathsWithFinerFaces) {
  constexpr double kCoarse = 0.06, kLess = 0.75;  // first order would be a half
  const double coarse =
      mean_error(finish(moebius(40, 6)), SourceSet::of_vertices({3}), LaplacianKind::kAuto);
  const double fine =
      mean_error(finish(moebius(80, 12)), SourceSet::of_vertices({6}), LaplacianKind::kAuto);
  EXPECT_LT(coarse, kCoarse);
  EXPECT_LT(fine, kLess * coarse);
}

/// Where a plane's faces are stretched, flips must pass the edges with three faces.
Draft stretched_book() {
  Draft draft = book(3, 12);
  for (Vec3& p : draft.positions) p.y() *= 0.15;
  return draft;
}

TEST(StretchedBook, NeedsItsCover) {
  const MeshPtr mesh = finish(stretched_book());
  const SourceSet source = SourceSet::of_vertices({grid_vertex(12, 12, 6)});
  const double cover = mean_error(mesh, source, LaplacianKind::kTufted);
  EXPECT_LT(cover, 0.03);
  EXPECT_GT(mean_error(mesh, source, LaplacianKind::kCotan), 2 * cover);
}

TEST(CoverOfAManifold, ChangesNoDistance) {
  Draft shifted = sphere(3);
  for (Vec3& p : shifted.positions) p.z() *= 0.3;
  const MeshPtr mesh = finish(shifted);
  SourceSet sources = SourceSet::of_vertices({7});
  sources.points.push_back(SurfacePoint::in_face(200, {0.2, 0.3, 0.5}));
  sources.points.push_back(SurfacePoint::in_face(300, {0.25, 0.75, 0}));
  for (const auto mode : {HeatMode::kUnit, HeatMode::kDiffuse, HeatMode::kHold}) {
    HeatOptions once = of_kind(LaplacianKind::kIntrinsicDelaunay);
    HeatOptions twice = of_kind(LaplacianKind::kTufted);
    once.heat = twice.heat = mode;
    once.time_step.rule = twice.time_step.rule = TimeRule::kMeanFaceArea;
    const auto d = solve(method_of(mesh, once), sources);
    const auto e = solve(method_of(mesh, twice), sources);
    EXPECT_LT(relative_difference(e.distances, d.distances), kTuftedSolved);
    EXPECT_EQ(e.quality.zero_gradient_faces, d.quality.zero_gradient_faces);
    EXPECT_NEAR(e.quality.eikonal_error_mean, d.quality.eikonal_error_mean, 1e-9);
  }
}

// A point on an edge with three faces lies in all of them, whichever is named.
TEST(PointOnAnEdgeOfThreeFaces, IsOneWhicheverFaceIsNamed) {
  const MeshPtr mesh = finish(book(3, 5));
  std::vector<std::vector<double>> answers;
  for (Index f = 0; f < mesh->face_count(); ++f) {
    const Face& face = mesh->faces()[f];
    for (int k = 0; k < 3; ++k) {
      const Vec3& a = mesh->positions()[face[k]];
      const Vec3& b = mesh->positions()[face[next_corner(k)]];
      if (std::hypot(a.x(), a.z()) + std::hypot(b.x(), b.z()) > 0) continue;
      if (std::abs((a + b).y() - 1) > 0.2) continue;  // one edge in the middle of the spine
      SourceSet source;
      source.points = {SurfacePoint::in_face(f, {})};
      source.points[0].weights[k] = source.points[0].weights[next_corner(k)] = 0.5;
      answers.push_back(solve(method_of(mesh), source).distances);
    }
  }
  ASSERT_GE(answers.size(), 3U);
  EXPECT_LT(relative_difference(answers[1], answers[0]), kTuftedSolved);
  EXPECT_LT(relative_difference(answers[2], answers[0]), kTuftedSolved);
}

}  // namespace
}  // namespace geotherm::test
