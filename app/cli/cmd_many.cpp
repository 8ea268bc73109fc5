// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "app/cli/commands.h"
#include "app/cli/many_work.h"
#include "app/cli/rows_file.h"
#include "app/session/outputs.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/memory.h"
#include "solver/core/text.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {
namespace {

bool is_npz(const std::string& path) { return io::file_extension(path) == ".npz"; }

}  // namespace

Result<void> check_each(const SolveArguments& arguments) {
  if (auto fits = refuse_single_options(arguments, "--each"); !fits) return fits;
  if (arguments.symmetric) {
    return Error{ErrorCode::kBadInput, "--symmetric is about --pairs", {"leave it out"}};
  }
  if (const auto type = number_type(arguments); !type) return type.error();
  if (arguments.outputs.size() != 1) {
    return Error{ErrorCode::kBadInput,
                 "--each writes one array, and " +
                     counted(std::ssize(arguments.outputs), "output", "outputs") + " were given",
                 {"give -o FILE.npy, or -o - for standard output"}};
  }
  const std::string& path = arguments.outputs.front();
  if (path != "-" && io::file_extension(path) != ".npy" && !is_npz(path)) {
    return Error{ErrorCode::kNotAvailable,
                 one_line(path) +
                     ": --each writes an array of sources x vertices as .npy, or sparse rows as "
                     ".npz",
                 {"choose another name"}};
  }
  if (is_npz(path) && !arguments.targets.empty()) {
    return Error{ErrorCode::kBadInput,
                 one_line(path) + ": sparse rows are of all vertices, and --target asks for some",
                 {"write a .npy, or leave --target out"}};
  }
  return {};
}

namespace {

Json each_json(const ManySources& work, const ManyFigures& figures, const DistanceSummary& sums,
               NpyType type, const RowsFile& file) {
  Json json = many_json(work, figures);
  json["rows"] = work.sources.sets.size();
  json["columns"] = file.columns();
  json["dtype"] = to_text(type);
  json["bytes"] = file.bytes();
  if (const auto entries = file.entries()) json["entries"] = *entries;
  json["distance"] = distance_json(sums);
  return json;
}

}  // namespace

Result<CommandOutput> run_each(const SolveArguments& arguments, const Progress& progress,
                               const Announce& announce) {
  if (auto fits = check_each(arguments); !fits) return fits.error();
  const auto type = number_type(arguments);
  Outputs outputs;
  const auto expected = expect_files(arguments.outputs, arguments.json, outputs);
  auto work = begin_many(arguments, expected, progress);
  if (!work) return work.error();

  const std::string& path = arguments.outputs.front();
  work->reach.sparse = is_npz(path);
  const auto rows = static_cast<std::int64_t>(work->sources.sets.size());
  DistanceSummary sums;
  auto file = RowsFile::open(path, *work, *type,
                             [&](std::size_t, std::span<const double> row) -> Result<void> {
                               sums.add(row);
                               return {};
                             });
  if (!file) return file.error();
  auto figures = solve_many(
      *work, arguments,
      [&](std::size_t row, const DistanceResult& answer) -> Result<void> {
        sums.add(answer.distances);
        const auto written = file->write(row, answer);
        return written ? written : about_file(written.error());
      },
      "a file of " + file->size_in_words(), progress, announce);
  if (!figures) return figures.error();
  sums = sums_of_all(sums, work->ranks);
  if (!work->ranks.is_first()) return CommandOutput();
  const auto written = outputs.write(path, [&] { return file->finish(); });
  if (!written) return written.error();
  const std::string size = counted(rows, "source", "sources") + " x " +
                           counted(file->columns(), "vertex", "vertices") + ", " + to_text(*type) +
                           ", " + file->size_in_words();

  if (sums.unreached > 0 && !work->reach.is_bounded())
    figures->warnings.push_back({unreached_note(*work, sums.unreached)});
  CommandOutput out{"", figures->warnings, {}};
  out.note = accuracy_note(arguments.json, outputs, arguments.quiet, figures->error);
  const auto table = [&] {
    return many_table(*work, *figures,
                      {{"model", one_line(work->model.name)},
                       {"array", one_line(path) + ": " + size},
                       {"distance", distances_in_words(sums)}});
  };
  return finish_command(
      std::move(out), outputs, arguments.json,
      [&] { return each_json(*work, *figures, sums, *type, *file); }, table);
}

namespace {

/// A table of more columns fits no terminal.
constexpr std::size_t kMaxInTable = 10;

bool is_npy(const std::string& path) { return io::file_extension(path) == ".npy"; }

}  // namespace

