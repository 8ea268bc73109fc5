// SPDX-License-Identifier: MIT
// What answers do not wait for: what is said of the mesh, light, paths, the centre of the sources,
// the check.

#include "app/session/explorer.h"
#include "app/session/progress.h"
#include "app/session/wording.h"
#include "solver/core/parallel.h"

namespace geotherm::app {
namespace {

/// What is to be said about a model's mesh.
void describe(ExploredModel& model) {
  model.mesh = inspect_mesh(*model.model.mesh);
  describe_space(model.model, *model.mesh);
  model.warnings = model.model.notes;
  if (const auto& space = model.model.space) {
    model.figures = space->figures();
    if (std::string unseen = space->unseen(); !unseen.empty()) {
      model.warnings.push_back({std::move(unseen)});
    }
  }
  for (Warning& warning :
       model.model.is_mesh() ? mesh_warnings(*model.mesh) : std::vector<Warning>()) {
    model.warnings.push_back(std::move(warning));
  }
}

}  // namespace

/// What is said of the mesh, once it rests.
Result<void> Explorer::inspect(const Progress& progress) {
  if (inspected_) return {};
  if (!report(progress, "inspecting", -1)) return cancelled_error();
  auto model = std::make_shared<ExploredModel>(*model_);
  if (!model->rays) {
    if (auto made = make_rays(*model, progress); !made) return made;
  }
  describe(*model);
  auto base = std::make_shared<PictureData>(*model->base);
  light_picture(*base);
  model->base = std::move(base);
  solver_->set_summary(model->mesh);
  model_ = std::move(model);
  inspected_ = true;
  return {};
}

/// Describes the model as its file has it, finds how light falls on it, and what picks on it;
/// answers are shown before.
Result<void> Explorer::make_whole(Result<Explored>& explored, const Progress& progress,
                                  const Early& early) {
  if (explored && explored->a) {
    early(*explored);
    explored->shown = true;
  }
  if (!report(progress, "inspecting", -1)) return cancelled_error();
  auto whole = std::make_shared<ExploredModel>(*read_);
  Result<RayTree> rays = cancelled_error();
  run_both(
      2, [&] { describe(*whole); }, [&] { rays = RayTree::build(read_->model.mesh, progress); });
  if (!rays) return rays.error();
  whole->rays = std::make_shared<const RayTree>(*std::move(rays));
  auto base = std::make_shared<PictureData>(*whole->base);
  light_picture(*base);
  whole->base = std::move(base);
  is_whole_ = true;
  if (model_ == read_) {
    model_ = whole;
    rays_ = whole->rays;
    solver_->set_summary(whole->mesh);
  }
  read_ = std::move(whole);
  if (explored) {
    explored->model = model_;
  } else {  // without an answer, it is seen all the same, as load() has shown it
    Explored model;
    model.model = read_;
    early(std::move(model));
  }
  return {};
}

/// If no path is found, the distances are still shown.
Result<void> Explorer::find_paths(const ExploreRequest& request, Explored& explored,
                                  const Progress& progress) {
  const Source target{*request.target, "target " + to_text(*request.target), ErrorCode::kBadInput};
  const auto placed = resolve_sources({&target, 1}, *read_->model.mesh);  // as sources are
  auto found =
      placed ? solver_->paths_to(placed->set.points.front(), *explored.a, PathKind::kAll, progress)
             : Result<TargetPaths>(placed.error());
  if (!found && found.error().code == ErrorCode::kCancelled) return found.error();
  if (!found) {
    explored.path_failure = warning_of(found.error());
  } else {
    explored.paths = std::move(found->paths);
  }
  return {};
}

/// Takes the centre that was found last, where it is that of these sources.
bool Explorer::knows_centre(const ExploreRequest& request, Explored& explored) const {
  if (!middle_ || middle_->mesh != model_->model.mesh || middle_->of != explored.set ||
      middle_->centre->kind != *request.centre) {
    return false;
  }
  explored.centre = middle_->centre;
  return true;
}

/// If there is none, the distances are still shown.
Result<void> Explorer::find_centre(const ExploreRequest& request, Explored& explored,
                                   const Progress& progress) {
  auto found = centre_of_sources(model_->model, explored.set, *request.centre,
                                 request.options.threads, progress);
  if (!found && found.error().code == ErrorCode::kCancelled) return found.error();
  if (!found) {
    explored.centre_failure = warning_of(found.error());
    return {};
  }
  explored.centre = std::make_shared<const SourceCentre>(*std::move(found));
  middle_ = {model_->model.mesh, explored.set, explored.centre};
  return {};
}

/// Hands the answers out as they are, looks for the centre, and holds them against better ones.
Result<void> Explorer::follow_up(const ExploreRequest& request, Explored& explored,
                                 const Progress& progress, const Early& early) {
  const bool checks = request.check == Check::kOn && !(request.max_distance < kUnreached);
  const bool seeks = request.centre && !knows_centre(request, explored);
  if (!checks && !seeks) return {};
  early(explored);
  explored.shown = true;
  if (seeks) {
    if (auto done = find_centre(request, explored, progress); !done) return done;
  }
  if (!checks) return {};
  for (auto* const answer : {&explored.a, &explored.b}) {
    if (!*answer) continue;
    auto checked = std::make_shared<Answer>(**answer);
    auto done = solver_->check(*checked, {.against = request.check, .quick = !request.quality},
                               with_prefix(progress, "checking: "));
    if (!done) return done;
    *answer = std::move(checked);
  }
  return {};
}

}  // namespace geotherm::app
