// SPDX-License-Identifier: MIT
// The loops of solve_kernels.h, compiled once for each instruction set: the including file sets
// GEOTHERM_KERNEL_NAMESPACE and its compiler flags. Plain loops over fixed sizes, which the
// compiler turns into vector code.
#include "solver/linear/solve_kernels.h"

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 8;  ///< doubles a register holds
#elif defined(__AVX2__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif
constexpr Index kTile = 4;  ///< rows or columns of the factor held in registers at a time

/// One right side: rows are the vector dimension.
void panel_forward_one(const Panel& p, double* x, std::ptrdiff_t stride, double* below) {
  const Index under = p.height - p.width;
  for (Index r = 0; r < under; ++r) below[r] = 0;
  Index c = 0;
  for (; c + kTile <= p.width; c += kTile) {
    double v[kTile];
    const double* column[kTile];
    for (Index i = 0; i < kTile; ++i) {
      column[i] = p.values + static_cast<std::ptrdiff_t>(c + i) * p.height;
      v[i] = x[(p.first + c + i) * stride];
      for (Index j = 0; j < i; ++j) v[i] -= column[j][c + i] * v[j];
      v[i] /= column[i][c + i];
      x[(p.first + c + i) * stride] = v[i];
    }
    for (Index r = c + kTile; r < p.width; ++r) {
      double sum = 0;
      for (Index i = 0; i < kTile; ++i) sum += column[i][r] * v[i];
      x[(p.first + r) * stride] -= sum;
    }
    const double *a = column[0] + p.width, *b = column[1] + p.width, *d = column[2] + p.width,
                 *e = column[3] + p.width;
#pragma GCC ivdep
    for (Index r = 0; r < under; ++r) {
      below[r] += a[r] * v[0] + b[r] * v[1] + (d[r] * v[2] + e[r] * v[3]);
    }
  }
  for (; c < p.width; ++c) {
    const double* column = p.values + static_cast<std::ptrdiff_t>(c) * p.height;
    const double v = x[(p.first + c) * stride] / column[c];
    x[(p.first + c) * stride] = v;
    for (Index r = c + 1; r < p.width; ++r) x[(p.first + r) * stride] -= column[r] * v;
    const double* a = column + p.width;
#pragma GCC ivdep
    for (Index r = 0; r < under; ++r) below[r] += a[r] * v;
  }
  for (Index r = 0; r < under; ++r) x[p.rows[r] * stride] -= below[r];
}

void panel_backward_one(const Panel& p, double* x, std::ptrdiff_t stride, double* gathered) {
  const Index under = p.height - p.width;
  for (Index r = 0; r < under; ++r) gathered[r] = x[p.rows[r] * stride];
  Index c = p.width;
  while (c > 0) {
    const Index tile = c >= kTile ? kTile : c;
    c -= tile;
    double sum[kTile] = {0, 0, 0, 0};
    const double* column[kTile];
    for (Index i = 0; i < kTile; ++i) {
      column[i] = p.values + static_cast<std::ptrdiff_t>(i < tile ? c + i : c) * p.height;
    }
    const double *a = column[0] + p.width, *b = column[1] + p.width, *d = column[2] + p.width,
                 *e = column[3] + p.width;
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    if (tile == kTile) {
#pragma omp simd reduction(+ : s0, s1, s2, s3)
      for (Index r = 0; r < under; ++r) {
        const double g = gathered[r];
        s0 += a[r] * g;
        s1 += b[r] * g;
        s2 += d[r] * g;
        s3 += e[r] * g;
      }
      sum[0] = s0, sum[1] = s1, sum[2] = s2, sum[3] = s3;
    } else {
      for (Index i = 0; i < tile; ++i) {
        const double* v = column[i] + p.width;
        double s = 0;
#pragma omp simd reduction(+ : s)
        for (Index r = 0; r < under; ++r) s += v[r] * gathered[r];
        sum[i] = s;
      }
    }
    for (Index r = c + tile; r < p.width; ++r) {
      const double g = x[(p.first + r) * stride];
      for (Index i = 0; i < tile; ++i) sum[i] += column[i][r] * g;
    }
    for (Index i = tile; i-- > 0;) {
      double v = x[(p.first + c + i) * stride] - sum[i];
      for (Index j = i + 1; j < tile; ++j) v -= column[i][c + j] * x[(p.first + c + j) * stride];
      x[(p.first + c + i) * stride] = v / column[i][c + i];
    }
  }
}

/// Several right sides: they are the vector dimension. A group of K doubles is held in registers
/// of the instruction set's width.
template <int K>
class Group {
  static constexpr int kWidth = K < kLanes ? K : kLanes;
  static constexpr int kCount = K / kWidth;
  typedef double Lane __attribute__((vector_size(8 * kWidth)));
  typedef double Loose __attribute__((vector_size(8 * kWidth), aligned(8), may_alias));

 public:
  static Group load(const double* from) {
    Group out;
    for (int i = 0; i < kCount; ++i) out.lane_[i] = reinterpret_cast<const Loose*>(from)[i];
    return out;
  }
  static Group zero() {
    Group out;
    for (int i = 0; i < kCount; ++i) out.lane_[i] = Lane{};
    return out;
  }
  void store(double* to) const {
    for (int i = 0; i < kCount; ++i) reinterpret_cast<Loose*>(to)[i] = lane_[i];
  }
  void add(double factor, const Group& other) {
    for (int i = 0; i < kCount; ++i) lane_[i] += factor * other.lane_[i];
  }
  void subtract(double factor, const Group& other) {
    for (int i = 0; i < kCount; ++i) lane_[i] -= factor * other.lane_[i];
  }
  void subtract(const Group& other) {
    for (int i = 0; i < kCount; ++i) lane_[i] -= other.lane_[i];
  }
  void scale(double factor) {
    for (int i = 0; i < kCount; ++i) lane_[i] *= factor;
  }

 private:
  Lane lane_[kCount];
};

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
    v.scale(1 / column[c]);
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
    value.scale(1 / column[c + i]);
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
void column_forward(const Column& column, double* x, std::ptrdiff_t stride) {
  const Group<K> own = Group<K>::load(x + column.index * stride);
  for (Index e = 0; e < column.count; ++e) {
    double* target = x + column.rows[e] * stride;
    Group<K> value = Group<K>::load(target);
    value.subtract(column.values[e], own);
    value.store(target);
  }
}

template <int K>
void column_backward(const Column& column, double* x, std::ptrdiff_t stride) {
  Group<K> own = Group<K>::load(x + column.index * stride);
  own.scale(column.inverse_pivot);
  for (Index e = 0; e < column.count; ++e) {
    own.subtract(column.values[e], Group<K>::load(x + column.rows[e] * stride));
  }
  own.store(x + column.index * stride);
}

template <int K>
constexpr SolveKernels kernels_for() {
  if constexpr (K == 1) {
    return {panel_forward_one, panel_backward_one, column_forward<1>, column_backward<1>};
  } else {
    return {panel_forward<K>, panel_backward<K>, column_forward<K>, column_backward<K>};
  }
}

}  // namespace

extern const SolveKernels kKernels[5];
const SolveKernels kKernels[5] = {kernels_for<1>(), kernels_for<2>(), kernels_for<4>(),
                                  kernels_for<8>(), kernels_for<16>()};

}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
