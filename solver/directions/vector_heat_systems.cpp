// SPDX-License-Identifier: MIT
// What the vector heat method solves: heat, values by it, and vectors by the connection Laplacian.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "solver/core/text.h"
#include "solver/directions/vector_heat_state.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {
namespace {

using Complex = std::complex<double>;

/// A time is made four times as long so often at most: half a million times the width.
constexpr int kMaxTimes = 20;
/// The share of the largest heat down to which conjugate gradients give seven digits.
constexpr double kMinHeat = 1e-6;
/// The share of the range of values by which rounding and iterations may lead out of it.
constexpr double kRangeRounding = 1e-5;

/// Says at how many vertices of the mesh heat is not what a mean is made of: the triangulation
/// keeps border edges opposite angles of up to 96 degrees, whose weights are a little below 0, and
/// these outweigh the others where faces are far wider than t reaches. is_wrong(row): of those
/// reached.
template <class IsWrong>
void note_negative_heat(const Surface& surface, const std::vector<char>& reached, const char* what,
                        const IsWrong& is_wrong, std::vector<Warning>& warnings) {
  Index vertices = 0, wrong = 0;
  for (Index row = 0; row < surface.size(); ++row) {
    if (reached[row] == 0 || !surface.is_of_input(row)) continue;
    ++vertices;
    if (is_wrong(row)) ++wrong;
  }
  if (wrong == 0) return;
  warnings.push_back({what + (" at " + std::to_string(wrong)) + " of " + std::to_string(vertices) +
                          " vertices, since the diffusion time is short for the faces at the "
                          "border; what is said there may not be that of the nearest",
                      {"raise ", SettingHint{"time-factor"}}});
}

}  // namespace

double Warmth::ratio(Index j, Index i) const {
  const auto columns = static_cast<std::size_t>(heat.u.cols());
  const double same = std::abs(heat.u(j, 0) / heat.u(i, 0));
  if (heat.level.empty()) return same;
  const int levels = int{heat.level[static_cast<std::size_t>(j) * columns]} -
                     int{heat.level[static_cast<std::size_t>(i) * columns]};
  return same * std::pow(heat.step, levels);
}

Result<Warmth> VectorHeat::State::warm(std::span<const Index> rows, bool for_vectors,
                                       std::vector<Warning>& warnings,
                                       const Progress& progress) const {
  const Components& parts = surface->parts_of_rows();
  std::vector<std::vector<char>> reached(1, std::vector<char>(parts.count, 0));
  for (const Index row : rows) reached[0][parts.of[row]] = 1;
  Warmth out{t, scalar, {}, {}};
  for (const Index part : parts.of) out.reached.push_back(reached[0][part]);
  for (int times = 0;; ++times) {
    const Workspace work{pool, threads};
    Block right = work.take_zero(size(), 1);
    for (const Index row : rows) right(row, 0) += 1;
    auto heat = diffuse(*out.system, parts, std::move(right), rows, reached,
                        iterative() ? kIterativeFloor : kDirectFloor, work, progress);
    if (!heat) return heat.error();
    out.heat = *std::move(heat);
    const bool in_range = out.heat.level.empty();
    if (iterative() || !for_vectors || in_range || times == kMaxTimes) break;
    if (!report(progress, "factorize", 0.5)) return cancelled_error();
    auto longer = factorize(4 * out.t);
    if (!longer) return longer.error();
    out.t *= 4;
    out.system = *std::move(longer);
  }
  double least = kUnreached, most = 0;
  for (Index i = 0; i < size(); ++i) {
    if (out.reached[i] == 0) continue;
    least = std::min(least, std::abs(out.heat.u(i, 0)));
    most = std::max(most, std::abs(out.heat.u(i, 0)));
  }
  out.scaled = iterative() && (!out.heat.level.empty() || !(least > kMinHeat * most));
  if (out.t != t) {
    warnings.push_back({"the mesh is so wide that the diffusion time is " +
                        rounded_text(out.t / t) + " times as long as asked for"});
  }
  note_negative_heat(
      *surface, out.reached, "heat is not positive",
      [&out](Index row) { return !(out.heat.u(row, 0) > 0); }, warnings);
  return out;
}

