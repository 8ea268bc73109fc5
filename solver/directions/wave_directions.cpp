// SPDX-License-Identifier: MIT
#include "solver/directions/wave_directions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/directions/directions_state.h"

#define GEOTHERM_KERNEL_NAMESPACE direction_waves
#include "solver/polyhedral/wave_fit.inl"

namespace geotherm {
namespace {

using direction_waves::Fit;
using direction_waves::fit_wave;
using Point2 = Eigen::Vector2d;

constexpr double kNoDirection = std::numeric_limits<double>::quiet_NaN();
/// Where a second way is longer by less than close_share() of it, and leaves the source in a
/// direction that differs by so many radians, waves cannot tell which is the shortest.
constexpr double kOtherWay = 0.2;
/// Neighbours on an edge whose directions differ by more than so many times what their distance
/// explains, and so many radians, are of paths that pass something on two sides.
constexpr double kTorn = 3, kTornAngle = 0.05;

/// Vertices by rank, then the samples of the edges.
class DirectionPass {
 public:
  DirectionPass(const WaveSurface& surface, const WaveTables& tables, const WaveFront& front,
                int samples, const WaveStart& start)
      : surface_(surface),
        tables_(tables),
        front_(front),
        samples_(samples),
        start_(start),
        close_(close_share(samples)),
        count_(static_cast<std::size_t>(tables.vertex_count())),
        direction_(count_ + static_cast<std::size_t>(samples) *
                                static_cast<std::size_t>(tables.edge_count()),
                   kNoDirection),
        in_doubt_(direction_.size(), 0) {}

  WaveDirections run() {
    for (std::size_t rank = 0; rank < count_; ++rank) {
      direction_[rank] = start_.known[static_cast<std::size_t>(tables_.vertex_of_rank[rank])];
    }
    for (const WaveStart::Face& face : start_.faces) seed(face);
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::size_t node = 0; node < direction_.size(); ++node) {
      const double d = value(node);
      if (d < kUnreached && std::isnan(direction_[node])) {
        order.emplace_back(d, static_cast<std::uint32_t>(node));
      }
    }
    std::ranges::sort(order);
    for (const auto& [d, node] : order) {
      if (node < count_) {
        set_vertex(node);
      } else {
        set_sample(node);
      }
    }
    WaveDirections out{std::vector<double>(tables_.rank_of_vertex.size(), kNoDirection), 0};
    for (std::size_t v = 0; v < out.of.size(); ++v) {
      const Index rank = tables_.rank_of_vertex[v];
      if (rank == kNoIndex) continue;
      out.of[v] = direction_[static_cast<std::size_t>(rank)];
      out.in_doubt += in_doubt_[static_cast<std::size_t>(rank)];
    }
    return out;
  }

 private:
  /// A way to a node, and the node beside which it comes in.
  struct Way {
    double value = kUnreached, direction = kNoDirection;
    std::size_t from = 0;
  };

  double value(std::size_t node) const {
    return node < count_ ? front_.distances()[node] : front_.sample_distances()[node - count_];
  }

  /// The nodes of side k of a face, from its first corner to its last.
  void nodes_of(const WaveFace& face, int k, std::array<std::size_t, 5>& out) const {
    out[0] = static_cast<std::size_t>(face.vertex[k]);
    const bool reversed = (face.reversed >> k & 1U) != 0;
    for (int i = 0; i < samples_; ++i) {
      const int own = reversed ? samples_ - 1 - i : i;
      out[static_cast<std::size_t>(i) + 1] =
          count_ + static_cast<std::size_t>(samples_) * static_cast<std::size_t>(face.edge[k]) +
          static_cast<std::size_t>(own);
    }
    out[static_cast<std::size_t>(samples_) + 1] =
        static_cast<std::size_t>(face.vertex[next_corner(k)]);
  }

