// SPDX-License-Identifier: MIT
#include "solver/mesh/ray_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <new>
#include <span>

#include "solver/mesh/box_tree.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

/// Origins farther out than this (frame units) are moved towards the model along the ray.
constexpr double kNear = 4;

/// Coordinates of a model that has moved (frame units) up to which it lies nearer than that.
constexpr double kMaxReach = 2;

/// Components of a direction are taken to be at least this, which moves no ray by as much as boxes
/// are padded.
constexpr double kMinComponent = 1e-30;

/// What a ray brings to every test, in the frame. Its direction's largest component is +-1.
struct Ray {
  Vec3 origin, inverse;
  double skipped = 0;       // how far the origin was moved along the direction
  int x = 0, y = 1, z = 2;  // z is the axis of the largest component
  double sx = 0, sy = 0;    // the shear that turns the direction into +-z
  double sz = 1;            // that sign

  /// Nothing where the ray cannot come near the model.
  static std::optional<Ray> from(const Vec3& start, const Vec3& direction) {
    if (!start.allFinite()) return std::nullopt;
    Ray ray;
    ray.origin = start;
    if (start.cwiseAbs().maxCoeff() > kNear) {
      const double to_middle = -start.dot(direction) / direction.squaredNorm();
      const double skipped = to_middle - kNear / direction.norm();
      if (skipped > 0) {
        ray.skipped = skipped;
        ray.origin += skipped * direction;
      }
      if (!ray.origin.allFinite() || ray.origin.cwiseAbs().maxCoeff() > 2 * kNear) {
        return std::nullopt;
      }
    }
    direction.cwiseAbs().maxCoeff(&ray.z);
    ray.x = (ray.z + 1) % 3;
    ray.y = (ray.z + 2) % 3;
    ray.sz = direction[ray.z];
    ray.sx = direction[ray.x] / ray.sz;
    ray.sy = direction[ray.y] / ray.sz;
    for (int k = 0; k < 3; ++k) {
      ray.inverse[k] =
          1 / std::copysign(std::max(std::abs(direction[k]), kMinComponent), direction[k]);
    }
    return ray;
  }
};

struct Best {
  double t = std::numeric_limits<double>::infinity();
  Index face = kNoIndex;
  double u = 0, v = 0, w = 0;  // weights times a common factor
};

/// a b - c d with the sign of the exact value: rounding the products keeps their order, and where
/// they round to the same number their errors decide. Needs -ffp-contract=off.
double difference_of_products(double a, double b, double c, double d) {
  const double p = a * b, q = c * d;
  if (p != q) return p - q;
  return std::fma(a, b, -p) - std::fma(c, d, -q);
}

/// Woop, Benthin, Wald 2013: corners are sheared so that the ray runs along z from 0; the three
/// edge functions are exact in sign, and two faces agree on the edge that they share.
void meet(const Ray& ray, const std::array<Vec3, 3>& corners, Index face, Best& best) {
  const Vec3 a = corners[0] - ray.origin, b = corners[1] - ray.origin, c = corners[2] - ray.origin;
  const double ax = a[ray.x] - ray.sx * a[ray.z], ay = a[ray.y] - ray.sy * a[ray.z];
  const double bx = b[ray.x] - ray.sx * b[ray.z], by = b[ray.y] - ray.sy * b[ray.z];
  const double cx = c[ray.x] - ray.sx * c[ray.z], cy = c[ray.y] - ray.sy * c[ray.z];
  const double u = difference_of_products(cx, by, cy, bx);
  const double v = difference_of_products(ax, cy, ay, cx);
  const double w = difference_of_products(bx, ay, by, ax);
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return;
  const double sum = u + v + w;
  if (sum == 0) return;
  const double t = ray.sz * (u * a[ray.z] + v * b[ray.z] + w * c[ray.z]) / sum;
  if (!(t >= 0) || t > best.t || (t == best.t && face > best.face)) return;
  best = {t, face, u, v, w};
}

/// Where the ray enters the box, at 0 or later; infinity where it misses.
double entry(const Ray& ray, const FloatBox& box) {
  double near = 0, far = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double low = (box.low[k] - ray.origin[k]) * ray.inverse[k];
    const double high = (box.high[k] - ray.origin[k]) * ray.inverse[k];
    near = std::max(near, std::min(low, high));
    far = std::min(far, std::max(low, high));
  }
  return near <= far ? near : std::numeric_limits<double>::infinity();
}

/// Multiples of 2^-53 that are >= 0 and sum to 1 without any round-off.
std::array<double, 3> weights_of(const Best& best) {
  constexpr double kGrid = 9007199254740992.0;  // 2^53
  std::array<double, 3> out{best.u, best.v, best.w};
  const double sum = best.u + best.v + best.w;
  for (double& each : out) each = std::nearbyint(each / sum * kGrid) / kGrid;
  const auto largest = std::max_element(out.begin(), out.end());
  *largest = 0;
  *largest = 1 - (out[0] + out[1] + out[2]);
  return out;
}

}  // namespace

struct RayTree::State {
  std::shared_ptr<const TriangleMesh> mesh;
  BoxFrame frame;
  BoxTree tree;

