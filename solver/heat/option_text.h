// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/core/result.h"
#include "solver/heat/heat_options.h"

namespace geotherm {

/// The text form of each option, the same on the command line, in JSON, in scripts and panels.
/// parse(to_text(x)) == x for every x. Errors list the values there are.
std::string to_text(const TimeStep& step);          // mean-edge | mean-face-area | absolute:T
std::string to_text(const Constraint& constraint);  // pin-sources | pin-vertex[:V] | penalty:C ...
std::string to_text(HeatMode mode);
std::string to_text(BoundaryRule rule);
std::string to_text(LaplacianKind kind);
std::string to_text(Variant variant);
std::string to_text(Precision precision);

/// Every name of a kind, the default first.
std::vector<std::string> heat_mode_names();
std::vector<std::string> boundary_rule_names();
std::vector<std::string> laplacian_names();
std::vector<std::string> variant_names();
std::vector<std::string> precision_names();

/// `factor` (m) is no part of the time step's text; it is kept from the argument.
Result<TimeStep> parse_time_step(std::string_view text, double factor = 1.0);
Result<Constraint> parse_constraint(std::string_view text);
Result<HeatMode> parse_heat_mode(std::string_view text);
Result<BoundaryRule> parse_boundary_rule(std::string_view text);
Result<LaplacianKind> parse_laplacian(std::string_view text);
Result<Variant> parse_variant(std::string_view text);
Result<Precision> parse_precision(std::string_view text);

}  // namespace geotherm
