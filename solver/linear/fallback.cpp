// SPDX-License-Identifier: MIT
#include "solver/linear/fallback.h"

#include <algorithm>

#include "solver/linear/backend.h"

namespace geotherm {
namespace {

bool may_follow(const Backend& backend, FallbackPolicy policy) {
  switch (policy) {
    case FallbackPolicy::kNone:
      return false;
    case FallbackPolicy::kAny:
      return true;
    case FallbackPolicy::kFactored:
      return !backend.iterative();
    case FallbackPolicy::kFactorless:
      return backend.iterative();
  }
  return false;
}

}  // namespace

FallbackPolicy policy_after(const Error& error) {
  switch (error.code) {
    case ErrorCode::kNumericalFailure:
      return FallbackPolicy::kAny;
    case ErrorCode::kBudgetEnded:
      return FallbackPolicy::kFactored;
    case ErrorCode::kOutOfMemory:
      return FallbackPolicy::kFactorless;
    default:
      return FallbackPolicy::kNone;
  }
}

std::string next_backend(std::span<const Fallback> failed, FallbackPolicy policy) {
  for (const std::string& name : backend_names()) {
    if (std::ranges::count(failed, name, &Fallback::backend) > 0) continue;
    const auto backend = find_backend(name);
    if (backend && may_follow(**backend, policy)) return name;
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
