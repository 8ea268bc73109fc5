// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "geotherm/progress.h"

// What long work says before and while it runs: how much it will write, need and take.
namespace geotherm::app {

/// Shows one sentence at once, beside the progress bar; empty: nobody wants to know.
using Announce = std::function<void(const std::string&)>;

/// A progress that announces, once, how long work will take whose reports of `stage` hold the true
/// share of what is done: at the second of them or soon after, where more than a second is left.
/// The first part says nothing about the others, since it does what is done once (quality figures).
/// A failure at once leaves its one line alone. `title` stands before the bar instead of the
/// stages, `details` behind the time. The time counts from this call.
Progress with_estimate(Progress progress, const Announce& announce, std::string_view stage,
                       std::string title, std::string details = {});

/// Bytes of a MB, in all that the program prints, reads and writes.
inline constexpr double kMegabyte = 1024.0 * 1024.0;

/// "3.2 GB", "264 MB", "512 bytes": each 2^10 of the one below it, as in --memory-limit.
std::string bytes_in_words(double bytes);

/// "12 s", "3 min 20 s", "2 h 5 min".
std::string seconds_in_words(double seconds);

}  // namespace geotherm::app
