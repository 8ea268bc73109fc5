// SPDX-License-Identifier: MIT
#include "engine/scene/draw_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/engine/models.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

/// 16 bits a coordinate.
constexpr float kNormalTolerance = 1e-4F;

glm::vec3 normal_of(const DrawMesh::Vertex& vertex) {
  const auto& n = vertex.normal_and_label;
  return glm::vec3(n[0], n[1], n[2]) / 32767.0F;
}

glm::vec3 face_normal(const Model& model, std::size_t f) {
  const auto& [a, b, c] = model.faces[f];
  const auto& p = model.positions;
  return glm::normalize(glm::cross(p[b] - p[a], p[c] - p[a]));
}

struct Shape {
  std::string name;
  Model model;
  double copies;  ///< of each vertex, at most
};
void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }

std::vector<Shape> shapes() {
  Model needles = plane_model(3, 3);
  for (auto& p : needles.positions) p.y *= 1e-6F;
  return {{"Plane", plane_model(20, 15), 2},
          {"Irregular", irregular_plane_model(20), 2.2},
          {"Sphere", model_of(sphere(4)), 2},
          {"Torus", model_of(torus(40, 20, 0.4)), 2},
          {"Moebius", model_of(moebius(40, 5)), 3},
          {"Cube", cube_model(0.5F), 6},
          {"Needles", needles, 3},
          {"OneTriangle", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 1}};
}

class DrawMeshOf : public testing::TestWithParam<Shape> {
 protected:
  const Model& model() const { return GetParam().model; }
  DrawMesh mesh() const { return build_draw_mesh(model().geometry()); }
};

TEST_P(DrawMeshOf, LabelsTheCornersOfEachFaceDifferently) {
  const DrawMesh drawn = mesh();
  ASSERT_EQ(drawn.faces.size(), model().faces.size());
  for (const auto& face : drawn.faces) {
    std::array<int, 3> labels{};
    for (std::size_t k = 0; k < 3; ++k) {
      labels[k] = drawn.vertices[face[k]].normal_and_label[3];
    }
    std::sort(labels.begin(), labels.end());
    EXPECT_EQ(labels, (std::array{-32767, 0, 32767}));
  }
}

TEST_P(DrawMeshOf, KeepsFacesAndPlaces) {
  const DrawMesh drawn = mesh();
  ASSERT_EQ(drawn.origin.size(), drawn.vertices.size());
  for (std::size_t i = 0; i < drawn.vertices.size(); ++i) {
    EXPECT_EQ(drawn.vertices[i].position, model().positions[drawn.origin[i]]);
  }
  for (std::size_t f = 0; f < drawn.faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(drawn.origin[drawn.faces[f][k]], model().faces[f][k]);
    }
  }
}

TEST_P(DrawMeshOf, CopiesVerticesRarely) {
  EXPECT_LE(static_cast<double>(mesh().vertices.size()),
            GetParam().copies * static_cast<double>(model().positions.size()));
}

TEST_P(DrawMeshOf, HasUnitNormalsOnTheSideOfTheirFaces) {
  const DrawMesh drawn = mesh();
  for (std::size_t f = 0; f < drawn.faces.size(); ++f) {
    for (const std::uint32_t v : drawn.faces[f]) {
      const glm::vec3 n = normal_of(drawn.vertices[v]);
      EXPECT_NEAR(glm::length(n), 1, kNormalTolerance);
      EXPECT_GT(glm::dot(n, face_normal(model(), f)), 0.5F);
    }
  }
}

TEST_P(DrawMeshOf, DoesNotDependOnHowNeighboursAreOriented) {
  Model turned = model();
  std::mt19937 random(3);
  for (auto& face : turned.faces) {
    if ((random() & 1U) != 0) std::swap(face[1], face[2]);
  }
  const DrawMesh drawn = mesh();
  const DrawMesh other = build_draw_mesh(turned.geometry());
  for (std::size_t f = 0; f < drawn.faces.size(); ++f) {
    const bool flipped = turned.faces[f] != model().faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t there = flipped && k > 0 ? 3 - k : k;
      const glm::vec3 a = normal_of(drawn.vertices[drawn.faces[f][k]]);
      const glm::vec3 b = normal_of(other.vertices[other.faces[f][there]]);
      EXPECT_LE(glm::length(a - (flipped ? -b : b)), kNormalTolerance);
    }
  }
}

