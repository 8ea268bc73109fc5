// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>

#include "bench/models/volumes.h"
#include "geotherm/domains.h"
#include "solver/volume/clean_tets.h"
#include "tests/support/cells.h"
#include "tests/support/dice.h"

namespace geotherm::test {
namespace {

const std::vector<Vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};

TEST(TetMeshBuild, RefusesWhatIsNoVolumeWithItsNumber) {
  const auto said = [](std::vector<Vec3> positions, std::vector<Tet> tets) {
    return sentence(TetMesh::build(std::move(positions), std::move(tets)).error());
  };
  EXPECT_EQ(said(kCorners, {}),
            "the volume has no tetrahedra (5 vertices); distances in a volume need tetrahedra with "
            "four corners");
  EXPECT_EQ(said(kCorners, {{0, 1, 2, 3}, {1, 2, 3, 5}}),
            "tetrahedron 1 uses vertex 5, but there are 5 vertices");
  EXPECT_EQ(said(kCorners, {{0, 1, 2, -1}}),
            "tetrahedron 0 uses vertex -1, but there are 5 vertices");
  std::vector<Vec3> infinite = kCorners;
  infinite[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(said(infinite, {{0, 1, 2, 3}}), "vertex 3 has a coordinate that is not finite");
}

TEST(TetGradients, OfLinearFunctionsAreExactInEitherOrientationAtAnyScale) {
  Dice dice(7);
  for (int i = 0; i < 500; ++i) {
    const double scale = dice.power(-90, 90);
    std::array<Vec3, 4> p;
    for (Vec3& each : p) each = scale * dice.in_cube();
    const Vec3 slope = dice.in_cube();
    const TetGradient g = tet_gradient(p[0], p[1], p[2], p[3]);
    const Vec3 a = (p[1] - p[0]) / scale, b = (p[2] - p[0]) / scale, c = (p[3] - p[0]) / scale;
    EXPECT_NEAR(g.volume / scale / scale / scale, std::abs(a.dot(b.cross(c))) / 6, 1e-14);
    if (std::abs(a.dot(b.cross(c))) < 1e-3) continue;
    Vec3 gradient = Vec3::Zero(), sum = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      gradient += slope.dot(p[k] / scale) * (scale * g.gradients[k]);
      sum += scale * g.gradients[k];
    }
    EXPECT_LT((gradient - slope).norm(), 1e-10);
    EXPECT_LT(sum.norm(), 1e-10);
  }
}

TEST(TetGradients, OfSliversAreFiniteDownToFlatOnesWhichHaveNone) {
  for (const double height : {1e-2, 1e-4, 2e-6, 1e-7, 1e-12, 0.0}) {
    const TetGradient g = tet_gradient({0, 0, 0}, {1, 0, height}, {1, 1, 0}, {0, 1, height});
    EXPECT_EQ(g.volume > 0, height > 1e-6) << height;
    for (const Vec3& gradient : g.gradients) {
      EXPECT_TRUE(gradient.allFinite());
      EXPECT_EQ(gradient.norm() > 0, height > 1e-6);
    }
  }
  // A rod and a plate of good tets are none, thin as they are.
  EXPECT_GT(tet_gradient({0, 0, 0}, {1e-4, 0, 0}, {0, 1e-4, 0}, {0, 0, 1}).volume, 0);
  EXPECT_GT(tet_gradient({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-5}).volume, 0);
  const Vec3 here(1, 2, 3), huge(1e308, -1e308, 1e308);
  EXPECT_EQ(tet_gradient(here, here, here, here).volume, 0);
  EXPECT_TRUE(tet_gradient(huge, -huge, here, {0, 1e308, 0}).gradients[0].allFinite());
}

TEST(TetCleaning, LeavesOutWhatCarriesNoOperatorAndSaysHowMany) {
  std::vector<Vec3> positions = kCorners;
  positions.emplace_back(0.25, 0.25, 0);  // 5: in the plane of 0, 1, 2
  positions.emplace_back(9, 9, 9);        // 6: of no tet
  const TetMesh mesh = *TetMesh::build(
      positions,
      {{0, 1, 2, 3}, {3, 1, 0, 2}, {1, 2, 3, 4}, {0, 1, 2, 5}, {0, 0, 2, 5}, {0, 2, 1, 3}});
  const CleanTets clean = clean_tets(mesh);
  EXPECT_EQ(clean.original, (std::vector<Index>{0, 2}));
  EXPECT_EQ(clean.duplicate, 2);
  EXPECT_EQ(clean.flat, 1);
  EXPECT_EQ(clean.repeated_corner, 1);
  EXPECT_EQ(clean.lost_vertices, 1);
  EXPECT_EQ(clean.unused_vertices, 1);
  for (const Tet& tet : clean.tets) {
    EXPECT_GT(
        orientation_of(positions[tet[0]], positions[tet[1]], positions[tet[2]], positions[tet[3]]),
        0);
  }
  EXPECT_EQ(
      clean.notes(),
      (std::vector<std::string>{
          "1 tetrahedron with a repeated corner left out",
          "2 tetrahedra that stood there before left out", "1 tetrahedron without volume left out",
          "1 vertex in none of the tetrahedra that are left", "1 vertex in no tetrahedron"}));
}

/// A box whose border has a sliver on each square of its sides, as the hull of a Delaunay
/// triangulation of points that lie there to round-off has.
TetMesh box_with_slivers(const TetMesh& box) {
  const std::vector<Face> faces = boundary(box)->faces;
  std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
  std::vector<Tet> tets(box.tets().begin(), box.tets().end());
  std::map<std::pair<Index, Index>, Index> beside;  // the longest edge of a face: its third corner
  for (const Face& f : faces) {
    for (int k = 0; k < 3; ++k) {
      const Index a = f[k], b = f[(k + 1) % 3], c = f[(k + 2) % 3];
      const double edge = (positions[a] - positions[b]).norm();
      if (edge < (positions[a] - positions[c]).norm() ||
          edge < (positions[b] - positions[c]).norm())
        continue;
      const auto [other, first] = beside.insert({std::minmax({a, b}), c});
      if (!first) tets.push_back({a, b, c, other->second});
    }
  }
  Dice dice(11);
  for (const Vec3 middle = positions[0] / 2 + positions.back() / 2; Vec3 & p : positions) {
    p += 1e-3 * dice.in_cube().x() * (p - middle);
  }
  return *TetMesh::build(std::move(positions), std::move(tets));
}

TEST(TetCells, OfSliversAreThereAndDoNotRuleTheDistances) {
  const TetMesh box = make_box_tets(8, 8, 8, Vec3(1, 1, 1));
  const TetMesh dirty = box_with_slivers(box);
  const auto slivers = dirty.tet_count() - box.tet_count();
  ASSERT_EQ(slivers, 6 * 8 * 8);
  const CellsPtr cells = shared(cells_of(dirty)), clean = shared(cells_of(box));
  EXPECT_TRUE(clean->notes.empty());
  EXPECT_EQ(cells->cell_count(), dirty.tet_count());
  ASSERT_EQ(cells->notes.size(), 1U);
  EXPECT_EQ(cells->notes[0].message.substr(0, 11), "384 slivers");
  const Vec3 corner = box.positions()[0];
  const auto error = [&corner](const CellsPtr& of) {
    return straight_error(*of, solve_cells(of, SourceSet::of_vertices({0})).distances, corner);
  };
  EXPECT_LT(error(cells), 1.1 * error(clean));
  // A source in a sliver is one like any other.
  const Tet& last = dirty.tets().back();
  Vec3 middle = Vec3::Zero();
  for (const Index v : last) middle += dirty.positions()[v] / 4;
  SourceSet inside;
  inside.cell_points.push_back({dirty.tet_count() - 1, {0.25, 0.25, 0.25, 0.25}});
  EXPECT_LT(straight_error(*cells, solve_cells(cells, inside).distances, middle), 0.1);
}

TEST(TetCells, OfASliverThatAloneHoldsAVertexKeepItsWeight) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, -0.01}};
  const CellComplex cells = *cells_of(*TetMesh::build(positions, {{0, 1, 2, 3}, {0, 1, 2, 4}}));
  EXPECT_NEAR(cells.measures[1], 0.01 / 6, 1e-12);
  EXPECT_TRUE(cells.notes.empty());
}

