// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/picture/chart.h"
#include "bench/estimates.h"
#include "bench/report.h"

namespace geotherm::bench {
namespace {

using app::chart::Box;
using app::chart::Mark;
using app::chart::Panel;
using app::chart::Series;

constexpr double kPage[2] = {1140, 870};
constexpr double kLeft = 84, kAcross = 560, kTop = 168, kDown = 370;
constexpr double kBox[2] = {350, 268};

/// What a panel shows of the figures.
struct Shown {
  const char* title;
  double Figures::*figure;
  std::string (*tick)(double);
  bool share;  ///< labels are ours of the baseline's
};

std::string tick_digits(double value) { return format("%.12g", value); }
std::string time_tick(double ms) {
  return ms < 1000 ? tick_digits(ms) + " ms" : tick_digits(ms / 1000) + " s";
}
std::string memory_tick(double mb) { return tick_digits(mb) + " MB"; }
std::string faces_tick(double faces) {
  return faces < 1e6 ? tick_digits(faces / 1e3) + "k" : tick_digits(faces / 1e6) + "M";
}

constexpr Shown kPanels[] = {
    {"Set-up: from a mesh in memory to the first query", &Figures::setup_ms, time_tick, false},
    {"Query: all distances from one source", &Figures::query_ms, time_tick, false},
    {"Batch: one of 16 sources that are asked for together", &Figures::batch_ms_per_source,
     time_tick, false},
    {"Memory of both factors", &Figures::factor_mb, memory_tick, true},
};

/// The irregular mesh with the most sizes; any mesh where none is irregular.
std::string joined_mesh(const std::vector<SolveGroup>& groups) {
  std::string best;
  int most = -1;
  std::map<std::string, int> sizes;
  for (const SolveGroup& group : groups) {
    const int count = (sizes[group.mesh] += group.regular ? 1 : 1000);
    if (count <= most) continue;
    most = count;
    best = group.mesh;
  }
  return best;
}

class Chart {
 public:
  explicit Chart(const BenchRun& run) : run_(run), joined_(joined_mesh(run.groups)) {
    constexpr std::array kMarks = {Mark::kRing, Mark::kTriangle, Mark::kSquare};
    for (const SolveGroup& group : run.groups) {
      if (group.failure.empty() && !marks_.contains(group.mesh)) {
        const bool joined = group.mesh == joined_;
        marks_[group.mesh] = joined ? Mark::kDot : kMarks[beside_++ % kMarks.size()];
        meshes_.emplace_back(group.mesh, group.regular);
      }
      for (const Figures& figures : group.figures) {
        const auto known = std::ranges::find(names_, figures.name);
        // Other methods have no factors: they are another comparison.
        if (known == names_.end() && figures.heat_method) names_.push_back(figures.name);
      }
    }
  }

  std::string svg() const {
    std::string body =
        app::chart::text(kLeft - 50, 44, "start", "head",
                         "The heat method by backend, beside a plain use of CHOLMOD") +
        app::chart::text(kLeft - 50, 68, "start", "soft", where_measured()) + legend();
    for (std::size_t q = 0; q < std::size(kPanels); ++q) {
      const Box box{kLeft + kAcross * static_cast<double>(q % 2),
                    kTop + kDown * static_cast<double>(q / 2), kBox[0], kBox[1]};
      body += panel_svg(panel(kPanels[q]), box);
    }
    return app::chart::page(kPage[0], kPage[1], body);
  }

 private:
  std::string where_measured() const {
    return run_.machine.cpu + format(", %d threads (the baseline 1). ", run_.threads) +
           "At the ends: the baseline's time over the backend's on that mesh; of memory, the "
           "backend's share of the baseline's.";
  }

  std::string kind_of(std::size_t place) const {
    if (names_[place] == kBaseline) return "base";
    return "k" + std::to_string(place % 6);
  }

  /// Colours first, then what the marks mean.
  std::string legend() const {
    constexpr double kY = 106, kSample = 30, kLetter = 7.4, kSpace = 34;
    std::string out;
    double x = kLeft - 50;
    const auto entry = [&](const std::string& kind, const std::string& sample,
                           const std::string& text) {
      out += app::chart::group(kind, sample) +
             app::chart::text(x + kSample + 6, kY, "start", "", text);
      x += kSample + kSpace + kLetter * static_cast<double>(text.size());
    };
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::string sample =
          app::chart::sample(x, kY - 4, kSample) + mark_svg(Mark::kDot, x + kSample / 2, kY - 4);
      entry(kind_of(i), sample, names_[i]);
    }
    for (const auto& [mesh, regular] : meshes_) {
      entry("any", mark_svg(marks_.at(mesh), x + kSample - 6, kY - 4),
            mesh + (regular ? " (regular)" : ""));
    }
    return out;
  }

  Panel panel(const Shown& quantity) const {
    Panel out{quantity.title, "faces", faces_tick, quantity.tick, {}};
    for (std::size_t i = 0; i < names_.size(); ++i) {
      Series series;
      series.kind = kind_of(i);
      for (const SolveGroup& group : run_.groups) add(group, names_[i], quantity, series);
      std::ranges::sort(series.joined, {}, &app::chart::Point::x);
      out.series.push_back(std::move(series));
    }
    return out;
  }

  void add(const SolveGroup& group, const std::string& name, const Shown& quantity,
           Series& series) const {
    const auto figures = std::ranges::find(group.figures, name, &Figures::name);
    if (figures == group.figures.end()) return;
    const double value = (*figures).*quantity.figure;
    if (!(value > 0) || !std::isfinite(value)) return;
    const bool joined = group.mesh == joined_;
    (joined ? series.joined : series.beside)
        .push_back({static_cast<double>(group.faces), value, marks_.at(group.mesh)});
    if (joined) series.end_label = end_label(name, value, group.baseline(), quantity);
  }

  static std::string end_label(const std::string& name, double ours, const Figures* baseline,
                               const Shown& quantity) {
    if (name == kBaseline || baseline == nullptr) return name;
    const double theirs = (*baseline).*quantity.figure;
    if (!(theirs > 0) || !std::isfinite(theirs)) return name;
    if (quantity.share) return name + format(" %.0f %%", 100 * ours / theirs);
    const double ratio = theirs / ours;
    if (ratio < 0.95) return name + format(" %.2g\u00d7", ratio);
    return name + format(" %.*f\u00d7", ratio < 9.95 ? 1 : 0, ratio);
  }

  const BenchRun& run_;
  std::string joined_;
  std::map<std::string, Mark> marks_;
  std::size_t beside_ = 0;
  std::vector<std::pair<std::string, bool>> meshes_;  ///< and whether they are regular
  std::vector<std::string> names_;                    ///< of the colours
};

}  // namespace

std::string performance_chart(const BenchRun& run) { return Chart(run).svg(); }

}  // namespace geotherm::bench
