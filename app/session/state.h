// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/picture/picture_settings.h"
#include "app/session/check.h"
#include "app/session/model.h"
#include "app/session/sculpture.h"
#include "app/session/sources.h"
#include "geotherm/build_method.h"
#include "geotherm/directions.h"
#include "geotherm/names.h"

namespace geotherm::app {

/// Which distances are shown when some settings are kept as B.
enum class Shown {
  kA,           ///< the present settings
  kB,           ///< the kept ones
  kDifference,  ///< d_A - d_B
};
inline NamedValues<Shown> named_values(Shown) {
  using enum Shown;
  return {"'*' cannot be shown", {{kA, "a"}, {kB, "b"}, {kDifference, "difference"}}};
}

/// The frames of a surface that moves.
struct Timeline {
  std::string sequence;  ///< Frames::open()'s path; empty: none
  int frame = 0;         ///< that is shown, from 0
  bool playing = false, loop = true;

  bool operator==(const Timeline&) const = default;
};

/// What is open, and what is asked of it.
struct Question {
  std::string model;                  ///< a path or a bundled name; empty: none is open
  ModelReading reading;               ///< how the model is read
  std::vector<SourceSpec> sources;    ///< one set
  MethodOptions options;              ///< A
  std::optional<MethodOptions> kept;  ///< B
  std::optional<SourceSpec> target;   ///< paths lead from this single point to the sources
  std::optional<CentreKind> centre;   ///< of the sources, which is shown; none: no centre
  double max_distance = kUnreached;   ///< distances beyond it are not asked for, model units
  std::string field;                  ///< a file shown in place of distances; empty: none

  bool operator==(const Question&) const = default;
};

/// All that decides what the program shows; a plain value. What commands change and session files
/// hold. Answers, panels and windows are not part of it.
struct ViewerState : Question {
  Timeline timeline;
  Sculpture sculpture;              ///< what was done to the surface since it was opened
  Shown shown = Shown::kA;          ///< kA unless `kept`
  Check check = Check::kOn;         ///< the view exact-error means kAuto where it is off or on
  PictureSettings picture;          ///< width and height: of saved pictures
  std::optional<FacePoint> picked;  ///< the point whose figures are shown
  bool rotating = false;

  bool operator==(const ViewerState&) const = default;
};

/// The state that the viewer starts with: nothing open, the camera the same size from everywhere.
ViewerState initial_state();

}  // namespace geotherm::app
