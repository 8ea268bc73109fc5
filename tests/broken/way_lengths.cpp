// SPDX-License-Identifier: MIT
#include "tests/broken/way_lengths.h"

#include <algorithm>
#include <map>
#include <queue>
#include <utility>

namespace geotherm::test {
namespace {

/// Places on the surface; a straight way leads from each to every other of the same face.
struct Places {
  std::vector<Vec3> at;  ///< those of the vertices first
  std::vector<std::vector<Index>> of_face;
  std::vector<std::vector<Index>> faces_of;  ///< the other way round

  void put(Index place, std::size_t face) {
    of_face[face].push_back(place);
    faces_of[place].push_back(static_cast<Index>(face));
  }
  Index add(const Vec3& p) {
    at.push_back(p);
    faces_of.emplace_back();
    return static_cast<Index>(at.size()) - 1;
  }
};

Places places_of(const TriangleMesh& mesh, const std::vector<Face>& faces, int cuts) {
  Places out;
  for (const Vec3& p : mesh.positions()) out.add(p);
  out.of_face.resize(faces.size());
  std::map<std::pair<Index, Index>, Index> first;  // of the cuts of a side
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      out.put(faces[f][k], f);
      const auto [low, high] = std::minmax({faces[f][k], faces[f][(k + 1) % 3]});
      const auto [side, fresh] = first.try_emplace({low, high}, static_cast<Index>(out.at.size()));
      for (int c = 0; c < cuts; ++c) {
        const double along = (c + 1.0) / (cuts + 1);
        const Vec3 p = (1 - along) * mesh.positions()[low] + along * mesh.positions()[high];
        out.put(fresh ? out.add(p) : side->second + c, f);
      }
    }
  }
  return out;
}

/// Whether a face has the corners that a point of another stands between.
bool holds(const Face& face, const Face& other, const std::array<double, 3>& weights) {
  for (int k = 0; k < 3; ++k) {
    if (weights[k] > 0 && std::ranges::find(face, other[k]) == face.end()) return false;
  }
  return true;
}

Index place_of(const SurfacePoint& point, const TriangleMesh& mesh, const std::vector<Face>& faces,
               Places& places) {
  if (point.is_vertex()) return point.vertex;
  const Face& own = mesh.faces()[point.face];
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) p += point.weights[k] * mesh.positions()[own[k]];
  const Index out = places.add(p);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (holds(faces[f], own, point.weights)) places.put(out, f);
  }
  return out;
}

}  // namespace

std::vector<double> way_lengths(const TriangleMesh& mesh, const std::vector<Face>& faces,
                                const SourceSet& sources, int cuts) {
  Places places = places_of(mesh, faces, cuts);
  using Reached = std::pair<double, Index>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (const SurfacePoint& p : sources.points) queue.push({0, place_of(p, mesh, faces, places)});
  std::vector<double> d(places.at.size(), kUnreached);
  while (!queue.empty()) {
    const auto [length, from] = queue.top();
    queue.pop();
    if (d[from] < kUnreached) continue;
    d[from] = length;
    for (const Index face : places.faces_of[from]) {
      for (const Index to : places.of_face[face]) {
        if (d[to] == kUnreached)
          queue.push({length + (places.at[to] - places.at[from]).norm(), to});
      }
    }
  }
  d.resize(mesh.positions().size());
  return d;
}

}  // namespace geotherm::test
