// SPDX-License-Identifier: MIT
// The vector heat method on the intrinsic Delaunay triangulation.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/text.h"
#include "solver/directions/vector_heat_state.h"

namespace geotherm {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Heat below this has lost digits, or will have on meshes a little wider.
constexpr double kLeastHeat = 1e-290;
/// A time is made four times as long so often at most: half a million times the width.
constexpr int kMaxTimes = 20;

/// Rows 2 i and 2 i + 1 of a pattern's row i.
SymmetricPattern doubled(const SymmetricPattern& pattern) {
  SymmetricPattern out;
  for (Index row = 0; row < 2 * pattern.size(); ++row) {
    for (const Index j : pattern.neighbors(row / 2)) {
      out.neighbor.push_back(2 * j);
      out.neighbor.push_back(2 * j + 1);
    }
    out.start.push_back(static_cast<std::int64_t>(out.neighbor.size()));
  }
  return out;
}

}  // namespace

void VectorHeat::State::add_links() {
  const IntrinsicMesh& intrinsic = flipped.mesh;
  for (Side s = 0; s < static_cast<Side>(intrinsic.twin.size()); ++s) {
    const Face& face = intrinsic.faces[face_of(s)];
    const int k = corner_of(s);
    const Index from = row_of_vertex[face[k]], to = row_of_vertex[face[next_corner(k)]];
    const auto& l = intrinsic.lengths[face_of(s)];
    const double turn = flipped.at_begin[s] - flipped.at_end[s] + std::numbers::pi;
    links.push_back({from, to, opposite_cotangent(l, k) / 2, std::cos(turn), std::sin(turn)});
    const FaceLayout p = lay_out(l);
    mass[from] += p.base * p.height / 6;
  }
}

Result<Factors> VectorHeat::State::factorize(double t) const {
  Factors out{t, nullptr};
  auto made = scalar.factorize(
      [&](const SpreadSystem::Add& add) {
        for (Index i = 0; i < size(); ++i) add(i, i, mass[i]);
        for (const Link& link : links) {
          if (link.from == link.to) continue;
          add(link.from, link.from, t * link.weight);
          add(link.to, link.to, t * link.weight);
          add(link.from, link.to, -t * link.weight);
        }
      },
      threads);
  if (!made) return made.error();
  out.scalar = *std::move(made);
  return out;
}

