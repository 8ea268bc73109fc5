// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <thread>
#include <vector>

#include "geotherm/accuracy.h"
#include "geotherm/heat_method.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// The distances that a heat answer will be held against, solved on a thread of their own while the
/// heat method is set up: from the moment that its triangulation stands, which both share. They
/// fill the time in which analysis and factorisation leave a core idle.
class ReferenceBeside {
 public:
  ReferenceBeside(std::shared_ptr<const TriangleMesh> mesh, MethodKind kind,
                  std::vector<SourceSet> sets)
      : mesh_(std::move(mesh)), kind_(kind), sets_(std::move(sets)) {}

  /// Whether a core and memory are there for it, and it takes long enough.
  static bool is_worth_it(const TriangleMesh& mesh, int threads);

  /// For HeatMethod::build(); to be called while this object lives.
  TriangulationReady starter();

  /// Whether it was started.
  bool has_begun() const { return thread_.joinable(); }

  /// Waits for the end. Precondition: has_begun(). Errors: those of solve_reference(), kCancelled.
  Result<ReferenceAnswers> wait(const Progress& progress);

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  MethodKind kind_;
  std::vector<SourceSet> sets_;
  std::atomic<double> share_{0};  ///< of the work that is done
  std::promise<Result<ReferenceAnswers>> answers_;
  std::future<Result<ReferenceAnswers>> done_ = answers_.get_future();
  std::jthread thread_;  ///< last: it uses all of the above, and ends before they do
};

}  // namespace geotherm::app
