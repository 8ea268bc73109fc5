// SPDX-License-Identifier: MIT
// Pictures and films as files.
#include <algorithm>
#include <utility>

#include "app/cli/render_work.h"
#include "app/picture/picture_text.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

constexpr int kUsualRate = 25, kMaxRate = 120;
constexpr int kMaxGifRate = 50;  ///< players show what is faster slowly

/// Precondition: check_film().
int rate_of(const RenderArguments& arguments) {
  return arguments.fps.empty() ? kUsualRate : *number_in<int>(arguments.fps);
}

}  // namespace

Result<void> check_film(const RenderArguments& arguments, const PictureSettings& settings) {
  const bool gif = io::file_extension(arguments.output) == ".gif";
  if (!arguments.fps.empty()) {
    if (!is_film(arguments.output)) {
      return Error{ErrorCode::kBadInput,
                   "--fps is for films",
                   {"give -o FILE.mp4 or -o FILE.gif, or leave it out"}};
    }
    const auto rate = whole_between(arguments.fps, 1, gif ? kMaxGifRate : kMaxRate,
                                    "is no number of pictures a second");
    if (!rate) return about("--fps", rate.error());
  }
  if (!is_film(arguments.output)) return {};
  if (settings.background == PictureBackground::kTransparent) {
    return Error{
        ErrorCode::kBadInput,
        "--background transparent: films have no transparency",
        {"choose ", SettingHint{"background", {"light", "dark"}}, ", or give -o FILE.png"}};
  }
  if (auto there = find_ffmpeg(); !there) return about("--output", there.error());
  return {};
}

std::optional<FigureFormat> figure_format(const std::string& path) {
  const std::string extension = io::file_extension(path);
  if (extension == ".pdf") return FigureFormat::kPdf;
  if (extension == ".svg") return FigureFormat::kSvg;
  return std::nullopt;
}

std::vector<std::string> picture_paths(const std::string& output, const PictureSettings& settings) {
  return is_film(output) ? std::vector{output} : frame_paths(output, settings);
}

FrameWriter::FrameWriter(const RenderArguments& arguments, Outputs& outputs,
                         PictureFigures& figures, Progress progress, std::string& standard_output)
    : arguments_(arguments),
      outputs_(outputs),
      figures_(figures),
      progress_(std::move(progress)),
      standard_output_(standard_output) {}

Result<void> FrameWriter::take(int frame, const DrawnPicture& picture) {
  figures_.draw_ms += watch_.lap();
  if (is_film(arguments_.output)) {
    if (!film_) {
      auto film = Film::open(arguments_.output, outputs_.place_of(arguments_.output), picture,
                             rate_of(arguments_), one_line(typed_command()));
      if (!film) return film.error();
      film_ = *std::move(film);
    }
    if (auto added = film_->add(picture); !added) return added;
  } else {
    const std::optional<FigureFormat> format = figure_format(arguments_.output);
    const auto texts = picture_texts(figures_, frame);
    const std::optional<int> dpi = said_dpi(figures_.settings);
    auto bytes =
        format ? figure_bytes(picture, *format, texts, dpi) : png_bytes(picture, texts, dpi);
    if (!bytes) return bytes.error();
    const std::string& path = figures_.paths[static_cast<std::size_t>(frame)];
    auto written = outputs_.write_text(path, *std::move(bytes), standard_output_);
    if (!written) return written;
  }
  figures_.write_ms += watch_.lap();
  const int frames = frame_count(figures_.settings);
  if (report(progress_, "drawing", std::min(1.0, (frame + 1.0) / frames))) return {};
  return cancelled_error();
}

Result<void> FrameWriter::finish() {
  if (!film_) return {};
  auto made = outputs_.write(arguments_.output, [this] { return film_->finish(); });
  figures_.write_ms += watch_.lap();
  return made;
}

}  // namespace geotherm::app
