// SPDX-License-Identifier: MIT
#include "app/picture/cut_picture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "app/picture/picture_scale.h"
#include "app/session/model.h"
#include "app/session/space.h"
#include "bench/models/volumes.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using app::CutPicture;
using app::kNoPictureValue;
using app::Peel;
using app::PeelSide;
using app::PictureData;
using app::PictureSettings;

/// Of floats within radius 1.
constexpr float kFloat = 1e-6F;

class CutPictures : public testing::Test {
 protected:
  CutPictures() {
    const auto border = boundary(*volume);
    const auto positions = volume->positions();
    mesh = std::make_shared<const TriangleMesh>(
        *TriangleMesh::build({positions.begin(), positions.end()}, border->faces));
    whole = app::picture_of(*mesh, volume);
  }

  /// A linear function in place of distances: its interpolation is exact.
  static double linear(const Vec3& p) { return 2 + p.x() - 0.5 * p.y() + 0.25 * p.z(); }
  void set_linear() {
    std::vector<double> values;
    for (const Vec3& p : volume->positions()) values.push_back(linear(p));
    app::add_distances(whole, values);
  }
  static PictureSettings sliced(const std::array<double, 3>& normal, double at) {
    PictureSettings settings;
    settings.slice = normal;
    settings.slice_at = at;
    return settings;
  }
  static PictureSettings peeled(PeelSide side, double share) {
    PictureSettings settings;
    settings.peel = {side, share};
    return settings;
  }
  Vec3 in_model(const PictureData::Vector& p) const {
    return whole.centre + whole.model_per_scene * Vec3(p[0], p[1], p[2]);
  }

  std::shared_ptr<const TetMesh> volume =
      std::make_shared<const TetMesh>(make_box_tets(6, 5, 4, Vec3(2, 1.5, 1)));
  std::shared_ptr<const TriangleMesh> mesh;
  PictureData whole;
};

TEST_F(CutPictures, HaveVerticesInsideTheVolumeWhereTheyAre) {
  for (std::size_t v = 0; v < whole.positions.size(); ++v) {
    EXPECT_LT((in_model(whole.positions[v]) - volume->positions()[v]).norm(), kFloat) << v;
  }
}

TEST_F(CutPictures, InterpolateValuesLinearlyOnTheCut) {
  set_linear();
  for (const double at : {0.2, 0.5, 0.9}) {
    const CutPicture cut = app::cut_picture(whole, sliced({1, 0.3, -0.2}, at));
    const PictureData& data = cut.data;
    ASSERT_GT(data.positions.size(), whole.positions.size());
    ASSERT_EQ(data.values.size(), data.positions.size());
    for (std::size_t v = 0; v < data.values.size(); ++v) {
      EXPECT_NEAR(data.values[v] * data.value_unit, linear(in_model(data.positions[v])),
                  4 * kFloat);
    }
  }
}

TEST_F(CutPictures, LeaveNothingBeyondThePlaneAndKeepPlaceAndScaleOfTheWhole) {
  set_linear();
  const CutPicture cut = app::cut_picture(whole, sliced({0, 0, 2}, 0.25));
  for (const auto& face : cut.data.faces) {
    for (const auto v : face) EXPECT_LE(in_model(cut.data.positions[v]).z(), 0.25 + kFloat);
  }
  EXPECT_EQ(cut.data.value_unit, whole.value_unit);
  EXPECT_EQ(cut.data.model_per_scene, whole.model_per_scene);
  EXPECT_EQ(cut.data.centre, whole.centre);
  EXPECT_FALSE(app::is_cut(whole, PictureSettings()));
}

TEST_F(CutPictures, HaveNoValueWhereAnEndHasNone) {
  set_linear();
  whole.values.assign(whole.values.size(), kNoPictureValue);
  const CutPicture cut = app::cut_picture(whole, sliced({1, 0, 0}, 0.4));
  EXPECT_TRUE(std::ranges::all_of(cut.data.values, [](float x) { return x == kNoPictureValue; }));
}

TEST_F(CutPictures, AreEmptyWhereNothingIsLeft) {
  set_linear();
  EXPECT_TRUE(app::cut_picture(whole, sliced({1, 0, 0}, 0)).data.faces.empty());
  EXPECT_TRUE(app::cut_picture(whole, peeled(PeelSide::kBelow, 0)).data.faces.empty());
}

TEST_F(CutPictures, KeepWhatFacesOfTheBorderShow) {
  for (std::size_t f = 0; f < whole.faces.size(); ++f) {
    whole.face_values.push_back(static_cast<float>(f));
  }
  const CutPicture cut = app::cut_picture(whole, sliced({0, 1, 0}, 0.5));
  ASSERT_EQ(cut.data.face_values.size(), cut.data.faces.size());
  for (std::size_t f = 0; f < cut.origin.size(); ++f) {
    EXPECT_EQ(cut.data.face_values[f],
              cut.origin[f] == kNoIndex ? kNoPictureValue : static_cast<float>(cut.origin[f]));
  }
}

