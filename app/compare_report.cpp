// SPDX-License-Identifier: MIT
#include "app/compare_report.h"

#include "app/answer_check.h"
#include "app/report_json.h"
#include "app/text.h"
#include "app/text_table.h"

namespace geotherm::app {
namespace {

Json figure(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json row_json(const CompareRow& row) {
  return {{"model", row.model},
          {"vertices", row.vertices},
          {"faces", row.faces},
          {"backend", row.name()},
          {"setup_ms", figure(row.setup_ms)},
          {"query_ms_median", figure(row.query_ms_median)},
          {"query_ms_min", figure(row.query_ms_min)},
          {"query_ms_max", figure(row.query_ms_max)},
          {"batch_query_ms", figure(row.batch_query_ms)},
          {"factor_mb", figure(row.factor_mb)},
          {"peak_rss_mb", figure(row.peak_rss_mb)},
          {"max_difference", figure(row.max_difference)},
          {"mean_difference", figure(row.mean_difference)},
          {"method", to_text(row.method)},
          {"mean_error", figure(row.mean_error)},
          {"max_error", figure(row.max_error)},
          {"error_reference", to_text(row.error_reference)},
          {"status", row.status},
          {"message", row.message}};
}

/// Names and messages come from elsewhere: what a spreadsheet would take for a formula begins with
/// an apostrophe, as one types it there for text.
std::string csv_field(const Json& value) {
  if (value.is_null()) return {};
  if (!value.is_string()) return value.dump();
  const std::string text = one_line(value.get<std::string>());
  const bool formula = !text.empty() && std::string_view("=+-@").find(text[0]) != std::string::npos;
  std::string quoted = formula ? "\"'" : "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string cell(const std::optional<double>& value) { return value ? milliseconds(*value) : "-"; }

}  // namespace

std::string compare_table(const Machine& machine, std::span<const CompareRow> rows) {
  using Align = TextTable::Align;
  TextTable table({{"model", Align::kLeft},
                   {"faces", Align::kRight},
                   {"solver", Align::kLeft},
                   {"pre-factorisation ms", Align::kRight},
                   {"solve ms", Align::kRight},
                   {"min - max", Align::kRight},
                   {"batch ms/source", Align::kRight},
                   {"factor MB", Align::kRight},
                   {"max difference", Align::kRight},
                   {"mean error", Align::kRight},
                   {"max error", Align::kRight}});
  std::string messages;
  const CompareRow* before = nullptr;
  for (const CompareRow& row : rows) {
    const bool same_model = before && before->model == row.model && before->faces == row.faces;
    const std::string range = row.query_ms_min
                                  ? cell(row.query_ms_min) + " - " + cell(row.query_ms_max)
                                  : std::string("-");
    table.add_row({same_model ? "" : one_line(row.model), same_model ? "" : grouped(row.faces),
                   row.name(), cell(row.setup_ms), cell(row.query_ms_median), range,
                   cell(row.batch_query_ms), cell(row.factor_mb),
                   row.status != "ok"   ? row.status
                   : row.max_difference ? significant(*row.max_difference, 2)
                                        : "-",
                   row.mean_error ? percent(*row.mean_error) : "-",
                   row.max_error ? percent(*row.max_error) : "-"});
    if (!row.message.empty()) {
      messages += one_line(row.model) + ", " + row.name() + ": " + one_line(row.message) + '\n';
    }
    before = &row;
  }
  return machine.cpu + ", " + counted(machine.cores, "core", "cores") + ", BLAS " + machine.blas +
         "\n\n" + table.text() + (messages.empty() ? "" : "\n" + messages);
}

std::string compare_csv(std::span<const CompareRow> rows) {
  std::string out;
  const Json keys = row_json({});
  for (const auto& item : keys.items()) out += (out.empty() ? "" : ",") + item.key();
  out += '\n';
  for (const CompareRow& row : rows) {
    std::string line;
    const Json json = row_json(row);
    for (const auto& item : json.items()) {
      line += (item.key() == "model" ? "" : ",") + csv_field(item.value());
    }
    out += line + '\n';
  }
  return out;
}

std::string compare_json(const Machine& machine, std::span<const CompareRow> rows) {
  Json list = Json::array();
  for (const CompareRow& row : rows) list.push_back(row_json(row));
  return to_text(
      Json{{"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"blas", machine.blas}}},
           {"rows", list}});
}

}  // namespace geotherm::app
