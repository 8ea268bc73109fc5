// SPDX-License-Identifier: MIT
// The vector heat method on the triangulation of the heat method.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <string>
#include <utility>

#include "geotherm/heat_method.h"
#include "solver/core/parallel.h"
#include "solver/core/text.h"
#include "solver/directions/vector_heat_state.h"

namespace geotherm {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The surface of a heat method, where it is that of vectors: Delaunay with vertices inserted where
/// they are needed, by the same backend.
std::shared_ptr<const Surface> surface_of(const HeatMethod* method, const TriangleMesh* mesh,
                                          const Backend* backend) {
  const auto triangulation = method != nullptr ? method->delaunay_triangulation() : nullptr;
  if (!triangulation) return nullptr;
  auto surface = std::static_pointer_cast<const Surface>(triangulation);
  const bool same = surface->mesh.get() == mesh && surface->backend == backend;
  return same ? surface : nullptr;
}

/// The power of two that brings the largest of some numbers to between 1 and 2; 0 where all are 0.
/// Scaled by it they neither vanish beside others nor overflow, and keep their digits.
int scale_exponent(std::span<const double> numbers) {
  double most = 0;
  for (const double x : numbers) most = std::max(most, std::abs(x));
  return most > 0 ? std::ilogb(most) : 0;
}

/// Refuses a vertex at which two things are given that differ. `rows`: of the vertices, where the
/// same row is the same vertex; `same`: whether two in the list are equal.
template <class Same>
Result<void> one_given_at_each(std::span<const Index> vertices, std::span<const Index> rows,
                               const char* what, Same&& same) {
  std::map<Index, std::size_t> first;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [known, is_new] = first.try_emplace(rows[i], i);
    if (is_new || same(known->second, i)) continue;
    const Index a = vertices[known->second], b = vertices[i];
    return Error{ErrorCode::kBadInput,
                 (a == b ? "vertex " + std::to_string(a) + " was"
                         : "vertices " + std::to_string(a) + " and " + std::to_string(b) +
                               ", which are one, were") +
                     " given two different " + what,
                 {"give one for each vertex"}};
  }
  return {};
}

/// Says how many vertices have no answer, and why. `lost`: in faces, without an answer.
void note_without_answer(const Components& parts, Index loose, Index lost, const char* what,
                         Spread& out) {
  if (loose > 0) {
    out.warnings.push_back(
        {counted_text(static_cast<std::size_t>(loose), "vertex belongs", "vertices belong") +
         " to no face and " + (loose == 1 ? "has" : "have") + " no " + what + " (NaN)"});
  }
  if (lost == 0) return;
  out.warnings.push_back(
      {counted_text(static_cast<std::size_t>(lost), "vertex lies", "vertices lie") +
           " in components without a given " + what + " (there are " +
           counted_text(static_cast<std::size_t>(parts.count), "component", "components") +
           ") and " + (lost == 1 ? "has" : "have") + " none (NaN)",
       {"give one in each component"}});
}

}  // namespace

Result<std::shared_ptr<const LinearSystem>> VectorHeat::State::factorize(double time) const {
  FactorOptions options;
  options.threads = threads;
  auto system = LinearSystem::build(*surface, 1, time, {}, options);
  if (!system) return about_time(system.error());
  return system;
}

Result<std::vector<Index>> VectorHeat::State::rows_of(std::span<const Index> vertices) const {
  if (vertices.empty()) return Error{ErrorCode::kBadInput, "there is no vertex to start from", {}};
  std::vector<Index> rows;
  for (const Index v : vertices) {
    if (v < 0 || v >= mesh().vertex_count()) {
      return Error{ErrorCode::kBadInput,
                   "there is no vertex " + std::to_string(v),
                   {"the mesh has 0 to " + std::to_string(mesh().vertex_count() - 1)}};
    }
    rows.push_back(row_of(v));
    if (rows.back() == kNoIndex) {
      return Error{ErrorCode::kBadInput,
                   "vertex " + std::to_string(v) + " is in no face",
                   {"choose another"}};
    }
  }
  return rows;
}

VectorHeat::VectorHeat(std::unique_ptr<const State> state) : state_(std::move(state)) {}
VectorHeat::~VectorHeat() = default;

Result<std::span<const TangentFrame>> VectorHeat::frames(const Progress& progress) const try {
  const auto parts = state_->vector_parts(progress);
  if (!parts) return parts.error();
  return std::span<const TangentFrame>((*parts)->frames);
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->mesh().face_count());
}

Result<std::shared_ptr<const VectorHeat>> VectorHeat::build(
    std::shared_ptr<const TriangleMesh> mesh, const SpreadOptions& options,
    const Progress& progress, const HeatMethod* beside) try {
  if (!(options.time_factor > 0) || !std::isfinite(options.time_factor)) {
    return Error{ErrorCode::kBadInput,
                 "a time factor of " + number_text(options.time_factor) + " is none",
                 {"give one above 0, such as ", SettingHint{"time-factor", {"1"}}}};
  }
  const auto backend =
      find_backend(options.backend.empty() ? backend_names().front() : options.backend);
  if (!backend) return backend.error();
  auto state = std::make_unique<State>();
  state->threads = thread_count(options.threads);
  state->surface = surface_of(beside, mesh.get(), *backend);
  if (!state->surface) {
    auto surface = build_surface(mesh, **backend, LaplacianKind::kAuto, state->threads,
                                 part_of(progress, 0, 0.5));
    if (!surface) return surface.error();
    state->surface = *std::move(surface);
  }
  if (!report(progress, "factorize", 0.5)) return cancelled_error();
  const double edge = state->surface->mean_edge / state->surface->unit;
  state->t = options.time_factor * edge * edge;
  auto scalar = state->factorize(state->t);
  if (!scalar) return scalar.error();
  state->scalar = *std::move(scalar);
  return std::shared_ptr<const VectorHeat>(new VectorHeat(std::move(state)));
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(mesh ? mesh->face_count() : 0);
}

