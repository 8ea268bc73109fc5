// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/session/answer.h"
#include "app/session/report.h"
#include "app/session/sources.h"
#include "solver/mesh/frames.h"

// What `solve --sequence` and `render --sequence` have in common: one source set on a surface that
// moves, solved frame after frame.
namespace geotherm::app {

/// What is asked for, before a frame is read.
struct Sequence {
  Model model;  ///< whose faces all frames have, and on which the sources were placed
  Frames frames;
  std::string path;  ///< of the frames, as typed
  bool skip_bad = false;
  MethodOptions options;
  ResolvedSources sources;
  QueryOptions query = {.quality = false};
  CheckSettings check;  ///< of the first frame
};

/// Refuses what contradicts a sequence among the options of commands that solve. Errors: kBadInput.
Result<void> refuse_with_sequence(const SequenceArguments& sequence, const CheckArguments& check);

/// Reads the model, places the sources on it and opens the frames. Errors: those of load_model(),
/// resolve_sources() and Frames::open(), kBadInput (a model that is no mesh).
Result<Sequence> begin_sequence(const std::string& model, const SequenceArguments& arguments,
                                const ViewerState& asked, const std::vector<Source>& sources,
                                const CheckSettings& check, const Progress& progress);

struct BadFrame {
  std::int64_t k = 0;
  std::string why;  ///< with the frame's name
};

/// What there is to say about all frames together.
struct SequenceFigures {
  std::optional<Answer> answer;  ///< of the last frame that was solved; `mesh` of the first
  std::vector<BadFrame> bad;
  double read_ms = 0, setup_ms = 0, query_ms = 0;  ///< sums; frames are read beside the others
  double wall_ms = 0;                              ///< from the first frame to the last
  double peak_rss_mb = 0;
  std::vector<Warning> warnings;
};

/// Takes frame k. In their order. `answer`: its distances, its mesh in `model`; null where the
/// frame is bad. An error ends the work and is what solve_frames() returns.
using TakeAnswer = std::function<Result<void>(std::int64_t k, const Answer* answer)>;

/// Solves each frame beside the reading of the next one, the first with the check, the others by
/// the method that answered it. Two methods and two frames are in memory at most. `output`: what
/// will be written, for the estimate. Errors: those of reading and solving the first bad frame,
/// with its name, unless those are skipped; no frame that is good; kOutOfMemory; kCancelled;
/// kNumericalFailure (OnPoor::kFail).
Result<SequenceFigures> solve_frames(const Sequence& sequence, const TakeAnswer& take,
                                     const std::string& output, const Progress& progress,
                                     const Announce& announce);

/// "100 of walk.pc2, 2 of them bad".
std::string frames_in_words(const Sequence& sequence, const SequenceFigures& figures);

/// model, options, sources, frames, timing_ms, memory_mb, warnings and error: what both reports
/// hold.
Json sequence_json(const Sequence& sequence, const SequenceFigures& figures);

/// "12.3 ms each: set-up 9.8, query 2.5, reading 3.1 beside them".
std::string frame_times_in_words(const Sequence& sequence, const SequenceFigures& figures);

}  // namespace geotherm::app
