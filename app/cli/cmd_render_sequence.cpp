// SPDX-License-Identifier: MIT
// `geotherm render --sequence`: a picture of each frame of a surface that moves.
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/picture_report.h"
#include "app/cli/render_work.h"
#include "app/cli/sequence_work.h"
#include "app/picture/picture_scale.h"
#include "app/session/outputs.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/mesh/connectivity.h"
#include "solver/mesh/frames.h"

namespace geotherm::app {
namespace {

/// What does not go with frames. Errors: kBadInput.
Result<void> refuse_other_pictures(const RenderArguments& arguments, const AskedPicture& asked) {
  const auto refuse = [](const std::string& option, const std::string& why, Hint hint) {
    return Error{ErrorCode::kBadInput, option + " does not go with --sequence, " + why,
                 std::move(hint)};
  };
  const View view = asked.settings.view;
  if (!arguments.more_models.empty()) {
    return refuse("a second model", "which moves one", {"leave the others out"});
  }
  if (asked.settings.turntable > 0) {
    return refuse("--turntable", "whose pictures are those of the frames",
                  {"leave one of them out"});
  }
  if (!arguments.max_distance.empty()) {
    return refuse("--max-distance", "whose scale is that of the first frame",
                  {"leave one of them out"});
  }
  if (!arguments.targets.empty()) {
    return refuse("--path", "which draws distances alone", {"leave one of them out"});
  }
  if (!arguments.field.empty()) {
    return refuse("--field", "which draws distances alone", {"leave one of them out"});
  }
  if (view == View::kExactError) {
    return refuse("--view exact-error", "whose first frame alone is checked",
                  {"choose another view"});
  }
  if (view == View::kRegions && asked.state.options.method == MethodKind::kHeat) {
    return refuse("--view regions by heat", "for heat does not know the nearest source",
                  {"add ", SettingHint{"method", {"wavefront"}}});
  }
  return {};
}

/// The name with a place for numbers. Errors: kBadInput.
Result<NumberedPath> numbered_output(const std::string& path) {
  if (is_film(path)) return NumberedPath::parse("%d.png");  // nobody asks for its names
  auto numbered = NumberedPath::parse(path);
  if (!numbered) {
    Error error = about("--output", numbered.error());
    error.hint = {"give -o 'frame_%04d.png', whose %04d becomes the frame's number"};
    return error;
  }
  if (io::file_extension(path) == ".png") return numbered;
  return Error{
      ErrorCode::kBadInput,
      "--output: " + one_line(path) + ": pictures are written as " + ".png, films as .mp4 and .gif",
      {"give -o 'frame_%04d.png'"}};
}

/// Points that enclose all frames almost as closely as all of their vertices: the farthest ones in
/// directions on all sides.
class FramesExtent {
 public:
  /// `model`: whose faces all frames have.
  explicit FramesExtent(const TriangleMesh& model)
      : used_(vertices_in_faces(model.vertex_count(), model.faces())) {
    constexpr int kDirections = 256;
    for (int i = 0; i < kDirections; ++i) {  // a spiral on the sphere
      const double z = 1 - (2 * i + 1.0) / kDirections;
      const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
      const double r = std::sqrt(1 - z * z);
      sides_.push_back({Vec3(r * std::cos(angle), r * std::sin(angle), z)});
    }
  }

  void add(const TriangleMesh& mesh) {
    for (std::size_t v = 0; v < used_.size(); ++v) {
      if (!used_[v]) continue;
      const Vec3& p = mesh.positions()[v];
      for (Side& side : sides_) {
        const double far = side.direction.dot(p);
        if (far <= side.far) continue;
        side.far = far;
        side.point = p;
      }
    }
  }

  std::vector<Vec3> points() const {
    std::vector<Vec3> out;
    for (const Side& side : sides_) out.push_back(side.point);
    return out;
  }

 private:
  struct Side {
    Vec3 direction;
    double far = -kUnreached;
    Vec3 point = Vec3::Zero();
  };
  std::vector<char> used_;
  std::vector<Side> sides_;
};

/// Reads all frames once: a frame that is bad ends the run before anything is solved.
Result<std::vector<Vec3>> extent_of(const Sequence& sequence, const Progress& progress) {
  const std::int64_t count = sequence.frames.count();
  FramesExtent extent(*sequence.model.mesh);
  bool some = false;
  for (std::int64_t k = 0; k < count; ++k) {
    if (!report(progress, "reading", static_cast<double>(k) / static_cast<double>(count))) {
      return cancelled_error();
    }
    const auto mesh = sequence.frames.read(k);
    if (!mesh && !sequence.skip_bad) return mesh.error();
    if (!mesh) continue;
    extent.add(*mesh);
    some = true;
  }
  if (!some) extent.add(*sequence.model.mesh);  // solve_frames() says that all frames are bad
  return extent.points();
}

/// Draws frame after frame.
class FramePainter {
 public:
  FramePainter(Drawing& drawing, const NumberedPath& paths, std::vector<Vec3> extent,
               Outputs& outputs, PictureFigures& figures, FrameWriter& film)
      : drawing_(drawing),
        paths_(paths),
        extent_(std::move(extent)),
        outputs_(outputs),
        figures_(figures),
        film_(film) {}

