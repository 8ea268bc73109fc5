// SPDX-License-Identifier: MIT
#include "solver/geometry/domain_operator.h"

namespace geotherm {

DomainOperator::DomainOperator(Index size, std::vector<Index> held) : held_(std::move(held)) {
  if (held_.empty()) return;
  is_held_.assign(static_cast<std::size_t>(size), 0);
  for (const Index i : held_) is_held_[i] = 1;
}

void DomainOperator::apply(std::span<const double> x, std::span<double> y) const {
  if (held_.empty()) return apply_free(x, y);
  std::vector<double> masked(x.begin(), x.end());
  for (const Index i : held_) masked[i] = 0;
  apply_free(masked, y);
  for (const Index i : held_) y[i] = x[i];
}

}  // namespace geotherm
