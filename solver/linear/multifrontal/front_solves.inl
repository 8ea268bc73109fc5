// SPDX-License-Identifier: MIT
// The passes of front_kernels.h over one front, compiled once for each instruction set: the
// including file sets GEOTHERM_KERNEL_NAMESPACE and its compiler flags. Both read the front's
// numbers as one stream, forward upwards and backward downwards.
#include <bit>
#include <cstdint>
#include <cstring>

#include "solver/core/processor.h"
#include "solver/linear/multifrontal/front_kernels.h"

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

#include "solver/linear/register_group.inl"

// Products with the tiles that a front is stored in, eight rows by the columns of a block. With one
// right side the rows of a tile are the vector dimension. The last rows are read together with what
// follows them: into lanes that are never used (forward), or multiplied by zero (backward).

using Slab = Group<kSlab>;

/// Distance in bytes by which numbers are prefetched into the second-level cache. Panels are short,
/// and the hardware prefetcher misses where they begin (a quarter of the time at a million faces).
constexpr std::ptrdiff_t kAhead = 6144;

/// Widens a tile of N columns, or of one less, which is then 0, to doubles in memory. A processor
/// broadcasts a factor from memory at no cost, but has to shuffle one out of a register; the empty
/// assembly statement keeps the compiler from doing the latter.
template <int N, class T>
inline void widen_tile(const T* values, Index columns, Index rows, double* out) {
#pragma GCC unroll 8
  for (int c = 0; c < N; ++c) {
    const bool present = c + 1 < N || columns == N;
    (present ? Slab::load(values + c * rows) : Slab::zero()).store(out + c * kSlab);
  }
  __asm__ __volatile__("" : : "r"(out) : "memory");
}

/// sum += tile x.
template <int N, class T>
inline void add_tile(const T* values, Index rows, const Slab (&x)[N], Slab& sum) {
#pragma GCC unroll 8
  for (int c = 0; c < N; ++c) sum.add(Slab::load(values + c * rows), x[c]);
}

/// y += tile x for all tiles of these rows; y = tile x where `fresh`.
template <int N, class T>
inline const T* add_rows(const T* values, Index rows, const Slab (&x)[N], double* y, bool fresh) {
  for (; rows > 0; rows -= kSlab, y += kSlab) {
    const Index here = rows < kSlab ? rows : kSlab;
    prefetch_beside(values, kAhead, kSlab * N);
    Slab sum = fresh ? Slab::zero() : Slab::load(y);
    if (here == kSlab) {
      add_tile<N>(values, kSlab, x, sum);
    } else {
      add_tile<N>(values, here, x, sum);
    }
    sum.store(y);
    values += here * N;
  }
  return values;
}

/// sum += tile^T z, from the last tile to the first; `values` is where they end.
template <int N, class T>
inline const T* add_columns(const T* values, Index rows, const double* z, Slab (&sum)[N]) {
  const Index whole = rows / kSlab;
  const Index last = rows - whole * kSlab;
  z += whole * kSlab;
  if (last > 0) {
    values -= last * N;
    const Slab at = Slab::load(z);
#pragma GCC unroll 8
    for (int c = 0; c < N; ++c) sum[c].add(Slab::load(values + c * last), at);
  }
  for (Index t = 0; t < whole; ++t) {
    values -= kSlab * N;
    prefetch_beside(values, -kAhead, kSlab * N);
    z -= kSlab;
    const Slab at = Slab::load(z);
#pragma GCC unroll 8
    for (int c = 0; c < N; ++c) sum[c].add(Slab::load(values + c * kSlab), at);
  }
  return values;
}

