// SPDX-License-Identifier: MIT
// Identities that the discrete operators must satisfy on every mesh.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "geotherm/domains.h"
#include "solver/geometry/cell_mesh.h"
#include "solver/geometry/fem_operator.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/operators.h"

namespace geotherm::test {
namespace {

// Sums of some dozen terms, relative to the largest.
constexpr double kOperatorRoundOff = 1e-12;
// Angles from three coordinates against angles from lengths: both lose digits on flat triangles
// (cotangents of the caps are about 1e4).
constexpr double kFromPositions = 1e-9;
// What the lengths of a face in units of 1e-4 edges lose to rounding.
constexpr double kPlanarRoundOff = 1e-8;

// Cotangent sums that flips leave alone, as round-off of cocircular corners.
constexpr double kFlipTolerance = 1e-6;

constexpr double kHeatTime = 1.0;  ///< t = h^2 in units of the mean edge
constexpr double kConsistentShare = 0.5;

std::span<const double> span_of(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}
std::span<double> span_of(Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

Eigen::VectorXd random_vector(Index n) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
}

class Operators : public testing::TestWithParam<ZooMesh> {
 protected:
  std::shared_ptr<const OperatorMesh> operators(bool flip) const {
    return operators_of(*mesh, intrinsic_of(*mesh, flip));
  }
  MeshPtr mesh = GetParam().mesh();
};

TEST_P(Operators, RowsOfTheStiffnessSumToZero) {
  const FemOperator L(operators(true), 0, 1);
  const Eigen::VectorXd sums = dense(L.assembled()).rowwise().sum();
  EXPECT_LE(sums.lpNorm<Eigen::Infinity>(), kOperatorRoundOff * largest(L.diagonal()));
}

TEST_P(Operators, StiffnessIsPositiveSemidefinite) {
  const FemOperator L(operators(false), 0, 1);
  const Eigen::VectorXd x = random_vector(L.size());
  EXPECT_GE(x.dot(dense(L.assembled()) * x), 0);
}

TEST_P(Operators, MassesArePositive) {
  const auto surface = operators(true);
  for (const double mass : surface->mass) EXPECT_GT(mass, 0);
}

TEST_P(Operators, DivergenceOfTheGradientIsTheStiffness) {
  const auto surface = operators(true);
  const FemOperator L(surface, 0, 1);
  const Eigen::VectorXd x = random_vector(L.size());
  Eigen::VectorXd divergences = Eigen::VectorXd::Zero(L.size());
  for (std::size_t f = 0; f < surface->faces.size(); ++f) {
    const auto [a, b, c] = surface->faces[f];
    const auto g = gradient(surface->layout[f], x(a), x(b), x(c));
    const auto d = divergence(surface->layout[f], g[0], g[1]);
    divergences(a) += d[0];
    divergences(b) += d[1];
    divergences(c) += d[2];
  }
  Eigen::VectorXd applied(L.size());
  L.apply(span_of(x), span_of(applied));
  // Where triangles are nearly flat the terms of a row are far larger than their sum.
  const double tolerance =
      kOperatorRoundOff * (largest(L.diagonal()) + applied.lpNorm<Eigen::Infinity>());
  EXPECT_LE((divergences - applied).lpNorm<Eigen::Infinity>(), tolerance);
  EXPECT_LE((dense(L.assembled()) * x - applied).lpNorm<Eigen::Infinity>(), tolerance);
}

/// apply(), assembled(), rows, diagonal(), residual() and pattern say the same.
void expect_one_operator(const DomainOperator& M) {
  const Eigen::MatrixXd applied = dense(M), stored = dense(M.assembled());
  EXPECT_LE(relative_difference(values(stored), values(applied)), kOperatorRoundOff);
  EXPECT_LE((applied - applied.transpose()).lpNorm<Eigen::Infinity>(),
            kOperatorRoundOff * applied.lpNorm<Eigen::Infinity>());
  EXPECT_LE(relative_difference(M.diagonal(), values(stored.diagonal())), 0);
  Eigen::MatrixXd listed = Eigen::MatrixXd::Zero(M.size(), M.size());
  std::vector<Index> columns;
  std::vector<double> entries;
  for (Index i = 0; i < M.size(); ++i, columns.clear(), entries.clear()) {
    M.list_row(i, columns, entries);
    EXPECT_EQ(columns.front(), i);
    for (std::size_t e = 0; e < columns.size(); ++e) {
      EXPECT_EQ(listed(i, columns[e]), 0) << "twice in row " << i;
      listed(i, columns[e]) = entries[e];
    }
  }
  EXPECT_LE(relative_difference(values(listed), values(stored)), kOperatorRoundOff);
  M.drop_assembled();
  EXPECT_EQ(dense(M.assembled()), stored);
  constexpr int kColumns = 3;
  const Block x = random_vector(kColumns * M.size()).reshaped(M.size(), kColumns);
  const Block b = x.rowwise().reverse();
  Block residual(x.rows(), x.cols());
  M.residual(b, x, residual, 1);
  EXPECT_LE(
      (residual - (b - stored * x)).lpNorm<Eigen::Infinity>(),
      kOperatorRoundOff * (stored.lpNorm<Eigen::Infinity>() + 1) * x.lpNorm<Eigen::Infinity>());
}

/// Every fifth vertex.
std::vector<Index> some_held(Index n) {
  std::vector<Index> held;
  for (Index i = 0; i < n; i += 5) held.push_back(i);
  return held;
}

class OperatorForms : public Operators {};

// A cube of five tets, of which the elimination order is not that of the vertices.
TEST(CellOperators, AgreeOnTets) {
  std::vector<Vec3> corners;
  for (int v = 0; v < 8; ++v) corners.emplace_back(v & 1, v >> 1 & 1, 1.3 * (v >> 2));
  const auto cube = TetMesh::build(
      corners, {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}});
  ASSERT_TRUE(cube) << cube.error().message;
  const auto cells = cells_of(*cube);
  ASSERT_TRUE(cells) << cells.error().message;
  const std::vector<Index> order = {3, 7, 0, 5, 1, 6, 2, 4};
  const auto mesh = build_cell_mesh(*cells, pattern_of_cells(*cells, 1), order, 1, 1);
  for (const double share : {0.0, kConsistentShare}) {
    expect_one_operator(CellOperator(mesh, 1, kHeatTime, share, {}, 1));
    expect_one_operator(CellOperator(mesh, 1, kHeatTime, share, some_held(mesh->size()), 1));
  }
}

TEST_P(OperatorForms, AgreeWithLumpedMass) {
  expect_one_operator(FemOperator(operators(true), 1, kHeatTime));
}

TEST_P(OperatorForms, AgreeWithConsistentMass) {
  expect_one_operator(FemOperator(operators(true), 1, kHeatTime, {}, kConsistentShare));
}

TEST_P(OperatorForms, AgreeWithHeldRows) {
  const auto surface = operators(true);
  const FemOperator M(surface, 1, kHeatTime, some_held(surface->size()), kConsistentShare);
  expect_one_operator(M);
  const Eigen::MatrixXd stored = dense(M.assembled());
  for (const Index i : M.held()) {
    EXPECT_EQ(stored(i, i), 1);
    EXPECT_EQ(stored.col(i).cwiseAbs().sum(), 1) << "row " << i;
  }
}

// Some columns first, then others, then all.
TEST_P(OperatorForms, AssembleTheColumnsThatAreWanted) {
  const FemOperator M(operators(true), 1, kHeatTime, {}, kConsistentShare);
  const FemOperator N(operators(true), 1, kHeatTime, {}, kConsistentShare);
  const LowerMatrix& all = N.assembled();
  for (const int part : {0, 1}) {
    std::vector<char> wanted(static_cast<std::size_t>(M.size()));
    for (Index j = part; j < M.size(); j += 2) wanted[j] = 1;
    const LowerMatrix& some = M.assembled_where(wanted);
    ASSERT_EQ(some.row, all.row);
    for (Index j = part; j < M.size(); j += 2) {
      for (std::int64_t e = all.start[j]; e < all.start[j + 1]; ++e) {
        EXPECT_EQ(some.value[e], all.value[e]);
      }
    }
  }
  EXPECT_EQ(M.assembled().value, all.value);
}

TEST_P(OperatorForms, ConsistentMassKeepsRowSums) {
  const auto surface = operators(true);
  const FemOperator M(surface, 1, 0, {}, kConsistentShare);
  const FemOperator N(operators(true), 1, kHeatTime, {}, kConsistentShare);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(M.size());
  EXPECT_LE(relative_difference(values(dense(N.assembled()) * ones), surface->mass),
            kOperatorRoundOff * largest(N.diagonal()));
}

TEST_P(OperatorForms, HaveNoKernelButConstants) {
  const auto surface = operators(true);
  EXPECT_EQ(FemOperator(surface, 0, 1).kernel().count, surface->components.count);
  EXPECT_TRUE(FemOperator(surface, 1, kHeatTime).kernel().empty());
  EXPECT_TRUE(FemOperator(surface, 0, 1, {0}).kernel().empty());
}

INSTANTIATE_TEST_SUITE_P(Zoo, Operators, testing::ValuesIn(zoo()), zoo_name);
INSTANTIATE_TEST_SUITE_P(Zoo, OperatorForms, testing::ValuesIn(zoo()), zoo_name);

class OperatorsOnRegularMeshes : public Operators {};

TEST_P(OperatorsOnRegularMeshes, MassesSumToTheArea) {
  const Intrinsic in = intrinsic_of(*mesh, true);
  ASSERT_EQ(in.mesh.mollified.most, 0);
  const auto p = mesh->positions();
  double area = 0;
  for (const auto& [a, b, c] : in.clean.faces) {
    area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
  }
  double total = 0;
  const auto surface = operators_of(*mesh, in);
  for (const double mass : surface->mass) total += mass;
  EXPECT_NEAR(total * in.mesh.unit * in.mesh.unit, area, kFromPositions * area);
}

TEST_P(OperatorsOnRegularMeshes, StiffnessIsHalfTheSumOfCotangents) {
  const Intrinsic in = intrinsic_of(*mesh, false);
  const Numbering numbers = numbering_of(*mesh, in.clean);
  const auto p = mesh->positions();
  const FemOperator L(operators_of(*mesh, in), 0, 1);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(L.size(), L.size());
  for (const Face& face : in.clean.faces) {
    for (int k = 0; k < 3; ++k) {
      const Index a = face[next_corner(k)], b = face[previous_corner(k)];
      const Vec3 u = p[a] - p[face[k]], v = p[b] - p[face[k]];
      const double half_cotangent = u.dot(v) / u.cross(v).norm() / 2;
      const Index i = numbers.local[a], j = numbers.local[b];
      expected(i, j) -= half_cotangent;
      expected(j, i) -= half_cotangent;
      expected(i, i) += half_cotangent;
      expected(j, j) += half_cotangent;
    }
  }
  EXPECT_LE(relative_difference(values(dense(L.assembled())), values(expected)), kFromPositions);
}

INSTANTIATE_TEST_SUITE_P(Zoo, OperatorsOnRegularMeshes, testing::ValuesIn(zoo(kRegular)), zoo_name);

class OperatorsOnThePlane : public Operators {
 protected:
  /// Largest |L x| and |L y| over inner vertices, relative to the largest entry of L.
  double harmonic_defect(bool flip) const {
    const Intrinsic in = intrinsic_of(*mesh, flip);
    const FemOperator L(operators_of(*mesh, in), 0, 1);
    std::vector<char> inner(static_cast<std::size_t>(mesh->vertex_count()), 1);
    for (Index e = 0; e < in.clean.edges.edge_count(); ++e) {
      if (in.clean.edges.sides(e).size() > 1) continue;
      inner[in.clean.edges.low(e)] = inner[in.clean.edges.high(e)] = 0;
    }
    double most = 0;
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::VectorXd x(L.size()), y(L.size());
      for (Index v = 0; v < L.size(); ++v) x(v) = mesh->positions()[v][axis] / in.mesh.unit;
      L.apply(span_of(x), span_of(y));
      for (Index v = 0; v < L.size(); ++v) {
        if (inner[static_cast<std::size_t>(v)]) most = std::max(most, std::abs(y(v)));
      }
    }
    return most / largest(L.diagonal());
  }
};

TEST_P(OperatorsOnThePlane, LinearFunctionsAreHarmonicInside) {
  EXPECT_LE(harmonic_defect(false), kPlanarRoundOff);
}

TEST_P(OperatorsOnThePlane, LinearFunctionsStayHarmonicAfterFlips) {
  EXPECT_LE(harmonic_defect(true), kPlanarRoundOff);
}

INSTANTIATE_TEST_SUITE_P(Zoo, OperatorsOnThePlane, testing::ValuesIn(zoo(kPlanar | kRegular)),
                         zoo_name);

class OperatorsOnClosedMeshes : public Operators {};

// What makes u positive: the heat step's matrix is an M-matrix.
TEST_P(OperatorsOnClosedMeshes, CoupleWithoutPositiveEntriesAfterFlips) {
  const FemOperator M(operators(true), 1, kHeatTime);
  Eigen::MatrixXd stored = dense(M.assembled());
  stored.diagonal().setConstant(-1);
  EXPECT_LE(stored.maxCoeff(), kFlipTolerance);
}

INSTANTIATE_TEST_SUITE_P(Zoo, OperatorsOnClosedMeshes, testing::ValuesIn(zoo(kClosed)), zoo_name);

}  // namespace
}  // namespace geotherm::test
