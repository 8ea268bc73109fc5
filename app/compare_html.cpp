// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "app/answer_check.h"
#include "app/compare_report.h"
#include "app/markup.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1c2733; --soft: #66758a; --line: #dde3ea;
  --paper: #ffffff; --setup: #2a6fb0; --query: #e08a1e; --bad: #b3261e; }
@media (prefers-color-scheme: dark) { :root { --ink: #e5eaf0; --soft: #97a5b6; --line: #303a46;
  --paper: #14191f; --setup: #5aa0e0; --query: #f0a84a; --bad: #ff8a80; } }
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
svg text { font: 12px system-ui, sans-serif; fill: var(--ink); } svg .soft { fill: var(--soft); }
.setup { fill: var(--setup); } .query { fill: var(--query); } .grid { stroke: var(--line); }
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

/// Milliseconds to pixels, logarithmic, over whole decades that hold all figures.
class Scale {
 public:
  explicit Scale(std::span<const CompareRow> rows) {
    double least = 1, most = 10;
    for (const CompareRow& row : rows) {
      for (const auto* value : {&row.setup_ms, &row.query_ms_median}) {
        if (!*value || !(**value > 0) || !std::isfinite(**value)) continue;
        least = std::min(least, **value);
        most = std::max(most, **value);
      }
    }
    first_ = static_cast<int>(std::floor(std::log10(least)));
    last_ = static_cast<int>(std::ceil(std::log10(most)));
  }
  static constexpr double kLeft = 190, kRight = 840;
  int first() const { return first_; }
  int last() const { return last_; }
  double at_decade(int decade) const {
    return kLeft + (kRight - kLeft) * (decade - first_) / (last_ - first_);
  }
  double at(double ms) const {
    const double decades = std::log10(ms) - first_;
    return kLeft + (kRight - kLeft) * std::max(decades, 0.0) / (last_ - first_);
  }

 private:
  int first_, last_;
};

std::string number(double value) { return significant(value, 6); }

std::string bar(const Scale& scale, const std::optional<double>& ms, double y, const char* kind) {
  if (!ms || !(*ms > 0) || !std::isfinite(*ms)) return {};
  const double end = std::max(scale.at(*ms), Scale::kLeft + 1);
  return "<rect class=" + std::string(kind) + " x=" + number(Scale::kLeft) + " y=" + number(y) +
         " height=9 rx=1.5 width=" + number(end - Scale::kLeft) +
         " /><text class=soft x=" + number(end + 5) + " y=" + number(y + 8.5) + ">" +
         milliseconds(*ms) + "</text>\n";
}

std::string chart(std::span<const CompareRow> rows) {
  constexpr double kRow = 30, kTop = 26;
  const Scale scale(rows);
  const double height = kTop + kRow * static_cast<double>(rows.size()) + 6;
  std::string out = "<svg viewBox=\"0 0 900 " + number(height) + "\" role=img>\n";
  for (int decade = scale.first(); decade <= scale.last(); ++decade) {
    const std::string x = number(scale.at_decade(decade));
    const double ms = std::pow(10.0, decade);
    out.append("<line class=grid x1=").append(x).append(" x2=").append(x);
    out.append(" y1=18 y2=").append(number(height)).append(" /><text class=soft");
    out.append(" text-anchor=middle x=").append(x).append(" y=12>");
    out.append(decade < 0 ? significant(ms) : grouped(std::llround(ms))).append(" ms</text>\n");
  }
  double y = kTop;
  for (const CompareRow& row : rows) {
    out += "<text text-anchor=end x=" + number(Scale::kLeft - 10) + " y=" + number(y + 14) + ">" +
           escaped(one_line(row.model)) + " <tspan class=soft>" + escaped(row.name()) +
           "</tspan></text>\n" + bar(scale, row.setup_ms, y, "setup") +
           bar(scale, row.query_ms_median, y + 11, "query");
    y += kRow;
  }
  return out + "</svg>\n";
}

}  // namespace

std::string compare_html(const Machine& machine, std::span<const CompareRow> rows) {
  std::string out = "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>";
  out += "<meta name=viewport content=\"width=device-width, initial-scale=1\">";
  out += "<title>geotherm compare</title><style>" + std::string(kStyle) + "</style></head><body>\n";
  out += "<h1>Backends side by side</h1>\n<p>" + escaped(machine.cpu) + ", " +
         counted(machine.cores, "core", "cores") + ", BLAS " + escaped(machine.blas) + "</p>\n";
  out +=
      "<h2>Time</h2>\n<p>Pre-factorisation (blue) and median solve (orange), on a logarithmic "
      "scale.</p>\n" +
      chart(rows);
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
