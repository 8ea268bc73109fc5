// SPDX-License-Identifier: MIT
#include "app/explore/explorer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <set>

#include "app/mesh_words.h"
#include "app/resolve_sources.h"
#include "app/solve_steps.h"
#include "app/told.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

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

/// Adds the places of one entry.
void add_places(const ResolvedSources& placed, int entry, const TriangleMesh& mesh,
                std::vector<SourcePlace>& places) {
  const bool alone = placed.set.points.size() == 1 && placed.set.edges.empty();
  for (const SurfacePoint& point : placed.set.points) {
    places.push_back({entry, point, position_at(mesh, point), alone});
  }
  for (const auto& edge : placed.set.edges) {
    for (const Index v : edge) {
      places.push_back({entry, SurfacePoint::at_vertex(v), mesh.positions()[v], false});
    }
  }
}

/// Puts sets together: no vertex and no edge twice.
class SetUnion {
 public:
  void add(const SourceSet& more) {
    for (std::size_t i = 0; i < more.points.size(); ++i) {
      add(more.points[i], more.offsets.empty() ? 0 : more.offsets[i]);
    }
    edges_.insert(more.edges.begin(), more.edges.end());
  }
  SourceSet take() {
    set_.edges.assign(edges_.begin(), edges_.end());
    if (std::ranges::all_of(set_.offsets, [](double x) { return x == 0; })) set_.offsets.clear();
    return std::move(set_);
  }

 private:
  void add(const SurfacePoint& point, double offset) {
    if (point.is_vertex()) {
      const auto [known, fresh] = vertices_.try_emplace(point.vertex, set_.points.size());
      if (!fresh) {
        set_.offsets[known->second] = std::min(set_.offsets[known->second], offset);
        return;
      }
    }
    set_.points.push_back(point);
    set_.offsets.push_back(offset);
  }

  SourceSet set_;
  std::map<Index, std::size_t> vertices_;
  std::set<std::array<Index, 2>> edges_;
};

}  // namespace

/// All entries as one set, and the places of each. What stood in the last request is not placed
/// anew: a curve is a walk over the mesh.
Result<std::vector<std::string>> Explorer::place_sources(const ExploreRequest& request,
                                                         Explored& explored) {
  const TriangleMesh& mesh = *model_->model.mesh;
  std::map<std::string, ResolvedSources> placed;
  SetUnion all;
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < request.sources.size(); ++i) {
    const std::string& text = request.sources[i];
    auto known = placed.find(text);
    if (known == placed.end()) {
      auto last = placed_.extract(text);
      if (last.empty()) {
        auto spec = parse_source(text);
        if (!spec) return spec.error();
        constexpr std::size_t kShown = 60;
        const Source source{*std::move(spec), "source " + text.substr(0, kShown),
                            ErrorCode::kBadInput};
        auto resolved = resolve_sources({&source, 1}, mesh);
        if (!resolved) return resolved.error();
        known = placed.emplace(text, *std::move(resolved)).first;
      } else {
        known = placed.insert(std::move(last)).position;
      }
      warnings.insert(warnings.end(), known->second.warnings.begin(), known->second.warnings.end());
    }
    add_places(known->second, static_cast<int>(i), mesh, explored.places);
    all.add(known->second.set);
  }
  placed_ = std::move(placed);
  explored.set = all.take();
  return warnings;
}

Result<void> Explorer::load(const ExploreRequest& request, const Progress& progress,
                            const Early& early) {
  if (model_ && request.model == model_text_ && request.reading == reading_ &&
      request.opening == opening_) {
    return {};
  }
  auto loaded = load_model(request.model, request.reading, progress);
  if (!loaded) return loaded.error();
  // What belonged to the old model goes before the new one needs the room.
  a_.reset();
  b_.reset();
  placed_.clear();
  waves_.reset();
  on_waves_.clear();
  reference_.reset();
  paths_.reset();
  model_.reset();
  auto model = std::make_shared<ExploredModel>();
  model->model = *std::move(loaded);
  const std::shared_ptr<const TriangleMesh> mesh = model->model.mesh;
  if (!report(progress, "inspecting", -1)) return cancelled_error();
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
  reading_ = request.reading;
  opening_ = request.opening;
  return {};
}

