// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/directions.h"
#include "geotherm/heat_method.h"
#include "tests/support/broken_mesh.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

std::shared_ptr<const VectorHeat> vector_heat(const MeshPtr& mesh,
                                              const SpreadOptions& options = {}) {
  auto built = VectorHeat::build(mesh, options);
  EXPECT_TRUE(built) << built.error().message;
  return *built;
}

/// The vector heat method with dense matrices, on triangles that are Delaunay: tangent vectors are
/// complex numbers whose zero direction is the first axis of `frames`, and all else comes of
/// positions. Source: Sharp, Soliman, Crane 2019, section 5.
class DenseVectorHeat {
 public:
  DenseVectorHeat(const TriangleMesh& mesh, std::span<const TangentFrame> frames)
      : mesh_(mesh), frames_(frames), size_(mesh.vertex_count()) {
    sum_angles();
    double edges = 0, length = 0;
    mass_ = Eigen::VectorXd::Zero(size_);
    Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(size_, size_);
    Eigen::MatrixXcd connection = Eigen::MatrixXcd::Zero(size_, size_);
    for (const Face& face : mesh.faces()) {
      for (int k = 0; k < 3; ++k) {
        const Index i = face[k], j = face[(k + 1) % 3], o = face[(k + 2) % 3];
        const double weight = 1 / std::tan(angle(o, i, j)) / 2;
        const bool border = !third_.contains({j, i});
        edges += border ? 1 : 0.5;
        length += (border ? 1 : 0.5) * (at(i) - at(j)).norm();
        mass_[i] += (at(j) - at(i)).cross(at(o) - at(i)).norm() / 6;
        laplacian(i, i) += weight, laplacian(j, j) += weight;
        laplacian(i, j) -= weight, laplacian(j, i) -= weight;
        const std::complex<double> turn =
            std::polar(1.0, angle_of_.at({i, j}) - angle_of_.at({j, i}) + std::numbers::pi);
        connection(i, i) += weight, connection(j, j) += weight;
        connection(i, j) -= weight * turn, connection(j, i) -= weight * std::conj(turn);
      }
    }
    const double t = (length / edges) * (length / edges);
    scalar_ = Eigen::MatrixXd(mass_.asDiagonal()) + t * laplacian;
    vector_ = Eigen::MatrixXcd(mass_.cast<std::complex<double>>().asDiagonal()) + t * connection;
  }

  Eigen::VectorXcd transport(const std::vector<TangentVector>& vectors) const {
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(size_);
    Eigen::MatrixXd heat = Eigen::MatrixXd::Zero(size_, 2);
    for (const TangentVector& v : vectors) {
      right[v.vertex] += std::complex<double>(v.x, v.y);
      heat(v.vertex, 0) += std::hypot(v.x, v.y);
      heat(v.vertex, 1) += 1;
    }
    const Eigen::VectorXcd spread = vector_.partialPivLu().solve(right);
    const Eigen::MatrixXd warm = scalar_.partialPivLu().solve(heat);
    Eigen::VectorXcd out(size_);
    for (Index i = 0; i < size_; ++i) {
      out[i] = spread[i] / std::abs(spread[i]) * warm(i, 0) / warm(i, 1);
    }
    return out;
  }

