// SPDX-License-Identifier: MIT
// `geotherm solve --sequence`: distances on a surface that moves.
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "app/cli/commands.h"
#include "app/cli/many_work.h"
#include "app/cli/sequence_work.h"
#include "app/session/outputs.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/io.h"
#include "solver/core/text.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {
namespace {

Result<void> refuse_other_answers(const SolveArguments& arguments) {
  const auto refuse = [](const std::string& option, const std::string& why) {
    return Error{ErrorCode::kBadInput,
                 option + " " + why + ", and --sequence writes the distances of every frame",
                 {"leave one of them out"}};
  };
  if (arguments.each) return refuse("--each", "solves for each source by itself");
  if (arguments.pairs) return refuse("--pairs", "is about the sources alone");
  if (arguments.symmetric) return refuse("--symmetric", "is about --pairs");
  if (!arguments.fields.empty()) return refuse("--fields", "is about one surface");
  if (arguments.labels) return refuse("--labels", "is about one surface");
  if (!arguments.max_distance.empty()) return refuse("--max-distance", "is about one surface");
  if (!arguments.targets.empty()) return refuse("--target", "is about one surface");
  if (!arguments.bake.empty()) return refuse("--bake-colours", "is about one surface");
  return {};
}

bool is_collection(const std::string& path) { return io::file_extension(path) == ".pvd"; }

Result<void> expect_output(const SolveArguments& arguments, Outputs& outputs) {
  if (arguments.outputs.size() != 1) {
    return Error{ErrorCode::kBadInput,
                 "--sequence writes one output, and " +
                     counted(std::ssize(arguments.outputs), "was", "were") + " given",
                 {"give -o FILE.npy, -o FILE.pvd, or -o - for standard output"}};
  }
  const std::string& path = arguments.outputs.front();
  if (path != "-" && io::file_extension(path) != ".npy" && !is_collection(path)) {
    return Error{ErrorCode::kNotAvailable,
                 one_line(path) +
                     ": --sequence writes an array of frames x vertices as .npy, or a .vtp file "
                     "for each frame and the .pvd file that lists them",
                 {"choose another name"}};
  }
  if (is_collection(path) && (arguments.float32 || !arguments.dtype.empty())) {
    return Error{ErrorCode::kBadInput,
                 "the type of numbers is that of a .npy file",
                 {"give -o FILE.npy, or leave --dtype and --float32 out"}};
  }
  if (auto expected = outputs.expect(path, "--output"); !expected) return expected;
  return expect_report(arguments.json, outputs);
}

/// Takes the distances of frame after frame and makes files of them.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// Null: the frame is bad.
  virtual Result<void> take(std::int64_t k, const Answer* answer) = 0;
  virtual Result<void> finish() = 0;
};

/// Rows of one array; those of bad frames are NaN.
class RowSink final : public FrameSink {
 public:
  RowSink(NpyRows rows, Outputs& outputs, std::string path, Index vertices)
      : rows_(std::move(rows)),
        outputs_(outputs),
        path_(std::move(path)),
        bad_(static_cast<std::size_t>(vertices), std::numeric_limits<double>::quiet_NaN()) {}

  Result<void> take(std::int64_t, const Answer* answer) override {
    auto written = rows_.append(answer ? answer->result.distances : bad_);
    if (written) return written;
    return with_hint(written.error(), {"make room there, or choose another place"});
  }
  Result<void> finish() override {
    return outputs_.write(path_, [this] { return rows_.finish(); });
  }

 private:
  NpyRows rows_;
  Outputs& outputs_;
  std::string path_;
  std::vector<double> bad_;
};

/// A file for each frame, and the list of them (a collection of ParaView), which comes last.
class CollectionSink final : public FrameSink {
 public:
  /// Errors: those of Outputs::expect() for a frame's file.
  static Result<std::unique_ptr<FrameSink>> open(const std::string& path, const Frames& frames,
                                                 Outputs& outputs) {
    auto sink = std::unique_ptr<CollectionSink>(new CollectionSink(path, frames, outputs));
    outputs.keep_together();
    for (std::int64_t k = 0; k < frames.count(); ++k) {
      if (auto expected = outputs.expect(sink->file_of(k), "--output"); !expected) {
        return expected.error();
      }
    }
    return std::unique_ptr<FrameSink>(std::move(sink));
  }

  Result<void> take(std::int64_t k, const Answer* answer) override {
    if (!answer) return {};
    const std::string file = file_of(k);
    list_ += "<DataSet timestep=\"" + std::to_string(frames_.number(k)) + "\" part=\"0\" file=\"" +
             escaped(std::filesystem::path(file).filename().string()) + "\"/>\n";
    return outputs_.write(file, [&] {
      return write_distances(outputs_.place_of(file), *answer->model.mesh,
                             answer->result.distances);
    });
  }
  Result<void> finish() override {
    return outputs_.write(path_, [this] {
      return write_file(outputs_.place_of(path_),
                        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
                        "version=\"0.1\">\n<Collection>\n" +
                            list_ + "</Collection>\n</VTKFile>\n");
    });
  }