/// One block of N columns, or where K > 1 of one less: `columns`.
template <int K, int N, class T>
inline const T* forward_block(const T* values, Index columns, Index own_rows, Index below,
                              double* own, double* under, bool fresh) {
  if constexpr (K == 1) {
    Slab x[N];
#pragma GCC unroll 8
    for (int c = 0; c < N; ++c) x[c] = Slab::all(own[c]);
    // The first tile is D, whose product replaces x.
    values = add_rows<N>(values, N, x, own, true);
    values = add_rows<N>(values, own_rows - N, x, own + kSlab, false);
    return add_rows<N>(values, below, x, under, fresh);
  } else {
    // With several right sides these are the vector dimension, and the tile's numbers scalar
    // factors.
    Group<K> x[N];
#pragma GCC unroll 8
    for (int c = 0; c < N; ++c) {
      x[c] = c < columns ? Group<K>::load(own + c * K) : Group<K>::zero();
    }
    const auto add = [&](Index rows, double* y, bool empty) {
      while (rows > 0) {
        const Index here = rows < kSlab ? rows : kSlab;
        double factor[kSlab * N];
        widen_tile<N>(values, columns, here, factor);
        for (Index r = 0; r < here; ++r, y += K) {
          Group<K> sum = empty ? Group<K>::zero() : Group<K>::load(y);
#pragma GCC unroll 8
          for (int c = 0; c < N; ++c) sum.add(factor[c * kSlab + r], x[c]);
          sum.store(y);
        }
        values += here * columns;
        rows -= here;
      }
    };
    add(columns, own, true);
    add(own_rows - columns, own + kSlab * K, false);
    add(below, under, fresh);
    return values;
  }
}

/// lane c = the sum of the lanes of sum[c].
template <int N>
inline Slab sums_of_lanes(const Slab (&sum)[N]) {
  Slab all[kSlab];
#pragma GCC unroll 8
  for (int c = 0; c < kSlab; ++c) all[c] = c < N ? sum[c < N ? c : 0] : Slab::zero();
  return Slab::sums(all);
}

template <int K, int N, class T>
inline const T* backward_block(const T* values, Index columns, Index own_rows, Index below,
                               double* own, const double* under) {
  if constexpr (K == 1) {
    Slab sum[N];
#pragma GCC unroll 8
    for (int c = 0; c < N; ++c) sum[c] = Slab::zero();
    values = add_columns<N>(values, below, under, sum);
    values = add_columns<N>(values, own_rows, own, sum);
    const Slab solved = sums_of_lanes<N>(sum);
    if constexpr (N == kSlab) {
      solved.store(own);
    } else {
      double numbers[kSlab];
      solved.store(numbers);
#pragma GCC unroll 8
      for (int c = 0; c < N; ++c) own[c] = numbers[c];
    }
    return values;
  } else {
    Group<K> sum[N];
#pragma GCC unroll 8
    for (int c = 0; c < N; ++c) sum[c] = Group<K>::zero();
    const auto add = [&](Index rows, const double* z) {
      for (Index first = (rows - 1) / kSlab * kSlab; first >= 0 && rows > 0; first -= kSlab) {
        const Index here = rows - first < kSlab ? rows - first : kSlab;
        values -= here * columns;
        double factor[kSlab * N];
        widen_tile<N>(values, columns, here, factor);
        for (Index r = 0; r < here; ++r) {
          const Group<K> at = Group<K>::load(z + (first + r) * K);
#pragma GCC unroll 8
          for (int c = 0; c < N; ++c) sum[c].add(factor[c * kSlab + r], at);
        }
      }
    };
    add(below, under);
    add(own_rows, own);
#pragma GCC unroll 8
    for (int c = 0; c < N; ++c) {
      if (c < columns) sum[c].store(own + c * K);
    }
    return values;
  }
}

/// Calls body<N>() for the last columns of a front, 1 to 7 of them; with several right sides N may
/// be one more, since half as many functions take half as long to compile.
template <int K, class Body>
inline void with_columns(Index columns, const Body& body) {
  constexpr int kMore = K == 1 ? 0 : 1;
  switch (columns) {
    case 1:
      return body.template operator()<1 + kMore>();
    case 2:
      return body.template operator()<2>();
    case 3:
      return body.template operator()<3 + kMore>();
    case 4:
      return body.template operator()<4>();
    case 5:
      return body.template operator()<5 + kMore>();
    case 6:
      return body.template operator()<6>();
    default:
      return body.template operator()<7 + kMore>();
  }
}

