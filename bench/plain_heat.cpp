// SPDX-License-Identifier: MIT
#include "bench/plain_heat.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace geotherm::bench {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Triplet = Eigen::Triplet<double>;

/// L's row and column of this vertex are the identity's, which makes the matrix definite.
constexpr Index kPinned = 0;

std::array<Vec3, 3> corners_of(std::span<const Vec3> positions, const Face& face) {
  return {positions[face[0]], positions[face[1]], positions[face[2]]};
}

/// The cotangent of the angle at corner k.
double cotangent(const std::array<Vec3, 3>& p, int k) {
  const Vec3 a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
  return a.dot(b) / a.cross(b).norm();
}

Matrix cotan_laplacian(const TriangleMesh& mesh) {
  std::vector<Triplet> triplets;
  triplets.reserve(static_cast<std::size_t>(mesh.face_count()) * 12);
  for (const Face& face : mesh.faces()) {
    const auto p = corners_of(mesh.positions(), face);
    for (int k = 0; k < 3; ++k) {
      const double weight = 0.5 * cotangent(p, k);
      const Index i = face[(k + 1) % 3], j = face[(k + 2) % 3];
      triplets.emplace_back(i, i, weight);
      triplets.emplace_back(j, j, weight);
      triplets.emplace_back(i, j, -weight);
      triplets.emplace_back(j, i, -weight);
    }
  }
  Matrix L(mesh.vertex_count(), mesh.vertex_count());
  L.setFromTriplets(triplets.begin(), triplets.end());
  return L;
}

Matrix lumped_mass(const TriangleMesh& mesh) {
  std::vector<Triplet> triplets;
  triplets.reserve(static_cast<std::size_t>(mesh.face_count()) * 3);
  for (const Face& face : mesh.faces()) {
    const auto p = corners_of(mesh.positions(), face);
    const double area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    for (const Index v : face) triplets.emplace_back(v, v, area / 3);
  }
  Matrix A(mesh.vertex_count(), mesh.vertex_count());
  A.setFromTriplets(triplets.begin(), triplets.end());
  return A;
}

/// Over the edges, each of which is one entry below the diagonal of L.
double mean_edge_length(const TriangleMesh& mesh, const Matrix& L) {
  const auto positions = mesh.positions();
  double total = 0;
  std::size_t edges = 0;
  for (int j = 0; j < L.outerSize(); ++j) {
    for (Matrix::InnerIterator entry(L, j); entry; ++entry) {
      if (entry.row() <= j) continue;
      total += (positions[static_cast<std::size_t>(entry.row())] - positions[j]).norm();
      ++edges;
    }
  }
  return total / static_cast<double>(edges);
}

}  // namespace

bool PlainHeat::set_up() {
  Matrix L = cotan_laplacian(*mesh_);
  const Matrix A = lumped_mass(*mesh_);
  const double h = mean_edge_length(*mesh_, L);
  Matrix heat = A + h * h * L;
  if (!heat_.factorize(heat)) return false;
  L.prune([](Eigen::Index i, Eigen::Index j, double) {
    return i == j || (i != kPinned && j != kPinned);
  });
  L.coeffRef(kPinned, kPinned) = 1;
  return poisson_.factorize(L);
}

Eigen::VectorXd PlainHeat::unit_field_divergence(const Eigen::VectorXd& u) const {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(u.size());
  for (const Face& face : mesh_->faces()) {
    const auto p = corners_of(mesh_->positions(), face);
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    // The gradient times twice the area: its length is divided out. Scaled as libigl does it, so
    // that the squares of tiny values do not vanish.
    Vec3 gradient = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      gradient += u[face[k]] * normal.cross(p[(k + 2) % 3] - p[(k + 1) % 3]);
    }
    const double largest = gradient.cwiseAbs().maxCoeff();
    if (!(largest > 0)) continue;
    gradient /= largest;
    const Vec3 X = -gradient / gradient.norm();
    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      const Vec3 e1 = p[k1] - p[k], e2 = p[k2] - p[k];
      b[face[k]] += 0.5 * (cotangent(p, k2) * e1.dot(X) + cotangent(p, k1) * e2.dot(X));
    }
  }
  return b;
}

std::vector<double> PlainHeat::distances(Index source) {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(mesh_->vertex_count());
  heat[source] = 1;
  const Eigen::VectorXd u = heat_.solve(heat);
  if (u.size() == 0) return {};
  Eigen::VectorXd b = -unit_field_divergence(u);  // L is positive semidefinite
  b[kPinned] = 0;
  const Eigen::VectorXd phi = poisson_.solve(b);
  if (phi.size() == 0) return {};
  const double lowest = phi.minCoeff();
  std::vector<double> out(static_cast<std::size_t>(phi.size()));
  for (Eigen::Index i = 0; i < phi.size(); ++i) out[static_cast<std::size_t>(i)] = phi[i] - lowest;
  return out;
}

}  // namespace geotherm::bench
