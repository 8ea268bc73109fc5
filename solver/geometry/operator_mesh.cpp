// SPDX-License-Identifier: MIT
#include "solver/geometry/operator_mesh.h"

#include <algorithm>
#include <span>
#include <vector>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/geometry/merge_faces.h"

namespace geotherm {

namespace {

/// Appends the neighbours of vertex `i`, at which `corners` of these faces are, ascending and each
/// once: the sides that begin there lead to them, and those that end there and have no twin.
/// has_twin(side); name(corner): of a corner of a face.
template <class HasTwin, class Name>
void add_neighbors(Index i, std::span<const Side> corners, std::span<const Face> faces,
                   const HasTwin& has_twin, const Name& name, std::vector<Index>& row) {
  const auto begin = static_cast<std::ptrdiff_t>(row.size());
  for (const Side corner : corners) {
    const Face& face = faces[face_of(corner)];
    const int k = corner_of(corner);
    row.push_back(name(face[next_corner(k)]));
    if (!has_twin(corner - k + previous_corner(k))) row.push_back(name(face[previous_corner(k)]));
  }
  short_sort(row.data() + begin, row.data() + row.size());
  // Two edges may join the same vertices, and one a vertex with itself.
  const auto end = std::unique(row.begin() + begin, row.end());
  row.erase(std::remove(row.begin() + begin, end, i), row.end());
}

}  // namespace

SymmetricPattern surface_pattern(const IntrinsicMesh& mesh, const CornerTable& corners,
                                 std::span<const Index> used, std::span<const Index> local,
                                 int threads) {
  SymmetricPattern pattern;
  list_rows(
      static_cast<Index>(used.size()), threads,
      [&](Index i, std::vector<Index>& row) {
        add_neighbors(
            i, corners.at(used[i]), mesh.faces,
            [&mesh](Side side) { return mesh.twin[side] != kNoSide; },
            [local](Index vertex) { return local[vertex]; }, row);
      },
      pattern.start, pattern.neighbor);
  return pattern;
}

namespace {

/// Minimum faces or vertices per thread.
constexpr std::int64_t kMinItemsPerThread = 1 << 13;

/// Builds the parts of an OperatorMesh one after the other, each by all threads.
class Builder {
 public:
  Builder(const IntrinsicMesh& mesh, Index size, int threads, OperatorMesh& out)
      : mesh_(mesh), threads_(threads), size_(static_cast<std::size_t>(size)), out_(out) {}

  void use_threads(int threads) { threads_ = threads; }

  /// row(vertex): its elimination number.
  template <class Row>
  void rename_faces(const Row& row) {
    renamed_.resize(mesh_.faces.size());
    for_each(renamed_.size(), [&](std::size_t f) {
      for (int k = 0; k < 3; ++k) renamed_[f][k] = row(mesh_.faces[f][k]);
    });
  }

  /// Sorts the faces by their earliest vertex: a walk over them then stays in a small window of
  /// vertices.
  void sort_faces() {
    out_.intrinsic_face = sorted_by_key(renamed_.size(), size_, threads_, [this](std::size_t f) {
      return std::min({renamed_[f][0], renamed_[f][1], renamed_[f][2]});
    });
    out_.ranges = part_by_rows(static_cast<Index>(size_), out_.intrinsic_face,
                               [this](Index f) { return std::ranges::minmax(renamed_[f]); });
    out_.crossing = out_.ranges.back().end_cell;
    out_.faces.resize(renamed_.size());
    out_.layout.resize(renamed_.size());
    for_each(renamed_.size(), [&](std::size_t f) {
      const Index source = out_.intrinsic_face[f];
      out_.faces[f] = renamed_[source];
    });
    out_.corners = CornerTable(static_cast<Index>(size_), out_.faces, threads_);
  }

  /// The pattern of the faces as they are numbered now.
  SymmetricPattern pattern() const {
    SymmetricPattern pattern;
    list_rows(
        static_cast<Index>(size_), threads_,
        [this](Index i, std::vector<Index>& row) {
          add_neighbors(
              i, out_.corners.at(i), out_.faces,
              [this](Side side) {
                return mesh_.twin[3 * out_.intrinsic_face[face_of(side)] + corner_of(side)] !=
                       kNoSide;
              },
              [](Index vertex) { return vertex; }, row);
        },
        pattern.start, pattern.neighbor);
    return pattern;
  }

  /// Where `changed` (F of the mesh) is not empty, only those faces: others are laid out.
  void lay_out_faces(std::span<const char> changed = {}) {
    out_.layout.resize(out_.faces.size());
    for_each(out_.faces.size(), [&](std::size_t f) {
      const Index face = out_.intrinsic_face[f];
      if (changed.empty() || changed[face] != 0) out_.layout[f] = lay_out(mesh_.lengths[face]);
    });
  }

  /// Sums the contributions of the faces at each vertex, in their order.
  void add_up_faces() {
    out_.mass.resize(size_);
    out_.stiffness_diagonal.resize(size_);
    for_each(size_, [this](std::size_t i) { add_up_faces_at(i); });
  }

