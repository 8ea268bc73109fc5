// SPDX-License-Identifier: MIT
// Frechet means and medians.
#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "geotherm/many.h"
#include "geotherm/polyhedral_methods.h"
#include "solver/core/text.h"
#include "solver/directions/directions_state.h"
#include "solver/directions/pointed_mesh.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;

/// A descent goes on until what is left to do is this share of the mean distance; it has converged
/// with the second, whose square is about what rounding leaves of an energy. Maps by waves are no
/// better than the third.
constexpr double kAtRest = 1e-7, kConverged = 1e-5, kConvergedByWaves = 5e-3;
/// Above so many faces the way near the centre is made by waves, which take less time.
constexpr Index kManyFaces = 20'000;
/// Energies that differ by less are equal but for rounding.
constexpr double kSameEnergy = 1e-12;
/// So many starts are tried, and a step is halved so often.
constexpr std::size_t kMaxStarts = 8;
constexpr int kHalvings = 12;
/// Minima whose energies differ by less than this share cannot be told apart on a mesh; those
/// within the second are told.
constexpr double kTied = 1e-3, kAboutAsLow = 0.02;
/// Descents that end nearer to each other than this share of the mean edge have found one minimum.
constexpr double kOnePlace = 0.01;

/// Points in a plane, as they are seen from one on the surface.
struct Seen {
  std::vector<Point2> places;
  std::span<const double> weights;
};

Point2 mean_of(const Seen& seen) {
  Point2 sum = Point2::Zero();
  double weight = 0;
  for (std::size_t i = 0; i < seen.places.size(); ++i) {
    sum += seen.weights[i] * seen.places[i];
    weight += seen.weights[i];
  }
  return sum / weight;
}

/// One iteration of Weiszfeld's from z. Where points lie within `near` of z, their weights hold it
/// back (Vardi, Zhang 2000).
Point2 towards_median(const Seen& seen, const Point2& z, double near) {
  Point2 pull = Point2::Zero();
  double stiffness = 0, held = 0;
  for (std::size_t i = 0; i < seen.places.size(); ++i) {
    const Point2 way = seen.places[i] - z;
    const double distance = way.norm();
    if (distance <= near) {
      held += seen.weights[i];
    } else {
      pull += seen.weights[i] / distance * way;
      stiffness += seen.weights[i] / distance;
    }
  }
  if (!(stiffness > 0) || pull.norm() <= held) return z;
  return z + (1 - held / pull.norm()) * pull / stiffness;
}

Point2 median_of(const Seen& seen, double scale) {
  constexpr int kIterations = 4000, kBetweenChecks = 40;
  const double near = 1e-14 * scale;
  Point2 z = mean_of(seen);
  for (int i = 1; i <= kIterations; ++i) {
    const Point2 next = towards_median(seen, z, near);
    const bool rests = (next - z).norm() <= near;
    z = next;
    if (!rests && i % kBetweenChecks != 0) continue;
    // The iteration comes to rest slowly where a point is the median.
    const Point2 nearest = *std::ranges::min_element(
        seen.places, {}, [&z](const Point2& place) { return (place - z).squaredNorm(); });
    if (towards_median(seen, nearest, near) == nearest) return nearest;
    if (rests) break;
  }
  return z;
}

/// The energy at a place on the surface, and the step from there that the tangent plane suggests.
struct Place {
  SurfacePoint point;
  TangentFrame frame;
  double energy = 0, scale = 0;
  Point2 step = Point2::Zero();
  Index at = kNoIndex;  ///< the point that the step leads to, if it does
  std::vector<double> distances;

  double residual() const { return step.norm(); }
};

class CentreDescent {
 public:
  CentreDescent(const Directions& directions, const PointedMesh& pointed,
                std::span<const double> weights, const CentreOptions& options)
      : directions_(directions), pointed_(pointed), weights_(weights), options_(options) {}

  Result<Centre> run(const SurfacePoint& start, const Progress& progress) {
    auto begun = place_at(start, progress);
    if (!begun) return begun.error();
    Place here = *std::move(begun);
    Centre out;
    for (int i = 0; i < options_.max_steps; ++i) {
      out.energies.push_back(here.energy);
      if (here.residual() <= kAtRest * here.scale) break;
      auto next = better(here, progress);
      if (!next) return next.error();
      if (next->distances.empty()) break;
      here = *std::move(next);
    }
    out.point = here.point;
    out.energy = here.energy;
    out.residual = here.residual();
    out.converged = has_converged(here);
    out.distances = std::move(here.distances);
    return out;
  }

