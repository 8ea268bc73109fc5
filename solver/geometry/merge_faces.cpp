// SPDX-License-Identifier: MIT
#include "solver/geometry/merge_faces.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "solver/core/sorting.h"

namespace geotherm {
namespace {

/// A changed face with its corners as rows.
struct ChangedFace {
  Index face;
  Face corners;
  std::pair<Index, Index> key() const { return {std::ranges::min(corners), face}; }
};

class FaceMerge {
 public:
  FaceMerge(const OperatorMesh& earlier, const IntrinsicMesh& mesh, const OperatorChanges& changes,
            int threads, OperatorMesh& out)
      : earlier_(earlier),
        mesh_(mesh),
        changes_(changes),
        row_now_(inverse_permutation(changes.earlier_row, threads)),
        out_(out) {
    out_.faces.resize(earlier.faces.size());
    out_.layout.resize(earlier.faces.size());
    out_.intrinsic_face.resize(earlier.faces.size());
  }

  void merge_all(std::span<const Index> row_of_vertex) {
    std::vector<ChangedFace> changed, fitting, crossing;
    for_each_with_value(changes_.faces, char{1}, [&](Index f) {
      ChangedFace face{f, mesh_.faces[f]};
      for (Index& corner : face.corners) corner = row_of_vertex[corner];
      changed.push_back(face);
    });
    std::ranges::sort(changed, {}, &ChangedFace::key);
    auto next = changed.begin();
    for (const RowRange& before : earlier_.ranges) {
      RowRange range{out_.ranges.empty() ? 0 : out_.ranges.back().end_row, end_now(before.end_row),
                     filled_, 0};
      fitting.clear();
      for (; next != changed.end() && next->key().first < range.end_row; ++next) {
        (std::ranges::max(next->corners) < range.end_row ? fitting : crossing).push_back(*next);
      }
      merge(before.first_cell, before.end_cell, fitting);
      range.end_cell = filled_;
      out_.ranges.push_back(range);
    }
    out_.crossing = filled_;
    merge(earlier_.crossing, earlier_.face_count(), crossing);
  }

  /// Appends column k of the lower triangle.
  void add_column(Index k, std::vector<Index>& list) const {
    if (changes_.rows[k] == 0) {
      const LowerPattern& lower = earlier_.lower;
      const Index before = changes_.earlier_row[k];
      for (std::int64_t e = lower.start[before]; e < lower.start[before + 1]; ++e) {
        list.push_back(row_now_[lower.row[e]]);
      }
      return;
    }
    list.push_back(k);
    const auto begin = std::ssize(list);
    for (const Side corner : out_.corners.at(k)) {
      for (const Index row : out_.faces[face_of(corner)]) {
        if (row > k) list.push_back(row);
      }
    }
    std::sort(list.begin() + begin, list.end());
    list.erase(std::unique(list.begin() + begin, list.end()), list.end());
  }

 private:
  /// Where a range ends: rows that did not rise keep their order, and with it their range.
  Index end_now(Index row) const {
    const auto size = static_cast<Index>(row_now_.size());
    while (row < size && changes_.rose[row_now_[row]] != 0) ++row;
    return row < size ? row_now_[row] : size;
  }

  /// Appends faces of the earlier mesh that have not changed, and others, by their earliest rows.
  void merge(Index first, Index end, std::span<const ChangedFace> changed) {
    auto next = changed.begin();
    const auto add_until = [&](Index row) {
      for (; next != changed.end() && next->key().first < row; ++next) {
        append(next->face, next->corners, lay_out(mesh_.lengths[next->face]));
      }
    };
    for (Index f = first; f < end; ++f) {
      if (changes_.faces[earlier_.intrinsic_face[f]] != 0) continue;
      Face corners = earlier_.faces[f];
      for (Index& corner : corners) corner = row_now_[corner];
      add_until(std::ranges::min(corners));
      append(earlier_.intrinsic_face[f], corners, earlier_.layout[f]);
    }
    add_until(static_cast<Index>(row_now_.size()));
  }

  void append(Index face, const Face& corners, const FaceLayout& layout) {
    out_.intrinsic_face[filled_] = face;
    out_.layout[filled_] = layout;
    out_.faces[filled_++] = corners;
  }

  const OperatorMesh& earlier_;
  const IntrinsicMesh& mesh_;
  const OperatorChanges& changes_;
  const std::vector<Index> row_now_;  ///< of each earlier row
  OperatorMesh& out_;
  Index filled_ = 0;  ///< faces that are in `out_`
};

}  // namespace

void merge_faces(const OperatorMesh& earlier, const IntrinsicMesh& mesh,
                 const OperatorChanges& changes, std::span<const Index> row_of_vertex, int threads,
                 OperatorMesh& out) {
  FaceMerge merge(earlier, mesh, changes, threads, out);
  merge.merge_all(row_of_vertex);
  out.corners = CornerTable(earlier.size(), out.faces, threads);
  list_rows(
      earlier.size(), threads,
      [&merge](Index k, std::vector<Index>& list) { merge.add_column(k, list); }, out.lower.start,
      out.lower.row);
}

}  // namespace geotherm
