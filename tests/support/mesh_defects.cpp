// SPDX-License-Identifier: MIT
#include "tests/support/mesh_defects.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace geotherm::test {
namespace {

/// What a defect adds stays small, so that meshes do.
constexpr Index kFew = 4;

Face any_face(const Draft& draft, Dice& dice) {
  return draft.faces[static_cast<std::size_t>(dice.below(draft.faces.size()))];
}

Index any_corner(const Draft& draft, Dice& dice) {
  return any_face(draft, dice)[static_cast<std::size_t>(dice.below(3))];
}

Face turned(const Face& face, Dice& dice) {
  Face out = face;
  const auto by = static_cast<std::ptrdiff_t>(dice.below(3));
  std::rotate(out.begin(), out.begin() + by, out.end());
  if (dice.chance(0.5)) std::swap(out[1], out[2]);
  return out;
}

/// Sheets on random edges.
void add_fins(Draft& draft, Dice& dice) {
  const double size = size_of(draft);
  for (Index n = dice.from(1, kFew); n > 0; --n) {
    const Face face = any_face(draft, dice);
    const Vec3 middle = (draft.positions[face[0]] + draft.positions[face[1]]) / 2;
    const Index tip = draft.add(middle + dice.between(0.02, 0.4) * size * dice.in_cube());
    draft.faces.push_back(turned({face[0], face[1], tip}, dice));
  }
}

/// Two vertices become one.
void pinch(Draft& draft, Dice& dice) {
  for (Index n = dice.from(1, 2); n > 0; --n) {
    const Index kept = any_corner(draft, dice), gone = any_corner(draft, dice);
    for (Face& face : draft.faces) std::ranges::replace(face, gone, kept);
  }
}

void turn_faces(Draft& draft, Dice& dice) {
  const double share = dice.between(0.05, 0.6);
  for (Face& face : draft.faces) {
    if (dice.chance(share)) std::swap(face[1], face[2]);
  }
}

void repeat_faces(Draft& draft, Dice& dice) {
  for (Index n = dice.from(1, 3 * kFew); n > 0; --n) {
    draft.faces.push_back(turned(any_face(draft, dice), dice));
  }
}

void repeat_corners(Draft& draft, Dice& dice) {
  for (Index n = dice.from(1, kFew); n > 0; --n) {
    const Index a = any_corner(draft, dice), b = any_corner(draft, dice);
    draft.faces.push_back(turned({a, b, dice.chance(0.2) ? b : a}, dice));
  }
}

/// A point on a side cuts one of its faces, and a face without area closes the gap to the other.
void close_t_junctions(Draft& draft, Dice& dice) {
  for (Index n = dice.from(1, kFew); n > 0; --n) {
    const auto f = static_cast<std::size_t>(dice.below(draft.faces.size()));
    const auto [a, b, c] = draft.faces[f];
    const double at = dice.chance(0.5) ? 0.5 : dice.unit();
    const Index m = draft.add((1 - at) * draft.positions[a] + at * draft.positions[b]);
    draft.faces[f] = {a, m, c};
    draft.faces.insert(draft.faces.end(), {{m, b, c}, {a, b, m}});
  }
}

/// Faces get a point that nearly lies on a side, in its middle (caps) or close to its end
/// (needles).
void add_slivers(Draft& draft, Dice& dice) {
  for (Index n = dice.from(1, 2 * kFew); n > 0; --n) {
    const auto f = static_cast<std::size_t>(dice.below(draft.faces.size()));
    const auto [a, b, c] = draft.faces[f];
    const double height = dice.power(-12, -1);
    const double along = dice.chance(0.5) ? dice.between(0.3, 0.7) : dice.power(-12, -1);
    const Vec3 base = (1 - along) * draft.positions[a] + along * draft.positions[b];
    const Index p = draft.add((1 - height) * base + height * draft.positions[c]);
    draft.faces[f] = {a, b, p};
    draft.faces.insert(draft.faces.end(), {{b, c, p}, {c, a, p}});
  }
}

/// Some faces at a vertex get a copy of it, in the same place or nearly so.
void crack(Draft& draft, Dice& dice) {
  const double size = size_of(draft);
  for (Index n = dice.from(1, 3 * kFew); n > 0; --n) {
    const Index v = any_corner(draft, dice);
    const double gap = dice.chance(0.5) ? 0 : dice.power(-12, -2) * size;
    const Index copy = draft.add(draft.positions[v] + gap * dice.in_cube());
    for (Face& face : draft.faces) {
      if (dice.chance(0.5)) std::ranges::replace(face, v, copy);
    }
  }
}

/// Vertices move to the place of others.
void collapse(Draft& draft, Dice& dice) {
  for (Index n = dice.from(1, kFew); n > 0; --n) {
    const Face face = any_face(draft, dice);
    const Index to = dice.chance(0.7) ? face[1] : any_corner(draft, dice);
    draft.positions[face[0]] = draft.positions[to];
  }
}

void strew_vertices(Draft& draft, Dice& dice) {
  const double size = size_of(draft) * dice.power(-1, 3);
  const Index shift = dice.from(1, kFew);
  std::vector<Vec3> first(static_cast<std::size_t>(shift));
  for (Vec3& p : first) p = size * dice.in_cube();
  draft.positions.insert(draft.positions.begin(), first.begin(), first.end());
  for (Face& face : draft.faces) {
    for (Index& corner : face) corner += shift;
  }
}

void cut_holes(Draft& draft, Dice& dice) {
  const double share = dice.between(0.05, 0.4);
  std::vector<Face> kept;
  for (const Face& face : draft.faces) {
    if (!dice.chance(share)) kept.push_back(face);
  }
  if (!kept.empty()) draft.faces = std::move(kept);
}

/// Vertices far from where they were: faces cross, and some are long.
void displace(Draft& draft, Dice& dice) {
  const double size = size_of(draft);
  for (Index n = dice.from(1, kFew); n > 0; --n) {
    draft.positions[any_corner(draft, dice)] += dice.between(0.1, 1) * size * dice.in_cube();
  }
}

/// A copy of what is there, or some faces, of another scale: a component of its own.
void add_component(Draft& draft, Dice& dice) {
  const double scale = dice.chance(0.3) ? 1 : dice.power(-4, 4);
  Draft other = draft.faces.size() < 80 ? draft : sphere(0);
  const double size = size_of(draft), other_size = size_of(other);
  if (!(size > 0) || !(other_size > 0)) return;
  for (Vec3& p : other.positions) p = p / other_size * size * scale + size * dice.in_cube();
  append(draft, other);
}

void throw_faces(Draft& draft, Dice& dice) { add_soup(draft, dice, dice.from(1, kFew)); }

constexpr MeshDefect kDefects[] = {
    {"fins", add_fins},
    {"pinch", pinch},
    {"turned faces", turn_faces},
    {"repeated faces", repeat_faces},
    {"repeated corners", repeat_corners},
    {"closed t-junctions", close_t_junctions},
    {"slivers", add_slivers},
    {"cracks", crack},
    {"collapsed edges", collapse},
    {"strewn vertices", strew_vertices},
    {"holes", cut_holes},
    {"displaced vertices", displace},
    {"component", add_component},
    {"thrown faces", throw_faces},
};

}  // namespace

std::span<const MeshDefect> mesh_defects() { return kDefects; }

void add_soup(Draft& draft, Dice& dice, Index count) {
  for (; count > 0; --count) {
    Face face{};
    for (Index& corner : face) corner = dice.below(draft.positions.size());
    draft.faces.push_back(face);
  }
}

double size_of(const Draft& draft) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : draft.positions) box.extend(p);
  return box.diagonal().norm();
}

}  // namespace geotherm::test
