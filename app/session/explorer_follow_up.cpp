// SPDX-License-Identifier: MIT
// What follows an answer: light, paths, the centre of its sources, the check.
#include "app/session/explorer.h"
#include "app/session/progress.h"
#include "app/session/wording.h"

namespace geotherm::app {

/// Finds how light falls on the model as its file has it, and what picks on it; answers are shown
/// before.
Result<void> Explorer::make_whole(Result<Explored>& explored, const Progress& progress,
                                  const Early& early) {
  if (explored && explored->a) {
    early(*explored);
    explored->shown = true;
  }
  auto rays = RayTree::build(read_->model.mesh, progress);
  if (!rays) return rays.error();
  auto whole = std::make_shared<ExploredModel>(*read_);
  whole->rays = std::make_shared<const RayTree>(*std::move(rays));
  auto base = std::make_shared<PictureData>(*whole->base);
  light_picture(*base);
  whole->base = std::move(base);
  is_whole_ = true;
  if (model_ == read_) {
    model_ = whole;
    rays_ = whole->rays;
  }
  read_ = std::move(whole);
  if (explored) {
    explored->model = model_;
  } else if (model_ == read_) {  // without an answer, it is seen all the same
    Explored model;
    model.model = model_;
    early(std::move(model));
  }
  return {};
}

/// If no path is found, the distances are still shown.
Result<void> Explorer::find_paths(const ExploreRequest& request, Explored& explored,
                                  const Progress& progress) {
  const Source target{*request.target, "target " + to_text(*request.target), ErrorCode::kBadInput};
  const auto placed = resolve_sources({&target, 1}, *model_->model.mesh);
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