/// Volume by the faces, each with the origin: outward they give the whole.
double enclosed(const TetMesh& mesh, const TetBoundary& border) {
  double volume = 0;
  for (const Face& f : border.faces) {
    const std::span<const Vec3> p = mesh.positions();
    volume += p[f[0]].dot(p[f[1]].cross(p[f[2]])) / 6;
  }
  return volume;
}

TEST(TetBoundaries, OfABoxAreItsSidesOutwardWhateverTheTetsOrientation) {
  const TetMesh box = make_box_tets(4, 3, 2, Vec3(4, 3, 2));
  std::vector<Tet> turned(box.tets().begin(), box.tets().end());
  for (std::size_t t = 0; t < turned.size(); t += 2) std::swap(turned[t][0], turned[t][1]);
  turned.push_back(turned[5]);     // does not count
  turned.push_back({0, 0, 1, 2});  // nor does this
  for (const TetMesh& mesh :
       {box, *TetMesh::build({box.positions().begin(), box.positions().end()}, turned)}) {
    const TetBoundary border = *boundary(mesh);
    EXPECT_EQ(border.faces.size(), 2U * 2 * (4 * 3 + 3 * 2 + 2 * 4));
    EXPECT_EQ(border.vertices.size(), 5U * 4 * 3 - 3 * 2 * 1);
    EXPECT_NEAR(enclosed(mesh, border), 24, 1e-12);
    ASSERT_EQ(border.tets.size(), border.faces.size());
    for (std::size_t f = 0; f < border.faces.size(); ++f) {
      const Tet& tet = mesh.tets()[border.tets[f]];
      for (const Index v : border.faces[f]) EXPECT_EQ(std::ranges::count(tet, v), 1);
    }
  }
}