TEST_F(CutPictures, PeelOffTheTetsThatAreNotOnTheirSideOfTheShare) {
  set_linear();
  for (const auto side : {PeelSide::kBelow, PeelSide::kAbove}) {
    const CutPicture cut = app::cut_picture(whole, peeled(side, 0.6));
    ASSERT_FALSE(cut.data.faces.empty());
    EXPECT_LT(std::ranges::count(cut.origin, kNoIndex), static_cast<long>(cut.origin.size()));
    EXPECT_GT(std::ranges::count(cut.origin, kNoIndex), 0);
    for (const auto& face : cut.data.faces) {
      for (const auto v : face) {
        const double share = cut.data.values[v];
        EXPECT_TRUE(side == PeelSide::kBelow ? share <= 0.6 : share >= 0.6) << share;
      }
    }
  }
}

TEST_F(CutPictures, PeelOffNothingWithoutValues) {
  EXPECT_FALSE(app::is_cut(whole, peeled(PeelSide::kBelow, 0.5)));
}

TEST_F(CutPictures, AreOpenOnSurfaces) {
  const PictureData surface = app::picture_of(*mesh);
  const CutPicture cut = app::cut_picture(surface, sliced({1, 0, 0}, 0.5));
  ASSERT_FALSE(cut.data.faces.empty());
  EXPECT_EQ(std::ranges::count(cut.origin, kNoIndex), 0);
}

TEST_F(CutPictures, HaveRegionsOnTheCutByTheNearerSource) {
  // Distances from both ends of the box, which meet in the middle.
  std::vector<double> values;
  for (const Vec3& p : volume->positions()) {
    values.push_back(std::min(p.x(), 2 - p.x()));
    whole.nearest.push_back(p.x() <= 1 ? 0 : 1);
  }
  app::add_distances(whole, values);
  const CutPicture cut = app::cut_picture(whole, sliced({0, 0, 1}, 0.4));
  ASSERT_EQ(cut.data.nearest.size(), cut.data.positions.size());
  for (std::size_t v = whole.positions.size(); v < cut.data.nearest.size(); ++v) {
    const double x = in_model(cut.data.positions[v]).x();
    if (std::abs(x - 1) < 1.0 / 3) continue;  // within a cell of where they meet
    EXPECT_EQ(cut.data.nearest[v], x < 1 ? 0 : 1) << x;
  }
}

TEST_F(CutPictures, ShowTheFieldsOfTheTetsTheyGoThrough) {
  // u and the distances are linear, so that their gradients are known in every tet.
  const Vec3 slope(1, -0.5, 0.25);
  DistanceResult result;
  for (const Vec3& p : volume->positions()) {
    result.distances.push_back(linear(p));
    result.log_heat.push_back(std::log(linear(p)));
  }
  set_linear();
  app::add_fields(whole, *mesh, result);
  app::set_face_values(whole, *mesh, app::View::kEikonalError, &result);
  PictureSettings settings = sliced({1, 1, 0}, 0.5);
  settings.peel = {PeelSide::kBelow, 0.9};
  for (const PictureData& data : {whole, app::cut_picture(whole, settings).data}) {
    ASSERT_EQ(data.heat_directions.size(), data.faces.size());
    ASSERT_EQ(data.face_values.size(), data.faces.size());
    for (std::size_t f = 0; f < data.faces.size(); ++f) {
      std::array<Vec3, 3> at;
      for (std::size_t k = 0; k < 3; ++k) at[k] = in_model(data.positions[data.faces[f][k]]);
      const Vec3 normal = (at[1] - at[0]).cross(at[2] - at[0]).normalized();
      const Vec3 x = -slope.normalized();
      const auto& [a, b, c] = data.heat_directions[f];
      constexpr double kOfNormals = 1e-4;  // thin faces have normals of few digits
      EXPECT_LT((Vec3(a, b, c) - (x - x.dot(normal) * normal)).norm(), kOfNormals);
      EXPECT_NEAR(data.face_values[f], std::abs(slope.norm() - 1), 4 * kFloat);
    }
  }
}

TEST_F(CutPictures, HaveNoSourceAndNoPathInTheAir) {
  for (const double x : {-0.5, 0.0, 0.5}) {
    const PictureData::Vector at{static_cast<float>(x), 0, 0};
    whole.sources.push_back({at, at});
  }
  whole.lines.emplace_back().points = {{-0.5F, 0, 0}, {0.5F, 0, 0}};
  const CutPicture cut = app::cut_picture(whole, sliced({1, 0, 0}, 0.5));
  ASSERT_EQ(cut.data.sources.size(), 2U);
  EXPECT_EQ(cut.data.sources[1].from[0], 0);
  EXPECT_TRUE(std::isfinite(cut.data.lines[0].points[0][0]));
  EXPECT_TRUE(std::isnan(cut.data.lines[0].points[1][0]));
}

TEST_F(CutPictures, MarkSourcesInsideTetsWhereTheyAre) {
  SourceSet sources;
  sources.cell_points.push_back({7, {0.1, 0.2, 0.3, 0.4}});
  app::Model model{"box", {}, mesh, 0, {}};
  model.space = *app::TetSpace::build(*volume);
  app::add_sources(whole, *mesh, sources, app::places_in_cells(model, sources));
  ASSERT_EQ(whole.sources.size(), 1U);
  Vec3 expected = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    expected += 0.1 * static_cast<double>(k + 1) * volume->positions()[volume->tets()[7][k]];
  }
  EXPECT_LT((in_model(whole.sources[0].from) - expected).norm(), kFloat);
}

}  // namespace
}  // namespace geotherm::test