Result<std::vector<double>> VectorHeat::State::spread(const Warmth& warmth,
                                                      std::span<const Index> rows,
                                                      std::span<const double> values,
                                                      std::vector<Warning>& warnings,
                                                      const Progress& progress) const {
  std::vector<double> out;
  const auto [low, high] = std::ranges::minmax(values);
  const double range = high > low ? high - low : 1;
  const auto keep_in_range = [&, low = low, high = high] {
    std::vector<double> means = out;
    for (double& value : out) value = std::clamp(value, low, high);
    note_negative_heat(
        *surface, warmth.reached, "values had left their range",
        [&](Index row) { return std::abs(means[row] - out[row]) > kRangeRounding * range; },
        warnings);
  };
  if (warmth.scaled) {
    const ScaledHeat scaled(find_links(nullptr), surface->mass(), warmth.t, warmth.heat, false);
    std::vector<Complex> right;
    for (const double value : values) right.emplace_back(1, value);
    const auto both = scaled.solve(rows, right, progress);
    if (!both) return both.error();
    for (const Complex& x : *both) out.push_back(x.imag() / x.real());
    keep_in_range();
    return out;
  }
  // Above the least value all is positive and not far from the heat.
  const double offset = low - range;
  const Components& parts = surface->parts_of_rows();
  std::vector<std::vector<char>> reached(1, std::vector<char>(parts.count, 0));
  for (const Index row : rows) reached[0][parts.of[row]] = 1;
  const Workspace work{pool, threads};
  Block right = work.take_zero(size(), 1);
  for (std::size_t i = 0; i < rows.size(); ++i) right(rows[i], 0) += (values[i] - offset) / range;
  auto heat =
      diffuse(*warmth.system, parts, std::move(right), rows, reached, kDirectFloor, work, progress);
  if (!heat) return heat.error();
  const auto level = [](const HeatField& field, Index i) {
    return field.level.empty() ? 0 : int{field.level[static_cast<std::size_t>(i)]};
  };
  for (Index i = 0; i < size(); ++i) {
    const double ratio = heat->u(i, 0) / warmth.heat.u(i, 0) *
                         std::pow(heat->step, level(*heat, i) - level(warmth.heat, i));
    out.push_back(offset + range * ratio);
  }
  keep_in_range();
  return out;
}

Result<const VectorParts*> VectorHeat::State::vector_parts(const Progress& progress) const {
  const std::lock_guard lock(lock_);
  if (parts_) return parts_.get();
  auto base = build_intrinsic_surface(surface->mesh, {.strictness = Strictness::kHeights},
                                      part_of(progress, 0, 0.3), threads, surface.get());
  if (!base) return base.error();
  auto waves = build_wave_surface(std::make_shared<const IntrinsicSurface>(*std::move(base)),
                                  part_of(progress, 0.3, 0.6));
  if (!waves) return waves.error();
  auto out = std::make_unique<VectorParts>();
  out->directions = std::make_unique<const Directions::State>(surface->mesh, *std::move(waves));
  const TangentFans& fans = out->directions->fans;
  out->frames.resize(static_cast<std::size_t>(mesh().vertex_count()));
  for (Index v = 0; v < mesh().vertex_count(); ++v) {
    const Index own = mesh().standing_for(v);
    if (fans.vertex(own).kind == TangentFans::Kind::kNone) continue;
    out->frames[v] = out->directions->frame_at(SurfacePoint::at_vertex(own));
  }
  out->flipped = flip_directions(*surface, fans);
  if (out->flipped.broken) {
    out->broken = Error{ErrorCode::kBadInput,
                        "vectors cannot be carried where the surface is no oriented manifold, "
                        "as at vertex " +
                            std::to_string(*out->flipped.broken),
                        {"repair the mesh; log maps and values need no such"}};
  } else {
    out->links = find_links(&out->flipped);
  }
  parts_ = std::move(out);
  return parts_.get();
}

