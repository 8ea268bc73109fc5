// SPDX-License-Identifier: MIT
#include "engine/renderer.h"

#include <algorithm>
#include <cassert>

#include "engine/scene/arrows.h"
#include "engine/scene/coarse_surface.h"
#include "engine/scene/draw_mesh.h"
#include "engine/scene/line_set.h"
#include "engine/target.h"
#include "engine/vulkan/frame_recorder.h"
#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {
namespace {

/// A software device draws this many faces several times a second; of more there is a coarse
/// surface.
constexpr std::size_t kManyFaces = 150'000;
constexpr std::size_t kCoarseFaces = 50'000;

}  // namespace

struct Renderer::State {
  State(std::shared_ptr<Device::State> on, int samples)
      : device(std::move(on)), recorder(device, samples) {}

  std::shared_ptr<Device::State> device;
  FrameRecorder recorder;

  // The model, as the processor has it.
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;
  bool solid = false;
  std::vector<Openness> openness;
  std::optional<MovingDrawMesh> moving;  ///< of a model that moves
  std::vector<std::uint32_t> origin;     ///< DrawMesh::origin
  std::vector<float> gathered;           ///< values by drawn vertex
  std::vector<glm::vec2> regions;        ///< and margins, by the model's vertices; empty: none
  std::optional<ArrowPlaces> places;     ///< made when arrows first come
  std::vector<glm::vec3> primary, secondary;
  LineSet lines;
  bool lines_old = false;  ///< the device has others
  std::vector<float> face_values;

  // The surface that is drawn while the picture moves.
  bool coarse_wanted = false;
  struct Coarse {
    CoarseSurface surface;
    DrawMesh mesh;
    bool old = true;  ///< values have been set since
  };
  std::optional<Coarse> coarse;
  bool no_coarse = false;  ///< the device had no memory for that of this model

  /// Draws this mesh, of these positions; what was set on another is gone. Throws, and leaves then
  /// what was there.
  void draw(const DrawMesh& mesh, std::vector<glm::vec3> of) {
    std::vector<float> values(mesh.vertices.size(), kNoValue);
    std::vector<std::uint32_t> origins = mesh.origin;
    recorder.set_surface(mesh, values);  // the last that can fail
    positions = std::move(of);
    origin = std::move(origins);
    gathered = std::move(values);
    places.reset();
    primary.clear();
    secondary.clear();
    regions.clear();
    face_values.clear();
    lines.set({});
    coarse.reset();
    no_coarse = false;
  }

  /// Draws the mesh that is drawn in this light.
  void relight(const DrawMesh& mesh) {
    recorder.set_vertices(mesh.vertices);
    coarse.reset();
    if (!face_values.empty()) recorder.set_separate_faces(separate_faces(mesh), by_corner());
  }

  /// The values of faces, three times each.
  std::vector<float> by_corner() const {
    std::vector<float> corners;
    corners.reserve(3 * face_values.size());
    for (const float value : face_values) corners.insert(corners.end(), 3, value);
    return corners;
  }

  /// The model's values, by its vertices.
  std::vector<float> values() const {
    std::vector<float> out(positions.size(), kNoValue);
    for (std::size_t i = 0; i < origin.size(); ++i) out[origin[i]] = gathered[i];
    return out;
  }

  void make_coarse() {
    if (coarse) return;
    Coarse made;
    made.surface = coarse_surface({positions, faces, solid, openness}, kCoarseFaces);
    made.mesh =
        build_draw_mesh({made.surface.positions, made.surface.faces, false, made.surface.openness});
    recorder.use_coarse(true);
    recorder.set_surface(made.mesh, std::vector<float>(made.mesh.vertices.size(), kNoValue));
    recorder.use_coarse(false);
    coarse = std::move(made);
  }

  /// Draws the coarse surface from now on where it is wanted and the device has the memory.
  void choose_surface(SceneUse use) {
    recorder.use_coarse(false);
    const bool early = use == SceneUse::kAgain;  // nobody waits for a frame of panels alone
    if (no_coarse || faces.size() < kManyFaces || !(coarse_wanted || early)) return;
    const Result<void> ready = guarded("drawing", [&] {
      make_coarse();
      if (coarse_wanted) update_coarse();
    });
    recorder.use_coarse(coarse_wanted && ready);
    no_coarse = !ready;
    if (!ready && ready.error().code != ErrorCode::kOutOfMemory) throw Failure(ready.error());
  }

