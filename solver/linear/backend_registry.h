// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geotherm/backend.h"
#include "geotherm/error.h"

namespace geotherm {

/// The multifrontal Cholesky factorisation of this project (Duff, Reid 1983), with factors stored
/// in narrow numbers. It needs no library beyond the standard one.
const Backend* native_backend();

/// Supernodal or simplicial Cholesky of SuiteSparse (Chen, Davis, Hager, Rajamanickam 2008).
/// Only in builds with GEOTHERM_WITH_CHOLMOD.
const Backend* cholmod_backend();

/// Simplicial LDL^T of Eigen: no dependency beyond Eigen.
const Backend* eigen_ldlt_backend();

/// Heat steps by the native factor, Poisson by PETSc. Where has_mpi_module().
const Backend* petsc_backend();

/// Conjugate gradients (Hestenes, Stiefel 1952), preconditioned by the diagonal, without a matrix;
/// where systems are large, by multigrid, whose coarser levels are made of the assembled matrix.
const Backend* cg_backend();

/// Which backends may take over from one that failed.
enum class FallbackPolicy {
  kNone,        ///< none: the input, the options or the caller are the cause
  kAny,         ///< the next one
  kFactored,    ///< the next one that factorises
  kFactorless,  ///< the next one that holds no factor, because memory ran out
};

/// The policy after this error of a backend.
FallbackPolicy policy_after(const Error& error);

/// The outcome of one backend; `policy` matters where it is an error.
template <class Value>
struct Attempt {
  Result<Value> outcome;
  FallbackPolicy policy = FallbackPolicy::kNone;
};

/// The first of backend_names() that has not failed and may follow; empty where there is none.
std::string next_backend(std::span<const Fallback> failed, FallbackPolicy policy);

/// "A failed: MESSAGE; B took over". Precondition: `failed` is not empty.
std::string takeover_text(std::span<const Fallback> failed, std::string_view by);

/// One error with the messages of all failures, the code and the hint of the last. Precondition:
/// not empty.
Error joint_error(std::span<const Fallback> failed);

/// Tries `backend`, and where it fails the others in the order of backend_names(), as far as they
/// may follow, once each. `failed`: those that have failed before, added to. `try_backend` takes a
/// backend's name and `failed`. With `strict` the first failure is the answer. Errors: kCancelled
/// and kBadInput, which are nobody's failure; otherwise joint_error() of all that failed.
template <class Value, class TryBackend>
Result<Value> first_that_works(std::string backend, bool strict, std::vector<Fallback>& failed,
                               const TryBackend& try_backend) {
  for (;;) {
    Attempt<Value> attempt = try_backend(backend, std::as_const(failed));
    if (attempt.outcome) return std::move(attempt.outcome);
    const Error& error = attempt.outcome.error();
    const bool final = error.code == ErrorCode::kCancelled || error.code == ErrorCode::kBadInput;
    if (strict || final) return error;
    failed.push_back({backend, error});
    backend = next_backend(failed, attempt.policy);
    if (backend.empty()) return joint_error(failed);
  }
}

}  // namespace geotherm