std::vector<Link> VectorHeat::State::find_links(const FlippedDirections* flipped) const {
  const IntrinsicMesh& intrinsic = surface->intrinsic;
  std::vector<Link> links;
  links.reserve(intrinsic.twin.size());
  for (Side s = 0; s < static_cast<Side>(intrinsic.twin.size()); ++s) {
    const Face& face = intrinsic.faces[face_of(s)];
    const int k = corner_of(s);
    Link link{surface->row_of_vertex[face[k]], surface->row_of_vertex[face[next_corner(k)]],
              opposite_cotangent(intrinsic.lengths[face_of(s)], k) / 2, 1, 0};
    if (flipped != nullptr) {
      const double turn = flipped->at_begin[s] - flipped->at_end[s] + std::numbers::pi;
      link.cosine = std::cos(turn);
      link.sine = std::sin(turn);
    }
    links.push_back(link);
  }
  return links;
}

Result<VectorHeat::State::VectorFactor> VectorHeat::State::vector_factor(
    double time, const VectorParts& parts, const Progress& progress) const {
  if (!report(progress, "factorize", 0.0)) return cancelled_error();
  const std::lock_guard lock(lock_);
  if (factor_ && factor_->t == time) return *factor_;
  if (!doubled_) {
    std::vector<Vec3> places;
    for (const Index v : surface->vertex_of_row) places.push_back(surface->position(v));
    std::vector<Face> faces(surface->operators->faces.begin(), surface->operators->faces.end());
    auto system = SpreadSystem::build_doubled(*surface->backend, *surface->analysis,
                                              pattern_of_faces(size(), faces), places, threads);
    if (!system) return system.error();
    doubled_ = *std::move(system);
  }
  auto made = doubled_->factorize(
      [&](const SpreadSystem::Add& add) {
        for (Index i = 0; i < 2 * size(); ++i) add(i, i, surface->mass()[i / 2]);
        for (const Link& link : parts.links) {
          const Index i = 2 * link.from, j = 2 * link.to;
          const double w = time * link.weight;
          if (i == j) {
            for (int k = 0; k < 2; ++k) add(i + k, i + k, 2 * w * (1 - link.cosine));
            continue;
          }
          for (int k = 0; k < 2; ++k) {
            add(i + k, i + k, w);
            add(j + k, j + k, w);
            add(i + k, j + k, -w * link.cosine);
          }
          add(i, j + 1, w * link.sine);
          add(i + 1, j, -w * link.sine);
        }
      },
      threads);
  if (!made) return about_time(made.error());
  VectorFactor out{time, *std::move(made)};
  if (!factor_) factor_ = out;
  return out;
}

Result<RowVectors> VectorHeat::State::carry(const Warmth& warmth, std::span<const Index> rows,
                                            std::span<const Complex> vectors,
                                            const Progress& progress) const {
  const auto parts = vector_parts(progress);
  if (!parts) return parts.error();
  if ((*parts)->broken) return *(*parts)->broken;
  if (warmth.scaled) {
    const ScaledHeat scaled((*parts)->links, surface->mass(), warmth.t, warmth.heat, true);
    return scaled.solve(rows, vectors, progress);
  }
  const auto factor = vector_factor(warmth.t, **parts, progress);
  if (!factor) return factor.error();
  std::vector<double> right(2 * static_cast<std::size_t>(size()), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    right[2 * rows[i]] += vectors[i].real();
    right[2 * rows[i] + 1] += vectors[i].imag();
  }
  const auto solved = doubled_->solve(*factor->factor, right, progress, threads);
  if (!solved) return solved.error();
  RowVectors out;
  for (Index i = 0; i < size(); ++i) {
    const double heat = std::abs(warmth.heat.u(i, 0));
    out.emplace_back((*solved)[2 * i] / heat, (*solved)[2 * i + 1] / heat);
  }
  return out;
}

}  // namespace geotherm