Result<void> check_pairs(const SolveArguments& arguments) {
  if (auto fits = refuse_single_options(arguments, "--pairs"); !fits) return fits;
  if (!arguments.targets.empty()) {
    return Error{ErrorCode::kBadInput,
                 "--target: the targets of --pairs are its sources",
                 {"leave it out, or take --each"}};
  }
  if (const auto type = number_type(arguments); !type) return type.error();
  for (const std::string& path : arguments.outputs) {
    if (path != "-" && !is_npy(path) && io::file_extension(path) != ".csv") {
      return Error{ErrorCode::kNotAvailable,
                   one_line(path) +
                       ": --pairs writes a matrix as .npy or .csv, and as JSON with "
                       "--json FILE",
                   {"choose another name"}};
    }
  }
  const bool typed = arguments.float32 || !arguments.dtype.empty();
  if (typed && std::ranges::none_of(arguments.outputs, is_npy)) {
    return Error{ErrorCode::kBadInput,
                 "the type of numbers is that of a .npy file",
                 {"give -o FILE.npy, or leave --dtype and --float32 out"}};
  }
  return {};
}

namespace {

/// Two at least. Errors: kBadInput.
Result<std::vector<Index>> vertices_of_pairs(const EachSource& each) {
  auto vertices = vertices_of_each(each, "--pairs: source");
  if (!vertices || vertices->size() >= 2) return vertices;
  return Error{ErrorCode::kBadInput,
               "--pairs: one vertex makes no pair",
               {"give several, such as -s 3,99,512"}};
}

Result<void> check_memory(std::size_t vertices) {
  const auto free = free_memory();
  const double bytes =
      sizeof(double) * static_cast<double>(vertices) * static_cast<double>(vertices);
  if (!free || bytes <= static_cast<double>(*free)) return {};
  return Error{ErrorCode::kOutOfMemory,
               "--pairs: " + counted(static_cast<std::int64_t>(vertices), "vertex", "vertices") +
                   " make a matrix of " + bytes_in_words(bytes) + ", and " +
                   bytes_in_words(static_cast<double>(*free)) + " of memory are free",
               {"take fewer, or --each, which streams"}};
}

Result<void> write_npy(const std::string& path, const PairMatrix& pairs, NpyType type) {
  auto file = NpyRows::open(path, pairs.size(), pairs.size(), type);
  if (!file) return file.error();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto row = std::span(pairs.entries).subspan(i * pairs.size(), pairs.size());
    if (auto written = file->append(row); !written) return written;
  }
  return file->finish();
}

std::string csv_of(const PairMatrix& pairs) {
  std::string text = "vertex";
  for (const Index v : pairs.vertices) text += ',' + std::to_string(v);
  text += '\n';
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    text += std::to_string(pairs.vertices[i]);
    for (std::size_t j = 0; j < pairs.size(); ++j) text += ',' + number_text(pairs.at(i, j));
    text += '\n';
  }
  return text;
}

Json pairs_json(const ManySources& work, const ManyFigures& figures, const PairMatrix& pairs,
                const Asymmetry& apart, bool symmetric) {
  Json json = many_json(work, figures);
  json["symmetric"] = symmetric;
  json["asymmetry"] = {{"max", apart.most},
                       {"max_of_distance", apart.of_larger},
                       {"vertices", {pairs.vertices[apart.i], pairs.vertices[apart.j]}}};
  Json rows = Json::array();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto begin = pairs.entries.begin() + static_cast<std::ptrdiff_t>(i * pairs.size());
    rows.push_back(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(pairs.size())));
  }
  json["distances"] = std::move(rows);
  return json;
}

std::string matrix_table(const PairMatrix& pairs) {
  std::vector<TextTable::Column> columns = {{"", TextTable::Align::kRight}};
  for (const Index v : pairs.vertices) {
    columns.push_back({std::to_string(v), TextTable::Align::kRight});
  }
  TextTable table(std::move(columns));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::vector<std::string> cells = {std::to_string(pairs.vertices[i])};
    for (std::size_t j = 0; j < pairs.size(); ++j) cells.push_back(significant(pairs.at(i, j)));
    table.add_row(std::move(cells));
  }
  return table.text();
}

std::string pairs_table(const ManySources& work, const ManyFigures& figures,
                        const PairMatrix& pairs, const Asymmetry& apart, bool symmetric) {
  double most = 0;
  for (const double d : pairs.entries) {
    if (std::isfinite(d)) most = std::max(most, d);
  }
  const std::string directions = significant(apart.most, 3) + " at most (" +
                                 significant(100 * apart.of_larger, 2) + " % of a distance)" +
                                 (symmetric ? "; both are their mean" : "");
  const auto count = static_cast<std::int64_t>(pairs.size());
  std::string text = many_table(work, figures,
                                {{"model", one_line(work.model.name)},
                                 {"matrix", counted(count, "vertex", "vertices") + ", " +
                                                counted(count * (count - 1) / 2, "pair", "pairs") +
                                                ", up to " + significant(most)},
                                 {"directions differ by", directions}});
  if (pairs.size() <= kMaxInTable) text += '\n' + matrix_table(pairs);
  return text;
}

}  // namespace

