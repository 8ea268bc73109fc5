// SPDX-License-Identifier: MIT
#include "solver/linear/column_factor.h"

#include <cmath>

#include "solver/linear/supernodal_factor.h"

namespace geotherm {
namespace {

/// A fundamental supernode goes on while a column has exactly one entry more than the next and the
/// next is its parent: then the rest of both patterns is the same (Liu, Ng, Peyton 1993).
bool continues(const ColumnFactorData& data, Index column) {
  const std::int64_t begin = data.start[column];
  const std::int64_t count = data.start[column + 1] - begin;
  if (count == 0 || data.row[begin] != column + 1) return false;
  return count - 1 == data.start[column + 2] - data.start[column + 1];
}

}  // namespace

std::unique_ptr<TriangularFactor> make_column_factor(const ColumnFactorData& data) {
  const auto size = static_cast<Index>(data.inverse_pivot.size());
  auto structure = std::make_shared<SupernodalStructure>();
  auto values = std::make_shared<std::vector<double>>();
  for (Index first = 0; first < size;) {
    Index last = first;
    while (last + 1 < size && continues(data, last)) ++last;
    const Index width = last - first + 1;
    const std::int64_t under = data.start[last + 1] - data.start[last];
    structure->rows.insert(structure->rows.end(), data.row.begin() + data.start[last],
                           data.row.begin() + data.start[last + 1]);
    for (Index column = first; column <= last; ++column) {
      // L L^T from L D L^T; the part above the diagonal is never read.
      const double scale = std::sqrt(1 / data.inverse_pivot[column]);
      values->insert(values->end(), static_cast<std::size_t>(column - first), 0.0);
      values->push_back(scale);
      for (std::int64_t e = data.start[column]; e < data.start[column + 1]; ++e) {
        values->push_back(data.value[e] * scale);
      }
    }
    structure->first.push_back(last + 1);
    structure->row_start.push_back(static_cast<std::int64_t>(structure->rows.size()));
    structure->value_start.push_back(structure->value_start.back() + width * (width + under));
    first = last + 1;
  }
  structure->finish();
  values->shrink_to_fit();
  const double* numbers = values->data();
  return make_supernodal_factor(std::move(structure), numbers, std::move(values));
}

}  // namespace geotherm
