// SPDX-License-Identifier: MIT
#include "bench/models/draft_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "solver/mesh/connectivity.h"

namespace geotherm::generate {
namespace {

/// Mixes 32 bits so that each input bit moves every output bit (the "lowbias32" constants).
std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

std::uint32_t bits(std::int32_t v) { return static_cast<std::uint32_t>(v); }

// A point's hash in three steps, as neighbours share the first two.
std::uint32_t hash_z(std::int32_t z, std::uint32_t seed) {
  return mix(bits(z) + seed * 0xc2b2ae3dU);
}
std::uint32_t hash_y(std::int32_t y, std::uint32_t rest) {
  return mix(bits(y) * 0x85ebca77U + rest);
}
std::uint32_t hash_x(std::int32_t x, std::uint32_t rest) {
  return mix(bits(x) * 0x9e3779b1U + rest);
}

/// The product with one of the twelve directions to the middles of a cube's edges.
double gradient_dot(std::uint32_t h, double x, double y, double z) {
  const std::uint32_t k = h % 12;
  const double a = k < 8 ? x : y;
  const double b = k < 4 ? y : z;
  return ((h & 0x10000U) ? a : -a) + ((h & 0x20000U) ? b : -b);
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double mix_values(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

double hash_unit(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  return hash_x(x, hash_y(y, hash_z(z, seed))) * (1.0 / 4294967296.0);
}

double gradient_noise(const Vec3& p, std::uint32_t seed) {
  const std::array<double, 3> low = {std::floor(p.x()), std::floor(p.y()), std::floor(p.z())};
  const auto ix = static_cast<std::int32_t>(low[0]);
  const auto iy = static_cast<std::int32_t>(low[1]);
  const auto iz = static_cast<std::int32_t>(low[2]);
  const double x = p.x() - low[0];
  const double y = p.y() - low[1];
  const double z = p.z() - low[2];
  const double u = fade(x);
  const double v = fade(y);
  const std::uint32_t near = hash_z(iz, seed);
  const std::uint32_t far = hash_z(iz + 1, seed);
  const auto row = [&](std::int32_t j, std::uint32_t rest, double zk) {
    const std::uint32_t here = hash_y(iy + j, rest);
    return mix_values(gradient_dot(hash_x(ix, here), x, y - j, zk),
                      gradient_dot(hash_x(ix + 1, here), x - 1, y - j, zk), u);
  };
  return mix_values(mix_values(row(0, near, z), row(1, near, z), v),
                    mix_values(row(0, far, z - 1), row(1, far, z - 1), v), fade(z));
}

double fractal_noise(const Vec3& p, int octaves, std::uint32_t seed) {
  double sum = 0;
  double height = 1;
  Vec3 q = p;
  for (int i = 0; i < octaves; ++i) {
    sum += height * gradient_noise(q, seed + static_cast<std::uint32_t>(i));
    height *= 0.5;
    q = 2 * q + Vec3(0.37, 0.61, 0.13);  // shifted, or all octaves would vanish at the same points
  }
  return sum;
}

double ridged_noise(const Vec3& p, int octaves, std::uint32_t seed) {
  double sum = 0;
  double total = 0;
  double height = 1;
  double weight = 1;
  Vec3 q = p;
  for (int i = 0; i < octaves; ++i) {
    const double n = gradient_noise(q, seed + static_cast<std::uint32_t>(i));
    const double crest = (1 - std::min(std::abs(n), 1.0)) * (1 - std::min(std::abs(n), 1.0));
    sum += height * weight * crest;
    total += height;
    weight = std::clamp(1.6 * crest * weight, 0.0, 1.0);
    height *= 0.5;
    q = 2 * q + Vec3(0.37, 0.61, 0.13);
  }
  return sum / total;
}

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

namespace {

// Share of the way to the middle of the faces: less than 1, as all the others move too.
constexpr double kStep = 0.7;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Cosine of the sharpest fold across which an edge may be flipped.
constexpr double kFlattest = 0.5;
// Sum of cotangents below which an edge is not Delaunay; not zero, or ties would flip for ever.
constexpr double kNotDelaunay = -1e-6;
constexpr int kMaxRounds = 20;

/// Half-edge h = 3 f + c, a Side, runs from corner c of face f to the next corner.
class Flipper {
 public:
  explicit Flipper(DraftMesh& mesh) : mesh_(mesh), twin_(3 * mesh.faces.size(), kNoIndex) {
    const EdgeTable edges(static_cast<Index>(mesh.positions.size()), mesh.faces);
    for (Index e = 0; e < edges.edge_count(); ++e) {
      const std::span<const Side> sides = edges.sides(e);
      if (sides.size() != 2 || start(sides[0]) == start(sides[1])) continue;
      twin_[at(sides[0])] = sides[1];
      twin_[at(sides[1])] = sides[0];
    }
  }

  void run() {
    for (int round = 0; round < kMaxRounds; ++round) {
      Index flips = 0;
      for (Index h = 0; h < std::ssize(twin_); ++h) {
        if (twin_[at(h)] > h && try_flip(h)) ++flips;
      }
      if (flips == 0) return;
    }
  }

 private:
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index& start(Index h) { return mesh_.faces[at(h / 3)][at(h % 3)]; }
  const Vec3& point(Index v) const { return mesh_.positions[at(v)]; }

  /// True when a face around the start of `h` has the vertex `other` as well.
  bool touches(Index h, Index other) {
    const Index first = h;
    do {
      if (start(next(h)) == other || start(previous(h)) == other) return true;
      h = twin_[at(previous(h))];
    } while (h != kNoIndex && h != first);
    if (h == first) return false;
    for (h = twin_[at(first)]; h != kNoIndex; h = twin_[at(h)]) {  // the boundary's other side
      h = next(h);
      if (start(next(h)) == other || start(previous(h)) == other) return true;
    }
    return false;
  }

  double cotangent(Index apex, Index a, Index b) const {
    const Vec3 u = point(a) - point(apex);
    const Vec3 v = point(b) - point(apex);
    return u.dot(v) / std::max(u.cross(v).norm(), 1e-300);
  }
  Vec3 normal(Index a, Index b, Index c) const {
    return (point(b) - point(a)).cross(point(c) - point(a)).normalized();
  }

  bool try_flip(Index h) {
    const Index t = twin_[at(h)];
    const Index a = start(h);
    const Index b = start(t);
    const Index c = start(previous(h));
    const Index d = start(previous(t));
    if (cotangent(c, a, b) + cotangent(d, a, b) >= kNotDelaunay) return false;
    const Vec3 fold = normal(a, b, c) + normal(b, a, d);
    const Vec3 one = normal(a, d, c);
    const Vec3 two = normal(b, c, d);
    if (normal(a, b, c).dot(normal(b, a, d)) < kFlattest || one.dot(two) < kFlattest ||
        fold.dot(one) < kFlattest || fold.dot(two) < kFlattest || touches(previous(h), d)) {
      return false;
    }
    const Index outer_c = twin_[at(previous(h))];  // c -> a
    const Index outer_d = twin_[at(previous(t))];  // d -> b
    const Index f = h / 3 * 3;
    const Index g = t / 3 * 3;
    const Index outer_b = twin_[at(next(h))];  // b -> c
    const Index outer_a = twin_[at(next(t))];  // a -> d
    mesh_.faces[at(h / 3)] = {a, d, c};
    mesh_.faces[at(t / 3)] = {b, c, d};
    join(f, outer_a);
    join(f + 1, g + 1);
    join(f + 2, outer_c);
    join(g, outer_b);
    join(g + 2, outer_d);
    return true;
  }

  void join(Index h, Index other) {
    twin_[at(h)] = other;
    if (other != kNoIndex) twin_[at(other)] = h;
  }

  DraftMesh& mesh_;
  std::vector<Index> twin_;
};

/// Flips edges until each is Delaunay: the two angles that face it sum to at most pi. An edge stays
/// where the surface is folded too sharply around it or where the new edge exists already, so the
/// mesh stays an oriented manifold. Precondition: it is one.
void flip_to_delaunay(DraftMesh& mesh) { Flipper(mesh).run(); }

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

void relax(DraftMesh& mesh, const Projection& project) {
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
  flip_to_delaunay(mesh);
}

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

}  // namespace geotherm::generate
