// SPDX-License-Identifier: MIT
// The one place that knows which backends a build has.
#include <algorithm>
#include <mutex>
#include <utility>

#include "geotherm/backend.h"
#include "solver/core/text.h"
#include "solver/linear/backend_registry.h"
#include "solver/linear/mpi_module.h"

namespace geotherm {
namespace {

std::vector<const Backend*> those_of_the_build() {
  std::vector<const Backend*> all = {
      native_backend(),
#ifdef GEOTHERM_HAS_CHOLMOD
      cholmod_backend(),
#endif
      eigen_ldlt_backend(),
  };
  if (has_mpi_module()) all.push_back(petsc_backend());
  all.push_back(cg_backend());
  return all;
}

/// All backends: first those of the build, then those that AddedBackend has added.
class Registry {
 public:
  static Registry& instance() {
    static Registry registry;
    return registry;
  }

  std::vector<const Backend*> all() const {
    const std::lock_guard lock(mutex_);
    return all_;
  }

  void add(const Backend* backend) {
    const std::lock_guard lock(mutex_);
    all_.push_back(backend);
  }

  void remove(const Backend* backend) {
    const std::lock_guard lock(mutex_);
    std::erase(all_, backend);
  }

 private:
  mutable std::mutex mutex_;
  std::vector<const Backend*> all_ = those_of_the_build();
};

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

std::vector<std::string> backend_names() {
  std::vector<std::string> names;
  for (const Backend* backend : Registry::instance().all()) names.emplace_back(backend->name());
  return names;
}

Result<const Backend*> find_backend(std::string_view name) {
  for (const Backend* backend : Registry::instance().all()) {
    if (backend->name() == name) return backend;
  }
  if (name == "petsc") return mpi_module().error();  // it says what to install
  return Error{ErrorCode::kNotAvailable,
               "there is no backend '" + std::string(name) + "' in this build",
               {known_words(name, backend_names())}};
}

AddedBackend::AddedBackend(std::unique_ptr<const Backend> backend) : backend_(std::move(backend)) {
  Registry::instance().add(backend_.get());
}

AddedBackend::~AddedBackend() { Registry::instance().remove(backend_.get()); }

Result<Eigen::MatrixXd> Factorization::inverse_entries(std::span<const Index> rows) const {
  constexpr Eigen::Index kColumnsAtOnce = 16;
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd entries(count, count);
  for (Eigen::Index first = 0; first < count; first += kColumnsAtOnce) {
    const Eigen::Index columns = std::min(kColumnsAtOnce, count - first);
    Block x = Block::Zero(size(), columns);
    for (Eigen::Index c = 0; c < columns; ++c) x(rows[first + c], c) = 1;
    const auto solved =
        solve(x, rows.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(columns)));
    if (!solved) return solved.error();
    for (Eigen::Index r = 0; r < count; ++r) {
      entries.block(r, first, 1, columns) = x.row(rows[static_cast<std::size_t>(r)]);
    }
  }
  return entries;
}

Result<std::shared_ptr<const Analysis>> Analysis::follow(const NodeOrder& /*order*/,
                                                         const SymmetricPattern& /*eliminated*/,
                                                         int /*threads*/) const {
  return Error{ErrorCode::kNotAvailable, "the backend keeps no order for another pattern"};
}

Result<std::shared_ptr<const Analysis>> Analysis::update(const NodeOrder& /*order*/,
                                                         const LowerPattern& /*lower*/,
                                                         const EarlierRows& /*rows*/,
                                                         int /*threads*/) const {
  return Error{ErrorCode::kNotAvailable, "the backend keeps no order for another pattern"};
}

Result<void> check_pattern(const SymmetricOperator& matrix, std::uint64_t analysed, Index size) {
  if (matrix.pattern() == analysed) return {};
  return Error{ErrorCode::kBadInput,
               "the matrix of size " + std::to_string(matrix.size()) +
                   " does not have the pattern that was analysed (size " + std::to_string(size) +
                   ")",
               {"analyse its own pattern first"}};
}

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