  /// What lies in a face at the source is seen straight, unless something is nearer.
  void seed(const WaveStart::Face& at) {
    constexpr double kSame = 1 - 1e-9;
    const WaveFace& face = tables_.faces[tables_.rank_of_face[at.face]];
    const auto corners =
        corners_of(surface_.base.intrinsic.lengths[static_cast<std::size_t>(at.face)]);
    for (int k = 0; k < 3; ++k) {
      std::array<std::size_t, 5> nodes{};
      nodes_of(face, k, nodes);
      for (int i = 0; i <= samples_ + 1; ++i) {
        const double share = static_cast<double>(i) / (samples_ + 1);
        const Point2 place = corners[k] + share * (corners[next_corner(k)] - corners[k]);
        const Point2 way = place - at.from;
        const std::size_t node = nodes[static_cast<std::size_t>(i)];
        if (value(node) < kSame * way.norm()) continue;
        const double angle =
            std::atan2(at.along.x() * way.y() - at.along.y() * way.x(), at.along.dot(way));
        direction_[node] = at.turn.mirrored ? at.turn.turn - angle : at.turn.turn + angle;
      }
    }
    mirrored_ = at.turn.mirrored;  // all alike where the surface is oriented
  }

  void set_vertex(std::size_t node) {
    for (const SideCode code : tables_.corners_at(static_cast<Index>(node))) {
      const int opposite = next_corner(corner_of_code(code));
      cross(tables_.faces[face_of_code(code)], opposite, 1, 0);
    }
    settle(node);
  }

  /// Takes the best of the ways. In doubt is what has another that is as good, and what lies behind
  /// such a node.
  void settle(std::size_t node) {
    const auto best = std::ranges::min_element(ways_, {}, &Way::value);
    if (best != ways_.end()) {
      const auto is_other = [&](const Way& way) {
        return way.value < (1 + close_) * best->value &&
               std::abs(difference(best->direction, way.direction)) > kOtherWay;
      };
      direction_[node] = best->direction;
      in_doubt_[node] = in_doubt_[best->from] != 0 || std::ranges::any_of(ways_, is_other) ? 1 : 0;
    }
    ways_.clear();
    shortest_ = kUnreached;
  }

  /// Whether a way of this length can be the best, or as good.
  bool counts(double value) const { return value < (1 + close_) * shortest_; }
  void add(const Way& way) {
    ways_.push_back(way);
    shortest_ = std::min(shortest_, way.value);
  }
  double difference(double from, double to) const {
    return start_.period > 0 ? std::remainder(to - from, start_.period) : to - from;
  }

  void set_sample(std::size_t node) {
    const std::size_t number = node - count_;
    const auto edge = number / static_cast<std::size_t>(samples_);
    const int i = static_cast<int>(number % static_cast<std::size_t>(samples_));
    const double share = (i + 1.0) / (samples_ + 1);
    const auto through = [&](SideCode code) {
      const WaveFace& face = tables_.faces[face_of_code(code)];
      const int k = corner_of_code(code);
      const bool reversed = (face.reversed >> k & 1U) != 0;
      const double from_first = reversed ? 1 - share : share;
      // Side k + 1 ends at the corner opposite of side k, side k + 2 at its first.
      cross(face, next_corner(k), 1 - from_first, -1);
      cross(face, previous_corner(k), from_first, 1);
    };
    through(tables_.sides[edge][0]);
    for (const SideCode side : tables_.other_sides(static_cast<Index>(edge))) through(side);
    settle(node);
  }

