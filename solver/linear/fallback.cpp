// SPDX-License-Identifier: MIT
#include "solver/linear/fallback.h"

#include <algorithm>

#include "solver/linear/backend.h"

namespace geotherm {
namespace {

constexpr std::string_view kCureAfter = "; ";  // between what is wrong and what to do

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

std::string without_backend(std::string_view message, std::string_view backend) {
  if (!backend.empty() && message.starts_with(backend)) {
    const std::string_view rest = message.substr(backend.size());
    if (rest.starts_with(": ")) return std::string(rest.substr(2));
    if (rest.starts_with(' ')) return std::string(rest.substr(1));
  }
  return std::string(message);
}

Fallback failure_of(std::string backend, Error error) {
  const std::string_view message = error.message;
  std::string reason = without_backend(message.substr(0, message.find(kCureAfter)), backend);
  return {std::move(backend), std::move(reason), std::move(error)};
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
  for (const Fallback& each : failed) text += each.backend + " failed: " + each.reason + "; ";
  return text + std::string(by) + " took over";
}

Error joint_error(std::span<const Fallback> failed) {
  const Error& last = failed.back().error;
  if (failed.size() == 1) return last;
  Error error{last.code, {}};
  for (const Fallback& each : failed) {
    error.message += (error.message.empty() ? "" : ", ") + each.backend + ": " + each.reason;
  }
  const std::size_t cure = last.message.find(kCureAfter);
  if (cure != std::string::npos) error.message += last.message.substr(cure);
  return error;
}

}  // namespace geotherm
