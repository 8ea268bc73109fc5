// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>

#include "geotherm/backend.h"

namespace geotherm::test {

/// Passes everything on to another operator and counts what it is asked for.
class CountingOperator final : public SymmetricOperator {
 public:
  explicit CountingOperator(std::shared_ptr<const SymmetricOperator> inner)
      : inner_(std::move(inner)) {}

  Index size() const override { return inner_->size(); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    ++applied;
    inner_->apply(x, y);
  }
  std::span<const double> diagonal() const override { return inner_->diagonal(); }
  Kernel kernel() const override { return inner_->kernel(); }
  std::uint64_t pattern() const override { return inner_->pattern(); }
  const LowerMatrix& assembled() const override {
    ++assemblies;
    return inner_->assembled();
  }

  mutable std::atomic<int> applied = 0, assemblies = 0;

 private:
  std::shared_ptr<const SymmetricOperator> inner_;
};

}  // namespace geotherm::test