  std::array<Vec3, 3> corners(Index f) const {
    const Face& face = mesh->faces()[f];
    return {frame.into(mesh->positions()[face[0]]), frame.into(mesh->positions()[face[1]]),
            frame.into(mesh->positions()[face[2]])};
  }

  Best first(const Ray& ray) const {
    struct Waiting {
      std::uint32_t node;
      double entry;
    };
    std::array<Waiting, BoxTree::kMaxDepth + 1> waiting;
    std::size_t count = 0;
    Best best;
    Waiting at{0, tree.nodes.empty() ? std::numeric_limits<double>::infinity()
                                     : entry(ray, tree.nodes[0].box)};
    while (true) {
      if (at.entry <= best.t && at.entry < std::numeric_limits<double>::infinity()) {
        const BoxNode& node = tree.nodes[at.node];
        if (node.count == 0) {
          Waiting near{node.first, entry(ray, tree.nodes[node.first].box)};
          Waiting far{node.first + 1, entry(ray, tree.nodes[node.first + 1].box)};
          if (far.entry < near.entry) std::swap(near, far);
          waiting[count++] = far;
          at = near;
          continue;
        }
        for (const Index f : std::span(tree.ids).subspan(node.first, node.count)) {
          meet(ray, corners(f), f, best);
        }
      }
      if (count == 0) return best;
      at = waiting[--count];
    }
  }
};

Result<RayTree> RayTree::build(std::shared_ptr<const TriangleMesh> mesh, const Progress& progress) {
  constexpr Index kAskEvery = 1 << 16;
  const Index face_count = mesh->face_count();
  try {
    auto state = std::make_shared<State>();
    state->mesh = std::move(mesh);
    state->frame = frame_of(*state->mesh);
    std::vector<BoxItem> items;
    items.reserve(static_cast<std::size_t>(face_count));
    for (Index f = 0; f < face_count; ++f) {
      if (f % kAskEvery == 0 && !report(progress, "ray tree", 0.0)) return cancelled_error();
      if (repeats_corner(state->mesh->faces()[f])) continue;
      const std::array<Vec3, 3> p = state->corners(f);
      if ((p[1] - p[0]).cross(p[2] - p[0]).isZero(0)) continue;
      items.push_back({box_of(p), f});
    }
    auto tree = build_box_tree(std::move(items), progress);
    if (!tree) return tree.error();
    state->tree = std::move(*tree);
    if (!report(progress, "ray tree", 1.0)) return cancelled_error();
    return RayTree(std::move(state));
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 "the memory ended in the ray tree of " + std::to_string(face_count) + " faces",
                 {"take a mesh with fewer faces"}};
  }
}

std::optional<RayTree> RayTree::moved(std::shared_ptr<const TriangleMesh> mesh) const {
  const auto faces = mesh->faces();
  const auto before = state_->mesh->positions(), after = mesh->positions();
  const auto whole = std::ranges::count_if(faces, std::not_fn(repeats_corner));
  if (whole != static_cast<std::ptrdiff_t>(state_->tree.ids.size())) return std::nullopt;
  std::vector<char> moves(after.size());
  for (std::size_t v = 0; v < moves.size(); ++v) moves[v] = before[v] != after[v] ? 1 : 0;
  auto state = std::make_shared<State>(State{std::move(mesh), state_->frame, state_->tree});
  BoxTree& tree = state->tree;
  std::vector<char> grows(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their parents
    BoxNode& node = tree.nodes[i];
    if (node.count == 0) {
      grows[i] = grows[node.first] | grows[node.first + 1];
      if (grows[i] == 0) continue;
      node.box = tree.nodes[node.first].box;
      node.box.add(tree.nodes[node.first + 1].box);
      continue;
    }
    const auto ids = std::span(tree.ids).subspan(node.first, node.count);
    for (const Index f : ids) {
      for (const Index v : faces[f]) grows[i] = grows[i] | moves[v];
    }
    if (grows[i] == 0) continue;
    node.box = {};
    for (const Index f : ids) {
      const std::array<Vec3, 3> corners = state->corners(f);
      for (const Vec3& corner : corners) {
        if (!(corner.cwiseAbs().maxCoeff() <= kMaxReach)) return std::nullopt;
      }
      node.box.add(box_of(corners));
    }
  }
  return RayTree(std::move(state));
}

std::optional<RayHit> RayTree::first_hit(const Vec3& origin, const Vec3& direction) const {
  const double length = direction.cwiseAbs().maxCoeff();
  if (!origin.allFinite() || !direction.allFinite() || !(length > 0)) return std::nullopt;
  const auto ray = Ray::from(state_->frame.into(origin), direction / length);
  if (!ray) return std::nullopt;
  const Best best = state_->first(*ray);
  if (best.face == kNoIndex) return std::nullopt;
  int exponent = 0;
  const double mantissa = std::frexp(length, &exponent);
  return RayHit{SurfacePoint::in_face(best.face, weights_of(best)),
                std::ldexp((ray->skipped + best.t) / mantissa, state_->frame.exponent - exponent)};
}

}  // namespace geotherm
