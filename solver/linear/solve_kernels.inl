// SPDX-License-Identifier: MIT
// The loops of solve_kernels.h, compiled once for each instruction set: the including file sets
// GEOTHERM_KERNEL_NAMESPACE and its compiler flags. Plain loops over fixed sizes, which the
// compiler turns into vector code.
#include <bit>
#include <cstdint>

#include "solver/linear/solve_kernels.h"

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

#include "solver/linear/register_group.inl"

constexpr Index kTile = 4;  ///< rows or columns of the factor held in registers at a time

/// One right side: rows are the vector dimension, kRows at a time. The last rows of a column are
/// read together with what follows them in memory and multiplied by zero or left unused; panels
/// at the end of the factor, where nothing follows, go one row at a time.
constexpr Index kRows = 8;

inline void subtract_rows_plainly(const Panel& p, const double* own, Index r, double* x,
                                  std::ptrdiff_t stride) {
  double sum = 0;
  for (Index c = 0; c < p.width; ++c) {
    sum += p.values[static_cast<std::ptrdiff_t>(c) * p.height + r] * own[c];
  }
  x[p.rows[r - p.width] * stride] -= sum;
}

/// Rows r .. r + T kRows: what the panel's columns subtract from them.
template <int T>
inline void subtract_row_blocks(const Panel& p, const double* own, Index r, double* x,
                                std::ptrdiff_t stride) {
  Group<kRows> sum[T];
  for (int i = 0; i < T; ++i) sum[i] = Group<kRows>::zero();
  const double* values = p.values + r;
  for (Index c = 0; c < p.width; ++c, values += p.height) {
    for (int i = 0; i < T; ++i) sum[i].add(own[c], Group<kRows>::load(values + i * kRows));
  }
  double out[T * kRows];
  for (int i = 0; i < T; ++i) sum[i].store(out + i * kRows);
  const Index count = p.height - r < T * kRows ? p.height - r : T * kRows;
  for (Index i = 0; i < count; ++i) x[p.rows[r - p.width + i] * stride] -= out[i];
}

void panel_forward_one(const Panel& p, double* x, std::ptrdiff_t stride, double* own) {
  for (Index c = 0; c < p.width; ++c) own[c] = x[(p.first + c) * stride];
  for (Index c = 0; c < p.width; ++c) {
    const double* column = p.values + static_cast<std::ptrdiff_t>(c) * p.height;
    const double v = own[c] *= p.inverse_diagonal[c];
    for (Index r = c + 1; r < p.width; ++r) own[r] -= column[r] * v;
  }
  for (Index c = 0; c < p.width; ++c) x[(p.first + c) * stride] = own[c];
  Index r = p.width;
  if (p.padded) {
    for (; r + kRows < p.height; r += 2 * kRows) subtract_row_blocks<2>(p, own, r, x, stride);
    for (; r < p.height; r += kRows) subtract_row_blocks<1>(p, own, r, x, stride);
  } else {
    for (; r < p.height; ++r) subtract_rows_plainly(p, own, r, x, stride);
  }
}

/// Columns c .. c + T, given the values of all rows after them in `rows`, padded with zeros.
template <int T>
inline void solve_columns_one(const Panel& p, Index c, double* rows, double* x,
                              std::ptrdiff_t stride) {
  const double* column[T];
  double sum[T] = {};
  for (int i = 0; i < T; ++i) {
    column[i] = p.values + static_cast<std::ptrdiff_t>(c + i) * p.height;
  }
  Index r = c + T;
  if (p.padded) {
    Group<kRows> part[T];
    for (int i = 0; i < T; ++i) part[i] = Group<kRows>::zero();
    for (; r < p.height; r += kRows) {
      const Group<kRows> v = Group<kRows>::load(rows + r);
      for (int i = 0; i < T; ++i) part[i].add(Group<kRows>::load(column[i] + r), v);
    }
    for (int i = 0; i < T; ++i) sum[i] = part[i].sum();
  }
  for (; r < p.height; ++r) {
    for (int i = 0; i < T; ++i) sum[i] += column[i][r] * rows[r];
  }
  for (int i = T; i-- > 0;) {
    double v = rows[c + i] - sum[i];
    for (int j = i + 1; j < T; ++j) v -= column[i][c + j] * rows[c + j];
    v *= p.inverse_diagonal[c + i];
    x[(p.first + c + i) * stride] = rows[c + i] = v;
  }
}

