// SPDX-License-Identifier: MIT
#include "geotherm/options.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "solver/core/text.h"

namespace geotherm {
namespace {

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
  const std::string name = to_text(step.rule);
  return step.rule == TimeRule::kAbsolute ? name + ":" + number_text(step.absolute) : name;
}

std::string to_text(const Constraint& constraint) {
  const std::string name = to_text(constraint.mode);
  if (constraint.mode == ConstraintMode::kPenalty)
    return name + ":" + number_text(constraint.penalty);
  if (constraint.mode == ConstraintMode::kPinVertex && constraint.pin_vertex != kNoIndex) {
    return name + ":" + std::to_string(constraint.pin_vertex);
  }
  return name;
}

Result<TimeStep> parse_time_step(std::string_view text, double factor) {
  bool has_value = false;
  const auto [name, tail] = cut(text, has_value);
  const auto rule = parse<TimeRule>(name);
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
  const auto mode = parse<ConstraintMode>(name);
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

}  // namespace geotherm
