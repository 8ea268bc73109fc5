// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "app/picture/drawing.h"
#include "geotherm/error.h"

namespace geotherm::app {

/// Whether a path is that of a film: .mp4 or .gif.
bool is_film(const std::string& path);

/// Looks for ffmpeg, which makes the films. Errors: kNotAvailable, with what to install.
Result<void> find_ffmpeg();

/// A film that ffmpeg makes of frames: beside its place until finish() puts it there, so that it is
/// there whole or not at all. Errors of add() and finish(): kBadFile, with what ffmpeg says.
class Film {
 public:
  /// Starts ffmpeg. `path`: what messages call the film; `place`: the file that it becomes, behind
  /// links that it may name. Preconditions: is_film() of both, all frames have the size of the
  /// first, which is not added yet. `comment`: what the file says about itself. Errors: those of
  /// find_ffmpeg(), kBadFile.
  static Result<Film> open(const std::string& path, const std::string& place,
                           const DrawnPicture& first, int frames_per_second,
                           const std::string& comment);

  Film(Film&&) noexcept;
  Film& operator=(Film&&) noexcept;
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  /// Without finish(): ends ffmpeg and removes what it wrote.
  ~Film();

  Result<void> add(const DrawnPicture& picture);

  /// Nothing may follow.
  Result<void> finish();

 private:
  struct State;
  explicit Film(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace geotherm::app
