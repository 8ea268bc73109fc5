// SPDX-License-Identifier: MIT
#include "app/many/each.h"

#include <algorithm>
#include <cmath>

#include "app/many/many_work.h"
#include "app/outputs.h"
#include "app/text.h"
#include "app/told.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

Result<void> expect_rows(const SolveArguments& arguments, Outputs& outputs) {
  protect_inputs(arguments.model, arguments.sources, outputs);
  if (arguments.outputs.size() != 1) {
    return Error{ErrorCode::kBadInput,
                 "--each writes one array, and " +
                     counted(std::ssize(arguments.outputs), "output", "outputs") +
                     " were given; give -o FILE.npy, or -o - for standard "
                     "output"};
  }
  const std::string& path = arguments.outputs.front();
  if (path != "-" && io::file_extension(path) != ".npy") {
    return Error{ErrorCode::kNotAvailable,
                 one_line(path) +
                     ": --each writes an array of sources x vertices as .npy; choose "
                     "another name"};
  }
  if (auto expected = outputs.expect(path, "--output"); !expected) return expected;
  if (arguments.json.empty()) return {};
  return outputs.expect(arguments.json, "--json");
}

Error about_file(const Error& error) {
  return with_hint(error, {"make room there, or choose another place"});
}

/// Of all rows.
struct Sums {
  double least = kUnreached, most = 0, mean = 0;
  double reached = 0;
  std::int64_t unreached = 0;

  void add(std::span<const double> row) {
    for (const double d : row) {
      if (!std::isfinite(d)) {
        ++unreached;
        continue;
      }
      least = std::min(least, d);
      most = std::max(most, d);
      mean += (d - mean) / ++reached;  // a sum could leave the range of doubles
    }
  }
};

Json each_json(const ManySources& work, const ManyFigures& figures, const Sums& sums, NpyType type,
               double bytes) {
  Json json = many_json(work, figures);
  json["rows"] = work.sources.sets.size();
  json["columns"] = work.mesh.vertices;
  json["dtype"] = to_text(type);
  json["bytes"] = bytes;
  json["distance"] = {
      {"min", sums.least}, {"max", sums.most}, {"mean", sums.mean}, {"unreached", sums.unreached}};
  return json;
}

}  // namespace

Result<CommandOutput> run_each(const SolveArguments& arguments, const Progress& progress,
                               const Announce& announce) {
  if (auto fits = refuse_single_options(arguments, "--each"); !fits) return fits.error();
  if (arguments.symmetric) {
    return Error{ErrorCode::kBadInput, "--symmetric is about --pairs; leave it out"};
  }
  const auto type = number_type(arguments);
  if (!type) return type.error();
  Outputs outputs;
  if (auto expected = expect_rows(arguments, outputs); !expected) return expected.error();
  auto work = begin_many(arguments, progress);
  if (!work) return work.error();

  const std::string& path = arguments.outputs.front();
  const auto rows = static_cast<std::int64_t>(work->sources.sets.size());
  const Index vertices = work->mesh.vertices;
  const auto bytes = static_cast<double>(
      npy_bytes_of(static_cast<std::uint64_t>(rows), static_cast<std::uint64_t>(vertices), *type));
  if (auto fits = check_room(path, bytes); !fits) return fits.error();
  const std::string size = counted(rows, "source", "sources") + " x " +
                           counted(vertices, "vertex", "vertices") + ", " + to_text(*type) + ", " +
                           bytes_in_words(bytes);
  auto array = NpyRows::open(path, static_cast<std::uint64_t>(rows),
                             static_cast<std::uint64_t>(vertices), *type);
  if (!array) return about_file(array.error());
  Sums sums;
  auto figures = solve_many(
      *work, arguments,
      [&](std::size_t, std::span<const double> distances) -> Result<void> {
        sums.add(distances);
        const auto written = array->append(distances);
        return written ? written : about_file(written.error());
      },
      "a file of " + bytes_in_words(bytes), progress, announce);
  if (!figures) return figures.error();
  const auto written = outputs.write(path, [&] { return array->finish(); });
  if (!written) return written.error();

  if (sums.unreached > 0) figures->warnings.push_back(unreached_note(*work, sums.unreached));
  CommandOutput out{"", figures->warnings, {}};
  if (!arguments.json.empty()) {
    const auto reported = outputs.write_text(
        arguments.json, to_text(each_json(*work, *figures, sums, *type, bytes)), out.text);
    if (!reported) return reported.error();
  }
  out.note = sample_note(arguments, outputs, *figures);
  if (!outputs.uses_stdout()) {
    out.text = many_table(*work, *figures,
                          {{"model", one_line(work->model.name)},
                           {"array", one_line(path) + ": " + size},
                           {"distance", significant(sums.least) + " to " + significant(sums.most) +
                                            ", mean " + significant(sums.mean)}});
  }
  out.made = outputs.made();
  return out;
}

}  // namespace geotherm::app
