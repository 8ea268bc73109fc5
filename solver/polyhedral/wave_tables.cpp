// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_tables.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/polyhedral/wave_corners.h"
#include "solver/polyhedral/wave_sides.h"

namespace geotherm {
namespace {

/// Bits of a coordinate in a Morton number; three of them fill 63.
constexpr int kMortonBits = 21;

/// Minimum vertices or faces per thread.
constexpr std::int64_t kMinTableRowsPerThread = 1 << 13;

/// Vertices that faces use, along a space-filling curve.
std::vector<Index> morton_order(const IntrinsicSurface& base, int threads) {
  std::vector<Index> used;
  Vec3 low = Vec3::Constant(kUnreached), high = -low;
  for (Index v = 0; v < base.vertex_count(); ++v) {
    if (static_cast<std::size_t>(v) < base.kept->on_surface.size() && base.kept->on_surface[v] == 0)
      continue;
    used.push_back(v);
    low = low.cwiseMin(base.position(v));
    high = high.cwiseMax(base.position(v));
  }
  const Vec3 origin = low / 2;  // halves, because the extent may be beyond the doubles' range
  const double extent = (high / 2 - origin).maxCoeff();
  const double steps = extent > 0 ? ((1 << kMortonBits) - 1) / extent : 0.0;
  RawVector<std::pair<std::uint64_t, Index>> codes(used.size());
  constexpr int kMaxPieces = 8;  // merging takes a pass over the vertices for each
  const int pieces =
      piece_count(std::min(threads, kMaxPieces), std::ssize(used), kMinTableRowsPerThread);
  for_pieces(pieces, std::ssize(used), [&](int, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const Vec3 at = (base.position(used[i]) / 2 - origin) * steps;
      std::uint64_t code = 0;
      for (int c = 0; c < 3; ++c) code |= spread_bits(static_cast<std::uint64_t>(at(c))) << c;
      codes[i] = {code, used[i]};
    }
    std::sort(codes.begin() + begin, codes.begin() + end);
  });
  const auto begin_of = [&](int piece) {
    return codes.begin() + std::ssize(used) * piece / pieces;
  };
  for (int p = 1; p < pieces; ++p) {
    std::inplace_merge(codes.begin(), begin_of(p), begin_of(p + 1));
  }
  std::ranges::transform(codes, used.begin(), [](const auto& pair) { return pair.second; });
  return used;
}

/// The corner at which the smallest of the three rotations of a face begins.
int first_corner(const Face& face) {
  const auto from = [&face](int k) {
    return Face{face[k], face[next_corner(k)], face[previous_corner(k)]};
  };
  int best = 0;
  for (int k = 1; k < 3; ++k) {
    if (from(k) < from(best)) best = k;
  }
  return best;
}

Face ranks(const WaveTables& tables, const Face& face) {
  return {tables.rank_of_vertex[face[0]], tables.rank_of_vertex[face[1]],
          tables.rank_of_vertex[face[2]]};
}

/// Faces by their lowest vertex, then by the others.
RawVector<Index> face_order(const WaveTables& tables, const std::vector<Face>& faces, int threads) {
  RawVector<Face> sorted(faces.size());
  parallel_each(threads, std::ssize(faces), kMinTableRowsPerThread, [&](std::int64_t f) {
    sorted[f] = ranks(tables, faces[f]);
    std::ranges::sort(sorted[f]);
  });
  std::vector<std::uint32_t> start;
  const auto emit = [&](std::size_t f, const auto& put) {
    put(sorted[f][0], static_cast<Index>(f));
  };
  auto order = counting_sort<Index>(faces.size(), static_cast<std::size_t>(tables.vertex_count()),
                                    threads, emit, start);
  const auto before = [&sorted](Index f, Index g) {
    return sorted[f] != sorted[g] ? sorted[f] < sorted[g] : f < g;
  };
  parallel_each(threads, tables.vertex_count(), kMinTableRowsPerThread, [&](std::int64_t v) {
    std::sort(order.begin() + start[v], order.begin() + start[v + 1], before);
  });
  return order;
}

/// Numbers faces, and edges in the order in which faces meet them, each from its first corner on.
class FaceWriter {
 public:
  FaceWriter(const WaveSurface& surface, WaveTables& tables, int threads)
      : surface_(surface), mesh_(surface.base.intrinsic), tables_(tables), threads_(threads) {}

