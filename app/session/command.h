// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/session/sculpture.h"
#include "app/session/sources.h"
#include "app/session/state.h"
#include "geotherm/directions.h"
#include "geotherm/error.h"
#include "geotherm/types.h"

// All that can be done to the program: mouse, keys, panels, scripts, the command line and tests
// make the same values. The text form of each stands behind it; docs/commands.md explains them.
namespace geotherm::app {
namespace command {

/// Opens a model; sources that only fit the old one become `random:1`.
struct Open {  // open MODEL
  std::string model;
};
/// Back to what the program starts with: the first line of a saved session. A model stays open
/// until another is.
struct Reset {};  // reset
/// Runs the commands of a file.
struct Run {  // run FILE
  std::string path;
};
/// Sets an option of the method or the picture (settings.h).
struct Set {  // NAME VALUE: backend cg, time-factor 2, view contours, range 0:2, bar off
  std::string name, value;
};

/// Replaces all sources.
struct SetSources {  // source set SPEC...
  std::vector<SourceSpec> sources;
};
struct AddSources {  // source add SPEC...
  std::vector<SourceSpec> sources;
};
/// Replaces entry `index` of ViewerState::sources: a source that is dragged.
struct MoveSource {  // source move INDEX SPEC
  int index = 0;
  SourceSpec source;
};
struct RemoveSource {  // source remove INDEX
  int index = 0;
};
/// Adds vertices, or points in faces, to the end of the last source, a curve of such: a brush that
/// goes on.
struct ExtendCurve {  // source extend V,V,... or source extend face:ID:b0:b1:b2,...
  std::vector<Index> vertices;
  std::vector<FacePoint> points = {};
};
struct ClearSources {};  // source clear
/// One more random source, one fewer (the last source where there is no random one), or as many as
/// there are at new random places.
struct MoreSources {};     // source more
struct FewerSources {};    // source fewer
struct ShuffleSources {};  // source shuffle

/// Begins a stroke of the sculpting brush.
struct Sculpt {  // sculpt pull|push|smooth RADIUS STRENGTH POINT...
  Stroke stroke;
};
/// Goes on with the last one.
struct ExtendStroke {  // sculpt extend POINT...
  std::vector<FacePoint> points;
};

/// A surface that moves: Frames::open()'s path; empty: none, the model as its file has it. Begins
/// at frame 0.
struct ShowSequence {  // sequence PATH, sequence none
  std::string path;
};
struct ShowFrame {  // frame INDEX
  int index = 0;
};
/// The window shows a frame after the other, each by `frame`.
struct Play {  // play on|off
  bool on = false;
};
/// Whether the first frame follows the last.
struct Loop {  // loop on|off
  bool on = true;
};

/// Degrees; the elevation stays within -90 to 90.
struct Orbit {  // camera orbit AZIMUTH ELEVATION
  double azimuth = 0, elevation = 0;
};
/// Zooms by a factor and keeps what lies at this place where it is. right, up: from the middle of
/// the picture, in picture heights.
struct Zoom {  // camera zoom FACTOR [RIGHT UP]
  double factor = 1, right = 0, up = 0;
};
struct Pan {  // camera pan RIGHT UP
  double right = 0, up = 0;
};
/// What the camera turns about and shows in the middle, model units.
struct Centre {  // camera centre X Y Z
  double x = 0, y = 0, z = 0;
};
/// Where the camera is, all at once.
struct Place {  // camera place AZIMUTH ELEVATION ZOOM RIGHT UP
  double azimuth = 0, elevation = 0, zoom = 1, right = 0, up = 0;
};
/// The whole model in the middle; the direction stays.
struct Frame {};  // camera frame
struct Rotate {   // rotate on|off
  bool on = false;
};

/// Keeps the present settings as B.
struct Keep {};    // keep
struct Forget {};  // forget
/// A and B change places.
struct Swap {};  // swap
struct Show {    // show a|b|difference
  Shown shown = Shown::kA;
};
/// From A to B, from anything else to A.
struct Flip {};  // flip

/// Shows the figures of a point; none: no longer.
struct Pick {  // pick face:ID:b0:b1:b2, pick none
  std::optional<FacePoint> point;
};

/// Draws the paths that lead from a point to the sources; none: no longer.
struct Target {                     // target SPEC, target none
  std::optional<SourceSpec> point;  ///< is_single_point()
};

/// Shows the centre of the sources and the shortest paths from there; none: no longer.
struct ShowCentre {  // source centre mean|median|none
  std::optional<CentreKind> kind;
};

/// Shows values, vectors or a log map of the vertices from a file in place of distances; empty: no
/// longer.
struct ShowField {  // field FILE, field none
  std::string path;
};
/// Distances no farther than that are asked for.
struct MaxDistance {         // max-distance R, max-distance none
  double most = kUnreached;  ///< > 0, model units
};

/// Runs the present work through several backends.
struct Compare {  // compare [all|NAME,NAME...]
  std::string backends = "all";
};

/// Writes a .png, .pdf or .svg of what is shown; no size: as large as it is shown.
struct SavePicture {  // save picture FILE [SIZE] [panels]
  std::string path;
  std::optional<PictureSize> size = {};
  bool panels = false;
};
struct SaveDistances {  // save distances FILE
  std::string path;
};
/// The mesh that is shown: what was sculpted, where it was.
struct SaveMesh {  // save mesh FILE
  std::string path;
};
/// The commands that lead to the present state.
struct SaveSession {  // save session FILE
  std::string path;
};
/// All commands since the start.
struct SaveLog {  // save log FILE
  std::string path;
};
/// What `solve --json` and `compare --json` write, of what is shown.
struct SaveFigures {  // save figures FILE
  std::string path;
};

struct Undo {};  // undo
struct Redo {};  // redo
struct Quit {};  // quit

}  // namespace command

using Command = std::variant<
    command::Open, command::Reset, command::Run, command::Set, command::SetSources,
    command::AddSources, command::MoveSource, command::RemoveSource, command::ExtendCurve,
    command::ClearSources, command::MoreSources, command::FewerSources, command::ShuffleSources,
    command::Sculpt, command::ExtendStroke, command::ShowSequence, command::ShowFrame,
    command::Play, command::Loop, command::Orbit, command::Zoom, command::Pan, command::Centre,
    command::Place, command::Frame, command::Rotate, command::Keep, command::Forget, command::Swap,
    command::Show, command::Flip, command::Pick, command::Target, command::ShowCentre,
    command::ShowField, command::MaxDistance, command::Compare, command::SavePicture,
    command::SaveDistances, command::SaveMesh, command::SaveSession, command::SaveLog,
    command::SaveFigures, command::Undo, command::Redo, command::Quit>;

/// Whether a command is of one of these kinds.
template <class... Kinds>
bool is_any_of(const Command& command) {
  return (std::holds_alternative<Kinds>(command) || ...);
}

/// One line without its end. parse_command(to_text(c)) == c for every command that can be parsed.
std::string to_text(const Command& command);

namespace command {
/// Whether two commands have the same text.
inline bool operator==(const Command& a, const Command& b) { return to_text(a) == to_text(b); }
}  // namespace command

/// Words are separated by blanks; one with blanks, quotes or # stands in double quotes, with \" and
/// \\ inside. Errors: kBadInput, "column N: ..." with what was expected.
Result<Command> parse_command(std::string_view line);

/// What the last word of an unfinished line may become, each as a whole word: commands and
/// settings, second words, values that have names. Empty: nothing is known of it.
std::vector<std::string> completions(std::string_view line);

/// A line of a script with its command.
struct ScriptLine {
  int number = 1;
  Command command;
  bool unseen = false;  ///< below kSeenLine: for pictures without a window alone
};

/// Stands in saved sessions above the size and the letters that a window had.
inline constexpr const char* kSeenLine = "# as it was seen; for pictures without a window";

/// One command a line; blank lines and what follows a # (outside quotes) are skipped. Errors:
/// kBadFile, "NAME: line N, column N: ..." with what was expected.
Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& name);

/// The state after a command. Pure: commands that save, compare, run a file, undo or quit change
/// nothing here. Errors: kBadInput, one sentence (no such source, nothing kept as B, ...).
Result<ViewerState> apply(const ViewerState& state, const Command& command);

/// Commands that lead from initial_state() to `state`, and back to it exactly.
std::vector<Command> commands_to(const ViewerState& state);

/// Whether undo takes the command back: what concerns sources, strokes, method, picture, A and B;
/// not camera and timeline. `merged`: together with the one before it, as of a drag.
struct UndoRule {
  bool undoable = false, merged = false;
};
UndoRule undo_rule(const Command& command);

}  // namespace geotherm::app
