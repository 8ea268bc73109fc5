// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/relax.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/mesh/generate/edge_flips.h"

namespace geotherm::generate {
namespace {

// Share of the way to the middle of the faces: less than 1, as all the others move too.
constexpr double kStep = 0.7;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void move_once(DraftMesh& mesh, const Projection& project) {
  struct Sums {
    Vec3 centroid = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    double area = 0;
  };
  std::vector<Sums> sums(mesh.positions.size());
  for (const Face& face : mesh.faces) {
    const Vec3& a = mesh.positions[at(face[0])];
    const Vec3& b = mesh.positions[at(face[1])];
    const Vec3& c = mesh.positions[at(face[2])];
    const Vec3 normal = (b - a).cross(c - a);
    const double area = normal.norm();
    const Vec3 centroid = area / 3 * (a + b + c);
    for (const Index v : face) {
      Sums& sum = sums[at(v)];
      sum.centroid += centroid;
      sum.normal += normal;
      sum.area += area;
    }
  }
  for (Index v = 0; v < std::ssize(mesh.positions); ++v) {
    const Sums& sum = sums[at(v)];
    Vec3& p = mesh.positions[at(v)];
    if (sum.area <= 0) continue;
    const Vec3 normal = sum.normal.normalized();
    Vec3 move = kStep * (sum.centroid / sum.area - p);
    move -= move.dot(normal) * normal;
    p = project(v, p + move, normal);
  }
}

/// Cosines of the largest and of the smallest angle of the face.
std::pair<double, double> extreme_cosines(const DraftMesh& mesh, const Face& face) {
  double least = 1;
  double most = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& p = mesh.positions[at(face[k])];
    const Vec3 u = (mesh.positions[at(face[(k + 1) % 3])] - p).normalized();
    const Vec3 v = (mesh.positions[at(face[(k + 2) % 3])] - p).normalized();
    least = std::min(least, u.dot(v));
    most = std::max(most, u.dot(v));
  }
  return {least, most};
}

}  // namespace

void smooth_slivers(DraftMesh& mesh) {
  constexpr int kRounds = 8;
  constexpr double kLargest = -0.574;  // cosine of 125 degrees
  constexpr double kSmallest = 0.940;  // cosine of 20 degrees
  for (int round = 0; round < kRounds; ++round) {
    std::vector<bool> bad(mesh.positions.size(), false);
    bool any = false;
    for (const Face& face : mesh.faces) {
      const auto [least, most] = extreme_cosines(mesh, face);
      if (least > kLargest && most < kSmallest) continue;
      any = true;
      for (const Index v : face) bad[at(v)] = true;
    }
    if (!any) return;
    std::vector<Vec3> sum(mesh.positions.size(), Vec3::Zero());
    std::vector<int> count(mesh.positions.size(), 0);
    for (const Face& face : mesh.faces) {  // each neighbour twice: closed surfaces
      for (std::size_t k = 0; k < 3; ++k) {
        if (!bad[at(face[k])]) continue;
        sum[at(face[k])] +=
            mesh.positions[at(face[(k + 1) % 3])] + mesh.positions[at(face[(k + 2) % 3])];
        count[at(face[k])] += 2;
      }
    }
    for (std::size_t v = 0; v < bad.size(); ++v) {
      if (bad[v]) mesh.positions[v] += kStep * (sum[v] / count[v] - mesh.positions[v]);
    }
    flip_to_delaunay(mesh);
  }
}

void relax(DraftMesh& mesh, int rounds, const Projection& project) {
  for (int round = 0; round < rounds; ++round) {
    move_once(mesh, project);
  }
  flip_to_delaunay(mesh);
}

}  // namespace geotherm::generate
