// SPDX-License-Identifier: MIT
#include "solver/accuracy/check_heat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "solver/accuracy/distance_bounds.h"
#include "solver/core/parallel.h"
#include "solver/core/text.h"
#include "solver/heat/normalize.h"

namespace geotherm {

double heat_residual(const DomainOperator& matrix, const HeatField& heat, const Block& b,
                     Eigen::Index column) {
  const auto n = static_cast<std::size_t>(matrix.size());
  std::vector<double> u(n), product(n);
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = heat.u(static_cast<Eigen::Index>(i), column);
    if (heat.level.empty()) continue;
    const int level =
        heat.level[i * static_cast<std::size_t>(heat.u.cols()) + static_cast<std::size_t>(column)];
    for (int k = 0; k < level && u[i] != 0; ++k) u[i] *= heat.step;
  }
  matrix.apply_free(u, product);
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double right = b(static_cast<Eigen::Index>(i), column);
    norm += right * right;  // of held rows, too: all the heat there is may come from them
    if (matrix.is_held(static_cast<Index>(i))) continue;
    error += (product[i] - right) * (product[i] - right);
  }
  return norm > 0 ? std::sqrt(error / norm) : std::sqrt(error);
}

double poisson_residual(const Domain& domain, std::span<const double> phi, const Block& b,
                        Eigen::Index column, const SourceAnchors& anchors, bool skip_anchors,
                        int threads) {
  std::vector<double> product(phi.size());
  domain.apply_stiffness(phi, product, threads);
  const Components& components = domain.parts_of_rows();
  std::vector<char> holds(static_cast<std::size_t>(components.count), 0);
  for (const Index c : anchors.components) holds[c] = 1;
  double error = 0, norm = 0;
  auto anchor = anchors.anchors.begin();
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const bool here = anchor != anchors.anchors.end() && anchor->row == static_cast<Index>(i);
    if (here) ++anchor;
    if (!holds[components.of[i]]) continue;
    if (here && skip_anchors) continue;
    const double right = b(static_cast<Eigen::Index>(i), column);
    error += (product[i] - right) * (product[i] - right);
    norm += right * right;
  }
  return norm > 0 ? std::sqrt(error / norm) : std::sqrt(error);
}

namespace {

/// Sums over a range of faces.
struct FaceSums {
  double error = 0, area = 0;
  Index in_reach = 0, without_direction = 0, lost = 0;  ///< in halves
  SteepSides steep;

  void add(const FaceSums& other) {
    error += other.error;
    area += other.area;
    in_reach += other.in_reach;
    without_direction += other.without_direction;
    lost += other.lost;
    steep.add(other.steep);
  }
};

double length(const std::array<double, 2>& g) {
  constexpr double kSafeLow = 1e-280, kSafeHigh = 1e280;
  const double square = g[0] * g[0] + g[1] * g[1];
  return square > kSafeLow && square < kSafeHigh ? std::sqrt(square) : std::hypot(g[0], g[1]);
}

}  // namespace

