// SPDX-License-Identifier: MIT
// The dense loops of front_kernels.h, compiled once for each instruction set: the including file
// sets GEOTHERM_KERNEL_NAMESPACE and its compiler flags.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/linear/multifrontal/front_kernels.h"

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

#include "solver/linear/register_group.inl"

using Slab = Group<kSlab>;
constexpr Index kTile = kSlab * kSlab;

/// The size of the tile of sums that stays in registers, in slabs of rows and in columns.
constexpr int kTileSlabs = kLanes == 8 ? 3 : 1;
constexpr int kTileColumns = kLanes == 8 ? 8 : kLanes == 4 ? 4 : 2;

/// c[i] -= a[i] b^T for i < Slabs: `depth` columns of slabs, in a and b one after the other; c[i]
/// points at eight columns of eight rows.
template <int Slabs>
inline void subtract_products(const double* const* a, const double* b, Index depth,
                              double* const* c) {
  for (int column = 0; column < kSlab; column += kTileColumns) {
    Slab sum[Slabs][kTileColumns];
    for (int i = 0; i < Slabs; ++i) {
      for (int j = 0; j < kTileColumns; ++j) sum[i][j] = Slab::load(c[i] + (column + j) * kSlab);
    }
    for (std::ptrdiff_t k = 0; k < depth; ++k) {
      Slab rows[Slabs];
      for (int i = 0; i < Slabs; ++i) rows[i] = Slab::load(a[i] + k * kSlab);
      for (int j = 0; j < kTileColumns; ++j) {
        const double factor = b[k * kSlab + column + j];
        for (int i = 0; i < Slabs; ++i) sum[i][j].subtract(factor, rows[i]);
      }
    }
    for (int i = 0; i < Slabs; ++i) {
      for (int j = 0; j < kTileColumns; ++j) sum[i][j].store(c[i] + (column + j) * kSlab);
    }
  }
}

/// The same for `count` slabs; a(i) and c(i) point at theirs.
template <class A, class C>
inline void subtract_all(Index count, const A& a, const double* b, Index depth, const C& c) {
  Index i = 0;
  for (; i + kTileSlabs <= count; i += kTileSlabs) {
    const double* from[kTileSlabs];
    double* to[kTileSlabs];
    for (int k = 0; k < kTileSlabs; ++k) {
      from[k] = a(i + k);
      to[k] = c(i + k);
    }
    subtract_products<kTileSlabs>(from, b, depth, to);
  }
  for (; i < count; ++i) {
    const double* from = a(i);
    double* to = c(i);
    subtract_products<1>(&from, b, depth, &to);
  }
}

/// Cholesky of a tile's first columns; zeros above the diagonal. Returns the column that fails.
inline Index factor_tile(double* tile, Index columns) {
  for (Index c = 0; c < columns; ++c) {
    double* column = tile + c * kSlab;
    const double pivot = column[c];
    if (!(pivot > 0) || !std::isfinite(pivot)) return c;
    Slab scaled = Slab::load(column);
    scaled.scale(1 / std::sqrt(pivot));
    scaled.store(column);
    for (Index r = 0; r < c; ++r) column[r] = 0;
    for (Index next = c + 1; next < columns; ++next) {
      Slab target = Slab::load(tile + next * kSlab);
      target.subtract(column[next], Slab::load(column));
      target.store(tile + next * kSlab);
    }
  }
  return kNoIndex;
}

/// The inverse of a lower triangular tile, by rows.
inline void invert_tile(const double* tile, Index columns, double* inverse) {
  for (Index r = 0; r < columns; ++r) {
    Slab row = Slab::zero();
    for (Index k = 0; k < r; ++k)
      row.subtract(tile[k * kSlab + r], Slab::load(inverse + k * kSlab));
    double values[kSlab];
    row.store(values);
    values[r] += 1;
    row = Slab::load(values);
    row.scale(1 / tile[r * kSlab + r]);
    row.store(inverse + r * kSlab);
  }
}

/// tile := tile D^T, a slab of L from one of A.
inline void divide_tile(double* tile, Index columns, const double* inverse) {
  Slab column[kSlab];
  for (Index k = 0; k < columns; ++k) column[k] = Slab::load(tile + k * kSlab);
  for (Index c = 0; c < columns; ++c) {
    Slab sum = Slab::zero();
    for (Index k = 0; k <= c; ++k) sum.add(inverse[c * kSlab + k], column[k]);
    sum.store(tile + c * kSlab);
  }
}

/// out := -tile D.
inline void tile_to_solve_with(const double* tile, Index columns, const double* inverse,
                               double* out) {
  Slab column[kSlab];
  for (Index k = 0; k < columns; ++k) column[k] = Slab::load(tile + k * kSlab);
  for (Index c = 0; c < columns; ++c) {
    Slab sum = Slab::zero();
    for (Index k = c; k < columns; ++k) sum.subtract(inverse[k * kSlab + c], column[k]);
    sum.store(out + c * kSlab);
  }
}

Index block_columns(Index width, Index block) { return std::min(kSlab, width - block * kSlab); }

/// The columns of a strip: three of its slabs and one more stay in the first-level cache while they
/// are multiplied with all others.
constexpr Index kStrip = 96;

