// SPDX-License-Identifier: MIT
#include "solver/linear/column_factor.h"

#include <cmath>

#include "solver/linear/supernodal_factor.h"

namespace geotherm {
namespace {

/// The last column of the fundamental supernode that begins with `column`. It goes on while a
/// column has exactly one entry more than the next and the next is its parent: then the rest of
/// both patterns is the same (Liu, Ng, Peyton 1993).
template <class Below, class Parent>
Index last_of_supernode(Index column, Index size, const Below& below, const Parent& parent) {
  for (; column + 1 < size; ++column) {
    const std::int64_t count = below(column);
    if (count == 0 || parent(column) != column + 1 || count - 1 != below(column + 1)) break;
  }
  return column;
}

}  // namespace

std::unique_ptr<TriangularFactor> make_column_factor(const ColumnFactorData& data) {
  const auto size = static_cast<Index>(data.inverse_pivot.size());
  auto structure = std::make_shared<SupernodalStructure>();
  auto values = std::make_shared<std::vector<double>>();
  const auto below = [&data](Index c) { return data.start[c + 1] - data.start[c]; };
  const auto parent = [&data](Index c) { return data.row[data.start[c]]; };
  for (Index first = 0; first < size;) {
    const Index last = last_of_supernode(first, size, below, parent);
    const Index width = last - first + 1;
    structure->rows.insert(structure->rows.end(), data.row.begin() + data.start[last],
                           data.row.begin() + data.start[last + 1]);
    structure->first.push_back(last + 1);
    structure->row_start.push_back(static_cast<std::int64_t>(structure->rows.size()));
    structure->value_start.push_back(structure->value_start.back() + width * (width + below(last)));
    first = last + 1;
  }
  values->reserve(static_cast<std::size_t>(structure->value_start.back()));
  for (std::size_t s = 0; s + 1 < structure->first.size(); ++s) {
    for (Index column = structure->first[s]; column < structure->first[s + 1]; ++column) {
      // L L^T from L D L^T; the part above the diagonal is never read.
      const double scale = std::sqrt(1 / data.inverse_pivot[column]);
      values->insert(values->end(), static_cast<std::size_t>(column - structure->first[s]), 0.0);
      values->push_back(scale);
      for (std::int64_t e = data.start[column]; e < data.start[column + 1]; ++e) {
        values->push_back(data.value[e] * scale);
      }
    }
  }
  structure->finish();
  const double* numbers = values->data();
  return make_supernodal_factor(std::move(structure), numbers, std::move(values));
}

std::int64_t column_factor_bytes(const ColumnCounts& counts) {
  const auto size = static_cast<Index>(counts.below.size());
  std::int64_t numbers = size;  // the inverse diagonal
  for (Index first = 0; first < size;) {
    const Index last = last_of_supernode(
        first, size, [&counts](Index c) { return std::int64_t{counts.below[c]}; },
        [&counts](Index c) { return counts.parent[c]; });
    const std::int64_t width = last - first + 1;
    numbers += width * (width + counts.below[last]);
    first = last + 1;
  }
  return numbers * static_cast<std::int64_t>(sizeof(double));
}

}  // namespace geotherm