Asymmetry asymmetry(const PairMatrix& pairs) {
  Asymmetry out;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double a = pairs.at(i, j), b = pairs.at(j, i);
      if (!std::isfinite(a) || !std::isfinite(b)) continue;
      const double apart = std::abs(a - b);
      if (apart > 0) out.of_larger = std::max(out.of_larger, apart / std::max(a, b));
      if (apart <= out.most) continue;
      out.most = apart;
      out.i = i;
      out.j = j;
    }
  }
  return out;
}

void symmetrise(PairMatrix& pairs) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double& a = pairs.entries[i * pairs.size() + j];
      double& b = pairs.entries[j * pairs.size() + i];
      a = b = a / 2 + b / 2;
    }
  }
}

Result<CommandOutput> run_pairs(const SolveArguments& arguments, const Progress& progress,
                                const Announce& announce) {
  if (auto fits = check_pairs(arguments); !fits) return fits.error();
  const auto type = number_type(arguments);
  Outputs outputs;
  const auto expected = expect_files(arguments.outputs, arguments.json, outputs);
  auto work = begin_many(arguments, expected, progress);
  if (!work) return work.error();
  PairMatrix pairs;
  auto vertices = vertices_of_pairs(work->sources);
  if (!vertices) return vertices.error();
  pairs.vertices = *std::move(vertices);
  work->reach.targets = pairs.vertices;
  const auto rows = static_cast<std::uint64_t>(pairs.size());
  Result<void> fits = check_memory(pairs.size());
  for (const std::string& path : arguments.outputs) {
    const auto bytes = static_cast<double>(npy_bytes_of(rows, rows, *type));
    if (fits) fits = check_room(path, bytes);
  }
  fits = work->ranks.agree(fits);
  if (!fits) return fits.error();
  std::string mine;  // of each row of this rank its number and entries, as bytes
  const auto take = [&mine](std::size_t row, std::span<const double> distances) -> Result<void> {
    mine.append(reinterpret_cast<const char*>(&row), sizeof row);
    mine.append(reinterpret_cast<const char*>(distances.data()), distances.size_bytes());
    return {};
  };
  // Rows are kept beside the first file, in case that the work is ended from outside.
  std::optional<SharedRows> kept;
  const auto beside = std::ranges::find_if(arguments.outputs, is_renamed);
  if (beside != arguments.outputs.end()) {
    auto file = SharedRows::open(*beside, *work, static_cast<Index>(rows), NpyType::kFloat64, take);
    if (!file) return about_file(file.error());
    kept.emplace(*std::move(file));
  }
  auto figures = solve_many(
      *work, arguments,
      [&](std::size_t row, const DistanceResult& answer) -> Result<void> {
        if (auto taken = take(row, answer.distances); !taken || !kept) return taken;
        const auto written = kept->write(row, answer.distances);
        return written ? written : about_file(written.error());
      },
      "a matrix of " + bytes_in_words(static_cast<double>(sizeof(double) * rows * rows)), progress,
      announce);
  if (!figures) return figures.error();
  pairs.entries.resize(pairs.size() * pairs.size());
  const std::size_t bytes_of_row = pairs.size() * sizeof(double);
  for (const std::string& of_rank : work->ranks.all_gather(mine)) {
    for (std::size_t at = 0, row = 0; at < of_rank.size(); at += sizeof row + bytes_of_row) {
      std::memcpy(&row, of_rank.data() + at, sizeof row);
      std::memcpy(pairs.entries.data() + row * pairs.size(), of_rank.data() + at + sizeof row,
                  bytes_of_row);
    }
  }
  if (!work->ranks.is_first()) return CommandOutput();
  const Asymmetry apart = asymmetry(pairs);
  if (arguments.symmetric) symmetrise(pairs);

  const auto unreached = std::ranges::count(pairs.entries, kUnreached);
  if (unreached > 0 && arguments.max_distance.empty()) {
    figures->warnings.push_back({unreached_note(*work, unreached)});
  }
  CommandOutput out{"", figures->warnings, {}};
  for (const std::string& path : arguments.outputs) {
    const auto written = outputs.write(path, [&]() -> Result<void> {
      if (is_npy(path)) return write_npy(path, pairs, *type);
      std::string text = csv_of(pairs);
      if (path != "-") return write_file(path, text);
      out.text = std::move(text);
      return {};
    });
    if (!written) return written.error();
  }
  if (kept) kept->discard();
  out.note = accuracy_note(arguments.json, outputs, arguments.quiet, figures->error);
  return finish_command(
      std::move(out), outputs, arguments.json,
      [&] { return pairs_json(*work, *figures, pairs, apart, arguments.symmetric); },
      [&] { return pairs_table(*work, *figures, pairs, apart, arguments.symmetric); });
}

}  // namespace geotherm::app
