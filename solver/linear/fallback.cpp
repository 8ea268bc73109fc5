// SPDX-License-Identifier: MIT
#include "solver/linear/fallback.h"

#include <algorithm>

#include "geotherm/backend.h"

namespace geotherm {
namespace {

bool may_follow(const Backend& backend, Successor successor) {
  switch (successor) {
    case Successor::kNone:
      return false;
    case Successor::kAny:
      return true;
    case Successor::kFactored:
      return !backend.iterative();
    case Successor::kFactorless:
      return backend.iterative();
  }
  return false;
}

}  // namespace

Successor successor_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::kNumericalFailure:
      return Successor::kAny;
    case ErrorCode::kBudgetEnded:
      return Successor::kFactored;
    case ErrorCode::kOutOfMemory:
      return Successor::kFactorless;
    default:
      return Successor::kNone;
  }
}

std::string next_backend(std::span<const Fallback> failed, Successor successor) {
  for (const std::string& name : backend_names()) {
    if (std::ranges::count(failed, name, &Fallback::backend) > 0) continue;
    const auto backend = find_backend(name);
    if (backend && may_follow(**backend, successor)) return name;
  }
  return {};
}

std::string takeover_text(std::span<const Fallback> failed, std::string_view by) {
  std::string text;
  for (const Fallback& each : failed)
    text += each.backend + " failed: " + each.error.message + "; ";
  return text + std::string(by) + " took over";
}

Error joint_error(std::span<const Fallback> failed) {
  const Error& last = failed.back().error;
  if (failed.size() == 1) return last;
  Error error{last.code, {}, last.hint};
  for (const Fallback& each : failed) {
    error.message += (error.message.empty() ? "" : ", ") + each.backend + ": " + each.error.message;
  }
  return error;
}

}  // namespace geotherm
