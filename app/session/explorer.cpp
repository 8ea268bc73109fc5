// SPDX-License-Identifier: MIT
#include "app/session/explorer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <utility>

#include "app/session/progress.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/parallel.h"

namespace geotherm::app {
namespace {

std::shared_ptr<const Explored::Difference> difference_of(const Answer& a, const Answer& b) {
  auto difference = std::make_shared<Explored::Difference>();
  difference->largest = a.distance.max;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.result.distances.size(); ++i) {
    const double d = a.result.distances[i] - b.result.distances[i];
    difference->values.push_back(std::isfinite(d) ? d : kUnreached);
    if (!std::isfinite(d)) continue;
    difference->most = std::max(difference->most, std::abs(d));
    sum += std::abs(d);
    ++count;
  }
  difference->mean = count > 0 ? sum / static_cast<double>(count) : 0;
  return difference;
}

/// Adds the places of one entry.
void add_places(const ResolvedSources& placed, int entry, const Model& model,
                std::vector<SourcePlace>& places) {
  const TriangleMesh& mesh = *model.mesh;
  for (const Vec3& place : places_in_cells(model, placed.set)) {  // each an entry of its own
    places.push_back({entry, {}, place, true});
  }
  const auto add = [&](const SurfacePoint& point, bool alone) {
    places.push_back({entry, point, position_at(mesh, point), alone});
  };
  const bool alone = only_point(placed.set) != nullptr;
  for (const SurfacePoint& point : placed.set.points) add(point, alone);
  for (const auto& edge : placed.set.edges) {
    for (const Index v : edge) add(SurfacePoint::at_vertex(v), false);
  }
  Index curve = kNoIndex;  // whose piece ends where the next one of it begins
  for (const FaceSegment& segment : placed.set.segments) {
    if (std::exchange(curve, segment.curve) != segment.curve) {
      add(SurfacePoint::in_face(segment.face, segment.from), false);
    }
    add(SurfacePoint::in_face(segment.face, segment.to), false);
  }
}

}  // namespace