  Eigen::VectorXd extend(const std::vector<Index>& vertices,
                         const std::vector<double>& values) const {
    Eigen::MatrixXd heat = Eigen::MatrixXd::Zero(size_, 2);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      heat(vertices[i], 0) += values[i];
      heat(vertices[i], 1) += 1;
    }
    const Eigen::MatrixXd warm = scalar_.partialPivLu().solve(heat);
    return warm.col(0).cwiseQuotient(warm.col(1));
  }

 private:
  const Vec3& at(Index v) const { return mesh_.positions()[v]; }
  double angle(Index tip, Index a, Index b) const {
    const Vec3 x = at(a) - at(tip), y = at(b) - at(tip);
    return std::acos(x.dot(y) / x.norm() / y.norm());
  }

  /// Goes round each vertex from the first edge of its frame.
  void sum_angles() {
    std::vector<double> sum(static_cast<std::size_t>(size_), 0.0);
    for (const Face& face : mesh_.faces()) {
      for (int k = 0; k < 3; ++k) {
        third_[{face[k], face[(k + 1) % 3]}] = face[(k + 2) % 3];
        sum[face[k]] += angle(face[k], face[(k + 1) % 3], face[(k + 2) % 3]);
      }
    }
    for (Index v = 0; v < size_; ++v) {
      double begin = 0;
      const bool border = frames_[v].on_boundary;
      const double scale = border ? 1 : 2 * std::numbers::pi / sum[v];
      for (Index to = frames_[v].first; !angle_of_.contains({v, to});) {
        angle_of_[{v, to}] = scale * begin;
        const auto face = third_.find({v, to});
        if (face == third_.end()) break;
        begin += angle(v, to, face->second);
        to = face->second;
      }
    }
  }

  const TriangleMesh& mesh_;
  std::span<const TangentFrame> frames_;
  Index size_;
  std::map<std::pair<Index, Index>, Index> third_;  // of the face with the side from i to j
  std::map<std::pair<Index, Index>, double> angle_of_;
  Eigen::VectorXd mass_;
  Eigen::MatrixXd scalar_;
  Eigen::MatrixXcd vector_;
};

struct DenseCase {
  const char* name;
  Draft (*draft)();
};

class VectorHeatAgainstDense : public testing::TestWithParam<DenseCase> {};

/// The figure that was asked for.
constexpr double kAgree = 1e-8;

TEST_P(VectorHeatAgainstDense, MatricesGivesTheSameVectors) {
  const MeshPtr mesh = finish(GetParam().draft());
  for (const std::string& backend : backend_names()) {
    const auto built = VectorHeat::build(mesh, {backend, 1, 0});
    ASSERT_TRUE(built) << built.error().message;
    const DenseVectorHeat dense(*mesh, *(*built)->frames());
    const Index last = mesh->vertex_count() - 1;
    const std::vector<TangentVector> vectors = {{3, 1, 0}, {last / 2, -0.5, 2}, {last, 0.1, -0.7}};
    const auto found = (*built)->transport(vectors);
    ASSERT_TRUE(found) << found.error().message;
    const Eigen::VectorXcd want = dense.transport(vectors);
    for (Index v = 0; v <= last; ++v) {
      const auto [x, y] = found->components[v];
      EXPECT_NEAR(std::abs(std::complex<double>(x, y) - want[v]), 0, kAgree * std::abs(want[v]))
          << backend << ", vertex " << v;
      const TangentFrame& frame = (*(*built)->frames())[v];
      EXPECT_NEAR((found->vectors[v] - x * frame.e1 - y * frame.e2).norm(), 0, kAgree);
    }
  }
}

TEST_P(VectorHeatAgainstDense, MatricesGivesTheSameValues) {
  const MeshPtr mesh = finish(GetParam().draft());
  const auto usual = vector_heat(mesh);
  const DenseVectorHeat dense(*mesh, *usual->frames());
  const Index last = mesh->vertex_count() - 1;
  const std::vector<Index> vertices = {3, last / 2, last};
  const std::vector<double> values = {-1, 5, 2.5};
  const Eigen::VectorXd want = dense.extend(vertices, values);
  for (const std::string& backend : backend_names()) {
    const auto found = vector_heat(mesh, {backend, 1, 0})->extend(vertices, values);
    ASSERT_TRUE(found) << found.error().message;
    for (Index v = 0; v <= last; ++v) {
      EXPECT_NEAR(found->values[v], want[v], 5 * kAgree) << backend << ", vertex " << v;
    }
  }
}

/// Heat far from the sources is far below what conjugate gradients end by.
TEST(Transport, ByIterationsIsThatByFactorsEverywhere) {
  const MeshPtr mesh = finish(prism(60, 40, 0.5));
  const std::vector<TangentVector> vectors = {{3, 1, 0}, {700, -0.5, 2}};
  for (const double factor : {1.0, 30.0, 3000.0}) {
    const auto direct = vector_heat(mesh, {{}, factor, 0})->transport(vectors);
    const auto iterated = vector_heat(mesh, {"cg", factor, 0})->transport(vectors);
    ASSERT_TRUE(direct && iterated);
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      EXPECT_NEAR((direct->vectors[v] - iterated->vectors[v]).norm(), 0, kAgree) << v;
    }
  }
}

