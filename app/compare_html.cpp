// SPDX-License-Identifier: MIT

#include "app/answer_check.h"
#include "app/chart.h"
#include "app/compare_report.h"
#include "app/text.h"

namespace geotherm::app {
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
                    grouped(row.faces) + "</td><td class=name>" + escaped(row.name()) + "</td>";
  for (const auto* value : {&row.setup_ms, &row.query_ms_median, &row.batch_query_ms,
                            &row.factor_mb, &row.peak_rss_mb}) {
    out += figure_cell(*value);
  }
  const std::string difference =
      row.max_difference ? significant(*row.max_difference, 2) : std::string("&ndash;");
  out += ok ? "<td>" + difference + "</td>" : "<td class=bad>" + escaped(row.status) + "</td>";
  for (const auto* error : {&row.mean_error, &row.max_error}) {
    out += "<td>" + (*error ? percent(**error) : std::string("&ndash;")) + "</td>";
  }
  out += "</tr>\n";
  if (!row.message.empty()) {
    out += "<tr><td></td><td></td><td class=message colspan=9>" + escaped(one_line(row.message)) +
           "</td></tr>\n";
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
  out +=
      "<h2>Figures</h2>\n<p>Differences are relative to the reference's largest distance; "
      "errors are held against a more accurate method.</p>\n"
      "<div class=scroll><table><thead><tr><th class=name>model</th><th>faces</th>"
      "<th class=name>solver</th><th>pre-factorisation ms</th><th>solve ms</th>"
      "<th>batch ms/source</th><th>factor MB</th><th>peak MB</th><th>max difference</th>"
      "<th>mean error</th><th>max error</th></tr>"
      "</thead><tbody>\n";
  for (const CompareRow& row : rows) out += table_row(row);
  return out + "</tbody></table></div>\n</body></html>\n";
}

}  // namespace geotherm::app