/// All entries as one set, and the places of each. What the last request had as well is not placed
/// anew: a curve is a walk over the mesh, a point in space a search over all faces. They are placed
/// on the model as its file has it, and go with the surface.
Result<std::vector<Warning>> Explorer::place_sources(const ExploreRequest& request,
                                                     Explored& explored) {
  std::vector<Placed> placed;
  SetUnion all;
  std::vector<Warning> warnings;
  for (std::size_t i = 0; i < request.sources.size(); ++i) {
    const SourceSpec& source = request.sources[i];
    const bool same_place = i < placed_.size() && placed_[i].source == source;
    const auto known = same_place ? placed_.begin() + static_cast<std::ptrdiff_t>(i)
                                  : std::ranges::find(placed_, source, &Placed::source);
    if (known != placed_.end()) {
      placed.push_back(*known);
    } else {
      const Source named{source, "source " + shortened(to_text(source)), ErrorCode::kBadInput};
      auto places = resolve_sources({&named, 1}, {read_->model, &*joiner_});
      if (!places) return places.error();
      placed.push_back({source, *std::move(places)});
    }
    const ResolvedSources& places = placed.back().places;
    for (const Warning& warning : places.warnings) {
      if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
    }
    add_places(places, static_cast<int>(i), model_->model, explored.places);
    all.add(places.set);
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
  solver_.reset();
  placed_.clear();
  joiner_.emplace(loaded->mesh);
  pose_ = {};
  rest_ = {};
  sequence_.reset();
  sculptor_.reset();
  inspected_ = true;
  model_.reset();
  rays_.reset();
  read_.reset();
  auto model = std::make_shared<ExploredModel>();
  model->model = *std::move(loaded);
  const std::shared_ptr<const TriangleMesh> mesh = model->model.mesh;
  bool solid = false;
  std::shared_ptr<PictureData> base;
  run_both(
      2, [&] { solid = is_solid(*mesh); },
      [&] {
        base = std::make_shared<PictureData>(unlit_picture_of(*mesh, tets_of(model->model)));
      });
  base->up = model->model.up;
  base->solid = solid;
  model->base = std::move(base);
  Explored first;
  first.model = model;
  early(first);  // people wait for the picture, then for distances: the rest comes after them
  read_ = model_ = std::move(model);
  is_whole_ = false;
  solver_.emplace(model_->model, ModelSolver::Use::kSession);
  model_text_ = request.model;
  reading_ = request.reading;
  opening_ = request.opening;
  return {};
}

/// The mesh before it is sculpted.
Result<std::shared_ptr<const TriangleMesh>> Explorer::frame_mesh(const Pose& pose) {
  if (pose.sequence.empty()) {
    sequence_.reset();
    return read_->model.mesh;
  }
  if (!sequence_ || sequence_->path != pose.sequence) {
    auto frames = Frames::open(pose.sequence, read_->model.mesh);
    if (!frames) return frames.error();
    sequence_ = Sequence{pose.sequence, *std::move(frames), -1, nullptr};
  }
  const std::int64_t count = sequence_->frames.count();
  if (pose.frame >= count) {
    return Error{ErrorCode::kBadInput,
                 "there is no frame " + std::to_string(pose.frame),
                 {"frames are 0 to " + std::to_string(count - 1)}};
  }
  if (sequence_->frame != pose.frame) {
    auto mesh = sequence_->frames.read(pose.frame);
    if (!mesh) return mesh.error();
    sequence_->mesh = std::make_shared<const TriangleMesh>(*std::move(mesh));
    sequence_->frame = pose.frame;
  }
  return sequence_->mesh;
}

/// Puts the vertices where frame and strokes want them. What belongs to another surface goes; the
/// method stays until the next one has taken over what it can.
Result<void> Explorer::move(const ExploreRequest& request, const Progress& progress) {
  const Pose& pose = request.pose;
  if (pose_ == pose) return {};
  const bool carved = !pose.sculpture.strokes.empty();
  if (carved || !pose.sequence.empty()) {
    if (pose.sequence.empty()) part_ = ExplorePart::kStrokes;
    auto surface = refuse_space(read_->model, carved ? "strokes are" : "frames are");
    if (!surface) return surface;
  }
  auto mesh = frame_mesh(pose);
  if (!mesh) return mesh.error();
  if (carved) {
    part_ = ExplorePart::kStrokes;
    if (!sculptor_ || carved_ != *mesh) sculptor_.emplace(*mesh);
    carved_ = *mesh;
    if (auto done = sculptor_->follow(pose.sculpture); !done) return done;
    auto bent = (*mesh)->moved(sculptor_->positions());
    if (!bent) return bent.error();
    mesh = std::make_shared<const TriangleMesh>(*std::move(bent));
  }
  const bool is_as_read = *mesh == read_->model.mesh;
  if (is_as_read) {
    model_ = read_;
    solver_->set_summary(model_->mesh);
  } else {
    const bool plays = !request.quality && pose.frame != pose_.frame;
    auto moved = moved_model(*std::move(mesh), plays, progress);
    if (!moved) return moved.error();
    model_ = *std::move(moved);
  }
  inspected_ = is_as_read;
  solver_->move(model_->model);
  pose_ = pose;
  return {};
}

Result<void> Explorer::make_rays(ExploredModel& model, const Progress& progress) {
  auto rays = rays_ ? rays_->moved(model.model.mesh) : std::optional<RayTree>();
  if (!rays) {
    auto built = RayTree::build(model.model.mesh, progress);
    if (!built) return built.error();
    rays = *std::move(built);
  }
  model.rays = rays_ = std::make_shared<const RayTree>(*std::move(rays));
  return {};
}

/// The model with its vertices elsewhere. What is said of its mesh is old. Nothing is picked while
/// frames are played, and light stays what it was while a stroke is drawn.
Result<std::shared_ptr<const ExploredModel>> Explorer::moved_model(
    std::shared_ptr<const TriangleMesh> mesh, bool plays, const Progress& progress) {
  auto moved = std::make_shared<ExploredModel>(*model_);
  std::vector<std::string> what;
  if (sequence_) {
    const std::filesystem::path name(sequence_->frames.name(sequence_->frame));
    what.push_back(name.filename().string());
  }
  if (!sequence_ || mesh != sequence_->mesh) what.emplace_back("sculpted");
  moved->model.name = read_->model.name + " (" + joined(what) + ")";
  moved->frames = sequence_ ? static_cast<int>(sequence_->frames.count()) : 0;
  auto base = std::make_shared<PictureData>(*model_->base);
  move_picture(*base, *mesh);
  if (plays) light_picture(*base);
  base->solid = false;  // a stroke may have gone through to the other side
  moved->base = std::move(base);
  moved->model.mesh = std::move(mesh);
  moved->rays = nullptr;
  if (!plays) {
    if (auto made = make_rays(*moved, progress); !made) return made.error();
  }
  return std::shared_ptr<const ExploredModel>(std::move(moved));
}

namespace {

/// The diffusion time of a heat method; none where components have their own.
std::optional<double> time_of(const HeatMethod* heat) {
  if (heat == nullptr) return {};
  const auto [least, most] = heat->t_range();
  return least == most ? std::optional(least) : std::nullopt;
}

}  // namespace

/// The options while a stroke is drawn: the diffusion time stays what it was at rest, where it
/// would follow the mean edge, so that the heat step, too, is solved anew only near the brush.
MethodOptions Explorer::live_options(const ExploreRequest& request) const {
  MethodOptions options = request.options;
  const bool carves = !request.quality && !pose_.sculpture.strokes.empty();
  if (carves && rest_.t && same_method(options, rest_.options)) {
    options.time_step = {TimeRule::kAbsolute, options.time_step.factor, *rest_.t};
  }
  return options;
}

Result<std::shared_ptr<const Answer>> Explorer::answer(const ExploreRequest& request,
                                                       const MethodOptions& options,
                                                       const ResolvedSources& sources, bool is_b,
                                                       const Progress& progress) {
  QueryOptions query{
      .quality = request.quality, .fields = request.fields, .nearest = request.nearest && !is_b};
  query.reach.max_distance = request.max_distance;
  // What is cut cannot be held against all distances: it is checked before it is cut.
  const bool bounded = request.max_distance < kUnreached, checks = is_thorough(request.check);
  const CheckSettings check{.against = request.check, .quick = !request.quality};
  Wanted wanted{query};
  if (bounded && checks) wanted.check = check;
  auto answer = solver_->solve(options, sources, wanted, progress);
  if (!answer) return answer.error();
  if (checks && !bounded) {
    if (auto done = solver_->check(*answer, check, progress); !done) return done.error();
  }
  return std::make_shared<const Answer>(*std::move(answer));
}

/// All that is shown at once.
Result<Explored> Explorer::work_out(const ExploreRequest& request, const Progress& progress) {
  Explored explored;
  explored.model = model_;
  explored.sources = request.sources;
  part_ = ExplorePart::kField;
  if (!request.field.empty()) {
    auto field = read_vertex_field(request.field, model_->model);
    if (!field) return field.error();
    explored.field = std::make_shared<const VertexField>(*std::move(field));
    return explored;
  }
  if (request.sources.empty()) return explored;
  part_ = ExplorePart::kSources;
  auto warnings = place_sources(request, explored);
  if (!warnings) return warnings.error();
  const ResolvedSources sources{explored.set, *std::move(warnings)};
  part_ = ExplorePart::kMethod;
  const MethodOptions options = live_options(request);
  std::vector<MethodOptions> wanted = {request.options, options};
  if (request.kept) wanted.push_back(*request.kept);
  solver_->want_methods(std::move(wanted));
  auto a = answer(request, options, sources, false, progress);
  if (!a) return a.error();
  if (request.quality) rest_ = {request.options, time_of((*a)->method->heat())};
  explored.a = *std::move(a);
  if (request.target) {
    part_ = ExplorePart::kTarget;
    if (auto found = find_paths(request, explored, progress); !found) return found.error();
  }
  if (request.kept) {
    auto b = answer(request, *request.kept, sources, true, progress);
    if (!b && b.error().code == ErrorCode::kCancelled) return b.error();
    if (!b) {  // A is good all the same
      explored.b_failure = about("B", b.error(), ErrorCode::kNumericalFailure);
    } else {
      explored.b = *std::move(b);
      explored.difference = difference_of(*explored.a, *explored.b);
    }
  }
  solver_->drop_unwanted();
  return explored;
}

Result<Explored> Explorer::explore(const ExploreRequest& request, const Progress& progress,
                                   const Early& early) try {
  part_ = ExplorePart::kModel;
  if (auto loaded = load(request, progress, early); !loaded) return loaded.error();
  part_ = ExplorePart::kFrame;
  auto placed = move(request, progress);
  if (placed && request.quality) placed = inspect(progress);
  Result<Explored> explored = placed ? work_out(request, progress) : placed.error();
  const bool cancelled = !explored && explored.error().code == ErrorCode::kCancelled;
  if (!is_whole_ && request.quality && !cancelled) {
    if (auto done = make_whole(explored, progress, early); !done) return done.error();
  }
  if (!explored || !explored->a) return explored;
  if (auto done = follow_up(request, *explored, progress, early); !done) return done.error();
  return explored;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory,
               "the memory ended while working on " + request.model,
               {"close other programs or take a mesh with fewer faces"}};
}

}  // namespace geotherm::app