Result<Spread> VectorHeat::transport(std::span<const TangentVector> vectors,
                                     const Progress& progress) const try {
  const State& state = *state_;
  std::vector<Index> vertices;
  std::vector<double> lengths, components;
  std::vector<std::complex<double>> given;
  for (const TangentVector& v : vectors) {
    vertices.push_back(v.vertex);
    given.emplace_back(v.x, v.y);
    components.insert(components.end(), {v.x, v.y});
    if (!std::isfinite(v.x) || !std::isfinite(v.y)) {
      return Error{ErrorCode::kBadInput,
                   "the vector at vertex " + std::to_string(v.vertex) + " is not finite",
                   {}};
    }
  }
  const int exponent = scale_exponent(components);
  for (std::complex<double>& v : given) {
    v = {std::ldexp(v.real(), -exponent), std::ldexp(v.imag(), -exponent)};
    lengths.push_back(std::abs(v));
  }
  const auto parts = state.vector_parts(part_of(progress, 0, 0.2));
  if (!parts) return parts.error();
  if ((*parts)->broken) return *(*parts)->broken;
  const auto rows = state.rows_of(vertices);
  if (!rows) return rows.error();
  const auto single =
      one_given_at_each(vertices, *rows, "vectors",
                        [&given](std::size_t i, std::size_t k) { return given[i] == given[k]; });
  if (!single) return single.error();
  Spread out;
  Index loose = 0, lost = 0;
  const auto warmth = state.warm(*rows, true, out.warnings, part_of(progress, 0.2, 0.4));
  if (!warmth) return warmth.error();
  const auto size =
      state.spread(*warmth, *rows, lengths, out.warnings, part_of(progress, 0.4, 0.5));
  if (!size) return size.error();
  const auto carried = state.carry(*warmth, *rows, given, part_of(progress, 0.5, 1));
  if (!carried) return carried.error();
  out.t = warmth->t * state.unit() * state.unit();
  for (Index v = 0; v < state.mesh().vertex_count(); ++v) {
    const Index row = state.row_of(v);
    if (row == kNoIndex || warmth->reached[row] == 0) {
      ++(row == kNoIndex ? loose : lost);
      out.components.push_back({kNaN, kNaN});
      out.vectors.push_back(Vec3::Constant(kNaN));
      continue;
    }
    const double norm = std::copysign(std::abs((*carried)[row]), warmth->heat.u(row, 0));
    const double factor = norm != 0 ? (*size)[row] / norm : 0;
    const double x = std::ldexp((*carried)[row].real() * factor, exponent);
    const double y = std::ldexp((*carried)[row].imag() * factor, exponent);
    out.components.push_back({x, y});
    const TangentFrame& frame = (*parts)->frames[state.mesh().standing_for(v)];
    out.vectors.push_back(x * frame.e1 + y * frame.e2);
  }
  note_without_answer(state.surface->parts_of_rows(), loose, lost, "vector", out);
  return out;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->mesh().face_count());
}

Result<Spread> VectorHeat::extend(std::span<const Index> vertices, std::span<const double> values,
                                  const Progress& progress) const try {
  const State& state = *state_;
  if (vertices.size() != values.size()) {
    return Error{ErrorCode::kBadInput,
                 std::to_string(values.size()) + " values for " + std::to_string(vertices.size()) +
                     " vertices",
                 {"give one for each"}};
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    return Error{ErrorCode::kBadInput,
                 "the value at vertex " + std::to_string(vertices[i]) + " is not finite",
                 {}};
  }
  const auto rows = state.rows_of(vertices);
  if (!rows) return rows.error();
  const auto single =
      one_given_at_each(vertices, *rows, "values",
                        [&values](std::size_t i, std::size_t k) { return values[i] == values[k]; });
  if (!single) return single.error();
  const int exponent = scale_exponent(values);
  std::vector<double> scaled;
  for (const double value : values) scaled.push_back(std::ldexp(value, -exponent));
  Spread out;
  Index loose = 0, lost = 0;
  const auto warmth = state.warm(*rows, false, out.warnings, part_of(progress, 0, 0.5));
  if (!warmth) return warmth.error();
  const auto spread = state.spread(*warmth, *rows, scaled, out.warnings, part_of(progress, 0.5, 1));
  if (!spread) return spread.error();
  out.t = warmth->t * state.unit() * state.unit();
  for (Index v = 0; v < state.mesh().vertex_count(); ++v) {
    const Index row = state.row_of(v);
    const bool has = row != kNoIndex && warmth->reached[row] != 0;
    out.values.push_back(has ? std::ldexp((*spread)[row], exponent) : kNaN);
    if (!has) ++(row == kNoIndex ? loose : lost);
  }
  note_without_answer(state.surface->parts_of_rows(), loose, lost, "value", out);
  return out;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->mesh().face_count());
}

}  // namespace geotherm
