// SPDX-License-Identifier: MIT
#include "solver/geometry/operator_mesh.h"

#include <algorithm>
#include <vector>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/sorting.h"

namespace geotherm {

SymmetricPattern surface_pattern(const IntrinsicMesh& mesh, const CornerTable& corners,
                                 std::span<const Index> used, std::span<const Index> local,
                                 int threads) {
  const auto add_neighbors = [&](Index i, std::vector<Index>& row) {
    const Index vertex = used[i];
    const auto begin = static_cast<std::ptrdiff_t>(row.size());
    for (const Side corner : corners.at(vertex)) {
      const Face& face = mesh.faces[face_of(corner)];
      const int k = corner_of(corner);
      row.push_back(local[face[next_corner(k)]]);
      const Side ending = corner - k + previous_corner(k);
      if (mesh.twin[ending] == kNoSide) row.push_back(local[face[previous_corner(k)]]);
    }
    short_sort(row.data() + begin, row.data() + row.size());
    // Two edges may join the same vertices, and one a vertex with itself.
    const auto end = std::unique(row.begin() + begin, row.end());
    row.erase(std::remove(row.begin() + begin, end, i), row.end());
  };
  SymmetricPattern pattern;
  list_rows(static_cast<Index>(used.size()), threads, add_neighbors, pattern.start,
            pattern.neighbor);
  return pattern;
}

namespace {

/// Minimum faces or vertices per thread.
constexpr std::int64_t kMinItemsPerThread = 1 << 13;

/// Rows of a range: some 0.1 ms of work for a pass over its faces, several times what it takes to
/// start a thread. Eliminated one after the other, they are a patch or a few: 2 to 5 % of the faces
/// cross.
constexpr Index kRowsOfRange = 8192;
/// The maximum number of ranges: more would make more faces cross without keeping more cores busy.
constexpr Index kMaxRanges = 32;

Index range_count(Index size) { return std::clamp<Index>(size / kRowsOfRange, 1, kMaxRanges); }

/// Brings the faces that cross from one range of rows to another to the end; all stay in order
/// otherwise. Gives the ranges.
std::vector<FaceRange> part_by_ranges(const RawVector<Face>& faces, Index size,
                                      RawVector<Index>& sorted) {
  const Index count = range_count(size);
  std::vector<FaceRange> ranges;
  RawVector<Index> parted, crossing;
  parted.reserve(sorted.size());
  std::size_t next = 0;
  for (Index r = 0; r < count; ++r) {
    FaceRange range{static_cast<Index>(std::int64_t{size} * r / count),
                    static_cast<Index>(std::int64_t{size} * (r + 1) / count),
                    static_cast<Index>(parted.size()), 0};
    for (; next < sorted.size(); ++next) {
      const auto [low, high] = std::ranges::minmax(faces[sorted[next]]);
      if (low >= range.end_row) break;
      (high < range.end_row ? parted : crossing).push_back(sorted[next]);
    }
    range.end_face = static_cast<Index>(parted.size());
    ranges.push_back(range);
  }
  parted.insert(parted.end(), crossing.begin(), crossing.end());
  sorted = std::move(parted);
  return ranges;
}

/// Builds the parts of an OperatorMesh one after the other, each by all threads.
class Builder {
 public:
  Builder(const IntrinsicMesh& mesh, std::span<const Index> local, std::span<const Index> order,
          int threads, OperatorMesh& out)
      : mesh_(mesh), threads_(threads), size_(order.size()), out_(out) {
    const std::vector<Index> position = inverse_permutation(order, threads);
    RawVector<Index> name(local.size());
    for_each(name.size(), [&](std::size_t v) {
      name[v] = local[v] == kNoIndex ? kNoIndex : position[local[v]];
    });
    renamed_.resize(mesh.faces.size());
    for_each(renamed_.size(), [&](std::size_t f) {
      for (int k = 0; k < 3; ++k) renamed_[f][k] = name[mesh.faces[f][k]];
    });
  }

