// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace geotherm::bench {

/// As printf. At most 511 characters.
__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...);

/// A number, a dash where there is none.
std::string number_text(double value, int decimals, const char* unit = "");

/// Three significant digits where that takes no more than two decimals.
std::string digits_text(double value);

/// Milliseconds as "0.45 ms", "12.3 ms", "1.25 s" or "161 s".
std::string time_text(double milliseconds);

/// 2^20 bytes as "12.3 MB" or "1.25 GB".
std::string memory_text(double megabytes);

/// Padded on the left.
std::string in_columns(const std::string& text, int width);

}  // namespace geotherm::bench