  /// The same at rows with a flag, of an earlier mesh elsewhere, with its rows.
  void add_up_faces(const OperatorMesh& earlier, const OperatorChanges& changes) {
    out_.mass.resize(size_);
    out_.stiffness_diagonal.resize(size_);
    for_each(size_, [&](std::size_t i) {
      if (changes.rows[i] != 0) return add_up_faces_at(i);
      const Index before = changes.earlier_row[i];
      out_.mass[i] = earlier.mass[before];
      out_.stiffness_diagonal[i] = earlier.stiffness_diagonal[before];
    });
  }

  /// Numbers the components anew in elimination order, which is given by numbers in `parts`.
  void name_components(const Components& parts, std::span<const Index> order) {
    geotherm::name_components(parts, order, out_.components);
    out_.doubled.assign(static_cast<std::size_t>(parts.count), 0);
    for (std::size_t f = 0; f < out_.faces.size() && !mesh_.back.empty(); ++f) {
      const auto of_mesh = static_cast<std::size_t>(out_.intrinsic_face[f]);
      if (of_mesh < mesh_.back.size() && mesh_.back[of_mesh] != kNoIndex) {
        out_.doubled[out_.components.of[out_.faces[f][0]]] = 1;
      }
    }
  }

  void add_up_areas() {
    out_.area.assign(out_.doubled.size(), 0.0);
    for (std::size_t i = 0; i < size_; ++i) out_.area[out_.components.of[i]] += out_.mass[i];
    for (std::size_t c = 0; c < out_.area.size(); ++c) out_.area[c] /= out_.doubled[c] ? 2 : 1;
  }

 private:
  void add_up_faces_at(std::size_t i) {
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
  }

  template <class Work>
  void for_each(std::size_t count, const Work& work) const {
    parallel_each<std::size_t>(threads_, static_cast<std::int64_t>(count), kMinItemsPerThread,
                               work);
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
  Builder builder(mesh, pattern.size(), threads, *out);
  const std::vector<Index> position = inverse_permutation(order, threads);
  builder.rename_faces([&](Index vertex) { return position[local[vertex]]; });
  builder.sort_faces();
  builder.lay_out_faces();
  builder.add_up_faces();
  builder.name_components(parts, order);
  builder.add_up_areas();
  return out;
}

std::shared_ptr<const OperatorMesh> follow_order(
    const IntrinsicMesh& mesh, std::span<const Index> vertex_of_row,
    std::span<const Index> row_of_vertex, const Components& parts, int threads,
    const std::function<void(const SymmetricPattern&, int threads)>& analyze) {
  auto out = std::make_shared<OperatorMesh>();
  Builder builder(mesh, static_cast<Index>(vertex_of_row.size()), threads, *out);
  builder.rename_faces([&](Index vertex) { return row_of_vertex[vertex]; });
  builder.sort_faces();
  const SymmetricPattern pattern = builder.pattern();
  const int half = std::max(1, threads / 2);
  builder.use_threads(half);
  run_both(
      threads,
      [&] {
        builder.lay_out_faces();
        builder.add_up_faces();
        builder.name_components(parts, vertex_of_row);
        builder.add_up_areas();
        out->lower = lower_of(pattern, half);
        out->pattern = pattern_hash(out->lower, half);
      },
      [&] { analyze(pattern, std::max(1, threads - half)); });
  return out;
}

std::shared_ptr<const OperatorMesh> moved_operator_mesh(const OperatorMesh& earlier,
                                                        const IntrinsicMesh& mesh,
                                                        const OperatorChanges& changes,
                                                        int threads) {
  auto out = std::make_shared<OperatorMesh>(earlier);
  Builder builder(mesh, earlier.size(), threads, *out);
  builder.lay_out_faces(changes.faces);
  if (changes.empty()) {
    builder.add_up_faces();
  } else {
    builder.add_up_faces(earlier, changes);
  }
  builder.add_up_areas();
  return out;
}

std::shared_ptr<const OperatorMesh> update_operators(
    const OperatorMesh& earlier, const IntrinsicMesh& mesh, const OperatorChanges& changes,
    std::span<const Index> vertex_of_row, std::span<const Index> row_of_vertex,
    const Components& parts, int threads,
    const std::function<void(const LowerPattern&, int threads)>& analyze) {
  auto out = std::make_shared<OperatorMesh>();
  merge_faces(earlier, mesh, changes, row_of_vertex, threads, *out);
  Builder builder(mesh, earlier.size(), threads, *out);
  const int half = std::max(1, threads / 2);
  builder.use_threads(half);
  run_both(
      threads,
      [&] {
        builder.add_up_faces(earlier, changes);
        builder.name_components(parts, vertex_of_row);
        builder.add_up_areas();
        out->pattern = pattern_hash(out->lower, half);
      },
      [&] { analyze(out->lower, std::max(1, threads - half)); });
  return out;
}

}  // namespace geotherm
