// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geotherm/error.h"

namespace geotherm {

/// Which backend may do what another one could not.
enum class Successor {
  kNone,        ///< none: input, options or the caller are the reason
  kAny,         ///< the next one
  kFactored,    ///< the next one that factorises
  kFactorless,  ///< the next one that holds no factor: the memory has ended
};

/// Who may follow after an error of a backend.
Successor successor_of(const Error& error);

/// What one backend made of the work. `successor` counts where that is an error.
template <class Value>
struct Trial {
  Result<Value> outcome;
  Successor successor = Successor::kNone;
};

/// The first of backend_names() that has not failed and may follow; empty where there is none.
std::string next_backend(std::span<const Fallback> failed, Successor successor);

/// "A failed: MESSAGE; B took over". Precondition: `failed` is not empty.
std::string takeover_text(std::span<const Fallback> failed, std::string_view by);

/// What all of them say, with the code and the hint of the last. Precondition: not empty.
Error joint_error(std::span<const Fallback> failed);

/// Tries `backend`, and where it fails the others in the order of backend_names(), as far as they
/// may follow, once each. `failed`: those that have failed before, added to. `attempt` takes a
/// backend's name and `failed`. With `strict` the first failure is the answer. Errors: kCancelled
/// and kBadInput, which are nobody's failure; otherwise joint_error() of all that failed.
template <class Value, class Attempt>
Result<Value> first_that_works(std::string backend, bool strict, std::vector<Fallback>& failed,
                               const Attempt& attempt) {
  for (;;) {
    Trial<Value> trial = attempt(backend, std::as_const(failed));
    if (trial.outcome) return std::move(trial.outcome);
    const Error& error = trial.outcome.error();
    const bool final = error.code == ErrorCode::kCancelled || error.code == ErrorCode::kBadInput;
    if (strict || final) return error;
    failed.push_back({backend, error});
    backend = next_backend(failed, trial.successor);
    if (backend.empty()) return joint_error(failed);
  }
}

}  // namespace geotherm
