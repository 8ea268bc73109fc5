// SPDX-License-Identifier: MIT
#include "app/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/text.h"

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

}  // namespace geotherm::app