 private:
  CollectionSink(std::string path, const Frames& frames, Outputs& outputs)
      : path_(std::move(path)), frames_(frames), outputs_(outputs) {}

  /// NAME_0007.vtp beside NAME.pvd.
  std::string file_of(std::int64_t k) const {
    constexpr std::size_t kDigits = 4;
    std::string digits = std::to_string(frames_.number(k));
    if (digits.size() < kDigits) digits.insert(0, kDigits - digits.size(), '0');
    const std::filesystem::path path(path_);
    return (path.parent_path() / (path.stem().string() + "_" + digits + ".vtp")).string();
  }

  std::string path_;
  Frames frames_;
  Outputs& outputs_;
  std::string list_;
};

std::string collection_in_words(std::int64_t frames) {
  return "a .vtp file for each of " + counted(frames, "frame", "frames");
}

struct OpenSink {
  std::unique_ptr<FrameSink> sink;
  std::string words;  ///< what is to be written
  std::string short_words;
};

Result<OpenSink> open_sink(const std::string& path, const Sequence& sequence, NpyType type,
                           Outputs& outputs) {
  const std::int64_t frames = sequence.frames.count();
  const Index vertices = sequence.model.mesh->vertex_count();
  if (is_collection(path)) {
    auto sink = CollectionSink::open(path, sequence.frames, outputs);
    if (!sink) return sink.error();
    return OpenSink{*std::move(sink), collection_in_words(frames), "a .vtp file for each"};
  }
  const auto rows = static_cast<std::uint64_t>(frames);
  const auto columns = static_cast<std::uint64_t>(vertices);
  const auto bytes = static_cast<double>(npy_bytes_of(rows, columns, type));
  if (auto fits = check_room(path, bytes); !fits) return fits.error();
  auto array = NpyRows::open(path, rows, columns, type);
  if (!array) return array.error();
  return OpenSink{std::make_unique<RowSink>(*std::move(array), outputs, path, vertices),
                  counted(frames, "frame", "frames") + " x " +
                      counted(vertices, "vertex", "vertices") + ", " + to_text(type) + ", " +
                      bytes_in_words(bytes),
                  "a file of " + bytes_in_words(bytes)};
}

std::string sequence_table(const Sequence& sequence, const SequenceFigures& figures,
                           const DistanceSummary& sums, const std::string& path,
                           const std::string& written) {
  const Answer& answer = *figures.answer;
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  table.add_row({"model", one_line(sequence.model.name) + ": " + mesh_in_words(answer.mesh)});
  table.add_row({"frames", frames_in_words(sequence, figures)});
  table.add_row({"output", one_line(path) + ": " + written});
  table.add_row({"distance", distances_in_words(sums)});
  table.add_row({"method", method_caption(*answer.method)});
  table.add_row({"time", frame_times_in_words(sequence, figures)});
  if (answer.error) {
    table.add_row({"first frame", "error " + to_text(accuracy_line(*answer.error))});
  }
  return table.text();
}

}  // namespace

Result<CommandOutput> run_sequence(const SolveArguments& arguments, const Progress& progress,
                                   const Announce& announce) {
  if (auto fits = refuse_other_answers(arguments); !fits) return fits.error();
  const auto type = number_type(arguments);
  if (!type) return type.error();
  const auto asked = settings_in(arguments.settings);
  if (!asked) return asked.error();
  const auto check = check_settings(arguments.check);
  if (!check) return check.error();
  const auto named = some_sources_of(arguments.sources);
  if (!named) return named.error();
  Outputs outputs;
  if (auto expected = expect_output(arguments, outputs); !expected) return expected.error();
  const auto sequence =
      begin_sequence(arguments.model, arguments.sequence, *asked, *named, *check, progress);
  if (!sequence) return sequence.error();
  const std::string& path = arguments.outputs.front();
  auto open = open_sink(path, *sequence, *type, outputs);
  if (!open) return open.error();
  DistanceSummary sums;
  auto figures = solve_frames(
      *sequence,
      [&](std::int64_t k, const Answer* answer) {
        if (answer) sums.add(answer->result.distances);
        return open->sink->take(k, answer);
      },
      open->short_words, progress, announce);
  if (!figures) {
    outputs.remove_written();
    return figures.error();
  }
  if (auto written = open->sink->finish(); !written) return written.error();

  note_unused_settings(arguments.settings, asked->options, figures->warnings);
  CommandOutput out{"", figures->warnings, {}};
  const auto report = [&] {
    Json json = sequence_json(*sequence, *figures);
    json["distance"] = distance_json(sums);
    return json;
  };
  out.note = accuracy_note(arguments.json, outputs, arguments.quiet, figures->answer->error);
  return finish_command(std::move(out), outputs, arguments.json, report, [&] {
    const std::int64_t solved = sequence->frames.count() - std::ssize(figures->bad);
    return sequence_table(*sequence, *figures, sums, path,
                          is_collection(path) ? collection_in_words(solved) : open->words);
  });
}

}  // namespace geotherm::app
