// SPDX-License-Identifier: MIT
// For front_solves.inl, which includes it inside its namespace: products with the tiles that a
// front is stored in, eight rows by the columns of a block. With one right side the rows of a tile
// are the vector dimension. The last rows are read together with what follows them: into lanes that
// are never looked at (forward), or times zero (backward).

using Slab = Group<kSlab>;

/// Bytes ahead of the numbers in use that are asked for, into the second cache: panels are short,
/// and the processor guesses their ends badly (a quarter of the time at a million faces).
constexpr std::ptrdiff_t kAhead = 6144;

/// A tile in doubles, in memory: from there a processor multiplies with one number at no cost, from
/// within registers it has to be moved about, which compilers prefer unless kept from it.
template <int N, class T>
inline void widen_tile(const T* values, Index rows, double* out) {
#pragma GCC unroll 8
  for (int c = 0; c < N; ++c) Slab::load(values + c * rows).store(out + c * kSlab);
  __asm__ __volatile__("" : : "r"(out) : "memory");
}

/// sum += tile x.
template <int N, class T>
inline void add_tile(const T* values, Index rows, const Slab (&x)[N], Slab& sum) {
#pragma GCC unroll 8
  for (int c = 0; c < N; ++c) sum.add(Slab::load(values + c * rows), x[c]);
}

/// y += tile x for all tiles of these rows, or = where nothing is in y yet.
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
