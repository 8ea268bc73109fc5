// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "geotherm/types.h"

namespace geotherm {

/// A number for each component of a surface, or one for all of them.
class PerComponent {
 public:
  PerComponent(double all) : values_{all} {}  // NOLINT: a number is one for all
  /// Precondition: not empty. Numbers that are all the same become one.
  explicit PerComponent(std::vector<double> values) : values_(std::move(values)) {
    if (std::ranges::adjacent_find(values_, std::not_equal_to{}) == values_.end()) {
      values_.resize(1);
    }
  }

  double of(Index component) const {
    return values_.size() == 1 ? values_[0] : values_[static_cast<std::size_t>(component)];
  }
  /// f of each.
  template <class F>
  PerComponent map(const F& f) const {
    std::vector<double> out;
    for (const double value : values_) out.push_back(f(value));
    return PerComponent(std::move(out));
  }
  bool same() const { return values_.size() == 1; }
  double least() const { return std::ranges::min(values_); }
  double most() const { return std::ranges::max(values_); }

  bool operator==(const PerComponent&) const = default;

 private:
  std::vector<double> values_;
};

}  // namespace geotherm
