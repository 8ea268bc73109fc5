// SPDX-License-Identifier: MIT
#include "bench/number_text.h"

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

}  // namespace geotherm::bench