  /// The ways through side k of a face to a target: `rise` of the way from the side to the corner
  /// opposite, starting at the side's first end (`end` -1), its last (1), or anywhere (rise 1).
  void cross(const WaveFace& face, int k, double rise, int end) {
    const double length = face.length[k], half = length / 2;
    const double to_b = face.length[next_corner(k)], to_a = face.length[previous_corner(k)];
    const double cx = (to_a - to_b) * (to_a + to_b) / (2 * length);
    const double x = rise * cx + (1 - rise) * end * half, y = rise * face.twice_area / length;
    std::array<std::size_t, 5> nodes{};
    nodes_of(face, k, nodes);
    const std::size_t last = static_cast<std::size_t>(samples_) + 1;
    std::array<double, 5> values{};
    for (std::size_t i = 0; i <= last; ++i) values[i] = value(nodes[i]);
    const auto place = [&](std::size_t i) {
      return -half + length * static_cast<double>(i) / static_cast<double>(last);
    };
    for (std::size_t i = 0; i <= last; i += 2) {
      const double bent = values[i] + std::hypot(x - place(i), y);
      if (counts(bent) && !std::isnan(direction_[nodes[i]])) {
        add({bent, direction_[nodes[i]], nodes[i]});
      }
    }
    const double step = length / static_cast<double>(last);
    for (std::size_t i = 0; i + 2 <= last; i += 2) {
      const Fit fit = fit_wave(place(i + 1), step, values[i], values[i + 1], values[i + 2]);
      if (fit.kind != Fit::Kind::kWave) continue;
      along(fit, x - fit.centre, y, {nodes[i], nodes[i + 1], nodes[i + 2]});
    }
  }

  /// The way of a fitted wave to (x, y), from the middle of the three nodes that it was fitted to.
  void along(const Fit& fit, double x, double y, const std::array<std::size_t, 3>& nodes) {
    const auto [arrives, at] = direction_waves::ray_to(fit, x, y);
    if (!counts(arrives)) return;  // infinite where the ray misses the edge
    const double found = between(fit, at, nodes);
    const std::size_t nearest = at < -fit.half / 2 ? 0 : at < fit.half / 2 ? 1 : 2;
    if (!std::isnan(found)) add({arrives, found, nodes[nearest]});
  }

  /// The direction of the line through the edge at `at`, from those of the nodes beside it.
  double between(const Fit& fit, double at, const std::array<std::size_t, 3>& nodes) const {
    const std::size_t left = at < 0 ? 0 : 1;
    const double from = left == 0 ? -fit.half : 0, to = from + fit.half;
    const double a = direction_[nodes[left]], b = direction_[nodes[left + 1]];
    const double turn_a = turn(fit, from, at), turn_b = turn(fit, to, at);
    const double sign = mirrored_ ? -1 : 1;
    const bool nearer_a = at - from < to - at;
    if (std::isnan(a) || std::isnan(b))
      return std::isnan(a) ? b + sign * turn_b : a + sign * turn_a;
    const double apart = difference(a, b);
    const double whole = turn_a - turn_b;
    const double explained = std::abs(whole) + fit.half / std::max(fit.middle, fit.half);
    if (std::abs(apart) > kTorn * explained + kTornAngle) {
      return nearer_a ? a + sign * turn_a : b + sign * turn_b;
    }
    const double share = whole != 0 ? turn_a / whole : (at - from) / (to - from);
    return a + std::clamp(share, 0.0, 1.0) * apart;
  }

  /// How far the line through `to` is turned against that through `from`, seen from where the wave
  /// comes from, below the edge.
  static double turn(const Fit& fit, double from, double to) {
    if (!(fit.k > 0)) return 0;
    const double x = fit.ux / fit.k, y = fit.uy / fit.k;
    return std::atan2(from - x, y) - std::atan2(to - x, y);
  }

  const WaveSurface& surface_;
  const WaveTables& tables_;
  const WaveFront& front_;
  int samples_;
  const WaveStart& start_;
  double close_;
  std::size_t count_;
  std::vector<double> direction_;
  std::vector<char> in_doubt_;
  std::vector<Way> ways_;  ///< to the node that is looked at
  double shortest_ = kUnreached;
  bool mirrored_ = false;
};

}  // namespace

double close_share(int samples) { return samples == 1 ? 4e-3 : 1e-3; }

WaveDirections wave_directions(const WaveSurface& surface, const WaveTables& tables,
                               const WaveFront& front, int samples, const WaveStart& start) {
  return DirectionPass(surface, tables, front, samples, start).run();
}

}  // namespace geotherm
