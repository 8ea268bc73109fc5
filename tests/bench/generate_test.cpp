// SPDX-License-Identifier: MIT
#include "bench/models/generate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "geotherm/mesh_report.h"

namespace geotherm {
namespace {

// Share by which the number of faces may differ from what was asked for: the contract's "about".
constexpr double kCountTolerance = 0.03;
// Degrees. Models are used to compare solvers: none may owe its errors to needles.
constexpr double kSmallestAngle = 8;
// Degrees, and the share of all angles that must lie between them.
constexpr double kLowAngle = 25;
constexpr double kHighAngle = 110;
constexpr double kGoodShare = 0.98;

struct Case {
  const char* name;
  Index faces;
  int boundary_loops;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name << " with " << c.faces; }

/// What the claims below are about: directed edges and how the faces hang together.
struct Structure {
  bool oriented = true;  ///< no directed edge belongs to two faces
  bool single_fans = true;
  int components = 0;
  int boundary_loops = 0;
  bool all_vertices_used = true;
};

Index root_of(std::vector<Index>& parent, Index v) {
  while (parent[static_cast<std::size_t>(v)] != v) {
    v = parent[static_cast<std::size_t>(v)] =
        parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(v)])];
  }
  return v;
}

/// True when the edges opposite to a vertex (start, end) make one closed ring or one open chain.
bool is_single_fan(const std::vector<std::pair<Index, Index>>& link) {
  std::map<Index, Index> next;
  std::map<Index, int> arrivals;
  for (const auto& [from, to] : link) {
    if (!next.emplace(from, to).second || ++arrivals[to] > 1) return false;
  }
  Index start = link.front().first;
  for (const auto& [from, to] : link) {
    if (arrivals.find(from) == arrivals.end()) start = from;
  }
  std::size_t steps = 0;
  Index at = start;
  do {
    const auto step = next.find(at);
    if (step == next.end()) break;
    at = step->second;
    ++steps;
  } while (at != start && steps <= link.size());
  return steps == link.size();
}

Structure structure_of(const TriangleMesh& mesh) {
  Structure found;
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  std::vector<std::pair<Index, Index>> edges;
  std::vector<std::vector<std::pair<Index, Index>>> links(vertices);
  std::vector<Index> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0);
  for (const Face& face : mesh.faces()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = face[k];
      const Index b = face[(k + 1) % 3];
      edges.emplace_back(a, b);
      links[static_cast<std::size_t>(a)].emplace_back(b, face[(k + 2) % 3]);
      parent[static_cast<std::size_t>(root_of(parent, a))] = root_of(parent, b);
    }
  }
  std::sort(edges.begin(), edges.end());
  found.oriented = std::adjacent_find(edges.begin(), edges.end()) == edges.end();
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (root_of(parent, v) == v) ++found.components;
    const auto& link = links[static_cast<std::size_t>(v)];
    if (link.empty()) found.all_vertices_used = false;
    if (!link.empty() && !is_single_fan(link)) found.single_fans = false;
  }
  std::map<Index, Index> border;  // single fans: at most one border edge starts at a vertex
  for (const auto& [a, b] : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), std::make_pair(b, a))) border[a] = b;
  }
  while (!border.empty()) {
    ++found.boundary_loops;
    for (auto at = border.begin(); at != border.end();) {
      const Index to = at->second;
      border.erase(at);
      at = border.find(to);
    }
  }
  return found;
}

/// All angles of the mesh in degrees.
std::vector<double> angles_of(const TriangleMesh& mesh) {
  std::vector<double> angles;
  for (const Face& face : mesh.faces()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions()[static_cast<std::size_t>(face[k])];
      const Vec3 u = mesh.positions()[static_cast<std::size_t>(face[(k + 1) % 3])] - p;
      const Vec3 v = mesh.positions()[static_cast<std::size_t>(face[(k + 2) % 3])] - p;
      angles.push_back(std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi);
    }
  }
  return angles;
}

