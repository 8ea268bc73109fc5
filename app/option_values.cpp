// SPDX-License-Identifier: MIT
#include "app/option_values.h"

#include <cmath>

#include "app/cure.h"
#include "app/text.h"
#include "solver/heat/option_text.h"
#include "solver/linear/backend.h"

namespace geotherm::app {
namespace {

constexpr int kMostThreads = 1024;

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

Result<std::string> parse_backend(const std::string& text) {
  if (text.empty()) return backend_names().front();
  const auto backend = find_backend(text);
  if (!backend) return backend.error();
  return text;
}

Result<LaplacianKind> parse_laplacian_option(const std::string& text) {
  auto kind = parse_laplacian(text);
  if (!kind || *kind != LaplacianKind::kTufted) return kind;
  return Error{ErrorCode::kNotAvailable,
               "tufted is not available in this version; there are auto, cotan, "
               "intrinsic-delaunay, and auto flips every edge that has two faces"};
}

Result<Constraint> parse_constraint_option(const std::string& text) {
  auto parsed = parse_constraint(text);
  if (parsed) return parsed;
  return with_cure(parsed.error(), text,
                   "write penalty:VALUE with a positive number, such as penalty:1e6, or "
                   "pin-vertex:V with a vertex id");
}

Result<TimeStep> parse_time_step_option(const std::string& text, double factor) {
  auto parsed = parse_time_step(text, factor);
  if (parsed) return parsed;
  return with_cure(parsed.error(), text,
                   "write absolute:T with a positive number, such as absolute:0.01");
}

}  // namespace geotherm::app
