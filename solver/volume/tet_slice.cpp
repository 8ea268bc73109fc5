// SPDX-License-Identifier: MIT
#include "solver/volume/tet_slice.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>

#include "solver/volume/clean_tets.h"

namespace geotherm {
namespace {

class Slicer {
 public:
  Slicer(std::span<const Vec3> positions, const SlicePlane& plane, double near)
      : positions_(positions), plane_(plane), heights_(positions.size()) {
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const double height = plane.normal.dot(positions[v]) - plane.offset;
      heights_[v] = std::abs(height) <= near ? 0 : height;
    }
  }

  void add_faces(std::span<const Face> faces) {
    for (std::size_t f = 0; f < faces.size(); ++f) add_face(faces[f], static_cast<Index>(f));
    numbers_.clear();  // of the cut, which shares no point with the faces
    faces_ = out_.faces.size();
  }

  void add_tets(std::span<const Tet> tets) {
    for (std::size_t t = 0; t < tets.size(); ++t) {
      add_cut(tets[t]);
      out_.tets.resize(out_.faces.size() - faces_, static_cast<Index>(t));
    }
  }

  SlicedSurface take() { return std::move(out_); }

 private:
  bool stays(Index v) const { return heights_[v] < 0; }

  /// The corner where the plane meets the edge from a vertex that stays to one that does not.
  Index crossing(Index below, Index above) {
    const double low = heights_[below], high = heights_[above];
    return corner_at(high == 0 ? EdgePoint{above, above, 0}
                               : EdgePoint{below, above, low / (low - high)});
  }

  Index corner_at(const EdgePoint& point) {
    const auto [low, high] = std::minmax(point.a, point.b);
    const std::uint64_t key = static_cast<std::uint64_t>(low) << 32U | static_cast<unsigned>(high);
    const auto next = static_cast<Index>(positions_.size() + out_.points.size());
    const auto [known, fresh] = numbers_.try_emplace(key, next);
    if (fresh) out_.points.push_back(point);
    return known->second;
  }

  Vec3 place(Index corner) const {
    const auto vertices = static_cast<Index>(positions_.size());
    if (corner < vertices) return positions_[corner];
    const EdgePoint& p = out_.points[static_cast<std::size_t>(corner - vertices)];
    return positions_[p.a] + p.share * (positions_[p.b] - positions_[p.a]);
  }

  void put(Index a, Index b, Index c, Index origin) {
    if (a == b || b == c || c == a) return;
    out_.faces.push_back({a, b, c});
    out_.origin.push_back(origin);
  }

  void add_face(const Face& face, Index f) {
    std::array<Index, 4> corners{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = face[k], b = face[(k + 1) % 3];
      if (stays(a)) corners[count++] = a;
      if (stays(a) && !stays(b)) corners[count++] = crossing_of_face(a, b);
      if (!stays(a) && stays(b)) corners[count++] = crossing_of_face(b, a);
    }
    for (std::size_t k = 2; k < count; ++k) put(corners[0], corners[k - 1], corners[k], f);
  }

  /// A face ends at a vertex in the plane as it is.
  Index crossing_of_face(Index below, Index above) {
    return heights_[above] == 0 ? above : crossing(below, above);
  }

  void add_cut(const Tet& tet) {
    std::array<Index, 4> below{}, above{};
    std::size_t low = 0, high = 0;
    for (const Index v : tet) {
      if (stays(v)) {
        below[low++] = v;
      } else {
        above[high++] = v;
      }
    }
    if (low == 0 || high == 0) return;
    if (low == 2) {
      const Index a = crossing(below[0], above[0]), b = crossing(below[0], above[1]);
      const Index c = crossing(below[1], above[1]), d = crossing(below[1], above[0]);
      put_in_cut(a, b, c);
      return put_in_cut(a, c, d);
    }
    const bool one_below = low == 1;
    const Index lone = one_below ? below[0] : above[0];
    const auto& others = one_below ? above : below;
    std::array<Index, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = one_below ? crossing(lone, others[k]) : crossing(others[k], lone);
    }
    put_in_cut(corners[0], corners[1], corners[2]);
  }

  void put_in_cut(Index a, Index b, Index c) {
    const Vec3 area = (place(b) - place(a)).cross(place(c) - place(a));
    if (area.dot(plane_.normal) < 0) std::swap(b, c);
    put(a, b, c, kNoIndex);
  }

  std::span<const Vec3> positions_;
  const SlicePlane& plane_;
  std::vector<double> heights_;
  std::unordered_map<std::uint64_t, Index> numbers_;  ///< of the points, by their edges
  std::size_t faces_ = 0;                             ///< that are no cut
  SlicedSurface out_;
};

}  // namespace

SlicedSurface slice(std::span<const Vec3> positions, std::span<const Face> faces,
                    std::span<const Tet> tets, const SlicePlane& plane, double near) {
  Slicer slicer(positions, plane, near);
  slicer.add_faces(faces);
  slicer.add_tets(tets);
  return slicer.take();
}

PeeledSurface peel(const TetMesh& mesh, std::span<const Face> border, std::span<const char> keep) {
  std::vector<std::pair<Face, Index>> known;  // by their corners in ascending order
  known.reserve(border.size());
  for (std::size_t f = 0; f < border.size(); ++f) {
    known.emplace_back(border[f], static_cast<Index>(f));
    std::ranges::sort(known.back().first);
  }
  std::ranges::sort(known);
  std::vector<Tet> kept;
  std::vector<Index> numbers;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t] == 0) continue;
    kept.push_back(mesh.tets()[t]);
    numbers.push_back(static_cast<Index>(t));
  }
  PeeledSurface out;
  if (kept.empty()) return out;
  const auto positions = mesh.positions();
  const auto part = TetMesh::build({positions.begin(), positions.end()}, std::move(kept));
  auto found = boundary(*part);
  if (!found) throw std::bad_alloc();
  out.faces = std::move(found->faces);
  for (const Index t : found->tets) out.tets.push_back(numbers[static_cast<std::size_t>(t)]);
  for (Face face : out.faces) {
    std::ranges::sort(face);
    const auto at = std::ranges::lower_bound(known, face, {}, &std::pair<Face, Index>::first);
    out.origin.push_back(at != known.end() && at->first == face ? at->second : kNoIndex);
  }
  return out;
}

}  // namespace geotherm
