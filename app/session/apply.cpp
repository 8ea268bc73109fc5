// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <type_traits>

#include "app/picture/picture_text.h"
#include "app/session/command.h"
#include "app/session/settings.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/backend.h"

namespace geotherm::app {
namespace {

const SourceSpec kFirstSource = RandomVertices{};
constexpr Index kMaxRandom = std::numeric_limits<Index>::max();

Error bad(std::string message, Hint hint = {}) {
  return {ErrorCode::kBadInput, std::move(message), std::move(hint)};
}

bool is_random(const SourceSpec& source) { return std::holds_alternative<RandomVertices>(source); }

/// Whether a source means something on any model.
bool fits_any_model(const SourceSpec& source) {
  return std::holds_alternative<WholeBoundary>(source) || is_random(source);
}

double within(double value, double most) { return std::clamp(value, -most, most); }

class Applier {
 public:
  explicit Applier(ViewerState& state) : s_(state) {}

  Result<void> operator()(const command::Open& c) {
    if (c.model.empty()) {
      return bad("no model was named", {"give a path or a bundled model's name"});
    }
    if (c.model == kStandardInput) {
      return bad("standard input cannot be opened here",
                 {"write the model to a file and name that"});
    }
    s_.model = c.model;
    s_.reading = {};
    s_.timeline = {};
    s_.sculpture = {};
    std::erase_if(s_.sources, std::not_fn(fits_any_model));
    if (s_.sources.empty()) s_.sources = {kFirstSource};
    s_.picked.reset();
    s_.target.reset();
    s_.centre.reset();
    s_.field.clear();
    s_.max_distance = kUnreached;
    // Lengths in units of the old model are reset.
    s_.picture.range_min = s_.picture.range_max = s_.picture.line_spacing = std::nullopt;
    (*this)(command::Frame{});
    return {};
  }

  void operator()(const command::Reset& /*c*/) {
    std::string model = std::move(s_.model);
    const ModelReading reading = s_.reading;
    s_ = initial_state();
    s_.model = std::move(model);
    s_.reading = reading;
  }

  Result<void> operator()(const command::Set& c) {
    const Setting* setting = find_setting(c.name);
    if (setting == nullptr) return bad("there is no setting '" + one_line(c.name) + "'");
    auto set = setting->set(s_, c.value);
    if (!set) return about(c.name, set.error());
    return {};
  }

  void operator()(const command::SetSources& c) { s_.sources = c.sources; }

  void operator()(const command::AddSources& c) {
    s_.sources.insert(s_.sources.end(), c.sources.begin(), c.sources.end());
  }

  Result<void> operator()(const command::MoveSource& c) {
    if (auto there = check_index(c.index); !there) return there;
    s_.sources[static_cast<std::size_t>(c.index)] = c.source;
    return {};
  }

  Result<void> operator()(const command::RemoveSource& c) {
    if (auto there = check_index(c.index); !there) return there;
    s_.sources.erase(s_.sources.begin() + c.index);
    return {};
  }