/// What a heat method has is used, and gives the same bits.
TEST(Transport, BesideAHeatMethodIsTheSame) {
  Index inserted = 0;
  for (const Draft& draft : {sphere(3), jittered_plane(14, 0.4, 8), random_delaunay(200, 3)}) {
    const MeshPtr mesh = finish(draft);
    const auto method = HeatMethod::build(mesh);
    ASSERT_TRUE(method);
    inserted += method->refinement().points;
    const auto beside = VectorHeat::build(mesh, {}, {}, &*method);
    ASSERT_TRUE(beside);
    const std::vector<TangentVector> vectors = {{3, 1, 0}, {70, -0.5, 2}};
    const auto alone = vector_heat(mesh)->transport(vectors),
               shared = (*beside)->transport(vectors);
    ASSERT_TRUE(alone && shared);
    EXPECT_EQ(alone->components, shared->components);
  }
  EXPECT_GT(inserted, 0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, VectorHeatAgainstDense,
                         testing::Values(DenseCase{"sphere", [] { return sphere(3); }},
                                         DenseCase{"icosahedron", [] { return sphere(1); }},
                                         DenseCase{"cone", [] { return pyramid(7, 6, 0.6); }},
                                         DenseCase{"prism", [] { return prism(16, 8, 0.5); }},
                                         DenseCase{"plane",
                                                   [] { return plane_grid(9, 7, 1, 0.8); }}),
                         [](const auto& test) { return std::string(test.param.name); });

/// Where the surface is flat, vectors stay parallel whatever the triangles are: directions are
/// carried through flips.
double parallel_error(const Draft& draft) {
  const MeshPtr mesh = finish(draft);
  const auto heat = vector_heat(mesh);
  const Index source = mesh->vertex_count() / 2;
  const auto found = heat->transport(std::vector<TangentVector>{{source, 0.6, -0.8}});
  EXPECT_TRUE(found) << found.error().message;
  const TangentFrame& frame = (*heat->frames())[source];
  const Vec3 want = 0.6 * frame.e1 - 0.8 * frame.e2;
  double most = 0;
  for (const Vec3& vector : found->vectors) most = std::max(most, (vector - want).norm());
  return most;
}

TEST(Transport, KeepsVectorsParallelOnAJitteredPlane) {
  EXPECT_LT(parallel_error(jittered_plane(14, 0.4, 8)), kAgree);
}
TEST(Transport, KeepsVectorsParallelOnSlivers) {
  EXPECT_LT(parallel_error(graded_plane(16, 1e3)), kAgree);
}
/// Heat falls below the least double after some seven hundred edges.
TEST(Transport, ReachesTheEndOfAStripOfThreeThousandEdges) {
  const MeshPtr mesh = finish(plane_grid(3000, 1, 3000, 1));
  for (const char* backend : {"", "cg"}) {
    const auto heat = vector_heat(mesh, {backend, 1, 0});
    const auto found = heat->transport(std::vector<TangentVector>{{0, 1, 0}});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->warnings.empty(), backend[0] != 0);  // iterations go on in any range
    for (const Vec3& vector : found->vectors) {
      EXPECT_NEAR((vector - (*heat->frames())[0].e1).norm(), 0, kAgree);
    }
  }
}
TEST(Extend, ReachesTheEndOfAStripAtTheTimeAskedFor) {
  const auto heat = vector_heat(finish(plane_grid(3000, 1, 3000, 1)));
  const auto found = heat->extend(std::vector<Index>{0, 6001}, std::vector<double>{-7, 3});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_TRUE(found->warnings.empty());
  EXPECT_NEAR(found->values[1000], -7, kAgree);
  EXPECT_NEAR(found->values[5000], 3, kAgree);
}