class GenerateModelTest : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    Result<TriangleMesh> made = generate_model(GetParam().name, GetParam().faces);
    ASSERT_TRUE(made) << made.error().message;
    mesh_ = std::make_unique<TriangleMesh>(std::move(*made));
  }
  std::unique_ptr<TriangleMesh> mesh_;
};

TEST_P(GenerateModelTest, IsAnOrientedManifoldOfOneComponentWithItsBoundaryLoops) {
  const Structure found = structure_of(*mesh_);
  EXPECT_TRUE(found.oriented);
  EXPECT_TRUE(found.single_fans);
  EXPECT_TRUE(found.all_vertices_used);
  EXPECT_EQ(found.components, 1);
  EXPECT_EQ(found.boundary_loops, GetParam().boundary_loops);
}

TEST_P(GenerateModelTest, HasAboutTheFacesAskedForAndNoNeedles) {
  EXPECT_NEAR(static_cast<double>(mesh_->face_count()) / GetParam().faces, 1, kCountTolerance);
  const std::vector<double> angles = angles_of(*mesh_);
  EXPECT_GE(*std::min_element(angles.begin(), angles.end()), kSmallestAngle);
  const auto good = std::count_if(angles.begin(), angles.end(), [](double angle) {
    return angle >= kLowAngle && angle <= kHighAngle;
  });
  EXPECT_GE(static_cast<double>(good) / static_cast<double>(angles.size()), kGoodShare);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.name) + "_" + std::to_string(info.param.faces);
}

INSTANTIATE_TEST_SUITE_P(AllSizes, GenerateModelTest,
                         testing::Values(Case{"terrain", 2000, 1}, Case{"terrain", 33000, 1},
                                         Case{"sleeve", 2000, 2}, Case{"sleeve", 37000, 2},
                                         Case{"cube", 2000, 0}, Case{"cube", 30000, 0},
                                         Case{"gargoyle", 2000, 0}, Case{"gargoyle", 20000, 0},
                                         Case{"bunny", 2000, 0}, Case{"bunny", 4000, 0},
                                         Case{"bunny", 16000, 0}),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Slow, GenerateModelTest,
                         testing::Values(Case{"terrain", 132000, 1}, Case{"sleeve", 148000, 2},
                                         Case{"cube", 120000, 0}, Case{"gargoyle", 200000, 0}),
                         case_name);

class GenerateModelNameTest : public testing::TestWithParam<const char*> {};

TEST_P(GenerateModelNameTest, HasTheSameBitsOnASecondRun) {
  constexpr Index kFaces = 6000;
  const Result<TriangleMesh> first = generate_model(GetParam(), kFaces);
  const Result<TriangleMesh> second = generate_model(GetParam(), kFaces);
  ASSERT_TRUE(first && second);
  ASSERT_EQ(first->vertex_count(), second->vertex_count());
  EXPECT_TRUE(std::equal(first->faces().begin(), first->faces().end(), second->faces().begin(),
                         second->faces().end()));
  EXPECT_EQ(std::memcmp(first->positions().data(), second->positions().data(),
                        first->positions().size_bytes()),
            0);
}

TEST_P(GenerateModelNameTest, SmallestSizeIsASingleCleanPieceToo) {
  const Result<TriangleMesh> made = generate_model(GetParam(), kMinModelFaces);
  ASSERT_TRUE(made);
  const Structure found = structure_of(*made);
  EXPECT_TRUE(found.oriented && found.single_fans && found.all_vertices_used);
  EXPECT_EQ(found.components, 1);
  constexpr double kCoarseTolerance = 0.06;  // so few faces come in large steps
  EXPECT_NEAR(static_cast<double>(made->face_count()) / kMinModelFaces, 1, kCoarseTolerance);
}

TEST_P(GenerateModelNameTest, StopsWhenTheCallerCancels) {
  int calls = 0;
  const Result<TriangleMesh> made =
      generate_model(GetParam(), 2000, [&](std::string_view, double share) {
        EXPECT_LE(share, 1);
        return ++calls < 3;
      });
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(calls, 3);
}