  void run() {
    tables_.intrinsic_face = face_order(tables_, mesh_.faces, threads_);
    const std::int64_t count = mesh_.face_count();
    tables_.rank_of_face.resize(static_cast<std::size_t>(count));
    tables_.faces.resize(static_cast<std::size_t>(count));
    parallel_each<Index>(threads_, count, kMinTableRowsPerThread,
                         [&](Index i) { tables_.rank_of_face[tables_.intrinsic_face[i]] = i; });
    const auto blocks = sums_of_blocks<Block>(
        threads_, count,
        [this](std::int64_t begin, std::int64_t end) { return write_faces(begin, end); });
    std::vector<Index> first_edge = {0};
    std::vector<SideLengths> lengths;
    for (const Block& block : blocks) {
      first_edge.push_back(first_edge.back() + block.edges);
      lengths.push_back(block.lengths);
    }
    sum_up(lengths, tables_);
    number_.resize(static_cast<std::size_t>(surface_.edge_count()));
    tables_.sides.resize(static_cast<std::size_t>(surface_.edge_count()));
    parallel_each(threads_, std::ssize(blocks), 1, [&](std::int64_t b) {
      number_edges(blocks[b].begin, blocks[b].end, first_edge[b]);
    });
    parallel_each<Index>(threads_, count, kMinTableRowsPerThread,
                         [this](Index i) { name_edges(i); });
    join_sides(surface_.base, threads_, tables_);
  }

 private:
  struct Block {
    std::int64_t begin = 0, end = 0;  ///< faces
    Index edges = 0;                  ///< that are met in them first
    SideLengths lengths{};
  };

  /// Whether an edge is met by this side before all others: in a lower face, or in this one
  /// earlier.
  bool is_first(Side side) const {
    const Index rank = tables_.rank_of_face[face_of(side)];
    const auto is_later = [&](Side other) {
      if (other == side) return true;
      const Index of_other = tables_.rank_of_face[face_of(other)];
      if (of_other != rank) return of_other > rank;
      const int start = first_corner(tables_.faces[rank].vertex);
      const auto place = [start](Side s) { return (corner_of(s) + 3 - start) % 3; };
      return place(other) > place(side);
    };
    if (mesh_.twin[side] != kNoSide) return is_later(mesh_.twin[side]);
    return std::ranges::all_of(surface_.sides_of(surface_.edge_of_side(side)), is_later);
  }

  Block write_faces(std::int64_t begin, std::int64_t end) {
    Block block{begin, end};
    for (std::int64_t i = begin; i < end; ++i) {
      const Index f = tables_.intrinsic_face[i];
      WaveFace& face = tables_.faces[i];
      face.vertex = ranks(tables_, mesh_.faces[f]);
      face.reversed = face.touching = 0;
      set_lengths(mesh_.lengths[f], face, block.lengths);
      for (int k = 0; k < 3; ++k) block.edges += is_first(3 * f + k) ? 1 : 0;
    }
    return block;
  }

  void number_edges(std::int64_t begin, std::int64_t end, Index next) {
    for (std::int64_t i = begin; i < end; ++i) {
      const int start = first_corner(tables_.faces[i].vertex);
      for (const int k : {start, next_corner(start), previous_corner(start)}) {
        const Side side = 3 * tables_.intrinsic_face[i] + k;
        if (is_first(side)) number_[surface_.edge_of_side(side)] = next++;
      }
    }
  }

  void name_edges(Index i) {
    const Side first = 3 * tables_.intrinsic_face[i];
    for (int k = 0; k < 3; ++k) {
      tables_.faces[i].edge[k] = number_[surface_.edge_of_side(first + k)];
    }
  }

  const WaveSurface& surface_;
  const IntrinsicMesh& mesh_;
  WaveTables& tables_;
  const int threads_;
  RawVector<Index> number_;  ///< E of the surface: number in the tables
};

template <class Values>
std::size_t bytes_of(const Values& values) {
  return values.capacity() * sizeof(values[0]);
}

}  // namespace

std::size_t WaveTables::bytes() const {
  return bytes_of(faces) + bytes_of(sides) + bytes_of(more) + bytes_of(rank_of_vertex) +
         bytes_of(vertex_of_rank) + bytes_of(rank_of_face) + bytes_of(intrinsic_face) +
         bytes_of(corner_start) + bytes_of(corners);
}

WaveTables build_wave_tables(const WaveSurface& surface, int threads) {
  WaveTables tables;
  tables.vertex_of_rank = morton_order(surface.base, threads);
  tables.rank_of_vertex.assign(static_cast<std::size_t>(surface.base.vertex_count()), kNoIndex);
  for (std::size_t r = 0; r < tables.vertex_of_rank.size(); ++r) {
    tables.rank_of_vertex[tables.vertex_of_rank[r]] = static_cast<Index>(r);
  }
  FaceWriter(surface, tables, threads).run();
  list_corners(tables, threads);
  mark_fans(tables, threads);
  mark_touching(tables, threads, surface.base);
  return tables;
}

}  // namespace geotherm
