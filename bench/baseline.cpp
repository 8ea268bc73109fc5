// SPDX-License-Identifier: MIT
#include <cholmod.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "bench/measure.h"
#include "geotherm/mesh.h"

namespace geotherm::bench {
namespace {

/// A symmetric positive definite matrix, factored by CHOLMOD the way that geometry libraries call
/// it (Eigen's CholmodSimplicialLDLT, geometry-central's PositiveDefiniteSolver): an analysis of
/// its own with CHOLMOD's default search for an ordering, a simplicial factorisation, and
/// cholmod_solve, which allocates its answer and workspace, for each right side.
class PlainCholmod {
 public:
  PlainCholmod();
  ~PlainCholmod();
  PlainCholmod(const PlainCholmod&) = delete;
  PlainCholmod& operator=(const PlainCholmod&) = delete;

  /// False when the matrix is not positive definite or memory ends.
  bool factorize(Eigen::SparseMatrix<double>& matrix);

  /// An empty vector when it fails.
  Eigen::VectorXd solve(Eigen::VectorXd& b);

  /// What the factor holds, unused capacity not counted.
  double bytes() const;

 private:
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

/// CHOLMOD's view of a matrix whose two triangles are stored; it reads the lower one.
cholmod_sparse view_of(Eigen::SparseMatrix<double>& matrix) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(matrix.rows());
  view.ncol = static_cast<std::size_t>(matrix.cols());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = matrix.outerIndexPtr();
  view.i = matrix.innerIndexPtr();
  view.x = matrix.valuePtr();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

PlainCholmod::PlainCholmod() {
  cholmod_start(&common_);
  common_.print = 0;
  // The one setting that differs from CHOLMOD's defaults, and it is theirs: the supernodal modules
  // need a real BLAS and are GPL, so libraries ask for the simplicial factorisation.
  common_.supernodal = CHOLMOD_SIMPLICIAL;
}

PlainCholmod::~PlainCholmod() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

bool PlainCholmod::factorize(Eigen::SparseMatrix<double>& matrix) {
  cholmod_free_factor(&factor_, &common_);
  cholmod_sparse view = view_of(matrix);
  factor_ = cholmod_analyze(&view, &common_);
  if (factor_ == nullptr) return false;
  cholmod_factorize(&view, factor_, &common_);
  return common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
}

Eigen::VectorXd PlainCholmod::solve(Eigen::VectorXd& b) {
  cholmod_dense view{};
  view.nrow = view.d = view.nzmax = static_cast<std::size_t>(b.size());
  view.ncol = 1;
  view.x = b.data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* answer = cholmod_solve(CHOLMOD_A, factor_, &view, &common_);
  if (answer == nullptr) return {};
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(answer->x), b.size());
  cholmod_free_dense(&answer, &common_);
  return x;
}

double PlainCholmod::bytes() const {
  if (factor_ == nullptr) return 0;
  const auto n = static_cast<double>(factor_->n);
  const auto* count = static_cast<const int*>(factor_->nz);
  double entries = 0;
  for (std::size_t j = 0; j < factor_->n; ++j) entries += count[j];
  constexpr double kIndexArrays = 6;  // Perm, ColCount, p, nz, next, prev
  return entries * (sizeof(double) + sizeof(int)) + kIndexArrays * n * sizeof(int);
}

/// The heat method as a competent but ordinary library has it (Crane, Weischedel, Wardetzky 2013,
/// t = h^2): cotan Laplacian and lumped mass from triplets, one plain factorisation each of A + t L
/// and of L with one vertex pinned, straightforward loops over the faces, one thread, one source at
/// a time. Nothing in it is slow on purpose; what it does not do is share the analysis between the
/// two matrices, choose the ordering and the kind of factorisation by size, renumber the mesh,
/// store what the faces' geometry gives, or block right sides.
class PlainHeat {
 public:
  explicit PlainHeat(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh)) {}

  /// False when a factorisation fails.
  bool set_up();

  /// Empty when a solve fails.
  std::vector<double> distances(Index source);

  double factor_bytes() const { return heat_.bytes() + poisson_.bytes(); }

 private:
  Eigen::VectorXd unit_field_divergence(const Eigen::VectorXd& u) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  PlainCholmod heat_, poisson_;
};

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

class BaselineContender final : public Contender {
 public:
  std::string name() const override { return kBaseline; }

  Result<void> set_up(std::shared_ptr<const TriangleMesh> mesh) override {
    heat_ = std::make_unique<PlainHeat>(std::move(mesh));
    if (heat_->set_up()) return {};
    heat_.reset();
    return Error{ErrorCode::kNumericalFailure, "the baseline's factorisation failed"};
  }

  void drop() override { heat_.reset(); }

  Result<std::vector<double>> query(Index source) override {
    std::vector<double> distances = heat_->distances(source);
    if (distances.empty()) {
      return Error{ErrorCode::kNumericalFailure, "the baseline's solve failed"};
    }
    return distances;
  }

  Result<void> batch(std::span<const Index> sources) override {
    for (const Index source : sources) {
      if (const auto answer = query(source); !answer) return answer.error();
    }
    return {};
  }

  double factor_mb() const override { return heat_->factor_bytes() / (1 << 20); }

 private:
  std::unique_ptr<PlainHeat> heat_;
};

}  // namespace

std::unique_ptr<Contender> make_baseline_contender() {
  return std::make_unique<BaselineContender>();
}

}  // namespace geotherm::bench
