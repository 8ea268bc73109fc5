// SPDX-License-Identifier: MIT
#include "app/announce.h"

#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "app/text.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

/// Work that ends sooner needs no word.
constexpr double kWorthAWord = 1;  // seconds
/// What is shorter tells little about the rest.
constexpr double kMeasured = 0.1;  // seconds

/// Holds the speed of all parts but the first, which does what is done once, too.
struct Estimate {
  Stopwatch watch;
  double begun_at = 0, begun_share = 0;  ///< seconds; where the first part ended
  bool told = false;

  /// Seconds that the rest will take; empty while nothing is known.
  std::optional<double> left(double share) {
    const double now = watch.milliseconds() / 1000;
    if (begun_share == 0) {
      begun_at = now;
      begun_share = share;
    }
    const double passed = now - begun_at;
    if (!(share > begun_share) || passed < kMeasured) return {};
    return passed * (1 - share) / (share - begun_share);
  }
};

}  // namespace

Progress with_estimate(Progress progress, const Announce& announce, std::string_view stage,
                       std::string title, std::string details) {
  if (!announce && !progress) return {};
  return [progress = std::move(progress), announce, stage, title = std::move(title),
          details = std::move(details),
          estimate = std::make_shared<Estimate>()](std::string_view at, double share) {
    if (announce && !estimate->told && at == stage && share > 0) {
      const std::optional<double> left = estimate->left(share);
      estimate->told = left.has_value();
      if (left && *left > kWorthAWord) {
        announce(title + ": about " +
                 seconds_in_words(estimate->watch.milliseconds() / 1000 + *left) +
                 (details.empty() ? "" : ", " + details));
      }
    }
    return report(progress, title, share);
  };
}

std::string bytes_in_words(double bytes) {
  constexpr double kStep = 1024;
  constexpr const char* kUnits[] = {"KB", "MB", "GB", "TB"};
  if (bytes < kStep) return counted(std::llround(bytes), "byte", "bytes");
  std::size_t unit = 0;
  constexpr double kFull = 999.5;  // three digits of it are the next unit
  for (bytes /= kStep; bytes >= kFull && unit + 1 < std::size(kUnits); bytes /= kStep) ++unit;
  return significant(bytes, 3) + " " + kUnits[unit];
}

std::string seconds_in_words(double seconds) {
  constexpr std::int64_t kMinute = 60, kHour = 3600;
  const std::int64_t whole = std::llround(seconds);
  if (seconds < 10) return significant(seconds, 2) + " s";
  if (whole < kMinute) return std::to_string(whole) + " s";
  if (whole < kHour) {
    return std::to_string(whole / kMinute) + " min " + std::to_string(whole % kMinute) + " s";
  }
  return grouped(whole / kHour) + " h " + std::to_string(whole % kHour / kMinute) + " min";
}

}  // namespace geotherm::app
