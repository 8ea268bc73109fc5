// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "solver/core/progress.h"

// What long work says before and while it runs: how much it will write, need and take.
namespace geotherm::app {

/// Shows one sentence at once, beside the progress bar; empty: nobody wants to know.
using Announce = std::function<void(const std::string&)>;

/// A progress that announces, once, how long work will take whose reports of `stage` hold the true
/// share of what is done: after the first of them, where more than a second is left, so that what
/// fails at once leaves its one line alone. `title` stands before the bar instead of the stages,
/// `details` behind the time. The time counts from this call.
Progress with_estimate(Progress progress, const Announce& announce, std::string_view stage,
                       std::string title, std::string details = {});

/// Of what is counted in 2^20 bytes.
inline constexpr double kMegabyte = 1024.0 * 1024.0;

/// "3.2 GB", "264 MB", "512 bytes": of 10^3 bytes each, as disks are sold.
std::string bytes_in_words(double bytes);

/// "12 s", "3 min 20 s", "2 h 5 min".
std::string seconds_in_words(double seconds);

}  // namespace geotherm::app