/// Along meridians from the pole, to the order of the mesh: the angle between them stays.
double error_on_sphere(int level) {
  const MeshPtr mesh = finish(sphere(level));
  const auto heat = vector_heat(mesh);
  const Index source = 4;
  const Vec3 pole = mesh->positions()[source];
  const TangentFrame& frame = (*heat->frames())[source];
  const auto found = heat->transport(std::vector<TangentVector>{{source, 1, 0}});
  EXPECT_TRUE(found);
  double sum = 0;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const Vec3& p = mesh->positions()[v];
    if (p.dot(pole) < -0.7) continue;  // far from the point where all meridians meet
    const Vec3 axis = pole.cross(p);
    const double angle = std::atan2(axis.norm(), pole.dot(p));
    const Vec3 want =
        axis.norm() > 0 ? Vec3(Eigen::AngleAxisd(angle, axis.normalized()) * frame.e1) : frame.e1;
    sum += (found->vectors[v] - want).norm();
  }
  return sum / mesh->vertex_count();
}

TEST(Transport, OnSpheresConvergesToThatOfMeridians) {
  const double coarse = error_on_sphere(2), fine = error_on_sphere(4);
  EXPECT_LT(fine, coarse / 2);
  EXPECT_LT(fine, 0.03);
}

TEST(Transport, IsRefusedWhereThereIsNoOrientedManifold) {
  for (const Draft& draft : {moebius(20, 3), graded_book(3)}) {
    const auto heat = vector_heat(finish(draft));
    const auto vectors = heat->transport(std::vector<TangentVector>{{0, 1, 0}});
    ASSERT_FALSE(vectors);
    EXPECT_EQ(vectors.error().code, ErrorCode::kBadInput);
    const auto values = heat->extend(std::vector<Index>{0, 5}, std::vector<double>{3, 3});
    ASSERT_TRUE(values) << values.error().message;
    for (const double value : values->values) {
      if (!std::isnan(value)) {  // not of vertices without a face
        EXPECT_NEAR(value, 3, kAgree);
      }
    }
    EXPECT_FALSE(std::isnan(values->values[5]));
  }
}

TEST(Transport, RefusesWhatIsNoVector) {
  const auto heat = vector_heat(finish(plane_grid(3, 3, 1, 1)));
  EXPECT_FALSE(heat->transport({}));
  EXPECT_FALSE(heat->transport(std::vector<TangentVector>{{99, 1, 0}}));
  EXPECT_FALSE(heat->transport(std::vector<TangentVector>{{0, std::nan(""), 0}}));
  EXPECT_FALSE(heat->extend(std::vector<Index>{0, 1}, std::vector<double>{1}));
  SpreadOptions no_time;
  no_time.time_factor = 0;
  EXPECT_FALSE(VectorHeat::build(finish(plane_grid(3, 3, 1, 1)), no_time));
}

class SpreadOnBroken : public testing::TestWithParam<unsigned> {};

TEST_P(SpreadOnBroken, MeshesIsFiniteOrOneSentence) {
  for (unsigned seed = 40 * GetParam(); seed < 40 * GetParam() + 40; ++seed) {
    const BrokenMesh broken = broken_mesh(seed);
    const auto mesh = TriangleMesh::build(broken.draft.positions, broken.draft.faces);
    if (!mesh) continue;
    const auto heat = VectorHeat::build(std::make_shared<const TriangleMesh>(*mesh));
    if (!heat) {
      EXPECT_EQ(heat.error().message.find('\n'), std::string::npos) << broken.recipe;
      continue;
    }
    const Index v = mesh->faces()[0][0];
    const auto values = (*heat)->extend(std::vector<Index>{v}, std::vector<double>{2});
    if (values) {
      for (const double value : values->values) {
        if (!std::isnan(value)) {
          EXPECT_NEAR(value, 2, 1e-6) << broken.recipe;
        }
      }
    }
    const auto vectors = (*heat)->transport(std::vector<TangentVector>{{v, 3, 4}});
    if (!vectors) continue;
    for (Index w = 0; w < mesh->vertex_count(); ++w) {
      EXPECT_EQ(std::isnan(vectors->components[w][0]), std::isnan(values->values[w]));
      if (!std::isnan(values->values[w])) {
        EXPECT_NEAR(vectors->vectors[w].norm(), 5, 1e-5) << broken.recipe;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SpreadOnBroken, testing::Range(0U, 6U));

}  // namespace
}  // namespace geotherm::test