class ClosedModelTest : public testing::TestWithParam<const char*> {};

TEST_P(ClosedModelTest, FacesLookOutwards) {
  const Result<TriangleMesh> made = generate_model(GetParam(), 2000);
  ASSERT_TRUE(made);
  double volume = 0;
  for (const Face& face : made->faces()) {
    const auto p = [&](std::size_t k) {
      return made->positions()[static_cast<std::size_t>(face[k])];
    };
    volume += p(0).dot(p(1).cross(p(2))) / 6;
  }
  EXPECT_GT(volume, 0);
}

TEST(GenerateModel, TerrainLooksUp) {
  const Result<TriangleMesh> made = generate_model("terrain", 2000);
  ASSERT_TRUE(made);
  const auto up = [&](const Face& face) {
    const auto p = [&](std::size_t k) {
      return made->positions()[static_cast<std::size_t>(face[k])];
    };
    return (p(1) - p(0)).cross(p(2) - p(0)).y() > 0;
  };
  EXPECT_TRUE(std::all_of(made->faces().begin(), made->faces().end(), up));
}

std::string model_name(const testing::TestParamInfo<const char*>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(ClosedModels, ClosedModelTest,
                         testing::Values("cube", "gargoyle", "bunny"), model_name);
INSTANTIATE_TEST_SUITE_P(AllModels, GenerateModelNameTest,
                         testing::Values("terrain", "sleeve", "cube", "gargoyle", "bunny"),
                         model_name);

TEST(WavingModel, MovesWithoutFoldingAndComesBack) {
  constexpr double kTurn = 2 * std::numbers::pi, kRoundOff = 1e-12;
  for (const char* name : {"bunny", "terrain"}) {
    const auto mesh = generate_model(name, 2000);
    ASSERT_TRUE(mesh);
    const auto begin = waving(*mesh, 0), middle = waving(*mesh, kTurn / 2),
               end = waving(*mesh, kTurn);
    const double size = inspect_mesh(*mesh).box_max.norm();
    double moved = 0;
    for (std::size_t v = 0; v < begin.size(); ++v) {
      EXPECT_LT((begin[v] - end[v]).norm(), kRoundOff * size);
      moved = std::max(moved, (begin[v] - middle[v]).norm());
    }
    EXPECT_GT(moved, 0.1 * size);
    const auto here = mesh->moved(begin), there = mesh->moved(middle);
    ASSERT_TRUE(here && there);
    for (const auto& frame : {*here, *there}) {
      const MeshReport report = inspect_mesh(frame);
      EXPECT_EQ(report.degenerate_faces, 0);
      EXPECT_GT(report.smallest_angle, 2);
    }
  }
}

TEST(GenerateModel, UnknownNameIsAnErrorThatListsTheNames) {
  const Result<TriangleMesh> made = generate_model("teapot", 2000);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kNotAvailable);
  EXPECT_NE(sentence(made.error()).find("teapot"), std::string::npos);
  for (const char* name : {"terrain", "sleeve", "cube", "gargoyle", "bunny"}) {
    EXPECT_NE(sentence(made.error()).find(name), std::string::npos) << name;
  }
}

TEST(GenerateModel, SizesOutsideTheLimitsAreErrorsThatSayTheLimits) {
  for (const Index faces : {-1, 1, kMinModelFaces - 1, kMaxModelFaces + 1}) {
    const Result<TriangleMesh> made = generate_model("cube", faces);
    ASSERT_FALSE(made) << faces;
    EXPECT_EQ(made.error().code, ErrorCode::kBadInput);
    EXPECT_NE(sentence(made.error()).find(std::to_string(faces)), std::string::npos);
    EXPECT_NE(sentence(made.error()).find("500 to 5000000"), std::string::npos);
  }
}

}  // namespace
}  // namespace geotherm