CellCounts inspect_faces(const OperatorMesh& mesh, std::span<const Side> twin,
                         const SteepSides& steep, const FaceField& field,
                         std::span<const double> phi, Eigen::Index column,
                         const SourceAnchors& anchors, std::span<const char> held_at_zero,
                         int threads, Quality& quality, std::span<const char> some) {
  std::vector<char> held(phi.size(), 0);
  std::ranges::copy(held_at_zero, held.begin());
  for (const auto& anchor : anchors.anchors) held[anchor.row] = 1;
  std::vector<char> holds(static_cast<std::size_t>(mesh.components.count), 0);
  for (const Index c : anchors.components) holds[c] = 1;
  const auto inspect = [&](Index f, FaceSums& sums) {
    const Face& face = mesh.faces[f];
    if (!some.empty() && !some[static_cast<std::size_t>(f)]) return;
    if (!holds[mesh.components.of[face[0]]]) return;
    // In halves, since a face of a tufted cover is half of one of the surface.
    const Index halves = mesh.is_doubled(mesh.components.of[face[0]]) ? 1 : 2;
    sums.in_reach += halves;
    const auto x = field.of_face(f, column);
    const bool known = held[face[0]] && held[face[1]] && held[face[2]];
    if (x[0] == 0 && x[1] == 0) {
      sums.without_direction += halves;
      if (!known) sums.lost += halves;
    }
    const auto g = gradient(mesh.layout[f], phi[face[0]], phi[face[1]], phi[face[2]]);
    const double face_area = mesh.layout[f].base * mesh.layout[f].height / 2;
    const double slope = length(g);
    if (known && slope == 0) return;  // sources alone: no distance rises here
    sums.error += face_area * std::abs(slope - 1);
    sums.area += face_area;
    if (!steep.may_be_steep(slope)) return;
    const FaceLayout& p = mesh.layout[f];
    const double lengths[3] = {p.base, std::hypot(p.base - p.x, p.height),
                               std::hypot(p.x, p.height)};
    for (int k = 0; k < 3; ++k) {
      const double difference =
          std::max(phi[face[next_corner(k)]], 0.0) - std::max(phi[face[k]], 0.0);
      if (!steep.is_steep(difference, lengths[k])) continue;
      const Side side = 3 * static_cast<Side>(mesh.intrinsic_face[f]) + k;
      const double share = twin[side] == kNoSide ? 1.0 : 0.5;
      sums.steep.add(difference, lengths[k], share * halves / 2);
    }
  };
  FaceSums sums;
  for (const FaceSums& part : sums_of_blocks<FaceSums>(
           threads, mesh.face_count(), [&](std::int64_t begin, std::int64_t end) {
             FaceSums part;
             for (auto f = static_cast<Index>(begin); f < end; ++f) inspect(f, part);
             return part;
           })) {
    sums.add(part);
  }
  sums.steep.write_to(quality);
  quality.zero_gradient_faces = (sums.lost + 1) / 2;
  quality.eikonal_error_mean = sums.area > 0 ? sums.error / sums.area : 0.0;
  return {(sums.in_reach + 1) / 2, (sums.without_direction + 1) / 2, sums.area};
}

namespace {

/// Residuals above the first are worth a word: backends reach 1e-9 and better. Above the second
/// there is no solution; the penalty mode, which is wrong by design, comes to some 1e-3.
constexpr double kSuspiciousResidual = 1e-6;
/// Compact factors leave what their rounding times the range of phi in mean edges is: 1e-4 at four
/// million faces, with distances right to 1e-7.
constexpr double kSuspiciousOfCompact = 1e-3;
constexpr double kUselessResidual = 0.1;
/// Times beyond these, in squares of the mean edge, may be why a system could not be solved.
constexpr double kLargeTime = 1e3;
constexpr double kSmallTime = 1e-3;
/// A mean error of the slope that no good distance has: at usual times it is below 0.1, and the
/// smoothest useful distances have some 0.3.
constexpr double kWrongSlope = 0.4;
/// Faces within a Dirichlet boundary, whose corners are all held, are no loss in a corner or two.
/// Above this share of all faces they are.
constexpr double kBoundaryShare = 0.1;

/// `words`, and the setting that t follows from.
Hint time_hint(const std::string& words, TimeRule rule) {
  if (rule == TimeRule::kAbsolute) return {words, SettingHint{"time-step"}, " absolute:T"};
  return {words, SettingHint{"time-factor"}};
}

Hint other_boundary_rule() { return {"use ", SettingHint{"boundary", {"neumann", "average"}}}; }

std::string share(Index count, std::size_t of) {
  return "(" + rounded_text(100.0 * count / static_cast<double>(std::max<std::size_t>(of, 1))) +
         " %)";
}

/// Whether most of the cells are cut off by a boundary that is held at 0.
bool is_cut_off(const HeatOptions& options, const CellCounts& cells) {
  return options.boundary == BoundaryRule::kDirichlet &&
         cells.without_direction > kBoundaryShare * cells.in_reach;
}

void add_lost_cells(const HeatOptions& options, double unit_t, const CellCounts& cells,
                    const char* names, DistanceResult& result) {
  const bool dirichlet = options.boundary == BoundaryRule::kDirichlet;
  const bool mostly_boundary = is_cut_off(options, cells);
  const Index lost = mostly_boundary ? cells.without_direction : result.quality.zero_gradient_faces;
  if (lost == 0) return;
  result.warnings.push_back(
      {"the heat has no direction on " + std::to_string(lost) + " of " +
           std::to_string(cells.in_reach) + " " + names + " " +
           share(lost, static_cast<std::size_t>(cells.in_reach)) +
           (dirichlet ? ": the boundary, held at 0, cuts them off"
                      : ", distances there follow their surroundings"),
       dirichlet ? other_boundary_rule()
                 : time_hint(is_extreme_time(unit_t) && unit_t > 1 ? "lower " : "raise ",
                             options.time_step.rule)});
}

void add_clamped_vertices(const HeatOptions& options, BelowLine below, DistanceResult& result) {
  const Index clamped = result.quality.clamped_vertices;
  if (clamped == 0) return;
  Warning warning{counted_text(static_cast<std::size_t>(clamped), "vertex ", "vertices ") +
                  share(clamped, static_cast<std::size_t>(result.quality.reached_vertices)) +
                  (below == BelowLine::kRaised
                       ? " came out below 0, and the straight line to the nearest source stands "
                         "there instead"
                       : " had a distance below 0, which was set to 0")};
  if (options.boundary == BoundaryRule::kDirichlet) {
    warning.hint = other_boundary_rule();
  } else if (options.constraint.mode != ConstraintMode::kPinSources) {
    warning.hint = {SettingHint{"constraint", {"pin-sources"}}, " holds every source at 0"};
  } else {
    warning.message +=
        below == BelowLine::kRaised
            ? ": the heat carries no information there, and where ways bend distances are too short"
            : ": the heat carries no information there, and distances around them are too short";
    if (below == BelowLine::kKept && result.quality.clamped_reach > 0) {  // else none was measured
      warning.message += ", up to " + rounded_text(result.quality.clamped_reach) +
                         " from the sources in a straight line";
    }
    warning.hint = {"use ", SettingHint{"method", {"wavefront"}}};
  }
  result.warnings.push_back(std::move(warning));
}

/// What makes the slope right. `cell_names`: as assess_heat() takes them.
Hint slope_hint(const HeatOptions& options, double unit_t, const CellCounts& cells,
                std::string_view cell_names) {
  if (is_cut_off(options, cells)) return other_boundary_rule();
  if (unit_t > 1) return time_hint("use a smaller ", options.time_step.rule);
  if (is_extreme_time(unit_t)) return time_hint("raise ", options.time_step.rule);
  // Cells that are no faces, those of grids, volumes and polygons, are not refined by the program.
  if (cell_names != "faces") return {"use ", SettingHint{"method", {"wavefront"}}};
  return {"refine the mesh"};
}

}  // namespace

