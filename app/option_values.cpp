// SPDX-License-Identifier: MIT
#include "app/option_values.h"

#include <cctype>
#include <cmath>
#include <utility>

#include "app/text.h"
#include "app/told.h"
#include "solver/core/number_text.h"
#include "solver/heat/option_text.h"
#include "solver/linear/backend.h"

namespace geotherm::app {
namespace {

constexpr int kMostThreads = 1024;
constexpr int kMostRefine = 6;
constexpr const char* kFree = "free";  // the memory limit that the machine sets

}  // namespace

Result<double> parse_time_factor(const std::string& text) {
  if (text.empty()) return 1.0;
  const auto factor = number_in<double>(text);
  if (factor && *factor > 0 && std::isfinite(*factor)) return *factor;
  return Error{ErrorCode::kBadInput, "'" + one_line(text) + "' is no time factor; it must be a " +
                                         "positive number, such as 1"};
}

Result<int> parse_threads(const std::string& text) {
  if (text.empty()) return 0;
  const auto threads = number_in<int>(text);
  if (threads && *threads >= 1 && *threads <= kMostThreads) return *threads;
  return Error{ErrorCode::kBadInput, "'" + one_line(text) +
                                         "' is no number of threads; give 1 to " +
                                         std::to_string(kMostThreads)};
}

Result<double> parse_memory_limit(const std::string& text) {
  if (text == kFree) return 0.0;
  constexpr std::pair<char, double> kUnits[] = {{'K', 1.0 / 1024}, {'M', 1.0}, {'G', 1024.0}};
  std::string number = text;
  double unit = 1;
  for (const auto& [letter, megabytes] : kUnits) {
    if (text.empty() || std::toupper(static_cast<unsigned char>(text.back())) != letter) continue;
    number.pop_back();
    unit = megabytes;
  }
  const auto size = number_in<double>(number);
  if (size && *size > 0 && *size * unit > 0 && std::isfinite(*size * unit)) return *size * unit;
  return Error{ErrorCode::kBadInput, "'" + one_line(text) +
                                         "' is no size; give a positive number of MB, or one with "
                                         "K, M or G, such as 800 or 4G, or free"};
}

std::string memory_limit_text(double megabytes) {
  return megabytes == 0 ? kFree : number_text(megabytes);
}

Result<int> parse_refine(const std::string& text) {
  const auto times = number_in<int>(text);
  if (times && *times >= 0 && *times <= kMostRefine) return *times;
  return Error{ErrorCode::kBadInput, "'" + one_line(text) + "' is no number of refinements; give " +
                                         "0 to " + std::to_string(kMostRefine) +
                                         ", each makes four times as many faces"};
}

Result<std::string> parse_backend(const std::string& text) {
  if (text.empty()) return backend_names().front();
  const auto backend = find_backend(text);
  if (!backend) return backend.error();
  return text;
}

Result<Constraint> parse_constraint_option(const std::string& text) {
  auto parsed = parse_constraint(text);
  if (parsed) return parsed;
  return with_hint(parsed.error(),
                   {"write penalty:VALUE with a positive number, such as penalty:1e6, or "
                    "pin-vertex:V with a vertex id"});
}

Result<TimeStep> parse_time_step_option(const std::string& text, double factor) {
  auto parsed = parse_time_step(text, factor);
  if (parsed) return parsed;
  return with_hint(parsed.error(),
                   {"write absolute:T with a positive number, such as absolute:0.01"});
}

}  // namespace geotherm::app
