// SPDX-License-Identifier: MIT
// `geotherm solve --sequence`: distances on a surface that moves.
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/many_work.h"
#include "app/cli/rows_file.h"
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
  return expect_files(arguments.outputs, arguments.json, outputs);
}

/// Takes the distances of frame after frame and makes files of them.
struct FrameSink {
  TakeAnswer take;
  std::function<Result<void>()> finish;
  std::string words, short_words;  ///< what is to be written
};

/// Rows of one array; those of bad frames are NaN.
Result<FrameSink> row_sink(const std::string& path, const Sequence& sequence, NpyType type,
                           Outputs& outputs) {
  const std::int64_t frames = sequence.frames.count();
  const Index vertices = sequence.model.mesh->vertex_count();
  const auto rows = static_cast<std::uint64_t>(frames);
  const auto columns = static_cast<std::uint64_t>(vertices);
  const auto bytes = static_cast<double>(npy_bytes_of(rows, columns, type));
  if (auto fits = check_room(path, bytes); !fits) return fits.error();
  auto array = NpyRows::open(path, rows, columns, type);
  if (!array) return array.error();
  const auto file = std::make_shared<NpyRows>(*std::move(array));
  const std::vector<double> bad(columns, std::numeric_limits<double>::quiet_NaN());
  return FrameSink{
      [file, bad](std::int64_t, const Answer* answer) -> Result<void> {
        auto written = file->append(answer ? answer->result.distances : bad);
        return written ? written : about_file(written.error());
      },
      [file, path, &outputs] { return outputs.write(path, [&] { return file->finish(); }); },
      counted(frames, "frame", "frames") + " x " + counted(vertices, "vertex", "vertices") + ", " +
          to_text(type) + ", " + bytes_in_words(bytes),
      "a file of " + bytes_in_words(bytes)};
}

/// NAME_0007.vtp beside NAME.pvd.
std::string file_of_frame(const std::string& collection, std::int64_t number) {
  constexpr std::size_t kDigits = 4;
  std::string digits = std::to_string(number);
  if (digits.size() < kDigits) digits.insert(0, kDigits - digits.size(), '0');
  const std::filesystem::path path(collection);
  return (path.parent_path() / (path.stem().string() + "_" + digits + ".vtp")).string();
}

std::string collection_in_words(std::int64_t frames) {
  return "a .vtp file for each of " + counted(frames, "frame", "frames");
}

/// A file for each frame, and the list of them (a collection of ParaView), which comes last.
/// Errors: those of Outputs::expect() for a frame's file.
Result<FrameSink> collection_sink(const std::string& path, const Frames& frames, Outputs& outputs) {
  outputs.keep_together();
  for (std::int64_t k = 0; k < frames.count(); ++k) {
    const auto expected = outputs.expect(file_of_frame(path, frames.number(k)), "--output");
    if (!expected) return expected.error();
  }
  const auto list = std::make_shared<std::string>();
  FrameSink sink;
  sink.words = collection_in_words(frames.count());
  sink.short_words = "a .vtp file for each";
  sink.take = [=, &frames, &outputs](std::int64_t k, const Answer* answer) -> Result<void> {
    if (!answer) return {};
    const std::string file = file_of_frame(path, frames.number(k));
    *list += "<DataSet timestep=\"" + std::to_string(frames.number(k)) + "\" part=\"0\" file=\"" +
             escaped(std::filesystem::path(file).filename().string()) + "\"/>\n";
    return outputs.write(file, [&] {
      return write_distances(outputs.place_of(file), *answer->model.mesh, answer->result.distances);
    });
  };
  sink.finish = [=, &outputs] {
    return outputs.write(path, [&] {
      return write_file(outputs.place_of(path),
                        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
                        "version=\"0.1\">\n<Collection>\n" +
                            *list + "</Collection>\n</VTKFile>\n");
    });
  };
  return sink;
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
  auto sink = is_collection(path) ? collection_sink(path, sequence->frames, outputs)
                                  : row_sink(path, *sequence, *type, outputs);
  if (!sink) return sink.error();
  DistanceSummary sums;
  auto figures = solve_frames(
      *sequence,
      [&](std::int64_t k, const Answer* answer) {
        if (answer) sums.add(answer->result.distances);
        return sink->take(k, answer);
      },
      sink->short_words, progress, announce);
  if (!figures) {
    outputs.remove_written();
    return figures.error();
  }
  if (auto written = sink->finish(); !written) return written.error();

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
                          is_collection(path) ? collection_in_words(solved) : sink->words);
  });
}

}  // namespace geotherm::app
