// SPDX-License-Identifier: MIT
#include "solver/wave/wave_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace geotherm {
namespace {

/// Bits of a coordinate in a Morton number; three of them fill 63.
constexpr int kMortonBits = 21;

/// Spreads the low bits so that two zeros follow each (Morton 1966).
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

/// Vertices that faces use, along a space-filling curve.
std::vector<Index> morton_order(const IntrinsicSurface& base) {
  std::vector<Vec3> positions(base.mesh->positions().begin(), base.mesh->positions().end());
  positions.insert(positions.end(), base.refinement.positions.begin(),
                   base.refinement.positions.end());
  const auto is_used = [&base](std::size_t v) {
    return v >= base.on_surface.size() || base.on_surface[v] != 0;
  };
  Vec3 low = Vec3::Constant(kUnreached), high = -low;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!is_used(v)) continue;
    low = low.cwiseMin(positions[v]);
    high = high.cwiseMax(positions[v]);
  }
  const Vec3 origin = low / 2;  // halves, because the extent may be beyond the doubles' range
  const double extent = (high / 2 - origin).maxCoeff();
  const double steps = extent > 0 ? ((1 << kMortonBits) - 1) / extent : 0.0;
  std::vector<std::pair<std::uint64_t, Index>> codes;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!is_used(v)) continue;
    const Vec3 at = (positions[v] / 2 - origin) * steps;
    std::uint64_t code = 0;
    for (int c = 0; c < 3; ++c) code |= spread(static_cast<std::uint64_t>(at(c))) << c;
    codes.emplace_back(code, static_cast<Index>(v));
  }
  std::ranges::sort(codes);
  std::vector<Index> order(codes.size());
  std::ranges::transform(codes, order.begin(), [](const auto& pair) { return pair.second; });
  return order;
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
std::vector<Index> face_order(const WaveTables& tables, const std::vector<Face>& faces) {
  std::vector<Face> sorted(faces.size());
  std::vector<std::size_t> next(static_cast<std::size_t>(tables.vertex_count()) + 1, 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    sorted[f] = ranks(tables, faces[f]);
    std::ranges::sort(sorted[f]);
    ++next[static_cast<std::size_t>(sorted[f][0]) + 1];
  }
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  std::vector<Index> order(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    order[next[static_cast<std::size_t>(sorted[f][0])]++] = static_cast<Index>(f);
  }
  const auto before = [&sorted](Index f, Index g) {
    return sorted[f] != sorted[g] ? sorted[f] < sorted[g] : f < g;
  };
  std::size_t begin = 0;
  for (std::size_t v = 0; v + 1 < next.size(); ++v) {  // next[v] is now where v's faces end
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
              order.begin() + static_cast<std::ptrdiff_t>(next[v]), before);
    begin = next[v];
  }
  return order;
}

/// Whether the two sides of one edge run the same way.
bool same_direction(const IntrinsicMesh& mesh, Side first, Side other) {
  if (first == other) return true;
  if (mesh.twin[first] == other) return false;  // also where both ends are one vertex
  return mesh.faces[face_of(first)][corner_of(first)] ==
         mesh.faces[face_of(other)][corner_of(other)];
}

/// The sides of edge `old` with `first` in front, as codes.
void add_sides(const WaveSurface& surface, Index old, Side first, WaveTables& tables) {
  const auto code = [&](Side side) {
    return static_cast<SideCode>(4 * tables.rank_of_face[face_of(side)] + corner_of(side));
  };
  const auto sides = surface.sides_of(old);
  SideCode second = kNoSideCode;
  if (sides.size() == 2) {
    second = code(sides[0] == first ? sides[1] : sides[0]);
  } else if (sides.size() > 2) {
    second = -2 - static_cast<SideCode>(tables.more.size());
    tables.more.push_back(static_cast<SideCode>(sides.size()) - 1);
    for (const Side side : sides) {
      if (side != first) tables.more.push_back(code(side));
    }
    std::sort(tables.more.end() - static_cast<std::ptrdiff_t>(sides.size()) + 1, tables.more.end());
  }
  tables.sides.push_back({code(first), second});
}

void add_faces(const WaveSurface& surface, WaveTables& tables) {
  const IntrinsicMesh& mesh = surface.base.intrinsic;
  tables.intrinsic_face = face_order(tables, mesh.faces);
  const std::vector<Index>& order = tables.intrinsic_face;
  tables.rank_of_face.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    tables.rank_of_face[order[i]] = static_cast<Index>(i);
  }
  tables.faces.resize(order.size());
  tables.sides.reserve(static_cast<std::size_t>(surface.edge_count()));
  std::vector<Index> number(static_cast<std::size_t>(surface.edge_count()), kNoIndex);
  std::vector<Side> first(number.size(), kNoSide);
  double sum = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Index f = order[i];
    const FaceLayout layout = lay_out(mesh.lengths[f]);
    WaveFace& face = tables.faces[i];
    face.vertex = ranks(tables, mesh.faces[f]);
    face.length = mesh.lengths[f];
    face.twice_area = layout.base * layout.height;
    face.reversed = face.touching = 0;
    const int start = first_corner(face.vertex);
    for (const int k : {start, next_corner(start), previous_corner(start)}) {
      const Side side = 3 * f + k;
      const Index old = surface.edge_of_side[side];
      if (number[old] == kNoIndex) {
        number[old] = tables.edge_count();
        first[old] = side;
        add_sides(surface, old, side, tables);
      }
      face.edge[k] = number[old];
      if (!same_direction(mesh, first[old], side)) {
        face.reversed = static_cast<std::uint16_t>(face.reversed | 1U << k);
      }
      sum += face.length[k];
      tables.longest_side = std::max(tables.longest_side, face.length[k]);
    }
  }
  tables.mean_side = sum / (3.0 * static_cast<double>(order.size()));
}