bool is_extreme_time(double unit_t) { return unit_t > kLargeTime || unit_t < kSmallTime; }

Error with_time_hint(Error error, double unit_t, TimeRule rule) {
  const bool numerical =
      error.code == ErrorCode::kNumericalFailure || error.code == ErrorCode::kBudgetEnded;
  if (!numerical || !is_extreme_time(unit_t)) return error;
  error.hint = time_hint("t is " + rounded_text(unit_t) + " squared mean edges: try a " +
                             (unit_t > 1 ? "smaller " : "larger "),
                         rule);
  return error;
}

Result<void> assess_heat(const HeatOptions& options, double unit_t, const CellCounts& cells,
                         DistanceResult& result, double usual_heat_residual,
                         const char* cell_names) {
  const Quality& q = result.quality;
  add_lost_cells(options, unit_t, cells, cell_names, result);
  const bool raises = uses_what_is_known(options) && q.lines_checked;
  const BelowLine below = raises ? BelowLine::kRaised : BelowLine::kKept;
  add_clamped_vertices(options, below, result);
  add_bound_warnings(MethodKind::kHeat, result, below);
  for (const bool heat : {true, false}) {
    const double residual = heat ? q.heat_residual : q.poisson_residual;
    const bool direct = (heat ? q.iterations_heat : q.iterations_poisson) == 0;
    const bool compact = options.precision == Precision::kCompact && direct;
    const double usual = std::max(compact ? kSuspiciousOfCompact : kSuspiciousResidual,
                                  heat ? usual_heat_residual : 0.0);
    if (residual <= usual) continue;  // false for what is no number
    const std::string text = std::string("the ") + (heat ? "heat" : "Poisson") +
                             " system was solved to a residual of " + rounded_text(residual) +
                             " only";
    const bool by_design = !heat && options.constraint.mode == ConstraintMode::kPenalty;
    if (!std::isfinite(residual) || (residual > kUselessResidual && !by_design)) {
      return with_time_hint(
          {ErrorCode::kNumericalFailure, text + ", which is no solution",
           no_answer_hint(heat ? ConstraintMode::kPinSources : options.constraint.mode)},
          unit_t, options.time_step.rule);
    }
    result.warnings.push_back({text});
  }
  if (q.eikonal_error_mean > kWrongSlope) {
    result.warnings.push_back(
        {"the slope of the distance is off by " + rounded_text(q.eikonal_error_mean) +
             " on average, where 1 is right (t is " + rounded_text(unit_t) + " squared mean edges)",
         slope_hint(options, unit_t, cells, cell_names)});
  }
  return {};
}

}  // namespace geotherm
