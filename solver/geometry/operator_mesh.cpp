// SPDX-License-Identifier: MIT
#include "solver/geometry/operator_mesh.h"

#include <algorithm>

namespace geotherm {
namespace {

/// Lower triangle of the permuted pattern, the diagonal first in each column.
LowerMatrix lower_pattern(const SymmetricPattern& pattern) {
  LowerMatrix lower;
  lower.start.reserve(pattern.start.size());
  lower.row.reserve(pattern.neighbor.size() / 2 + static_cast<std::size_t>(pattern.size()));
  lower.start.push_back(0);
  for (Index j = 0; j < pattern.size(); ++j) {
    lower.row.push_back(j);
    for (const Index i : pattern.neighbors(j)) {
      if (i > j) lower.row.push_back(i);
    }
    lower.start.push_back(static_cast<std::int64_t>(lower.row.size()));
  }
  return lower;
}

std::int64_t find_entry(const LowerMatrix& lower, Index a, Index b) {
  if (a == b) return -1;
  const Index column = std::min(a, b);
  const auto begin = lower.row.begin() + lower.start[column];
  const auto end = lower.row.begin() + lower.start[column + 1];
  return std::lower_bound(begin, end, std::max(a, b)) - lower.row.begin();
}

/// Rows of a range: some 0.1 ms of work for a pass over its faces, several times what it takes to
/// start a thread. Eliminated one after the other, they are a patch or a few: 2 to 5 % of the faces
/// cross.
constexpr Index kRowsOfRange = 8192;
/// More would feed no more cores than people have, and let more faces cross.
constexpr Index kMostRanges = 32;

Index range_count(Index size) { return std::clamp<Index>(size / kRowsOfRange, 1, kMostRanges); }

/// Brings the faces that cross from one range of rows to another to the end; all stay in order
/// otherwise. Gives the ranges.
std::vector<FaceRange> part_by_ranges(const std::vector<Face>& faces, Index size,
                                      std::vector<Index>& sorted) {
  const Index count = range_count(size);
  std::vector<FaceRange> ranges;
  std::vector<Index> parted, crossing;
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

/// Face numbers sorted by their earliest vertex: a walk over the faces then stays in a small
/// window of vertices.
std::vector<Index> faces_in_order(const std::vector<Face>& faces, Index size) {
  std::vector<Index> start(static_cast<std::size_t>(size) + 1, 0);
  const auto earliest = [](const Face& f) { return std::min({f[0], f[1], f[2]}); };
  for (const Face& face : faces) ++start[earliest(face) + 1];
  for (Index i = 0; i < size; ++i) start[i + 1] += start[i];
  std::vector<Index> sorted(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    sorted[start[earliest(faces[f])]++] = static_cast<Index>(f);
  }
  return sorted;
}

void list_incident_faces(OperatorMesh& mesh) {
  mesh.incident_start.assign(static_cast<std::size_t>(mesh.size()) + 1, 0);
  for (const Face& face : mesh.faces) {
    for (const Index corner : face) ++mesh.incident_start[corner + 1];
  }
  for (Index i = 0; i < mesh.size(); ++i) mesh.incident_start[i + 1] += mesh.incident_start[i];
  std::vector<Index> cursor(mesh.incident_start.begin(), mesh.incident_start.end() - 1);
  mesh.incident.resize(3 * mesh.faces.size());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (const Index corner : mesh.faces[f]) mesh.incident[cursor[corner]++] = f;
  }
}

}  // namespace

std::array<double, 3> stiffness(const FaceLayout& p) {
  const double w12 = -p.x / (2 * p.height);
  const double w20 = (p.x - p.base) / (2 * p.height);
  const double w01 = (p.x * (p.base - p.x) / p.height - p.height) / (2 * p.base);
  return {w01, w12, w20};
}

std::shared_ptr<const OperatorMesh> build_operator_mesh(const IntrinsicMesh& mesh,
                                                        const SymmetricPattern& pattern,
                                                        std::span<const Index> local,
                                                        std::span<const Index> order) {
  auto out = std::make_shared<OperatorMesh>();
  const SymmetricPattern ordered = permuted(pattern, order);
  const std::vector<Index> position = inverse_permutation(order);
  out->pattern = pattern_hash(ordered);
  out->components = connected_components(ordered);
  out->lower = lower_pattern(ordered);

  const auto count = mesh.faces.size();
  std::vector<Face> renamed(count);
  for (std::size_t f = 0; f < count; ++f) {
    for (int k = 0; k < 3; ++k) renamed[f][k] = position[local[mesh.faces[f][k]]];
  }
  out->intrinsic_face = faces_in_order(renamed, pattern.size());
  out->ranges = part_by_ranges(renamed, pattern.size(), out->intrinsic_face);
  out->crossing = out->ranges.back().end_face;
  out->faces.resize(count);
  out->layout.resize(count);
  out->entry.resize(count);
  out->mass.assign(order.size(), 0.0);
  out->stiffness_diagonal.assign(order.size(), 0.0);
  for (std::size_t f = 0; f < count; ++f) {
    const Index source = out->intrinsic_face[f];
    const Face& face = out->faces[f] = renamed[source];
    const FaceLayout& p = out->layout[f] = lay_out(mesh.lengths[source]);
    const std::array<double, 3> weight = stiffness(p);
    for (int k = 0; k < 3; ++k) {
      out->mass[face[k]] += p.base * p.height / 6;
      const Index a = face[k];
      const Index b = face[next_corner(k)];
      out->entry[f][k] = find_entry(out->lower, a, b);
      if (a == b) continue;
      out->stiffness_diagonal[a] -= weight[k];
      out->stiffness_diagonal[b] -= weight[k];
    }
  }
  list_incident_faces(*out);
  out->doubled.assign(static_cast<std::size_t>(out->components.count), 0);
  for (std::size_t f = 0; f < count && !mesh.back.empty(); ++f) {
    const bool is_back = static_cast<std::size_t>(out->intrinsic_face[f]) >= mesh.back.size();
    if (is_back) out->doubled[out->components.of[out->faces[f][0]]] = 1;
  }
  return out;
}

}  // namespace geotherm