TEST_P(DrawMeshOf, MovesToWhatIsBuiltOfThePositions) {
  MovingDrawMesh moving(model().geometry());
  Model bent = model();
  std::mt19937 random(7);
  int kept = 0;
  for (const float reach : {1e-3F, 1e-2F, 0.3F, 1e-3F, 0.0F}) {
    std::uniform_real_distribution<float> step(-reach, reach);
    for (std::size_t v = 0; v < bent.positions.size() / 2 + 1; ++v) {
      bent.positions[v] += glm::vec3(step(random), step(random), step(random));
    }
    if (reach == 0) bent = model();
    kept += moving.move(bent.positions) ? 1 : 0;
    const DrawMesh built = build_draw_mesh(bent.geometry());
    ASSERT_EQ(moving.mesh().faces, built.faces) << reach;
    EXPECT_EQ(moving.mesh().origin, built.origin);
    for (std::size_t i = 0; i < built.vertices.size(); ++i) {
      ASSERT_EQ(moving.mesh().vertices[i].position, built.vertices[i].position);
      ASSERT_EQ(moving.mesh().vertices[i].normal_and_label, built.vertices[i].normal_and_label);
    }
  }
  EXPECT_GT(kept, 0);
}

INSTANTIATE_TEST_SUITE_P(All, DrawMeshOf, testing::ValuesIn(shapes()),
                         [](const auto& test) { return test.param.name; });

TEST_P(DrawMeshOf, GivesEachCopyTheOpennessOfItsSide) {
  const Model& own = model();
  std::vector<Openness> openness;
  for (std::size_t v = 0; v < own.positions.size(); ++v) {
    openness.push_back({{0, 0, 1}, 1, 0.2F});
  }
  SurfaceGeometry geometry = own.geometry();
  geometry.openness = openness;
  const DrawMesh drawn = build_draw_mesh(geometry);
  MovingDrawMesh moving(own.geometry());
  moving.move(own.positions, openness);
  for (std::size_t i = 0; i < drawn.vertices.size(); ++i) {
    const DrawMesh::Vertex& vertex = drawn.vertices[i];
    const bool up = vertex.normal_and_label[2] >= 0;
    EXPECT_EQ(vertex.openness[up ? 0 : 1], 255);
    EXPECT_EQ(vertex.openness[up ? 1 : 0], 51);
    EXPECT_EQ(vertex.openness, moving.mesh().vertices[i].openness);
  }
}

TEST(DrawMesh, GivesEachSideOfACubeItsOwnNormal) {
  const Model cube = cube_model(0.5F);
  const DrawMesh drawn = build_draw_mesh(cube.geometry());
  for (std::size_t f = 0; f < drawn.faces.size(); ++f) {
    for (const std::uint32_t v : drawn.faces[f]) {
      EXPECT_LE(glm::length(normal_of(drawn.vertices[v]) - face_normal(cube, f)), kNormalTolerance);
    }
  }
}

TEST(DrawMesh, HasTheNormalsOfASphere) {
  const DrawMesh drawn = build_draw_mesh(model_of(sphere(4)).geometry());
  constexpr float kFacets = 0.01F;  // the sphere is a polyhedron
  for (const DrawMesh::Vertex& vertex : drawn.vertices) {
    EXPECT_LE(glm::length(normal_of(vertex) - vertex.position), kFacets);
  }
}

TEST(DrawMesh, SharesOneNormalOnASmoothSurface) {
  // Not so where each face's own neighbours are weighed, as at creases.
  const Model model = model_of(sphere(3));
  const DrawMesh drawn = build_draw_mesh(model.geometry());
  std::vector<glm::vec3> first(model.positions.size(), glm::vec3(0));
  for (std::size_t i = 0; i < drawn.vertices.size(); ++i) {
    glm::vec3& n = first[drawn.origin[i]];
    if (n == glm::vec3(0)) n = normal_of(drawn.vertices[i]);
    EXPECT_EQ(normal_of(drawn.vertices[i]), n);
  }
}

TEST(DrawMesh, TakesFacesWithoutArea) {
  Model model = plane_model(1, 1);
  model.faces.push_back({0, 0, 1});
  model.faces.push_back({2, 2, 2});
  const DrawMesh drawn = build_draw_mesh(model.geometry());
  ASSERT_EQ(drawn.faces.size(), 4U);
  for (const DrawMesh::Vertex& vertex : drawn.vertices) {
    EXPECT_NEAR(normal_of(vertex).z, 1, kNormalTolerance);
  }
}

TEST(DrawMesh, IsEmptyWithoutFaces) {
  const DrawMesh drawn = build_draw_mesh(SurfaceGeometry{});
  EXPECT_TRUE(drawn.vertices.empty());
  EXPECT_TRUE(drawn.faces.empty());
}

}  // namespace
}  // namespace geotherm::test
