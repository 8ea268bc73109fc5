// SPDX-License-Identifier: MIT
#include <algorithm>

#include "app/picture/chart.h"
#include "app/session/compare.h"
#include "app/session/report.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/accuracy.h"

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
          {"cells", row.cells ? Json(*row.cells) : Json(nullptr)},
          {"status", row.status},
          {"message", to_text(row.note)},
          {"error_queries", row.error_queries}};
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

Index count_of(const CompareRow& row) { return row.cells.value_or(row.faces); }

/// What is counted beside the models.
const char* counted_in(std::span<const CompareRow> rows) {
  const auto of_space = [](const CompareRow& row) { return row.cells.has_value(); };
  return std::ranges::any_of(rows, of_space) ? "cells" : "faces";
}

/// Of which queries the errors are; empty where none was measured.
std::string error_line(std::span<const CompareRow> rows) {
  std::size_t count = 0;
  std::vector<std::string> references;
  for (const CompareRow& row : rows) {
    if (row.error_queries == 0) continue;
    count = std::max(count, row.error_queries);
    const std::string reference = one_line(row.model) + " against " + to_text(row.error_reference);
    if (std::ranges::count(references, reference) == 0) references.push_back(reference);
  }
  if (count == 0) return {};
  return "errors are of the first " +
         counted(static_cast<std::int64_t>(count), "query", "queries") + ", of " +
         joined(references);
}

std::string cell(const std::optional<double>& value) { return value ? milliseconds(*value) : "-"; }

}  // namespace

std::string compare_table(const Machine& machine, std::span<const CompareRow> rows) {
  using Align = TextTable::Align;
  TextTable table({{"model", Align::kLeft},
                   {counted_in(rows), Align::kRight},
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
    table.add_row({same_model ? "" : one_line(row.model), same_model ? "" : grouped(count_of(row)),
                   row.name(), cell(row.setup_ms), cell(row.query_ms_median), range,
                   cell(row.batch_query_ms), cell(row.factor_mb),
                   row.status != "ok"   ? row.status
                   : row.max_difference ? significant(*row.max_difference, 2)
                                        : "-",
                   row.mean_error ? percent_text(*row.mean_error) : "-",
                   row.max_error ? percent_text(*row.max_error) : "-"});
    if (!row.note.message.empty()) {
      messages +=
          one_line(row.model) + ", " + row.name() + ": " + one_line(to_text(row.note)) + '\n';
    }
    before = &row;
  }
  if (const std::string errors = error_line(rows); !errors.empty()) messages += errors + '\n';
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
  return report_text(
      Json{{"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"blas", machine.blas}}},
           {"rows", list}});
}

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1c2733; --soft: #66758a; --line: #dde3ea;
  --paper: #ffffff; --bad: #b3261e; }
@media (prefers-color-scheme: dark) { :root { --ink: #e5eaf0; --soft: #97a5b6; --line: #303a46;
  --paper: #14191f; --bad: #ff8a80; } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 68rem; margin: 2.5rem auto; padding: 0 1.5rem; }
h1 { font-size: 1.5rem; margin: 0; } h2 { font-size: 1.1rem; margin: 2.2rem 0 .4rem; }
p { color: var(--soft); margin: .2rem 0 1rem; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th { text-align: right; font-weight: 600; color: var(--soft); border-bottom: 2px solid var(--line); }
td { text-align: right; border-bottom: 1px solid var(--line); }
th, td { padding: .35rem .6rem; white-space: nowrap; } .name { text-align: left; }
.bad { color: var(--bad); } .message { white-space: normal; color: var(--soft); text-align: left; }
.scroll { overflow-x: auto; } svg { width: 100%; height: auto; }
)";

std::string figure_cell(const std::optional<double>& value) {
  return "<td>" + (value ? milliseconds(*value) : std::string("&ndash;")) + "</td>";
}

std::string table_row(const CompareRow& row) {
  const bool ok = row.status == "ok";
  std::string out = "<tr><td class=name>" + escaped(one_line(row.model)) + "</td><td>" +
                    grouped(count_of(row)) + "</td><td class=name>" + escaped(row.name()) + "</td>";
  for (const auto* value : {&row.setup_ms, &row.query_ms_median, &row.batch_query_ms,
                            &row.factor_mb, &row.peak_rss_mb}) {
    out += figure_cell(*value);
  }
  const std::string difference =
      row.max_difference ? significant(*row.max_difference, 2) : std::string("&ndash;");
  out += ok ? "<td>" + difference + "</td>" : "<td class=bad>" + escaped(row.status) + "</td>";
  for (const auto* error : {&row.mean_error, &row.max_error}) {
    out += "<td>" + (*error ? percent_text(**error) : std::string("&ndash;")) + "</td>";
  }
  out += "</tr>\n";
  if (!row.note.message.empty()) {
    out += "<tr><td></td><td></td><td class=message colspan=9>" +
           escaped(one_line(to_text(row.note))) + "</td></tr>\n";
  }
  return out;
}

std::string times_chart(std::span<const CompareRow> rows) {
  const auto bar = [](const char* kind, const std::optional<double>& ms) {
    return chart::Bars::Bar{kind, ms.value_or(0), milliseconds(ms.value_or(0))};
  };
  std::vector<chart::Bars> bars;
  for (const CompareRow& row : rows) {
    bars.push_back({one_line(row.model),
                    row.name(),
                    {bar("k0", row.setup_ms), bar("k1", row.query_ms_median)}});
  }
  return bars_svg(bars, " ms");
}

}  // namespace

std::string compare_html(const Machine& machine, std::span<const CompareRow> rows) {
  std::string out = "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>";
  out += "<meta name=viewport content=\"width=device-width, initial-scale=1\">";
  out += "<title>geotherm compare</title><style>" + std::string(kStyle) +
         std::string(chart::style()) + "</style></head><body>\n";
  out += "<h1>Backends side by side</h1>\n<p>" + escaped(machine.cpu) + ", " +
         counted(machine.cores, "core", "cores") + ", BLAS " + escaped(machine.blas) + "</p>\n";
  out +=
      "<h2>Time</h2>\n<p>Pre-factorisation (blue) and median solve (orange), on a logarithmic "
      "scale.</p>\n" +
      times_chart(rows);
  const std::string errors = error_line(rows);
  out += "<h2>Figures</h2>\n<p>Differences are relative to the reference's largest distance" +
         (errors.empty() ? errors : "; " + escaped(errors)) +
         ".</p>\n"
         "<div class=scroll><table><thead><tr><th class=name>model</th><th>" +
         std::string(counted_in(rows)) +
         "</th>"
         "<th class=name>solver</th><th>pre-factorisation ms</th><th>solve ms</th>"
         "<th>batch ms/source</th><th>factor MB</th><th>peak MB</th><th>max difference</th>"
         "<th>mean error</th><th>max error</th></tr>"
         "</thead><tbody>\n";
  for (const CompareRow& row : rows) out += table_row(row);
  return out + "</tbody></table></div>\n</body></html>\n";
}

}  // namespace geotherm::app
