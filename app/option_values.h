// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "solver/core/result.h"
#include "solver/heat/heat_options.h"

// Values of the method's options from their texts, the same on the command line and in scripts; the
// rest is in solver/heat/option_text.h. Errors: kBadInput or kNotAvailable, with the text, what is
// expected and the cure.
namespace geotherm::app {

Result<double> parse_time_factor(const std::string& text);  // empty: 1
Result<int> parse_refine(const std::string& text);
Result<int> parse_threads(const std::string& text);          // empty: 0, all cores
Result<double> parse_memory_limit(const std::string& text);  // in 2^20 bytes; "free": 0
std::string memory_limit_text(double megabytes);
Result<std::string> parse_backend(const std::string& text);  // empty: the default
Result<Constraint> parse_constraint_option(const std::string& text);
Result<TimeStep> parse_time_step_option(const std::string& text, double factor);

}  // namespace geotherm::app