  Result<void> operator()(const command::ExtendCurve& c) {
    const auto extend = [](auto& all, const auto& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    SourceSpec* const last = s_.sources.empty() ? nullptr : &s_.sources.back();
    auto* const across = last == nullptr ? nullptr : std::get_if<SurfaceCurve>(last);
    auto* const edges = last == nullptr ? nullptr : std::get_if<VertexCurve>(last);
    if (c.points.empty() ? edges == nullptr : across == nullptr) {
      const bool other = edges != nullptr || across != nullptr;
      return bad(other ? "the last source is a curve of another kind"
                       : "the last source is no curve to extend",
                 {c.points.empty() ? "begin one with source add curve:V"
                                   : "begin one with source add curve:face:ID:b0:b1:b2"});
    }
    if (c.points.empty()) {
      extend(edges->vertices, c.vertices);
    } else {
      extend(across->points, c.points);
    }
    return {};
  }

  void operator()(const command::ClearSources& /*c*/) { s_.sources.clear(); }

  Result<void> operator()(const command::MoreSources& /*c*/) {
    if (const auto at = last_random(); at != s_.sources.rend()) {
      auto& random = std::get<RandomVertices>(*at);
      if (random.count == kMaxRandom) return bad("there are as many random sources as can be");
      ++random.count;
    } else {
      s_.sources.push_back(kFirstSource);
    }
    return {};
  }

  Result<void> operator()(const command::FewerSources& /*c*/) {
    if (s_.sources.empty()) return bad("there is no source to remove");
    const auto at = last_random();
    if (at == s_.sources.rend()) {
      s_.sources.pop_back();
      return {};
    }
    if (auto& random = std::get<RandomVertices>(*at); random.count > 1) {
      --random.count;
    } else {
      s_.sources.erase(std::next(at).base());
    }
    return {};
  }

  void operator()(const command::ShuffleSources& /*c*/) {
    Index count = 0;
    std::uint64_t seed = 0;
    for (const SourceSpec& source : s_.sources) {
      const auto* const random = std::get_if<RandomVertices>(&source);
      if (random) count = std::min<Index>(kMaxRandom - count, random->count) + count;
      if (random) seed = std::max(seed, random->seed);
    }
    if (count == 0) count = std::max<Index>(1, static_cast<Index>(s_.sources.size()));
    s_.sources = {RandomVertices{count, seed + 1}};
  }

  void operator()(const command::Sculpt& c) {
    s_.sculpture.strokes.push_back(std::make_shared<const Stroke>(c.stroke));
  }

  Result<void> operator()(const command::ExtendStroke& c) {
    auto& strokes = s_.sculpture.strokes;
    if (strokes.empty()) {
      return bad("there is no stroke to extend",
                 {"begin one with sculpt pull RADIUS STRENGTH POINT"});
    }
    Stroke longer = *strokes.back();
    longer.points.insert(longer.points.end(), c.points.begin(), c.points.end());
    strokes.back() = std::make_shared<const Stroke>(std::move(longer));
    return {};
  }

  Result<void> operator()(const command::ShowSequence& c) {
    if (s_.model.empty()) {
      return bad("there is no model whose vertices could move", {"open one first: open MODEL"});
    }
    s_.timeline = {.sequence = c.path, .loop = s_.timeline.loop};
    return {};
  }

  Result<void> operator()(const command::ShowFrame& c) {
    if (s_.timeline.sequence.empty()) return no_sequence();
    s_.timeline.frame = c.index;
    return {};
  }

  Result<void> operator()(const command::Play& c) {
    if (c.on && s_.timeline.sequence.empty()) return no_sequence();
    s_.timeline.playing = c.on;
    return {};
  }

  void operator()(const command::Loop& c) { s_.timeline.loop = c.on; }

  void operator()(const command::Orbit& c) {
    constexpr double kTurn = 360;
    CameraSettings& camera = s_.picture.camera;
    camera.azimuth = std::fmod(camera.azimuth + c.azimuth, kTurn);
    if (camera.azimuth < 0) camera.azimuth += kTurn;
    camera.elevation = within(camera.elevation + c.elevation, 90);
  }

  void operator()(const command::Zoom& c) {
    CameraSettings& camera = s_.picture.camera;
    const double zoom = std::clamp(camera.zoom * c.factor, kMinZoom, kMaxZoom);
    const double factor = zoom / camera.zoom;
    camera.zoom = zoom;
    camera.pan_right = within(c.right + (camera.pan_right - c.right) * factor, kMaxPan);
    camera.pan_up = within(c.up + (camera.pan_up - c.up) * factor, kMaxPan);
  }

  void operator()(const command::Pan& c) {
    CameraSettings& camera = s_.picture.camera;
    camera.pan_right = within(camera.pan_right + c.right, kMaxPan);
    camera.pan_up = within(camera.pan_up + c.up, kMaxPan);
  }

  void operator()(const command::Centre& c) {
    CameraSettings& camera = s_.picture.camera;
    camera.centre = {c.x, c.y, c.z};
    camera.fit = PictureFit::kSphere;
    camera.pan_right = camera.pan_up = 0;
  }

  void operator()(const command::Place& c) {
    CameraSettings& camera = s_.picture.camera;
    camera.azimuth = c.azimuth;
    camera.elevation = c.elevation;
    camera.zoom = c.zoom;
    camera.pan_right = c.right;
    camera.pan_up = c.up;
  }

  void operator()(const command::Frame& /*c*/) {
    CameraSettings& camera = s_.picture.camera;
    camera.zoom = 1;
    camera.pan_right = camera.pan_up = 0;
    camera.centre.reset();
  }

  void operator()(const command::Rotate& c) { s_.rotating = c.on; }

  void operator()(const command::Keep& /*c*/) { s_.kept = s_.options; }

  void operator()(const command::Forget& /*c*/) {
    s_.kept.reset();
    s_.shown = Shown::kA;
  }

  Result<void> operator()(const command::Swap& /*c*/) {
    if (!s_.kept) return nothing_kept();
    std::swap(*s_.kept, s_.options);
    return {};
  }

  Result<void> operator()(const command::Show& c) {
    if (c.shown != Shown::kA && !s_.kept) return nothing_kept();
    s_.shown = c.shown;
    return {};
  }

  Result<void> operator()(const command::Flip& /*c*/) {
    if (!s_.kept) return nothing_kept();
    s_.shown = s_.shown == Shown::kA ? Shown::kB : Shown::kA;
    return {};
  }

  void operator()(const command::Pick& c) { s_.picked = c.point; }

  Result<void> operator()(const command::Target& c) {
    if (c.point && !is_single_point(*c.point)) {
      return bad_value(to_text(*c.point), "is no target",
                       "write one vertex, face:ID:b0:b1:b2 or xyz:x:y:z");
    }
    s_.target = c.point;
    return {};
  }

  void operator()(const command::ShowCentre& c) { s_.centre = c.kind; }

  Result<void> operator()(const command::ShowField& c) {
    if (s_.model.empty() && !c.path.empty()) {
      return bad("there is no model whose vertices could have values",
                 {"open one first: open MODEL"});
    }
    s_.field = c.path;
    return {};
  }

  void operator()(const command::MaxDistance& c) { s_.max_distance = c.most; }

  // Those that work on the program, not on its state.
  void operator()(const command::Run& /*c*/) {}
  void operator()(const command::Compare& /*c*/) {}
  void operator()(const command::SavePicture& /*c*/) {}
  void operator()(const command::SaveDistances& /*c*/) {}
  void operator()(const command::SaveMesh& /*c*/) {}
  void operator()(const command::SaveSession& /*c*/) {}
  void operator()(const command::SaveLog& /*c*/) {}
  void operator()(const command::SaveFigures& /*c*/) {}
  void operator()(const command::Undo& /*c*/) {}
  void operator()(const command::Redo& /*c*/) {}
  void operator()(const command::Quit& /*c*/) {}

 private:
  static Error nothing_kept() {
    return bad("no settings are kept as B", {"keep some first: keep"});
  }

  static Error no_sequence() {
    return bad("there are no frames", {"name those of a surface that moves: sequence FRAMES"});
  }

  std::vector<SourceSpec>::reverse_iterator last_random() {
    return std::find_if(s_.sources.rbegin(), s_.sources.rend(), is_random);
  }

  Result<void> check_index(int index) const {
    const auto count = static_cast<int>(s_.sources.size());
    if (index >= 0 && index < count) return {};
    return bad("there is no source " + std::to_string(index),
               {count == 0 ? "there is none" : "sources are 0 to " + std::to_string(count - 1)});
  }

  ViewerState& s_;
};

}  // namespace

ViewerState initial_state() {
  ViewerState state;
  state.options.backend = backend_names().front();
  state.picture.camera.fit = PictureFit::kSphere;
  state.picture.path_kind = PathKind::kAll;
  return state;
}

Result<ViewerState> apply(const ViewerState& state, const Command& command) {
  ViewerState next = state;
  Applier applier(next);
  const auto run = [&applier](const auto& c) -> Result<void> {
    if constexpr (std::is_void_v<decltype(applier(c))>) {
      applier(c);
      return {};
    } else {
      return applier(c);
    }
  };
  if (auto done = std::visit(run, command); !done) return done.error();
  return next;
}

}  // namespace geotherm::app