  /// Sorts the faces by their earliest vertex: a walk over them then stays in a small window of
  /// vertices.
  void sort_faces() {
    out_.intrinsic_face = sorted_by_key(renamed_.size(), size_, threads_, [this](std::size_t f) {
      return std::min({renamed_[f][0], renamed_[f][1], renamed_[f][2]});
    });
    out_.ranges = part_by_ranges(renamed_, static_cast<Index>(size_), out_.intrinsic_face);
    out_.crossing = out_.ranges.back().end_face;
    out_.faces.resize(renamed_.size());
    out_.layout.resize(renamed_.size());
    for_each(renamed_.size(), [&](std::size_t f) {
      const Index source = out_.intrinsic_face[f];
      out_.faces[f] = renamed_[source];
      out_.layout[f] = lay_out(mesh_.lengths[source]);
    });
    out_.corners = CornerTable(static_cast<Index>(size_), out_.faces, threads_);
  }

  /// Sums the contributions of the faces at each vertex, in their order.
  void add_up_faces() {
    out_.mass.resize(size_);
    out_.stiffness_diagonal.resize(size_);
    for_each(size_, [&](std::size_t i) {
      double mass = 0, diagonal = 0;
      for (const Side corner : out_.corners.at(static_cast<Index>(i))) {
        const Index f = face_of(corner);
        const int k = corner_of(corner), before = previous_corner(k);
        const FaceLayout& p = out_.layout[f];
        const std::array<double, 3> weight = stiffness(p);
        mass += p.base * p.height / 6;
        // A side may join a vertex with itself.
        if (out_.faces[f][next_corner(k)] != out_.faces[f][k]) diagonal -= weight[k];
        if (out_.faces[f][before] != out_.faces[f][k]) diagonal -= weight[before];
      }
      out_.mass[i] = mass;
      out_.stiffness_diagonal[i] = diagonal;
    });
  }

  /// `parts`: components of the pattern, which the elimination order numbers anew.
  void name_components(const Components& parts, std::span<const Index> order) {
    out_.components.count = parts.count;
    out_.components.of.assign(size_, 0);
    if (parts.count > 1) {
      std::vector<Index> name(static_cast<std::size_t>(parts.count), kNoIndex);
      Index named = 0;
      for (std::size_t k = 0; k < size_; ++k) {
        Index& here = name[parts.of[order[k]]];
        if (here == kNoIndex) here = named++;
        out_.components.of[k] = here;
      }
    }
    out_.doubled.assign(static_cast<std::size_t>(parts.count), 0);
    for (std::size_t f = 0; f < mesh_.back.size(); ++f) {
      if (mesh_.back[f] != kNoIndex) out_.doubled[out_.components.of[renamed_[f][0]]] = 1;
    }
    out_.area.assign(static_cast<std::size_t>(parts.count), 0.0);
    for (std::size_t i = 0; i < size_; ++i) out_.area[out_.components.of[i]] += out_.mass[i];
    for (std::size_t c = 0; c < out_.area.size(); ++c) out_.area[c] /= out_.doubled[c] ? 2 : 1;
  }

 private:
  template <class Work>
  void for_each(std::size_t count, const Work& work) const {
    parallel_for(threads_, static_cast<std::int64_t>(count), kMinItemsPerThread,
                 [&](std::int64_t begin, std::int64_t end) {
                   for (std::int64_t i = begin; i < end; ++i) work(static_cast<std::size_t>(i));
                 });
  }

  const IntrinsicMesh& mesh_;
  int threads_;
  std::size_t size_;
  OperatorMesh& out_;
  RawVector<Face> renamed_;  ///< the mesh's faces in elimination numbers
};

}  // namespace

std::shared_ptr<const OperatorMesh> build_operator_mesh(const IntrinsicMesh& mesh,
                                                        const SymmetricPattern& pattern,
                                                        std::span<const Index> local,
                                                        std::span<const Index> order,
                                                        const Components& parts, int threads) {
  auto out = std::make_shared<OperatorMesh>();
  out->lower = permuted_lower(pattern, order, threads);
  out->pattern = pattern_hash(out->lower, threads);
  Builder builder(mesh, local, order, threads, *out);
  builder.sort_faces();
  builder.add_up_faces();
  builder.name_components(parts, order);
  return out;
}

}  // namespace geotherm