  Result<void> paint(std::int64_t number, const Answer& answer) {
    figures_.solve = answer;
    PictureData data = data_of(answer);
    figures_.scale = picture_scale(data, figures_.settings);
    data.caption = caption_of(figures_) + ", frame " + std::to_string(number);
    const std::string path = paths_.path(number);
    Stopwatch watch;
    return drawing_.draw(data, figures_.settings,
                         [&](int, const DrawnPicture& picture) -> Result<void> {
                           if (is_film(film_.path())) return film_.take(0, picture);
                           figures_.draw_ms += watch.lap();
                           auto texts = picture_texts(figures_, 0);
                           texts.push_back({"geotherm:frame", std::to_string(number)});
                           auto bytes = png_bytes(picture, texts, said_dpi(figures_.settings));
                           if (!bytes) return bytes.error();
                           std::string nowhere;
                           auto written = outputs_.write_text(path, *std::move(bytes), nowhere);
                           if (!written) return written;
                           figures_.paths.push_back(path);
                           figures_.write_ms += watch.lap();
                           return {};
                         });
  }

 private:
  /// With the scales of the first frame.
  PictureData data_of(const Answer& answer) {
    const TriangleMesh& mesh = *answer.model.mesh;
    const View view = figures_.settings.view;
    const bool first = !unit_;
    PictureData data = picture_of_frame(mesh, extent_);
    data.up = answer.model.up;
    if (first) solid_ = is_solid(mesh);
    data.solid = solid_;
    add_sources(data, mesh, answer.sources);
    add_distances(data, answer.result.distances, unit_);
    unit_ = data.value_unit;
    data.nearest = answer.result.nearest_source;
    set_face_values(data, mesh, view, &answer.result);
    if (first) largest_face_value_ = data.largest_face_value;
    data.largest_face_value = largest_face_value_;
    if (!shows_arrows(view)) return data;
    add_fields(data, mesh, answer.result);
    return data;
  }

  Drawing& drawing_;
  const NumberedPath& paths_;
  std::vector<Vec3> extent_;
  Outputs& outputs_;
  PictureFigures& figures_;
  FrameWriter& film_;
  std::optional<double> unit_;
  float largest_face_value_ = 0;
  bool solid_ = false;
};

Result<void> expect_pictures(const RenderArguments& arguments, const Sequence& sequence,
                             const NumberedPath& paths, Outputs& outputs) {
  if (is_film(arguments.output)) {
    if (auto expected = outputs.expect(arguments.output, "--output"); !expected) return expected;
  }
  for (std::int64_t k = 0; k < sequence.frames.count() && !is_film(arguments.output); ++k) {
    const std::string path = paths.path(sequence.frames.number(k));
    if (auto expected = outputs.expect(path, "--output"); !expected) return expected;
  }
  return expect_report(arguments.json, outputs);
}

}  // namespace

Result<CommandOutput> run_render_sequence(const RenderArguments& arguments,
                                          const AskedPicture& asked, Drawing& drawing,
                                          const Progress& progress) {
  if (auto fits = refuse_other_pictures(arguments, asked); !fits) return fits.error();
  const auto paths = numbered_output(arguments.output);
  if (!paths) return paths.error();
  if (auto fits = check_film(arguments, asked.settings); !fits) return fits.error();
  const auto named = some_sources_of(arguments.sources);
  if (!named) return named.error();
  auto device = drawing.open(asked.settings);
  if (!device) return device.error();
  auto sequence = begin_sequence(arguments.model, arguments.sequence, asked.state, *named,
                                 asked.check, progress);
  if (!sequence) return sequence.error();
  sequence->query.fields = needs_fields(asked.settings.view);
  sequence->query.nearest = asked.settings.view == View::kRegions;
  Outputs outputs;
  outputs.keep_together();
  if (auto expected = expect_pictures(arguments, *sequence, *paths, outputs); !expected) {
    return expected.error();
  }

  constexpr double kReadShare = 0.05;
  auto extent = extent_of(*sequence, part_of(progress, 0, kReadShare));
  if (!extent) return extent.error();
  PictureFigures pictures;
  pictures.model = sequence->model;
  pictures.model_argument = arguments.model;
  pictures.sources = typed_sources(arguments.sources);
  pictures.settings = asked.settings;
  pictures.device = *std::move(device);
  if (is_film(arguments.output)) pictures.paths = {arguments.output};
  CommandOutput out;
  const Progress silent;
  FrameWriter film(arguments, outputs, pictures, silent, out.text);
  FramePainter painter(drawing, *paths, *std::move(extent), outputs, pictures, film);
  const auto paint = [&](std::int64_t k, const Answer* answer) -> Result<void> {
    return answer ? painter.paint(sequence->frames.number(k), *answer) : Result<void>();
  };
  auto figures = solve_frames(*sequence, paint, {}, part_of(progress, kReadShare, 1), {});
  if (!figures) {
    outputs.remove_written();
    return figures.error();
  }

  note_unused_settings(arguments.settings, asked.state.options, figures->warnings);
  if (auto made = film.finish(); !made) return made.error();
  out.warnings = figures->warnings;
  pictures.frames = frames_in_words(*sequence, *figures);
  pictures.frame_times = frame_times_in_words(*sequence, *figures);
  const auto report = [&] {
    Json json = sequence_json(*sequence, *figures);
    json["picture"] = picture_json(pictures)["picture"];
    return json;
  };
  return finish_command(std::move(out), outputs, arguments.json, report,
                        [&] { return picture_table(pictures); });
}

}  // namespace geotherm::app