 private:
  bool is_exact() const { return options_.method == MethodKind::kExact; }
  bool has_converged(const Place& place) const {
    return place.residual() <= (is_exact() ? kConverged : kConvergedByWaves) * place.scale;
  }

  Result<Place> place_at(const SurfacePoint& point, const Progress& progress) {
    const LogMapOptions map_options{options_.method, kUnreached, pointed_.vertices};
    const auto map = directions_.log_map(point, map_options, progress);
    if (!map) return map.error();
    Place out;
    out.point = point;
    out.frame = map->frame;
    Seen seen{{}, weights_};
    double weight = 0;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const auto v = static_cast<std::size_t>(pointed_.vertices[i]);
      const double d = map->distances[v], angle = map->directions[v];
      out.distances.push_back(d);
      seen.places.emplace_back(d > 0 ? Point2(d * std::cos(angle), d * std::sin(angle))
                                     : Point2(Point2::Zero()));
      weight += weights_[i];
      out.scale += weights_[i] * d;
      out.energy += weights_[i] * (options_.kind == CentreKind::kMean ? d * d : d);
    }
    out.energy /= weight;
    out.scale /= weight;
    if (!std::isfinite(out.energy)) return out;
    out.step = options_.kind == CentreKind::kMean ? mean_of(seen) : median_of(seen, out.scale);
    const auto hit = std::ranges::find(seen.places, out.step);
    if (hit != seen.places.end()) out.at = pointed_.vertices[hit - seen.places.begin()];
    return out;
  }

  /// A place of less energy, or as much and a smaller step left; one without distances: there is
  /// none near. First along the step, then to its sides.
  Result<Place> better(const Place& here, const Progress& progress) {
    constexpr double kPi = std::numbers::pi;
    for (const double turn : {0.0, kPi / 4, -kPi / 4, kPi / 2, -kPi / 2}) {
      if (turn != 0 && (has_converged(here) || !is_exact())) break;
      double share = 1;
      for (int i = 0; i < kHalvings; ++i, share /= 2) {
        const auto point = i == 0 && turn == 0 && here.at != kNoIndex
                               ? Result<SurfacePoint>(SurfacePoint::at_vertex(here.at))
                               : go(here, turn, share * here.residual());
        if (!point) break;
        auto there = place_at(*point, progress);
        if (!there && there.error().code == ErrorCode::kBadInput) continue;  // no order there
        if (!there) return there.error();
        const bool lower = there->energy < here.energy * (1 - kSameEnergy);
        const bool same = there->energy <= here.energy * (1 + kSameEnergy);
        if (lower || (same && there->residual() < here.residual() / 2)) return there;
      }
    }
    return Place{};
  }

  Result<SurfacePoint> go(const Place& here, double turn, double length) const {
    double angle = angle_of(here.step) + turn;
    if (here.frame.on_boundary) {
      angle -= 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi));
    }
    const auto line = directions_.trace(here.point, angle, length);
    if (!line) return line.error();
    return line->path.points.back();
  }

  const Directions& directions_;
  const PointedMesh& pointed_;
  std::span<const double> weights_;
  const CentreOptions& options_;
};

Result<void> check_asked(std::span<const SurfacePoint> points, std::span<const double> weights,
                         const CentreOptions& options) {
  if (points.empty()) {
    return Error{ErrorCode::kBadInput, "a centre of no points was asked for", {"name one"}};
  }
  if (!weights.empty() && weights.size() != points.size()) {
    return Error{ErrorCode::kBadInput,
                 counted_text(weights.size(), "weight", "weights") + " for " +
                     counted_text(points.size(), "point", "points"),
                 {"give one for each, or none"}};
  }
  const auto bad =
      std::ranges::find_if(weights, [](double w) { return !(w >= 0) || !std::isfinite(w); });
  if (bad != weights.end()) {
    return Error{ErrorCode::kBadInput,
                 "weight " + std::to_string(bad - weights.begin()) + " is " + number_text(*bad),
                 {"give numbers from 0 on"}};
  }
  if (!weights.empty() && *std::ranges::max_element(weights) == 0) {
    return Error{ErrorCode::kBadInput, "all weights are 0", {"give one that is above"}};
  }
  if (options.max_steps >= 1) return {};
  return Error{ErrorCode::kBadInput,
               "a descent of " + std::to_string(options.max_steps) + " steps was asked for",
               {"give 1 or more"}};
}

