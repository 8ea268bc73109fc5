// SPDX-License-Identifier: MIT
// The loops of solve_kernels.h, compiled once for each instruction set: the including file sets
// GEOTHERM_KERNEL_NAMESPACE and its compiler flags. Plain loops over fixed sizes, which the
// compiler turns into vector code.
#include "solver/linear/solve_kernels.h"

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

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

/// Several right sides: they are the vector dimension.
template <int K>
void panel_forward(const Panel& p, double* x, std::ptrdiff_t stride, double* scratch) {
  double* own = scratch;  // the supernode's own rows, packed
  for (Index c = 0; c < p.width; ++c) {
    double* row = x + (p.first + c) * stride;
    const double* column = p.values + static_cast<std::ptrdiff_t>(c) * p.height;
    const double inverse = 1 / column[c];
    for (int k = 0; k < K; ++k) own[c * K + k] = row[k] *= inverse;
    for (Index r = c + 1; r < p.width; ++r) {
      double* target = x + (p.first + r) * stride;
      const double factor = column[r];
      for (int k = 0; k < K; ++k) target[k] -= factor * own[c * K + k];
    }
  }
  for (Index r = p.width; r < p.height; r += kTile) {
    const Index tile = p.height - r < kTile ? p.height - r : kTile;
    double sum[kTile][K] = {};
    if (tile == kTile) {
      for (Index c = 0; c < p.width; ++c) {
        const double* factor = p.values + static_cast<std::ptrdiff_t>(c) * p.height + r;
        for (Index i = 0; i < kTile; ++i) {
          for (int k = 0; k < K; ++k) sum[i][k] += factor[i] * own[c * K + k];
        }
      }
    } else {
      for (Index c = 0; c < p.width; ++c) {
        const double* factor = p.values + static_cast<std::ptrdiff_t>(c) * p.height + r;
        for (Index i = 0; i < tile; ++i) {
          for (int k = 0; k < K; ++k) sum[i][k] += factor[i] * own[c * K + k];
        }
      }
    }
    for (Index i = 0; i < tile; ++i) {
      double* target = x + p.rows[r - p.width + i] * stride;
      for (int k = 0; k < K; ++k) target[k] -= sum[i][k];
    }
  }
}

template <int K>
void panel_backward(const Panel& p, double* x, std::ptrdiff_t stride, double* scratch) {
  for (Index r = 0; r < p.height; ++r) {
    const double* row = x + (r < p.width ? p.first + r : p.rows[r - p.width]) * stride;
    for (int k = 0; k < K; ++k) scratch[r * K + k] = row[k];
  }
  for (Index c = p.width; c > 0;) {
    const Index tile = c >= kTile ? kTile : c;
    c -= tile;
    double sum[kTile][K] = {};
    const double* factor = p.values + static_cast<std::ptrdiff_t>(c) * p.height;
    if (tile == kTile) {
      for (Index r = c + tile; r < p.height; ++r) {
        for (Index i = 0; i < kTile; ++i) {
          const double f = factor[static_cast<std::ptrdiff_t>(i) * p.height + r];
          for (int k = 0; k < K; ++k) sum[i][k] += f * scratch[r * K + k];
        }
      }
    } else {
      for (Index r = c + tile; r < p.height; ++r) {
        for (Index i = 0; i < tile; ++i) {
          const double f = factor[static_cast<std::ptrdiff_t>(i) * p.height + r];
          for (int k = 0; k < K; ++k) sum[i][k] += f * scratch[r * K + k];
        }
      }
    }
    for (Index i = tile; i-- > 0;) {
      const double* column = factor + static_cast<std::ptrdiff_t>(i) * p.height;
      double* own = scratch + (c + i) * K;
      for (int k = 0; k < K; ++k) own[k] -= sum[i][k];
      for (Index j = i + 1; j < tile; ++j) {
        for (int k = 0; k < K; ++k) own[k] -= column[c + j] * scratch[(c + j) * K + k];
      }
      const double inverse = 1 / column[c + i];
      double* row = x + (p.first + c + i) * stride;
      for (int k = 0; k < K; ++k) row[k] = own[k] *= inverse;
    }
  }
}

template <int K>
void column_forward(const Column& column, double* x, std::ptrdiff_t stride) {
  double own[K];
  for (int k = 0; k < K; ++k) own[k] = x[column.index * stride + k];
  for (Index e = 0; e < column.count; ++e) {
    double* target = x + column.rows[e] * stride;
    const double factor = column.values[e];
    for (int k = 0; k < K; ++k) target[k] -= factor * own[k];
  }
}

template <int K>
void column_backward(const Column& column, double* x, std::ptrdiff_t stride) {
  double own[K];
  double* row = x + column.index * stride;
  for (int k = 0; k < K; ++k) own[k] = row[k] * column.inverse_pivot;
  for (Index e = 0; e < column.count; ++e) {
    const double* source = x + column.rows[e] * stride;
    const double factor = column.values[e];
    for (int k = 0; k < K; ++k) own[k] -= factor * source[k];
  }
  for (int k = 0; k < K; ++k) row[k] = own[k];
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