Result<std::shared_ptr<const Factorization>> VectorHeat::State::factorize_vectors(
    const SpreadSystem& system, double t) const {
  return system.factorize(
      [&](const SpreadSystem::Add& add) {
        for (Index i = 0; i < 2 * size(); ++i) add(i, i, mass[i / 2]);
        for (const Link& link : links) {
          const Index i = 2 * link.from, j = 2 * link.to;
          const double w = t * link.weight;
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
}

Result<VectorSystem> VectorHeat::State::vectors(double t, const Progress& progress) const {
  if (!report(progress, "factorize", 0.5)) return cancelled_error();
  const std::lock_guard lock(vector_lock_);
  if (vector_ && vector_->t == t) return *vector_;
  VectorSystem out;
  if (vector_) {
    out.system = vector_->system;
  } else {
    std::vector<Vec3> twice;
    for (const Vec3& place : places) twice.insert(twice.end(), 2, place);
    auto system = SpreadSystem::build(*backend, doubled(pattern), twice, threads);
    if (!system) return system.error();
    out.system = *std::move(system);
  }
  auto factors_there = factorize_vectors(out.system, t);
  if (!factors_there) return factors_there.error();
  out.t = t;
  out.factors = *std::move(factors_there);
  if (!vector_) vector_ = out;
  return out;
}

Result<std::vector<Index>> VectorHeat::State::rows_of(std::span<const Index> vertices) const {
  if (vertices.empty()) return Error{ErrorCode::kBadInput, "there is no vertex to start from", {}};
  std::vector<Index> rows;
  for (const Index v : vertices) {
    if (v < 0 || v >= mesh->vertex_count()) {
      return Error{ErrorCode::kBadInput,
                   "there is no vertex " + std::to_string(v),
                   {"the mesh has 0 to " + std::to_string(mesh->vertex_count() - 1)}};
    }
    rows.push_back(row_of_vertex[mesh->standing_for(v)]);
    if (rows.back() == kNoIndex) {
      return Error{ErrorCode::kBadInput,
                   "vertex " + std::to_string(v) + " is in no face",
                   {"choose another"}};
    }
  }
  return rows;
}

std::vector<char> VectorHeat::State::reached(std::span<const Index> rows) const {
  std::vector<char> part(static_cast<std::size_t>(parts.count), 0), out;
  for (const Index row : rows) part[parts.of[row]] = 1;
  for (const Index of : parts.of) out.push_back(part[of]);
  return out;
}

Result<std::vector<double>> VectorHeat::State::spread(const Factors& at,
                                                      std::span<const Index> rows,
                                                      std::span<const double> values,
                                                      const Progress& progress) const {
  std::vector<double> right(mass.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) right[rows[i]] += values.empty() ? 1 : values[i];
  return scalar.solve(*at.scalar, right, progress, threads);
}

Result<Factors> VectorHeat::State::warm(std::span<const Index> rows, std::span<const char> in_reach,
                                        std::vector<double>& heat, std::vector<Warning>& warnings,
                                        const Progress& progress) const {
  Factors at = factors;
  for (int times = 0;; ++times) {
    auto solved = spread(at, rows, {}, progress);
    if (!solved) return solved.error();
    heat = *std::move(solved);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < heat.size(); ++i) {
      if (in_reach[i]) least = std::isfinite(heat[i]) ? std::min(least, heat[i]) : 0;
    }
    if (least > kLeastHeat || times == kMaxTimes) break;
    if (!report(progress, "factorize", 0.5)) return cancelled_error();
    auto longer = factorize(4 * at.t);
    if (!longer) return longer.error();
    at = *std::move(longer);
  }
  if (at.t != factors.t) {
    warnings.push_back({"the mesh is so wide that the diffusion time is " +
                        rounded_text(at.t / factors.t) + " times as long as asked for"});
  }
  return at;
}

VectorHeat::VectorHeat(std::unique_ptr<const State> state) : state_(std::move(state)) {}
VectorHeat::~VectorHeat() = default;
const std::vector<TangentFrame>& VectorHeat::frames() const { return state_->frames; }

Result<std::shared_ptr<const VectorHeat>> VectorHeat::build(
    std::shared_ptr<const TriangleMesh> mesh, const SpreadOptions& options,
    const Progress& progress) try {
  if (!(options.time_factor > 0) || !std::isfinite(options.time_factor)) {
    return Error{ErrorCode::kBadInput,
                 "a time factor of " + number_text(options.time_factor) + " is none",
                 {"give one above 0, such as ", SettingHint{"time-factor", {"1"}}}};
  }
  const auto backend =
      find_backend(options.backend.empty() ? backend_names().front() : options.backend);
  if (!backend) return backend.error();
  if ((*backend)->iterative()) {
    return Error{ErrorCode::kNotAvailable,
                 "backend " + options.backend + " loses vectors far from where they start",
                 {"use ", SettingHint{"backend", {backend_names().front()}}}};
  }
  auto base = build_intrinsic_surface(mesh, {}, part_of(progress, 0, 0.1));
  if (!base) return base.error();
  auto waves = build_wave_surface(std::make_shared<const IntrinsicSurface>(*std::move(base)),
                                  part_of(progress, 0.1, 0.2));
  if (!waves) return waves.error();
  auto state = std::make_unique<State>();
  state->directions = std::make_unique<const Directions::State>(mesh, *std::move(waves));
  const Directions::State& directions = *state->directions;
  auto flipped =
      flip_with_directions(*directions.surface, directions.fans, part_of(progress, 0.2, 0.3));
  if (!flipped) return flipped.error();
  state->flipped = *std::move(flipped);

  state->mesh = mesh;
  state->threads = thread_count(options.threads);
  state->unit = directions.surface->base.length_unit();
  state->row_of_vertex.assign(static_cast<std::size_t>(mesh->vertex_count()), kNoIndex);
  state->frames.resize(state->row_of_vertex.size());
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    if (directions.fans.vertex(v).kind == TangentFans::Kind::kNone) continue;
    state->frames[v] = directions.frame_at(SurfacePoint::at_vertex(v));
    state->row_of_vertex[v] = static_cast<Index>(state->places.size());
    state->places.push_back(mesh->positions()[v]);
  }
  state->mass.assign(state->places.size(), 0.0);
  state->add_links();
  if (state->flipped.broken) {
    state->no_vectors =
        Error{ErrorCode::kBadInput,
              "vectors cannot be carried where the surface is no oriented manifold, "
              "as at vertex " +
                  std::to_string(*state->flipped.broken),
              {"repair the mesh; log maps and values need no such"}};
  }
  std::vector<Face> faces;
  for (const Face& f : state->flipped.mesh.faces) {
    faces.push_back(
        {state->row_of_vertex[f[0]], state->row_of_vertex[f[1]], state->row_of_vertex[f[2]]});
  }
  state->backend = *backend;
  state->pattern = pattern_of_faces(state->size(), faces);
  state->parts = connected_components(state->pattern);
  if (!report(progress, "analyze", 0.3)) return cancelled_error();
  auto scalar = SpreadSystem::build(**backend, state->pattern, state->places, state->threads);
  if (!scalar) return scalar.error();
  state->scalar = *std::move(scalar);
  if (!report(progress, "factorize", 0.5)) return cancelled_error();
  auto factors = state->factorize(options.time_factor);
  if (!factors) return factors.error();
  state->factors = *std::move(factors);
  return std::shared_ptr<const VectorHeat>(new VectorHeat(std::move(state)));
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(mesh ? mesh->face_count() : 0);
}

Result<Spread> VectorHeat::transport(std::span<const TangentVector> vectors,
                                     const Progress& progress) const try {
  const State& state = *state_;
  if (state.no_vectors) return *state.no_vectors;
  std::vector<Index> vertices;
  std::vector<double> lengths;
  for (const TangentVector& v : vectors) {
    vertices.push_back(v.vertex);
    lengths.push_back(std::hypot(v.x, v.y));
    if (!std::isfinite(lengths.back())) {
      return Error{ErrorCode::kBadInput,
                   "the vector at vertex " + std::to_string(v.vertex) + " is not finite",
                   {}};
    }
  }
  const auto rows = state.rows_of(vertices);
  if (!rows) return rows.error();
  const auto in_reach = state.reached(*rows);
  Spread out;
  std::vector<double> heat;
  const auto at = state.warm(*rows, in_reach, heat, out.warnings, progress);
  if (!at) return at.error();
  const auto size = state.spread(*at, *rows, lengths, progress);
  if (!size) return size.error();
  const auto system = state.vectors(at->t, progress);
  if (!system) return system.error();
  std::vector<double> right(2 * state.mass.size(), 0.0);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    right[2 * (*rows)[i]] += vectors[i].x;
    right[2 * (*rows)[i] + 1] += vectors[i].y;
  }
  const auto carried = system->system.solve(*system->factors, right, progress, state.threads);
  if (!carried) return carried.error();
  out.t = at->t * state.unit * state.unit;
  for (Index v = 0; v < state.mesh->vertex_count(); ++v) {
    const Index own = state.mesh->standing_for(v), row = state.row_of_vertex[own];
    if (row == kNoIndex || !in_reach[row]) {
      out.components.push_back({kNaN, kNaN});
      out.vectors.push_back(Vec3::Constant(kNaN));
      continue;
    }
    const double x = (*carried)[2 * row], y = (*carried)[2 * row + 1], norm = std::hypot(x, y);
    const double length = (*size)[row] / heat[row];
    const double factor = norm > 0 ? length / norm : 0;
    out.components.push_back({x * factor, y * factor});
    const TangentFrame& frame = state.frames[own];
    out.vectors.push_back(x * factor * frame.e1 + y * factor * frame.e2);
  }
  return out;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->mesh->face_count());
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
  const auto in_reach = state.reached(*rows);
  Spread out;
  std::vector<double> heat;
  const auto at = state.warm(*rows, in_reach, heat, out.warnings, progress);
  if (!at) return at.error();
  const auto spread = state.spread(*at, *rows, values, progress);
  if (!spread) return spread.error();
  out.t = at->t * state.unit * state.unit;
  for (Index v = 0; v < state.mesh->vertex_count(); ++v) {
    const Index row = state.row_of_vertex[state.mesh->standing_for(v)];
    const bool has = row != kNoIndex && in_reach[row];
    out.values.push_back(has ? (*spread)[row] / heat[row] : kNaN);
  }
  return out;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->mesh->face_count());
}

}  // namespace geotherm