/// The energy of a centre at every vertex, from near-exact distances.
Result<std::vector<double>> energies_at_vertices(const WavefrontMethod& method,
                                                 std::span<const SurfacePoint> points,
                                                 std::span<const double> weights,
                                                 const CentreOptions& options, Index vertices,
                                                 const Progress& progress) {
  std::vector<SourceSet> sets(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) sets[i].points.push_back(points[i]);
  const double weight = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> sum(static_cast<std::size_t>(vertices), 0.0);
  const auto add = [&](std::size_t set, DistanceResult&& answer) -> Result<void> {
    const double share = weights[set] / weight;
    for (std::size_t v = 0; v < sum.size(); ++v) {
      const double d = answer.distances[v];
      const double term = options.kind == CentreKind::kMean ? share * d * d : share * d;
      sum[v] += d < kUnreached ? term : kUnreached;  // with a weight of 0, too
    }
    return {};
  };
  StreamOptions stream;
  stream.query.quality = false;
  if (auto done = stream_answers(method, sets, stream, add, progress); !done) return done.error();
  return sum;
}

/// Vertices with no lower neighbour whose energy could be the least of all, the lowest first.
std::vector<Index> starts_of(const TriangleMesh& mesh, const std::vector<double>& energies,
                             double slack) {
  std::vector<char> low = vertices_in_faces(mesh.vertex_count(), mesh.faces());
  for (const Face& face : mesh.faces()) {
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k], b = face[next_corner(k)];
      if (energies[a] > energies[b]) low[a] = 0;
      if (energies[b] > energies[a]) low[b] = 0;
    }
  }
  const double least = *std::ranges::min_element(energies);
  std::vector<Index> out;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (low[v] != 0 && energies[v] <= least + slack) out.push_back(v);
  }
  std::ranges::stable_sort(out, {}, [&](Index v) { return energies[v]; });
  if (out.size() > kMaxStarts) out.resize(kMaxStarts);
  return out;
}

/// `exponent`: of the power of two that lengths are model units of.
void note(const CentreOptions& options, int exponent, Centres& out) {
  const Centre& best = out.found.front();
  const std::string what = to_text(options.kind);
  if (!best.converged) {
    out.warnings.push_back(
        {"the descent to the " + what + " stalled with a step of " +
         rounded_text(std::ldexp(best.residual, exponent)) +
         " left to do: the point may be a tip, on the boundary or at a crease of the distances"});
  }
  const auto tied = std::ranges::count_if(out.found, [&best](const Centre& other) {
    return other.energy <= best.energy * (1 + kTied);
  });
  if (tied < 2) return;
  out.warnings.push_back({std::to_string(tied) + " minima or more have an energy within " +
                          rounded_text(100 * kTied) + " % of the least: the " + what +
                          " is not unique"});
}