Index factor_own(const FrontPanel& front, double* inverses) {
  const Index blocks = slabs(front.width);
  const std::int64_t size = front.slab_size();
  const auto slab = [&](Index i) { return front.values + i * size; };
  for (Index begin = 0; begin < blocks; begin += kStrip / kSlab) {
    const Index end = std::min<Index>(blocks, begin + kStrip / kSlab);
    for (Index b = begin; b < end; ++b) {
      const Index columns = block_columns(front.width, b);
      double* const diagonal = slab(b) + b * kTile;
      double* const inverse = inverses + b * kTile;
      subtract_all(
          blocks - b, [&](Index i) { return slab(b + i) + begin * kTile; }, slab(b) + begin * kTile,
          (b - begin) * kSlab, [&](Index i) { return slab(b + i) + b * kTile; });
      const Index failed = factor_tile(diagonal, columns);
      if (failed != kNoIndex) return b * kSlab + failed;
      invert_tile(diagonal, columns, inverse);
      for (Index i = b + 1; i < blocks; ++i) divide_tile(slab(i) + b * kTile, columns, inverse);
    }
    for (Index first = end; first < blocks; first += kTileSlabs) {
      const Index count = std::min<Index>(kTileSlabs, blocks - first);
      for (Index b = end; b < first + count; ++b) {
        const Index from = std::max<Index>(b - first, 0);
        subtract_all(
            count - from, [&](Index i) { return slab(first + from + i) + begin * kTile; },
            slab(b) + begin * kTile, (end - begin) * kSlab,
            [&](Index i) { return slab(first + from + i) + b * kTile; });
      }
    }
  }
  return kNoIndex;
}

void factor_below(const FrontPanel& front, const double* inverses, Index begin, Index end) {
  const std::int64_t size = front.slab_size();
  const Index blocks = slabs(front.width);
  double* const below = front.below_values();
  for (Index first = begin; first < end; first += kTileSlabs) {
    const Index count = std::min<Index>(kTileSlabs, end - first);
    for (Index strip = 0; strip < blocks; strip += kStrip / kSlab) {
      const Index strip_end = std::min<Index>(blocks, strip + kStrip / kSlab);
      const auto tile = [&](Index i, Index b) { return below + (first + i) * size + b * kTile; };
      for (Index b = strip; b < blocks; ++b) {
        const Index depth = (std::min(b, strip_end) - strip) * kSlab;
        subtract_all(
            count, [&](Index i) { return tile(i, strip); }, front.values + b * size + strip * kTile,
            depth, [&](Index i) { return tile(i, b); });
        if (b >= strip_end) continue;
        for (Index i = 0; i < count; ++i) {
          divide_tile(tile(i, b), block_columns(front.width, b), inverses + b * kTile);
        }
      }
    }
  }
}

void update(const FrontPanel& front, double* triangle, Index begin, Index end) {
  const std::int64_t size = front.slab_size();
  const double* const below = front.below_values();
  for (Index first = begin; first < end; first += kTileSlabs) {
    const Index count = std::min<Index>(kTileSlabs, end - first);
    for (Index strip = 0; strip < front.width; strip += kStrip) {
      const Index depth = std::min(kStrip, front.width - strip);
      const auto a = [&](Index i) { return below + i * size + strip * kSlab; };
      for (Index column = 0; column < first + count; ++column) {
        const Index from = first + std::max<Index>(column - first, 0);  // has this column
        subtract_all(
            first + count - from, [&](Index i) { return a(from + i); }, a(column), depth,
            [&](Index i) { return triangle + triangle_size(from + i) + column * kTile; });
      }
    }
  }
}

/// Writes tiles of numbers of type T.
template <class T>
class Writer {
 public:
  explicit Writer(void* to) : to_(static_cast<T*>(to)) {}

  void tile(const double* values, Index rows, Index columns) {
    for (Index c = 0; c < columns; ++c) {
      for (Index r = 0; r < rows; ++r) {
        const double value = values[c * kSlab + r];
        if (!(std::abs(value) < kLimit)) fits_ = false;  // also what is no number
        narrow(value, *to_++);
      }
    }
  }
  bool fits() const { return fits_; }

 private:
  static constexpr double kLimit = std::is_same_v<T, float>
                                       ? std::numeric_limits<float>::max()
                                       : std::numeric_limits<double>::max() / 2;
  T* to_;
  bool fits_ = true;
};

template <class T>
bool store_as(const FrontPanel& front, const double* inverses, void* to) {
  Writer<T> writer(to);
  const std::int64_t size = front.slab_size();
  double tile[kTile];
  for (Index b = 0; b < slabs(front.width); ++b) {
    const Index columns = block_columns(front.width, b);
    const double* inverse = inverses + b * kTile;
    for (Index c = 0; c < columns; ++c) {
      for (Index r = 0; r < columns; ++r) {
        tile[c * kSlab + r] = r < c ? 0 : inverse[r * kSlab + c];
      }
    }
    writer.tile(tile, columns, columns);
    const auto rest = [&](const double* slab, Index rows) {
      for (Index done = 0; done < rows; done += kSlab, slab += size) {
        tile_to_solve_with(slab + b * kTile, columns, inverse, tile);
        writer.tile(tile, std::min(kSlab, rows - done), columns);
      }
    };
    rest(front.values + (b + 1) * size, front.width - b * kSlab - columns);
    rest(front.below_values(), front.below);
  }
  return writer.fits();
}

bool store(const FrontPanel& front, const double* inverses, FactorStorage storage, void* to) {
  switch (storage) {
    case FactorStorage::kSingle:
      return store_as<float>(front, inverses, to);
    case FactorStorage::kWideExponent:
      return store_as<UpperHalf>(front, inverses, to);
    case FactorStorage::kFull:
      break;
  }
  return store_as<double>(front, inverses, to);
}

}  // namespace

extern const FrontKernels kFrontKernels;
const FrontKernels kFrontKernels = {factor_own, factor_below, update, store};

}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