void panel_backward_one(const Panel& p, double* x, std::ptrdiff_t stride, double* rows) {
  for (Index r = 0; r < p.width; ++r) rows[r] = x[(p.first + r) * stride];
  for (Index r = p.width; r < p.height; ++r) rows[r] = x[p.rows[r - p.width] * stride];
  for (Index r = 0; r < kRows; ++r) rows[p.height + r] = 0;
  Index c = p.width;
  for (; c >= kTile; c -= kTile) solve_columns_one<kTile>(p, c - kTile, rows, x, stride);
  if (c >= 2) solve_columns_one<2>(p, c -= 2, rows, x, stride);
  if (c > 0) solve_columns_one<1>(p, 0, rows, x, stride);
}

/// Several right sides: they are the vector dimension.

/// Rows r .. r + T below the supernode: what its columns subtract from them.
template <int K, int T>
inline void subtract_rows(const Panel& p, const double* own, Index r, double* x,
                          std::ptrdiff_t stride) {
  Group<K> sum[T];
  for (int i = 0; i < T; ++i) sum[i] = Group<K>::zero();
  const double* factor = p.values + r;
  for (Index c = 0; c < p.width; ++c, factor += p.height) {
    const Group<K> v = Group<K>::load(own + c * K);
    for (int i = 0; i < T; ++i) sum[i].add(factor[i], v);
  }
  for (int i = 0; i < T; ++i) {
    double* target = x + p.rows[r - p.width + i] * stride;
    Group<K> value = Group<K>::load(target);
    value.subtract(sum[i]);
    value.store(target);
  }
}

template <int K>
void panel_forward(const Panel& p, double* x, std::ptrdiff_t stride, double* own) {
  for (Index c = 0; c < p.width; ++c) {  // `own`: the supernode's own rows, packed
    Group<K>::load(x + (p.first + c) * stride).store(own + c * K);
  }
  for (Index c = 0; c < p.width; ++c) {
    const double* column = p.values + static_cast<std::ptrdiff_t>(c) * p.height;
    Group<K> v = Group<K>::load(own + c * K);
    v.scale(p.inverse_diagonal[c]);
    v.store(own + c * K);
    v.store(x + (p.first + c) * stride);
    for (Index r = c + 1; r < p.width; ++r) {
      Group<K> target = Group<K>::load(own + r * K);
      target.subtract(column[r], v);
      target.store(own + r * K);
    }
  }
  Index r = p.width;
  for (; r + kTile <= p.height; r += kTile) subtract_rows<K, kTile>(p, own, r, x, stride);
  for (; r < p.height; ++r) subtract_rows<K, 1>(p, own, r, x, stride);
}

/// Columns c .. c + T of the supernode, given the rows after them.
template <int K, int T>
inline void solve_columns(const Panel& p, Index c, double* rows, double* x, std::ptrdiff_t stride) {
  const double* factor = p.values + static_cast<std::ptrdiff_t>(c) * p.height;
  Group<K> sum[T];
  for (int i = 0; i < T; ++i) sum[i] = Group<K>::zero();
  for (Index r = c + T; r < p.height; ++r) {
    const Group<K> v = Group<K>::load(rows + r * K);
    for (int i = 0; i < T; ++i)
      sum[i].add(factor[i * static_cast<std::ptrdiff_t>(p.height) + r], v);
  }
  for (int i = T; i-- > 0;) {
    const double* column = factor + i * static_cast<std::ptrdiff_t>(p.height);
    Group<K> value = Group<K>::load(rows + (c + i) * K);
    value.subtract(sum[i]);
    for (int j = i + 1; j < T; ++j) {
      value.subtract(column[c + j], Group<K>::load(rows + (c + j) * K));
    }
    value.scale(p.inverse_diagonal[c + i]);
    value.store(rows + (c + i) * K);
    value.store(x + (p.first + c + i) * stride);
  }
}

template <int K>
void panel_backward(const Panel& p, double* x, std::ptrdiff_t stride, double* rows) {
  for (Index r = 0; r < p.height; ++r) {
    const Index row = r < p.width ? p.first + r : p.rows[r - p.width];
    Group<K>::load(x + row * stride).store(rows + r * K);
  }
  Index c = p.width;
  for (; c >= kTile; c -= kTile) solve_columns<K, kTile>(p, c - kTile, rows, x, stride);
  for (; c > 0; --c) solve_columns<K, 1>(p, c - 1, rows, x, stride);
}

template <int K>
constexpr SolveKernels kernels_for() {
  if constexpr (K == 1) {
    return {panel_forward_one, panel_backward_one};
  } else {
    return {panel_forward<K>, panel_backward<K>};
  }
}

}  // namespace

extern const SolveKernels kKernels[5];
const SolveKernels kKernels[5] = {kernels_for<1>(), kernels_for<2>(), kernels_for<4>(),
                                  kernels_for<8>(), kernels_for<16>()};

}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