  void update_coarse() {
    if (!coarse->old) return;
    recorder.use_coarse(true);
    const CoarseSurface& surface = coarse->surface;
    const std::vector<float> means = surface.means(values());
    std::vector<float> drawn;
    for (const std::uint32_t v : coarse->mesh.origin) drawn.push_back(means[v]);
    recorder.set_values(drawn);
    std::vector<glm::vec3> with_regions;
    for (std::size_t i = 0; i < drawn.size() && !regions.empty(); ++i) {
      with_regions.emplace_back(drawn[i], regions[surface.example[coarse->mesh.origin[i]]]);
    }
    recorder.set_regions(with_regions);
    std::vector<float> corners;
    for (std::size_t f = 0; f < surface.faces.size() && !face_values.empty(); ++f) {
      corners.insert(corners.end(), 3, face_values[surface.origin[f]]);
    }
    if (!corners.empty() && !recorder.has_face_values()) {
      recorder.set_separate_faces(separate_faces(coarse->mesh), corners);
    } else {
      recorder.set_face_values(corners);
    }
    coarse->old = false;
  }

  void values_changed() {
    if (coarse) coarse->old = true;
    recorder.use_coarse(false);
  }

  /// Values and regions by drawn vertex, as they are drawn together.
  void upload_regions(std::span<const glm::vec2> from) {
    std::vector<glm::vec3> all;
    all.reserve(from.empty() ? 0 : origin.size());
    for (std::size_t i = 0; i < origin.size() && !from.empty(); ++i) {
      all.emplace_back(gathered[i], from[origin[i]]);
    }
    recorder.set_regions(all);
  }
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::set_samples(int samples) { state_->recorder.set_samples(samples); }

void Renderer::set_coarse(bool coarse) { state_->coarse_wanted = coarse; }

Result<Renderer> Renderer::build(const Device& device, int samples) {
  if (samples != 1 && samples != 4) {
    return Error{ErrorCode::kBadInput,
                 "there are 1 or 4 samples a pixel, not " + std::to_string(samples)};
  }
  return guarded("preparing to draw", [&]() -> Result<Renderer> {
    return Renderer(std::make_unique<State>(device.state(), samples));
  });
}

Result<void> Renderer::set_surface(const SurfaceGeometry& geometry) {
  return guarded("loading the model", [&] {
    std::vector<std::array<std::uint32_t, 3>> faces(geometry.faces.begin(), geometry.faces.end());
    State& s = *state_;
    s.recorder.use_coarse(false);
    s.draw(build_draw_mesh(geometry), {geometry.positions.begin(), geometry.positions.end()});
    s.faces = std::move(faces);
    s.openness.assign(geometry.openness.begin(), geometry.openness.end());
    s.solid = geometry.solid;
    s.moving.reset();
  });
}

Result<void> Renderer::move_surface(std::span<const glm::vec3> positions,
                                    std::span<const Openness> openness) {
  assert(positions.size() == state_->positions.size());
  State& s = *state_;
  auto moved = guarded("moving the model", [&] {
    s.recorder.use_coarse(false);
    const bool known = s.moving.has_value();
    if (!known) s.moving.emplace(SurfaceGeometry{positions, s.faces, s.solid, openness});
    if (known && s.moving->move(positions, openness)) {
      s.recorder.set_vertices(s.moving->mesh().vertices);
      s.positions.assign(positions.begin(), positions.end());
      s.places.reset();
      s.coarse.reset();
    } else {
      s.draw(s.moving->mesh(), {positions.begin(), positions.end()});
    }
    s.openness.assign(openness.begin(), openness.end());
  });
  if (!moved) s.moving.reset();  // its vertices are not those that are drawn
  return moved;
}

Result<void> Renderer::set_openness(std::span<const Openness> openness) {
  State& s = *state_;
  assert(openness.size() == s.positions.size());
  return guarded("loading light", [&] {
    s.recorder.use_coarse(false);
    s.openness.assign(openness.begin(), openness.end());
    if (s.moving) {
      s.moving->move(s.positions, s.openness);
      s.relight(s.moving->mesh());
    } else {
      s.relight(build_draw_mesh({s.positions, s.faces, s.solid, s.openness}));
    }
  });
}

Result<void> Renderer::set_values(std::span<const float> values) {
  assert(values.size() == state_->positions.size());
  return guarded("loading distances", [&] {
    State& s = *state_;
    s.values_changed();
    for (std::size_t i = 0; i < s.origin.size(); ++i) s.gathered[i] = values[s.origin[i]];
    s.recorder.set_values(s.gathered);
    if (!s.regions.empty()) s.upload_regions(s.regions);
  });
}

Result<void> Renderer::set_regions(std::span<const std::int32_t> regions,
                                   std::span<const float> margins) {
  assert(regions.empty() || regions.size() == state_->positions.size());
  assert(regions.size() == margins.size());
  return guarded("loading regions", [&] {
    state_->values_changed();
    std::vector<glm::vec2> kept;
    for (std::size_t v = 0; v < regions.size(); ++v) {
      kept.emplace_back(static_cast<float>(regions[v]), margins[v]);
    }
    state_->upload_regions(kept);
    state_->regions = std::move(kept);
  });
}

Result<void> Renderer::set_face_values(std::span<const float> values) {
  assert(values.empty() || values.size() == state_->faces.size());
  return guarded("loading values of faces", [&] {
    State& s = *state_;
    s.values_changed();
    s.face_values.assign(values.begin(), values.end());
    const std::vector<float> corners = s.by_corner();
    if (!values.empty() && !s.recorder.has_face_values()) {
      const DrawMesh mesh = build_draw_mesh({s.positions, s.faces, s.solid, s.openness});
      s.recorder.set_separate_faces(separate_faces(mesh), corners);
    } else {
      s.recorder.set_face_values(corners);
    }
  });
}

Result<void> Renderer::set_colours(const ColourTable& table) {
  return guarded("loading colours", [&] { state_->recorder.set_colours(table); });
}

Result<void> Renderer::set_arrows(std::span<const glm::vec3> primary,
                                  std::span<const glm::vec3> secondary) {
  assert(primary.empty() || primary.size() == state_->faces.size());
  assert(secondary.empty() || secondary.size() == state_->faces.size());
  return guarded("loading arrows", [&] {
    State& s = *state_;
    if (!s.places && !(primary.empty() && secondary.empty())) {
      s.places = ArrowPlaces({s.positions, s.faces, s.solid});
    }
    s.primary.assign(primary.begin(), primary.end());
    s.secondary.assign(secondary.begin(), secondary.end());
  });
}

Result<void> Renderer::set_lines(std::span<const Polyline> lines) {
  return guarded("loading lines", [&] { state_->lines.set(lines); });
}

Result<void> Renderer::set_markers(std::span<const Marker> markers) {
  return guarded("loading sources", [&] { state_->recorder.set_markers(markers); });
}

Result<void> Renderer::set_panel_font(const PanelFont& font) {
  return guarded("loading letters", [&] { state_->recorder.set_panel_font(font); });
}

Result<void> Renderer::render(Target& target, const Scene& scene, const Overlay& overlay,
                              const PanelDraw* panels, SceneUse use) {
  return guarded("drawing", [&]() -> Result<void> {
    State& s = *state_;
    ArrowSelection arrows;
    if (s.places && !(s.primary.empty() && s.secondary.empty())) {
      arrows = select_arrows({{s.positions, s.faces, s.solid}, *s.places}, scene.camera,
                             scene.arrows, scene.pixel_scale, s.primary, s.secondary);
    }
    if (s.lines.fit(scene.camera)) s.lines_old = true;
    if (s.lines_old && scene.lines.visible) {
      s.recorder.set_lines(s.lines);
      s.lines_old = false;
    }
    s.choose_surface(use);
    TargetFrame frame;
    s.recorder.prepare(arrows, overlay, panels);
    if (auto begun = target.begin(frame); !begun) return begun;
    s.recorder.record(frame, target.extent(), scene, use);
    return target.end(frame);
  });
}

namespace {

constexpr int kLargestPicture = 16384;
/// With 4 samples a pixel of colour and depth this is 160 MiB at most.
constexpr int kUsualTile = 2048;

}  // namespace

Result<Image> draw_picture(const Device& device, Renderer& renderer, const Scene& scene,
                           const Overlay& overlay, int largest_tile) {
  const glm::ivec2 size(scene.camera.extent);
  if (size.x < 1 || size.y < 1 || size.x > kLargestPicture || size.y > kLargestPicture) {
    return Error{ErrorCode::kBadInput,
                 "a picture of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                     " pixels cannot be drawn",
                 {"sides are 1 to " + std::to_string(kLargestPicture)}};
  }
  const int at_once =
      std::min(device.largest_picture(), largest_tile > 0 ? largest_tile : kUsualTile);
  const glm::ivec2 tile = glm::min(size, glm::ivec2(at_once));
  auto target = OffscreenTarget::build(device, tile);
  if (!target) return target.error();
  Image image;
  image.width = size.x;
  image.height = size.y;
  image.pixels.resize(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  for (int y = 0; y < size.y; y += tile.y) {
    for (int x = 0; x < size.x; x += tile.x) {
      (*target)->set_origin({x, y});
      if (auto drawn = renderer.render(**target, scene, overlay); !drawn) return drawn.error();
      (*target)->read(image, {x, y}, glm::min(tile, size - glm::ivec2(x, y)));
    }
  }
  return image;
}

}  // namespace geotherm::engine