Result<void> Explorer::prepare(const MethodOptions& options, std::optional<Method>& kept,
                               const std::optional<Method>& other, const Progress& progress) {
  if (kept && same_method(kept->options, options)) return {};
  if (other && same_method(other->options, options)) {
    if (kept) {
      std::swap(a_, b_);  // A and B have changed places
    } else {
      kept = other;
    }
    return {};
  }
  if (auto pin = check_pin(options.constraint, *model_->model.mesh); !pin) return pin;
  const std::optional<Method>& near = kept ? kept : other;
  const Stopwatch watch;
  auto made = make(options, near ? near->method.get() : nullptr, progress);
  if (!made) return about_model(model_->model.name, made.error());
  SetupTiming setup = (*made)->timing();
  if (near && setup.operators == 0) {  // taken over
    setup.operators = near->setup.operators;
    setup.analyze = near->setup.analyze;
  }
  kept = Method{*std::move(made), options, setup, watch.milliseconds()};
  return {};
}

Result<std::shared_ptr<const Answer>> Explorer::answer(
    const ExploreRequest& request, const MethodOptions& options, bool is_b,
    const Explored& explored, const std::vector<std::string>& source_warnings,
    const Progress& progress) {
  std::optional<Method>& mine = is_b ? b_ : a_;
  if (auto ready = prepare(options, mine, is_b ? a_ : b_, progress); !ready) return ready.error();
  if (!report(progress, "solve", -1)) return cancelled_error();
  QueryOptions query;
  query.fields = request.fields;
  query.quality = request.quality;
  query.nearest = request.nearest && !is_b;
  auto result = mine->method->solve(explored.set, query, progress);
  if (!result) return about_model(model_->model.name, result.error());
  Answer out{mine->method, options, *std::move(result), {}, mine->setup, mine->setup_ms, {}};
  out.distance = summarize(out.result.distances);
  const auto add = [&out](const std::vector<std::string>& more) {
    out.warnings.insert(out.warnings.end(), more.begin(), more.end());
  };
  add(told(out.method->warnings()));
  add(source_warnings);
  add(told(out.result.warnings));
  add(unreached_notes(model_->mesh, out.distance.unreached));
  if (request.check != Check::kOff && request.check != Check::kOn) {
    if (auto done = check(request, explored.set, out, progress); !done) return done.error();
  }
  return std::make_shared<const Answer>(std::move(out));
}

Result<Explored> Explorer::explore(const ExploreRequest& request, const Progress& progress,
                                   const Early& early) try {
  if (auto loaded = load(request, progress, early); !loaded) return loaded.error();
  Explored explored;
  explored.model = model_;
  explored.sources = request.sources;
  if (request.sources.empty()) return explored;
  auto warnings = place_sources(request, explored);
  if (!warnings) return warnings.error();
  auto a = answer(request, request.options, false, explored, *warnings, progress);
  if (!a) return a.error();
  explored.a = *std::move(a);
  if (request.nearest) {
    if (auto found = find_nearest(explored, progress); !found) return found.error();
  }
  if (request.target) {
    if (auto found = find_paths(request, explored, progress); !found) return found.error();
  }
  if (!request.kept) {
    b_.reset();
    if (auto done = check_afterwards(request, explored, progress, early); !done) {
      return done.error();
    }
    return explored;
  }
  auto b = answer(request, *request.kept, true, explored, *warnings, progress);
  if (!b && b.error().code == ErrorCode::kCancelled) return b.error();
  if (!b) {  // A is good all the same
    b_.reset();
    explored.b_failure = "B: " + told(b.error());
  } else {
    explored.b = *std::move(b);
    explored.difference = difference_of(*explored.a, *explored.b);
  }
  if (auto done = check_afterwards(request, explored, progress, early); !done) return done.error();
  return explored;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory,
               "the memory ended while working on " + request.model +
                   "; close other programs or take a mesh with fewer faces"};
}

}  // namespace geotherm::app
