// SPDX-License-Identifier: MIT
#include "app/session/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "app/text/text.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

constexpr int kWidth = 30;
constexpr std::chrono::milliseconds kBetween{100};

}  // namespace

Progress ProgressBar::progress() {
  if (!shown_) return {};
  return [this](std::string_view stage, double share) {
    draw(stage, share);
    return true;
  };
}

Announce ProgressBar::announce() {
  return [this](const std::string& text) {
    clear();
    std::fprintf(stderr, "geotherm: %s\n", one_line(text).c_str());
    std::fflush(stderr);
  };
}

std::string ProgressBar::line(std::string_view stage, double share) {
  std::string text(stage);
  if (!(share >= 0)) return text + " ...";
  share = std::min(share, 1.0);
  const auto filled = static_cast<std::size_t>(std::lround(share * kWidth));
  text += "  [" + std::string(filled, '=') + std::string(kWidth - filled, ' ') + "] ";
  const std::string percent = std::to_string(std::lround(share * 100));
  return text + std::string(percent.size() < 3 ? 3 - percent.size() : 0, ' ') + percent + " %";
}

void ProgressBar::draw(std::string_view stage, double share) {
  const Clock::time_point now = Clock::now();
  if (now - last_ < kBetween) return;
  last_ = now;
  drawn_ = true;
  std::fprintf(stderr, "\r\033[K%s", one_line(line(stage, share)).c_str());
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!std::exchange(drawn_, false)) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

bool error_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

Progress with_prefix(Progress progress, std::string prefix) {
  if (!progress) return {};
  return [progress = std::move(progress), prefix = std::move(prefix)](std::string_view stage,
                                                                      double share) {
    return progress(prefix + std::string(stage), share);
  };
}

namespace {

/// Work that ends sooner needs no word.
constexpr double kWorthAWord = 1;  // seconds
/// Shorter parts do not predict the remaining time.
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
