// SPDX-License-Identifier: MIT
#include "geotherm/options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "solver/core/text.h"

namespace geotherm {
namespace {

template <class Enum, std::size_t N>
using Names = std::array<std::pair<Enum, std::string_view>, N>;

constexpr Names<TimeRule, 3> kTimeRules = {{{TimeRule::kMeanEdge, "mean-edge"},
                                            {TimeRule::kMeanFaceArea, "mean-face-area"},
                                            {TimeRule::kAbsolute, "absolute"}}};
constexpr Names<ConstraintMode, 5> kConstraints = {
    {{ConstraintMode::kPinSources, "pin-sources"},
     {ConstraintMode::kPinVertex, "pin-vertex"},
     {ConstraintMode::kPenalty, "penalty"},
     {ConstraintMode::kConserveEnergy, "conserve-energy"},
     {ConstraintMode::kPseudoInverse, "pseudo-inverse"}}};
constexpr Names<HeatMode, 3> kHeatModes = {
    {{HeatMode::kUnit, "unit"}, {HeatMode::kDiffuse, "diffuse"}, {HeatMode::kHold, "hold"}}};
constexpr Names<BoundaryRule, 3> kBoundaryRules = {{{BoundaryRule::kNeumann, "neumann"},
                                                    {BoundaryRule::kDirichlet, "dirichlet"},
                                                    {BoundaryRule::kAverage, "average"}}};
constexpr Names<LaplacianKind, 5> kLaplacians = {
    {{LaplacianKind::kAuto, "auto"},
     {LaplacianKind::kCotan, "cotan"},
     {LaplacianKind::kIntrinsicDelaunay, "intrinsic-delaunay"},
     {LaplacianKind::kTufted, "tufted"},
     {LaplacianKind::kRefined, "refined"}}};

constexpr Names<Variant, 2> kVariants = {
    {{Variant::kCorrected, "corrected"}, {Variant::kClassic, "classic"}}};
constexpr Names<Precision, 3> kPrecisions = {{{Precision::kCompact, "compact"},
                                              {Precision::kRefined, "refined"},
                                              {Precision::kFull, "full"}}};

template <class Enum, std::size_t N>
std::string name_of(const Names<Enum, N>& names, Enum value) {
  for (const auto& [each, name] : names) {
    if (each == value) return std::string(name);
  }
  return "?";
}

template <class Enum, std::size_t N>
std::vector<std::string> all_of(const Names<Enum, N>& names) {
  std::vector<std::string> all;
  for (const auto& [each, name] : names) all.emplace_back(name);
  return all;
}

template <class Enum, std::size_t N>
Result<Enum> value_of(const Names<Enum, N>& names, std::string_view what, std::string_view text) {
  std::string known;
  for (const auto& [value, name] : names) {
    if (name == text) return value;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  return Error{ErrorCode::kBadInput,
               "'" + std::string(text) + "' is no " + std::string(what),
               {"there are " + known}};
}

template <class Number>
Result<Number> number(std::string_view what, std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    return Error{ErrorCode::kBadInput,
                 "'" + std::string(text) + "' is no number for " + std::string(what)};
  }
  return value;
}

/// NAME or NAME:VALUE.
std::pair<std::string_view, std::string_view> cut(std::string_view text, bool& has_value) {
  const std::size_t colon = text.find(':');
  has_value = colon != std::string_view::npos;
  if (!has_value) return {text, {}};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

}  // namespace

std::string to_text(const TimeStep& step) {
  const std::string name = name_of(kTimeRules, step.rule);
  return step.rule == TimeRule::kAbsolute ? name + ":" + number_text(step.absolute) : name;
}

std::string to_text(const Constraint& constraint) {
  const std::string name = name_of(kConstraints, constraint.mode);
  if (constraint.mode == ConstraintMode::kPenalty)
    return name + ":" + number_text(constraint.penalty);
  if (constraint.mode == ConstraintMode::kPinVertex && constraint.pin_vertex != kNoIndex) {
    return name + ":" + std::to_string(constraint.pin_vertex);
  }
  return name;
}

std::string to_text(HeatMode mode) { return name_of(kHeatModes, mode); }
std::string to_text(BoundaryRule rule) { return name_of(kBoundaryRules, rule); }
std::string to_text(LaplacianKind kind) { return name_of(kLaplacians, kind); }
std::string to_text(Variant variant) { return name_of(kVariants, variant); }
std::string to_text(Precision precision) { return name_of(kPrecisions, precision); }

std::vector<std::string> heat_mode_names() { return all_of(kHeatModes); }
std::vector<std::string> boundary_rule_names() { return all_of(kBoundaryRules); }
std::vector<std::string> laplacian_names() { return all_of(kLaplacians); }
std::vector<std::string> variant_names() { return all_of(kVariants); }
std::vector<std::string> precision_names() { return all_of(kPrecisions); }

Result<TimeStep> parse_time_step(std::string_view text, double factor) {
  bool has_value = false;
  const auto [name, tail] = cut(text, has_value);
  const auto rule = value_of(kTimeRules, "time step", name);
  if (!rule) return rule.error();
  TimeStep step{*rule, factor, 0.0};
  if ((*rule == TimeRule::kAbsolute) != has_value) {
    return Error{ErrorCode::kBadInput,
                 "'" + std::string(text) + "' is no time step",
                 {"write mean-edge, mean-face-area or absolute:T, with T in model units squared"}};
  }
  if (!has_value) return step;
  const auto value = number<double>("the time step", tail);
  if (!value) return value.error();
  if (!(*value > 0) || !std::isfinite(*value)) {
    return Error{ErrorCode::kBadInput,
                 "the time step is " + std::string(tail),
                 {"it must be a positive number"}};
  }
  step.absolute = *value;
  return step;
}

Result<Constraint> parse_constraint(std::string_view text) {
  bool has_value = false;
  const auto [name, tail] = cut(text, has_value);
  const auto mode = value_of(kConstraints, "constraint mode", name);
  if (!mode) return mode.error();
  Constraint constraint;
  constraint.mode = *mode;
  if (!has_value) return constraint;
  if (*mode == ConstraintMode::kPenalty) {
    const auto value = number<double>("the penalty", tail);
    if (!value) return value.error();
    if (!(*value > 0) || !std::isfinite(*value)) {
      return Error{ErrorCode::kBadInput,
                   "the penalty is " + std::string(tail),
                   {"it must be a positive number"}};
    }
    constraint.penalty = *value;
    return constraint;
  }
  if (*mode == ConstraintMode::kPinVertex) {
    const auto vertex = number<Index>("the pinned vertex", tail);
    if (!vertex) return vertex.error();
    if (*vertex < 0) {
      return Error{ErrorCode::kBadInput,
                   "the pinned vertex is " + std::string(tail),
                   {"vertices are numbered from 0"}};
    }
    constraint.pin_vertex = *vertex;
    return constraint;
  }
  return Error{ErrorCode::kBadInput,
               "the constraint mode " + std::string(name) + " takes no value",
               {"write it without ':" + std::string(tail) + "'"}};
}

Result<HeatMode> parse_heat_mode(std::string_view text) {
  return value_of(kHeatModes, "heat mode", text);
}
Result<BoundaryRule> parse_boundary_rule(std::string_view text) {
  return value_of(kBoundaryRules, "boundary rule", text);
}
Result<LaplacianKind> parse_laplacian(std::string_view text) {
  return value_of(kLaplacians, "Laplacian", text);
}
Result<Variant> parse_variant(std::string_view text) {
  return value_of(kVariants, "variant", text);
}
Result<Precision> parse_precision(std::string_view text) {
  return value_of(kPrecisions, "precision", text);
}

}  // namespace geotherm
