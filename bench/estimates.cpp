// SPDX-License-Identifier: MIT
#include "bench/estimates.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace geotherm::bench {

std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string number_text(double value, int decimals, const char* unit) {
  return std::isfinite(value) ? format("%.*f%s", decimals, value, unit) : "-";
}

std::string digits_text(double value) {
  return number_text(value, value < 10 ? 2 : value < 100 ? 1 : 0);
}

std::string time_text(double milliseconds) {
  if (!std::isfinite(milliseconds)) return "-";
  return milliseconds < 1000 ? digits_text(milliseconds) + " ms"
                             : digits_text(milliseconds / 1000) + " s";
}

std::string memory_text(double megabytes) {
  if (!std::isfinite(megabytes)) return "-";
  return megabytes < 1024 ? digits_text(megabytes) + " MB" : digits_text(megabytes / 1024) + " GB";
}

std::string in_columns(const std::string& text, int width) {
  return format("%*s", width, text.c_str());
}

namespace {

/// A power of the number of faces, and the range in which a slope between two sizes is believed:
/// small meshes are measured with much noise, and nothing here grows slower than its input.
struct Power {
  double usual, least, most;
};
constexpr Power kSetup = {1.5, 1.0, 2.0};  // nested dissection's operations (George 1973)
constexpr Power kQuery = {1.5, 1.0, 2.0};  // of conjugate gradients; factors grow slower
constexpr Power kMemory = {1.15, 1.0, 1.5};

double power_between(double small, double large, double ratio, const Power& power) {
  const double slope = std::log(large / small) / std::log(ratio);
  return std::isfinite(slope) ? std::clamp(slope, power.least, power.most) : power.usual;
}

}  // namespace

void Estimates::learn(Index faces, const Figures& figures) {
  if (!std::isfinite(figures.setup_ms) || !std::isfinite(figures.query_ms)) return;
  const double peak = std::isfinite(figures.peak_mb) ? figures.peak_mb : 0;
  known_[figures.name].push_back(
      {static_cast<double>(faces), {figures.setup_ms, figures.query_ms, peak}});
}

std::optional<Estimate> Estimates::of(const std::string& name, Index faces) const {
  const auto found = known_.find(name);
  if (found == known_.end()) return {};
  const auto by_size = [](const Known& a, const Known& b) { return a.faces < b.faces; };
  const Known& last = *std::ranges::max_element(found->second, by_size);
  const Known* before = nullptr;
  for (const Known& known : found->second) {
    if (known.faces * 1.5 > last.faces) continue;
    if (before == nullptr || before->faces < known.faces) before = &known;
  }
  const double ratio = static_cast<double>(faces) / last.faces;
  const auto grown = [&](double Estimate::*figure, const Power& power) {
    const double large = last.figures.*figure;
    const double exponent = before == nullptr ? power.usual
                                              : power_between(before->figures.*figure, large,
                                                              last.faces / before->faces, power);
    return large * std::pow(ratio, exponent);
  };
  return Estimate{grown(&Estimate::setup_ms, kSetup), grown(&Estimate::query_ms, kQuery),
                  grown(&Estimate::peak_mb, kMemory)};
}

std::string reason_not_to_run(const Estimate& estimate, const Limits& limits, bool may_be_slow) {
  // The first query after a set-up, and those of one turn.
  const double cost = estimate.setup_ms + (1 + kQueriesPerTurn) * estimate.query_ms;
  if (cost > limits.most_ms && !may_be_slow) {
    return "not run: would take about " + time_text(estimate.setup_ms) + " of set-up and " +
           time_text(estimate.query_ms) + " a query; a row may take " + time_text(limits.most_ms);
  }
  if (estimate.peak_mb > limits.most_memory_mb) {
    return "not run: would take about " + memory_text(estimate.peak_mb) + " of memory; " +
           memory_text(limits.most_memory_mb) + " are free for it";
  }
  return {};
}

}  // namespace geotherm::bench
