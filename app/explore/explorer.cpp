// SPDX-License-Identifier: MIT
#include "app/explore/explorer.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "app/mesh_words.h"
#include "app/resolve_sources.h"
#include "app/solve_steps.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

Error cancelled() { return {ErrorCode::kCancelled, "the work was cancelled"}; }

/// All entries as one set, and the places of each.
Result<std::vector<std::string>> place_sources(const ExploreRequest& request, Explored& explored) {
  const TriangleMesh& mesh = *explored.model->model.mesh;
  std::vector<Source> sources;
  for (const std::string& text : request.sources) {
    auto spec = parse_source(text);
    if (!spec) return spec.error();
    sources.push_back({*std::move(spec), "source " + text.substr(0, 60), ErrorCode::kBadInput});
  }
  auto all = resolve_sources(sources, mesh);
  if (!all) return all.error();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto one = sources.size() == 1 ? *all : *resolve_sources({&sources[i], 1}, mesh);
    const auto entry = static_cast<int>(i);
    const bool alone = one.set.points.size() == 1 && one.set.edges.empty();
    for (const SurfacePoint& point : one.set.points) {
      explored.places.push_back({entry, point, position_of(mesh, point), alone});
    }
    for (const auto& edge : one.set.edges) {
      for (const Index v : edge) {
        explored.places.push_back({entry, SurfacePoint::at_vertex(v), mesh.positions()[v], false});
      }
    }
  }
  explored.set = std::move(all->set);
  return std::move(all->warnings);
}

std::shared_ptr<const Explored::Difference> difference_of(const Answer& a, const Answer& b) {
  auto difference = std::make_shared<Explored::Difference>();
  difference->largest = a.distance.max;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.result.distances.size(); ++i) {
    const double d = a.result.distances[i] - b.result.distances[i];
    const bool is_number = std::isfinite(d);
    difference->values.push_back(is_number ? d : kUnreached);
    if (!is_number) continue;
    difference->most = std::max(difference->most, std::abs(d));
    sum += std::abs(d);
    ++count;
  }
  difference->mean = count > 0 ? sum / static_cast<double>(count) : 0;
  return difference;
}

}  // namespace

Result<void> Explorer::load(const ExploreRequest& request, const Progress& progress,
                            const Early& early) {
  if (model_ && request.model == model_text_ && request.opening == opening_) return {};
  auto loaded = load_model(request.model, progress);
  if (!loaded) return loaded.error();
  // What belonged to the old model goes before the new one needs the room.
  a_.reset();
  b_.reset();
  model_.reset();
  auto model = std::make_shared<ExploredModel>();
  model->model = *std::move(loaded);
  const std::shared_ptr<const TriangleMesh> mesh = model->model.mesh;
  if (!report(progress, "inspecting", -1)) return cancelled();
  model->mesh = inspect_mesh(*mesh);
  model->warnings = model->model.notes;
  for (std::string& warning : mesh_warnings(model->mesh)) {
    model->warnings.push_back(std::move(warning));
  }
  auto base = std::make_shared<PictureData>(picture_of(*mesh));
  base->solid = is_solid(*mesh, model->mesh);
  model->base = std::move(base);
  Explored first;
  first.model = model;
  early(first);
  auto rays = RayTree::build(mesh, progress);
  if (!rays) return rays.error();
  auto whole = std::make_shared<ExploredModel>(*model);
  whole->rays = std::make_shared<const RayTree>(*std::move(rays));
  model_ = std::move(whole);
  model_text_ = request.model;
  opening_ = request.opening;
  return {};
}

Result<void> Explorer::prepare(const HeatOptions& options, std::optional<Method>& kept,
                               const std::optional<Method>& other, const Progress& progress) {
  if (kept && kept->method.options() == options) return {};
  if (auto pin = check_pin(options.constraint, *model_->model.mesh); !pin) return pin;
  const std::optional<Method>& near = kept ? kept : other;
  const Stopwatch watch;
  auto made = near ? near->method.with(options, progress)
                   : HeatMethod::build(model_->model.mesh, options, progress);
  if (!made) return about_model(model_->model.name, made.error());
  SetupTiming setup = made->timing();
  if (near && setup.operators == 0) {  // taken over
    setup.operators = near->setup.operators;
    setup.analyze = near->setup.analyze;
  }
  kept = Method{*std::move(made), setup, watch.milliseconds()};
  return {};
}

Result<std::shared_ptr<const Answer>> Explorer::answer(
    const ExploreRequest& request, const HeatOptions& options, bool is_b, const Explored& explored,
    const std::vector<std::string>& source_warnings, const Progress& progress) {
  std::optional<Method>& mine = is_b ? b_ : a_;
  if (auto ready = prepare(options, mine, is_b ? a_ : b_, progress); !ready) return ready.error();
  if (!report(progress, "solve", -1)) return cancelled();
  QueryOptions query;
  query.fields = request.fields;
  query.quality = request.quality;
  auto result = mine->method.solve(explored.set, query, progress);
  if (!result) return about_model(model_->model.name, result.error());
  Answer out{mine->method, *std::move(result), {}, mine->setup, mine->setup_ms, {}};
  out.distance = summarize(out.result.distances);
  const auto add = [&out](const std::vector<std::string>& more) {
    out.warnings.insert(out.warnings.end(), more.begin(), more.end());
  };
  add(out.method.warnings());
  add(source_warnings);
  add(out.result.warnings);
  add(unreached_notes(model_->mesh, out.distance.unreached));
  return std::make_shared<const Answer>(std::move(out));
}

Result<Explored> Explorer::explore(const ExploreRequest& request, const Progress& progress,
                                   const Early& early) try {
  if (auto loaded = load(request, progress, early); !loaded) return loaded.error();
  Explored explored;
  explored.model = model_;
  explored.sources = request.sources;
  explored.has_fields = request.fields;
  if (request.sources.empty()) return explored;
  auto warnings = place_sources(request, explored);
  if (!warnings) return warnings.error();
  auto a = answer(request, request.heat, false, explored, *warnings, progress);
  if (!a) return a.error();
  explored.a = *std::move(a);
  if (!request.kept) {
    b_.reset();
    return explored;
  }
  auto b = answer(request, *request.kept, true, explored, *warnings, progress);
  if (!b) return Error{b.error().code, "B: " + b.error().message};
  explored.b = *std::move(b);
  explored.difference = difference_of(*explored.a, *explored.b);
  return explored;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory,
               "the memory ended while working on " + request.model +
                   "; close other programs or take a mesh with fewer faces"};
}

}  // namespace geotherm::app