/// The centres on a mesh whose lengths are model units over 2^exponent.
Result<Centres> centres_on(const std::shared_ptr<const TriangleMesh>& mesh,
                           std::span<const SurfacePoint> points, std::span<const double> weights,
                           const CentreOptions& options, int exponent, const Progress& progress) {
  const auto surface = build_wave_surface(mesh, part_of(progress, 0, 0.1), options.threads);
  if (!surface) return surface.error();
  const auto method = WavefrontMethod::build(*surface, WavefrontMethod::Samples::kMidpoint,
                                             options.threads, part_of(progress, 0.1, 0.2));
  if (!method) return method.error();
  const auto energies = energies_at_vertices(**method, points, weights, options,
                                             mesh->vertex_count(), part_of(progress, 0.2, 0.5));
  if (!energies) return energies.error();
  const double least = *std::ranges::min_element(*energies), edge = (*surface)->base.mean_edge;
  if (!std::isfinite(least)) {
    return Error{
        ErrorCode::kBadInput,
        "no vertex is reached from all of " + counted_text(points.size(), "point", "points"),
        {"choose points on one component"}};
  }
  const auto pointed = pointed_mesh(mesh, points);
  if (!pointed) return pointed.error();
  const auto directions = Directions::build(pointed->mesh, part_of(progress, 0.5, 0.6));
  if (!directions) return directions.error();

  const double slack =
      (options.kind == CentreKind::kMean ? 4 * edge * edge : 2 * edge) + kTied * least;
  const std::vector<Index> starts = starts_of(*mesh, *energies, slack);
  CentreOptions first = options;
  const bool is_large = mesh->face_count() > kManyFaces;
  if (options.method == MethodKind::kExact && is_large) first.method = MethodKind::kWavefront;
  Centres out;
  Error refused;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double begun = 0.6 + 0.4 * static_cast<double>(i) / static_cast<double>(starts.size());
    const Progress part = part_of(progress, begun, begun);  // how many steps there are is not known
    auto centre = CentreDescent(**directions, *pointed, weights, first)
                      .run(SurfacePoint::at_vertex(starts[i]), part);
    if (centre && first.method != options.method) {
      centre = CentreDescent(**directions, *pointed, weights, options).run(centre->point, part);
    }
    if (!centre && centre.error().code == ErrorCode::kBadInput) {
      refused = centre.error();
      continue;  // a start where directions have no order
    }
    if (!centre) return centre.error();
    centre->point = pointed->out_of(centre->point);
    const bool known = std::ranges::any_of(out.found, [&](const Centre& other) {
      return (position_at(*mesh, other.point) - position_at(*mesh, centre->point)).norm() <=
             kOnePlace * edge;
    });
    if (!known) out.found.push_back(*std::move(centre));
  }
  if (out.found.empty()) return refused;
  std::ranges::stable_sort(out.found, {}, &Centre::energy);
  const double most = out.found.front().energy * (1 + kAboutAsLow);
  std::erase_if(out.found, [most](const Centre& centre) { return centre.energy > most; });
  note(options, exponent, out);
  return out;
}

/// The exponent of the mesh's size where squares of lengths may leave the range of doubles, else 0.
int extreme_exponent(const TriangleMesh& mesh) {
  constexpr int kUsual = 300, kMax = 1000;  // squares go to 1023
  double most = 0;
  for (const Vec3& p : mesh.positions()) most = std::max(most, p.cwiseAbs().maxCoeff());
  const int exponent = most > 0 ? std::ilogb(most) : 0;
  return std::abs(exponent) > kUsual ? std::clamp(exponent, -kMax, kMax) : 0;
}

}  // namespace

Result<Centres> find_centres(const std::shared_ptr<const TriangleMesh>& mesh,
                             std::span<const SurfacePoint> points,
                             std::span<const double> given_weights, const CentreOptions& options,
                             const Progress& progress) try {
  if (auto fine = check_asked(points, given_weights, options); !fine) return fine.error();
  std::vector<double> weights(points.size(), 1.0);
  std::ranges::copy(given_weights, weights.begin());
  const int most = std::ilogb(*std::ranges::max_element(weights));
  for (double& weight : weights) weight = std::scalbn(weight, -most);  // their sums are doubles
  const int exponent = extreme_exponent(*mesh);
  if (exponent == 0) return centres_on(mesh, points, weights, options, 0, progress);
  const double unit = std::ldexp(1.0, exponent);
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  for (Vec3& p : positions) p /= unit;
  auto scaled = mesh->moved(std::move(positions));
  if (!scaled) return scaled.error();
  auto out = centres_on(std::make_shared<const TriangleMesh>(*std::move(scaled)), points, weights,
                        options, exponent, progress);
  if (!out) return out;
  for (Centre& centre : out->found) {
    centre.residual *= unit;
    for (double& d : centre.distances) d *= unit;
    for (int k = 0; k < (options.kind == CentreKind::kMean ? 2 : 1); ++k) {
      centre.energy *= unit;
      for (double& energy : centre.energies) energy *= unit;
    }
  }
  return out;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(mesh->face_count());
}

}  // namespace geotherm
