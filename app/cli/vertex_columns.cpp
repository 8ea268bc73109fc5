// SPDX-License-Identifier: MIT
#include "app/cli/vertex_columns.h"

#include <CLI/CLI.hpp>

#include "app/cli/options.h"
#include "app/text/text.h"
#include "geotherm/io.h"
#include "solver/core/text.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {
namespace {

std::string columns_csv(Index vertices, const std::vector<VertexColumn>& columns) {
  std::string text = "vertex";
  for (const VertexColumn& column : columns) text += ',' + column.name;
  text += '\n';
  for (Index v = 0; v < vertices; ++v) {
    text += std::to_string(v);
    for (const VertexColumn& column : columns) text += ',' + number_text(column.values[v]);
    text += '\n';
  }
  return text;
}

Result<void> write_rows(const std::string& path, Index vertices,
                        const std::vector<VertexColumn>& columns) {
  auto rows =
      NpyRows::open(path, static_cast<std::uint64_t>(vertices), columns.size(), NpyType::kFloat64);
  if (!rows) return rows.error();
  std::vector<double> row(columns.size());
  for (Index v = 0; v < vertices; ++v) {
    for (std::size_t c = 0; c < columns.size(); ++c) row[c] = columns[c].values[v];
    if (auto written = rows->append(row); !written) return written;
  }
  return rows->finish();
}

}  // namespace

void add_column_options(CLI::App& command, std::vector<std::string>& outputs, std::string& json,
                        const std::string& what, bool pictures) {
  may_repeat(command.add_option("-o,--output", outputs,
                                "where " + what + " go: .csv .npy .ply" +
                                    (pictures ? ", .svg (a picture)" : "") +
                                    ", or - for CSV on standard output; may be repeated"),
             "FILE");
  add_json_option(command, json);
}

Result<void> expect_columns(const std::vector<std::string>& outputs, const std::string& json,
                            bool pictures, Outputs& expected) {
  for (const std::string& path : outputs) {
    const std::string ending = io::file_extension(path);
    const bool known = path == "-" || ending == ".csv" || ending == ".npy" || ending == ".ply" ||
                       (pictures && ending == ".svg");
    if (!known) {
      return Error{ErrorCode::kNotAvailable,
                   "--output: " + one_line(path) + ": unknown extension '" + one_line(ending) + "'",
                   {std::string("there are .csv .npy .ply") + (pictures ? " .svg" : "")}};
    }
    if (auto fits = expected.expect(path, "--output"); !fits) return fits;
  }
  return expect_report(json, expected);
}

Result<void> write_columns(const std::string& path, const TriangleMesh& mesh,
                           const std::vector<VertexColumn>& columns, Outputs& outputs,
                           std::string& standard_output) {
  const std::string ending = io::file_extension(path);
  if (path == "-" || ending == ".csv") {
    return outputs.write_text(path, columns_csv(mesh.vertex_count(), columns), standard_output);
  }
  return outputs.write(path, [&]() -> Result<void> {
    if (ending == ".npy" && columns.size() == 1) {
      return write_file(outputs.place_of(path), io::npy_bytes(columns.front().values));
    }
    if (ending == ".npy") {
      return write_rows(outputs.place_of(path), mesh.vertex_count(), columns);
    }
    std::vector<DataField> fields;
    for (const VertexColumn& column : columns) {
      fields.push_back(
          {column.name, DataField::Place::kVertices, DataField::Type::kFloat64, column.values});
    }
    return write_file(outputs.place_of(path), io::ply_bytes(mesh, {}, {}, fields));
  });
}

}  // namespace geotherm::app
