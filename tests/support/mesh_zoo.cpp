// SPDX-License-Identifier: MIT
#include "tests/support/mesh_zoo.h"

#include <cmath>
#include <utility>

namespace geotherm::test {
namespace {

constexpr unsigned kSeed = 11;

Draft sheared_plane() {
  Draft draft = plane_grid(10, 10, 1, 1);
  for (Vec3& p : draft.positions) p.x() += 4 * p.y();
  return draft;
}

/// A plane in which a point is put close to the middle of a side of some faces (caps), or close to
/// a corner (needles).
Draft with_point_in_every_face(double to_corner, double to_side) {
  Draft draft = jittered_plane(6, 0.2, kSeed);
  const std::vector<Face> faces = std::exchange(draft.faces, {});
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto [a, b, c] = faces[f];
    if (f % 3 != 0) {
      draft.faces.push_back(faces[f]);
      continue;
    }
    const auto at = [&draft](Index v) { return draft.positions[static_cast<std::size_t>(v)]; };
    const Vec3 base = (1 + to_corner) / 2 * at(a) + (1 - to_corner) / 2 * at(b);
    const Index p = draft.add((1 - to_side) * base + to_side * at(c));
    draft.faces.insert(draft.faces.end(), {{a, b, p}, {b, c, p}, {c, a, p}});
  }
  return draft;
}

Draft caps() { return with_point_in_every_face(0, 0.02); }
Draft flat_caps() { return with_point_in_every_face(0, 1e-4); }
Draft needles() { return with_point_in_every_face(1 - 1e-4, 1e-4); }
Draft degenerate_caps() { return with_point_in_every_face(0, 0); }
Draft coincident_points() { return with_point_in_every_face(1, 0); }

Draft two_components() {
  Draft draft = sphere(2);
  append(draft, transformed(torus(20, 10, 0.4), 1, Vec3(4, 0, 0), false));
  return draft;
}

Draft closed_and_bordered() {
  Draft draft = sphere(2);
  append(draft, transformed(plane_grid(8, 8, 1, 1), 1, Vec3(0, 0, 3), false));
  return draft;
}

Draft one_triangle() {
  Draft draft;
  draft.positions = {{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}};
  draft.faces = {{0, 1, 2}};
  return draft;
}

Draft two_triangles_at_a_vertex() {
  Draft draft;
  draft.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  draft.faces = {{0, 1, 2}, {0, 3, 4}};
  return draft;
}

/// Two spheres that touch at vertex 0, which therefore has two fans.
Draft bowtie() {
  Draft draft = sphere(2);
  const Vec3 shift = 2 * draft.positions[0];
  const Draft other = sphere(2);
  const Index first = draft.vertex_count();
  // The antipode of vertex 0 in the other sphere, moved, is vertex 0 of this one.
  Index antipode = 0;
  for (std::size_t v = 0; v < other.positions.size(); ++v) {
    if ((other.positions[v] + other.positions[0]).norm() < 1e-9) antipode = static_cast<Index>(v);
  }
  append(draft, transformed(other, 1, shift, false));
  for (Face& face : draft.faces) {
    for (Index& corner : face) {
      if (corner == first + antipode) corner = 0;
    }
  }
  draft.positions.erase(draft.positions.begin() + first + antipode);
  for (Face& face : draft.faces) {
    for (Index& corner : face) corner -= static_cast<Index>(corner > first + antipode);
  }
  return draft;
}

/// A plane with one more sheet that stands on a row of its edges, each of which has three faces.
Draft fin() {
  Draft draft = plane_grid(10, 10, 1, 1);
  std::vector<Index> top;
  for (Index i = 0; i <= 10; ++i) top.push_back(draft.add({0.1 * i, 0.5, 0.12}));
  for (Index i = 0; i < 10; ++i) {
    const Index a = grid_vertex(10, i, 5), b = grid_vertex(10, i + 1, 5);
    const Index c = top[static_cast<std::size_t>(i) + 1], d = top[static_cast<std::size_t>(i)];
    draft.faces.insert(draft.faces.end(), {{a, b, c}, {a, c, d}});
  }
  return draft;
}

Draft flipped_faces() {
  Draft draft = sphere(3);
  for (std::size_t f = 0; f < draft.faces.size(); f += 3) {
    std::swap(draft.faces[f][1], draft.faces[f][2]);
  }
  return draft;
}

Draft duplicate_faces() {
  Draft draft = torus(20, 10, 0.4);
  for (std::size_t f = 0; f < 60; f += 4) {
    const auto [a, b, c] = draft.faces[f];
    draft.faces.push_back(f % 8 == 0 ? Face{b, c, a} : Face{a, c, b});
  }
  return draft;
}

Draft repeated_corners() {
  Draft draft = jittered_plane(8, 0.2, kSeed);
  for (Index f = 0; f < 5; ++f) draft.faces.push_back({f, f + 7, f});
  draft.faces.push_back({3, 3, 3});
  return draft;
}

Draft unreferenced_vertices() {
  Draft draft;
  draft.add({9, 9, 9});
  append(draft, sphere(2));
  for (int i = 0; i < 5; ++i) draft.add({0.1 * i, 0, 0});
  return draft;
}

/// Neighbouring faces of very different sizes: rings that shrink by three towards a point.
Draft graded() {
  Draft draft;
  draft.add({0, 0, 0});
  constexpr Index kRings = 9, kAround = 10;
  double radius = 1;
  for (Index r = 0; r < kRings; ++r, radius /= 3) {
    for (Index s = 0; s < kAround; ++s) {
      const double u = 0.6283185307179586 * s;
      draft.add({radius * std::cos(u), radius * std::sin(u), 0});
    }
  }
  for (Index s = 0; s < kAround; ++s) {
    const Index t = (s + 1) % kAround;
    for (Index r = 0; r + 1 < kRings; ++r) {
      const Index a = 1 + r * kAround + s, b = 1 + r * kAround + t;
      draft.faces.insert(draft.faces.end(), {{a, b, b + kAround}, {a, b + kAround, a + kAround}});
    }
    draft.faces.push_back({1 + (kRings - 1) * kAround + s, 1 + (kRings - 1) * kAround + t, 0});
  }
  return draft;
}

constexpr unsigned kGood = kManifold | kConnected | kRegular | kSmooth;

const ZooMesh kZoo[] = {
    {"plane_grid", kGood | kPlanar | kBorder, [] { return plane_grid(24, 20, 1.2, 1); }},
    {"jittered_plane", kGood | kPlanar | kBorder, [] { return jittered_plane(20, 0.3, kSeed); }},
    {"sheared_plane", kPlanar | kBorder | kManifold | kConnected | kRegular, sheared_plane},
    {"caps", kPlanar | kBorder | kManifold | kConnected | kRegular, caps},
    {"flat_caps", kPlanar | kBorder | kManifold | kConnected, flat_caps},
    {"needles", kPlanar | kBorder | kManifold | kConnected, needles},
    {"degenerate_caps", kBorder | kManifold | kConnected, degenerate_caps},
    {"coincident_points", kBorder | kManifold | kConnected, coincident_points},
    {"graded", kPlanar | kBorder | kManifold | kConnected, graded},
    {"sphere", kGood | kClosed, [] { return sphere(3); }},
    {"torus", kGood | kClosed, [] { return torus(36, 18, 0.4); }},
    {"prism", kGood | kBorder, [] { return prism(24, 20, 0.8); }},
    {"pyramid", kGood | kBorder, [] { return pyramid(5, 12, 0.9); }},
    {"folded_flat_torus", kGood | kClosed, [] { return folded_flat_torus(20, 0.2, kSeed); }},
    {"moebius", kManifold | kConnected | kRegular | kBorder, [] { return moebius(40, 6); }},
    {"two_components", kManifold | kRegular | kClosed, two_components},
    {"closed_and_bordered", kManifold | kRegular | kBorder, closed_and_bordered},
    {"one_triangle", kManifold | kConnected | kRegular | kPlanar | kBorder, one_triangle},
    {"two_triangles_at_a_vertex", kConnected | kRegular | kPlanar | kBorder,
     two_triangles_at_a_vertex},
    {"bowtie", kConnected | kRegular | kClosed, bowtie},
    {"fin", kConnected | kRegular | kBorder, fin},
    {"flipped_faces", kGood | kClosed, flipped_faces},
    {"duplicate_faces", kConnected | kClosed, duplicate_faces},
    {"repeated_corners", kConnected | kBorder, repeated_corners},
    {"unreferenced_vertices", kManifold | kRegular | kClosed, unreferenced_vertices},
    {"long_strip", kManifold | kConnected | kRegular | kPlanar | kBorder,
     [] { return plane_grid(520, 2, 520, 2); }},
};

}  // namespace

std::vector<ZooMesh> zoo(unsigned tags) {
  std::vector<ZooMesh> out;
  for (const ZooMesh& mesh : kZoo) {
    if ((mesh.tags & tags) == tags) out.push_back(mesh);
  }
  return out;
}

std::string zoo_name(const testing::TestParamInfo<ZooMesh>& info) { return info.param.name; }

void PrintTo(const ZooMesh& mesh, std::ostream* out) { *out << mesh.name; }

}  // namespace geotherm::test