template <int K, class T>
void forward(const StoredFront& front, double* x, bool fresh) {
  const auto* values = static_cast<const T*>(front.values);
  double* const under = x + static_cast<std::ptrdiff_t>(padded(front.width)) * K;
  Index column = 0;
  for (; column + kSlab <= front.width; column += kSlab) {
    values = forward_block<K, kSlab>(values, kSlab, front.width - column, front.below,
                                     x + static_cast<std::ptrdiff_t>(column) * K, under, fresh);
    fresh = false;
  }
  if (column == front.width) return;
  const Index last = front.width - column;
  with_columns<K>(last, [&]<int N>() {
    forward_block<K, N>(values, last, last, front.below,
                        x + static_cast<std::ptrdiff_t>(column) * K, under, fresh);
  });
}

/// to[i] = from[place[i]] for the rows below, 0 in the padding; whole slabs are stored, since wide
/// loads wait for narrow stores.
template <int K>
inline void gather(const double* from, const Index* place, Index count, double* to) {
  if constexpr (K == 1) {
    for (; count >= kSlab; count -= kSlab, place += kSlab, to += kSlab) {
      Slab::gather(from, place).store(to);
    }
    if (count == 0) return;
    Index last[kSlab];
    for (Index i = 0; i < kSlab; ++i) last[i] = place[i < count ? i : 0];
    Slab slab = Slab::gather(from, last);
    slab.keep_first(count);
    slab.store(to);
  } else {
    for (Index i = 0; i < count; ++i) {
      Group<K>::load(from + static_cast<std::ptrdiff_t>(place[i]) * K).store(to + i * K);
    }
  }
}

/// Usually the first number decides.
inline bool is_zero(const double* x, std::int64_t count) {
  for (std::int64_t i = 0; i < count; ++i) {
    if (x[i] != 0) return false;
  }
  return true;
}

template <int K, class T>
void backward(const StoredFront& front, double* x, const double* above, const Index* place) {
  double* const under = x + static_cast<std::ptrdiff_t>(padded(front.width)) * K;
  gather<K>(above, place, front.below, under);
  // Where the heat has underflowed, 0 stays 0 and no number of the factor is read.
  if (is_zero(under, std::int64_t{front.below} * K) && is_zero(x, std::int64_t{front.width} * K)) {
    return;
  }
  const Index last = front.width % kSlab;
  Index column = front.width - last;
  // Blocks of eight columns hold 8 (rows from their first column on) numbers each.
  const std::int64_t whole = column / kSlab;
  const std::int64_t rows = front.width + std::int64_t{front.below};
  const auto* values = static_cast<const T*>(front.values) +
                       kSlab * (whole * rows - kSlab * (whole * (whole - 1) / 2)) +
                       last * (last + std::int64_t{front.below});
  if (last > 0) {
    with_columns<K>(last, [&]<int N>() {
      values = backward_block<K, N>(values, last, last, front.below,
                                    x + static_cast<std::ptrdiff_t>(column) * K, under);
    });
  }
  while (column > 0) {
    column -= kSlab;
    values = backward_block<K, kSlab>(values, kSlab, front.width - column, front.below,
                                      x + static_cast<std::ptrdiff_t>(column) * K, under);
  }
}

template <int K>
void take(const double* left, const Index* place, Index count, double* x) {
  if constexpr (K == 1) {
    for (Index i = 0; i < count; ++i) x[place[i]] += left[i];
  } else {
    for (Index i = 0; i < count; ++i, left += K) {
      double* const at = x + static_cast<std::ptrdiff_t>(place[i]) * K;
      Group<K> sum = Group<K>::load(at);
      sum.add(1.0, Group<K>::load(left));
      sum.store(at);
    }
  }
}

template <int K, class T>
constexpr FrontSolves solves() {
  return {forward<K, T>, backward<K, T>, take<K>};
}

}  // namespace

extern const FrontSolves kFrontSolves[3][5];
const FrontSolves kFrontSolves[3][5] = {
    {solves<1, double>(), solves<2, double>(), solves<4, double>(), solves<8, double>(),
     solves<16, double>()},
    {solves<1, float>(), solves<2, float>(), solves<4, float>(), solves<8, float>(),
     solves<16, float>()},
    {solves<1, UpperHalf>(), solves<2, UpperHalf>(), solves<4, UpperHalf>(), solves<8, UpperHalf>(),
     solves<16, UpperHalf>()},
};

}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