void list_corners(WaveTables& tables) {
  tables.corner_start.assign(static_cast<std::size_t>(tables.vertex_count()) + 1, 0);
  for (const WaveFace& face : tables.faces) {
    for (const Index v : face.vertex) ++tables.corner_start[v + 1];
  }
  for (std::size_t v = 1; v < tables.corner_start.size(); ++v) {
    tables.corner_start[v] += tables.corner_start[v - 1];
  }
  tables.corners.resize(3 * tables.faces.size());
  std::vector<std::size_t> next(tables.corner_start.begin(), tables.corner_start.end() - 1);
  for (std::size_t f = 0; f < tables.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      tables.corners[next[tables.faces[f].vertex[k]]++] = static_cast<SideCode>(4 * f) + k;
    }
  }
}

/// A vertex whose longest side is that much longer than its shortest hands its distance on by
/// itself: samples far out on a long side do not notice when it falls, and faces beyond would never
/// know.
constexpr double kStretched = 6;

/// Marks corners at vertices whose faces are not all joined by edges at the vertex, where a wave
/// has to be handed from fan to fan, and at stretched ones.
class FanMarker {
 public:
  explicit FanMarker(WaveTables& tables) : tables_(tables), fan_(4 * tables.faces.size()) {}

  void run() {
    for (std::size_t c = 0; c < fan_.size(); ++c) fan_[c] = static_cast<SideCode>(c);
    for (const auto& sides : tables_.sides) {
      if (sides[1] >= 0) {
        join_ends(sides[0], sides[1]);
      } else if (sides[1] != kNoSideCode) {
        const SideCode* list = &tables_.more[static_cast<std::size_t>(-2 - sides[1])];
        for (SideCode i = 1; i <= list[0]; ++i) join_ends(sides[0], list[i]);
      }
    }
    for (Index v = 0; v < tables_.vertex_count(); ++v) mark(tables_.corners_at(v));
  }

 private:
  static SideCode next_code(SideCode code) {
    return (code & ~3) | next_corner(corner_of_code(code));
  }
  bool runs_back(SideCode code) const {
    return (tables_.faces[face_of_code(code)].reversed >> corner_of_code(code) & 1) != 0;
  }
  SideCode root(SideCode c) {
    while (fan_[c] != c) c = fan_[c] = fan_[fan_[c]];
    return c;
  }
  void join_ends(SideCode first, SideCode other) {
    const SideCode begin = runs_back(other) ? next_code(other) : other;
    const SideCode end = runs_back(other) ? other : next_code(other);
    fan_[root(first)] = root(begin);
    fan_[root(next_code(first))] = root(end);
  }
  bool stretched(std::span<const SideCode> corners) const {
    double longest = 0, shortest = kUnreached;
    for (const SideCode c : corners) {
      const auto& length = tables_.faces[face_of_code(c)].length;
      for (const int side : {corner_of_code(c), previous_corner(corner_of_code(c))}) {
        longest = std::max(longest, length[side]);
        shortest = std::min(shortest, length[side]);
      }
    }
    return longest > kStretched * shortest;
  }
  void mark(std::span<const SideCode> corners) {
    const auto elsewhere = [&](SideCode c) { return root(c) != root(corners.front()); };
    if (std::ranges::none_of(corners, elsewhere) && !stretched(corners)) return;
    for (const SideCode c : corners) {
      auto& bits = tables_.faces[face_of_code(c)].touching;
      bits = static_cast<std::uint16_t>(bits | 1U << corner_of_code(c));
    }
  }

  WaveTables& tables_;
  std::vector<SideCode> fan_;  ///< of a corner: another one of its fan
};

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace

std::size_t WaveTables::bytes() const {
  return bytes_of(faces) + bytes_of(sides) + bytes_of(more) + bytes_of(rank_of_vertex) +
         bytes_of(vertex_of_rank) + bytes_of(rank_of_face) + bytes_of(intrinsic_face) +
         bytes_of(corner_start) + bytes_of(corners);
}

WaveTables build_wave_tables(const WaveSurface& surface) {
  WaveTables tables;
  tables.vertex_of_rank = morton_order(surface.base);
  tables.rank_of_vertex.assign(static_cast<std::size_t>(surface.base.vertex_count()), kNoIndex);
  for (std::size_t r = 0; r < tables.vertex_of_rank.size(); ++r) {
    tables.rank_of_vertex[tables.vertex_of_rank[r]] = static_cast<Index>(r);
  }
  add_faces(surface, tables);
  list_corners(tables);
  FanMarker(tables).run();
  return tables;
}

}  // namespace geotherm