TEST(TetBoundaries, OfABallAreClosed) {
  const TetMesh ball = make_ball_tets(5);
  const TetBoundary border = *boundary(ball);
  EXPECT_EQ(border.faces.size(), 20U * 25);
  std::map<std::pair<Index, Index>, int> sides;
  for (const Face& f : border.faces) {
    for (std::size_t k = 0; k < 3; ++k) ++sides[{f[k], f[(k + 1) % 3]}];
  }
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(sides.contains({side.second, side.first}));
  }
  for (const Index v : border.vertices) EXPECT_NEAR(ball.positions()[v].norm(), 1, 1e-14);
}

TEST(TetClosestPoint, IsThePointItselfInsideAndOnTheBorderOutsideSlow) {
  const TetMesh box = make_box_tets(3, 3, 3, Vec3(1, 1, 1));
  Dice dice(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 query = Vec3(0.5, 0.5, 0.5) + dice.in_cube();
    const Vec3 nearest = query.cwiseMax(0.0).cwiseMin(1.0);
    const Result<ClosestVolumePoint> found = closest_point(box, query);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance, (nearest - query).norm(), 1e-14);
    if (found->point.is_vertex()) {
      EXPECT_LT((box.positions()[found->point.vertex] - nearest).norm(), 1e-14);
      continue;
    }
    Vec3 point = Vec3::Zero();
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_GE(found->point.weights[k], 0);
      sum += found->point.weights[k];
      point += found->point.weights[k] * box.positions()[box.tets()[found->point.tet][k]];
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_LT((point - nearest).norm(), 1e-14);
  }
  EXPECT_EQ(closest_point(box, {1, 1, 1})->point, VolumePoint::at_vertex(63));
  EXPECT_EQ(closest_point(box, {5, 5, 5})->point, VolumePoint::at_vertex(63));
  EXPECT_FALSE(closest_point(box, {0, std::nan(""), 0}));
  EXPECT_FALSE(closest_point(*TetMesh::build(kCorners, {{0, 0, 1, 2}}), {0, 0, 0}));
}

TEST(TetModels, HaveTheSizeAskedForAndNoBadTetSlow) {
  for (const std::string name : {"box-tets", "ball-tets"}) {
    for (const Index tets : {5000, 40000}) {
      const Result<TetMesh> mesh = generate_volume(name, tets);
      ASSERT_TRUE(mesh);
      EXPECT_NEAR(mesh->tet_count(), tets, 0.15 * tets) << name;
      const CleanTets clean = clean_tets(*mesh);
      EXPECT_TRUE(clean.notes().empty());
      EXPECT_EQ(clean.turned, 0);
      double volume = 0, worst = 1;
      for (const Tet& t : clean.tets) {
        const std::span<const Vec3> p = mesh->positions();
        const TetGradient g = tet_gradient(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
        double longest = 0, steepest = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          steepest = std::max(steepest, g.gradients[i].norm());
          for (std::size_t j = 0; j < i; ++j) {
            longest = std::max(longest, (p[t[i]] - p[t[j]]).norm());
          }
        }
        volume += g.volume;
        worst = std::min(worst, 1 / (steepest * longest));
      }
      EXPECT_NEAR(volume, name == "box-tets" ? 3 : 4 * 3.14159265358979 / 3, 0.1);
      EXPECT_GT(worst, 0.3) << name;  // least height over longest edge
    }
  }
  EXPECT_FALSE(generate_volume("cone-tets", 1000));
  EXPECT_FALSE(generate_volume("box-tets", 3));
}

TEST(TetTimes, DoNotHangOnTheUnitOfLengthSlow) {
  const auto grading = [](double unit) {
    const TetMesh box = make_box_tets(24, 24, 24, Vec3::Constant(unit));
    return HeatMethod::build(shared(cells_of(box)))->grading();
  };
  const double expected = grading(1);
  EXPECT_GT(expected, 0.65) << "neither the least time nor the square of the width";
  EXPECT_LT(expected, 0.95);
  // Areas have squares beyond the range of doubles there.
  for (const double unit : {1e-100, 1e100}) EXPECT_NEAR(grading(unit), expected, 1e-9);
}

}  // namespace
}  // namespace geotherm::test
