// SPDX-License-Identifier: MIT
#include "tests/support/broken_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/support/mesh_defects.h"

namespace geotherm::test {
namespace {

Draft one_triangle(Dice& dice) {
  Draft draft;
  for (int k = 0; k < 3; ++k) draft.add(dice.in_cube());
  draft.faces = {{0, 1, 2}};
  return draft;
}

/// Triangles that have one vertex in common, and no edge.
Draft pinwheel(Dice& dice) {
  Draft draft;
  draft.add(Vec3::Zero());
  for (Index n = dice.from(2, 6); n > 0; --n) {
    const Index a = draft.add(dice.in_cube()), b = draft.add(dice.in_cube());
    draft.faces.push_back({0, a, b});
  }
  return draft;
}

/// A tube that closes on itself from the inside.
Draft klein_bottle(Dice& dice) {
  const Index around = dice.from(5, 9), across = dice.from(4, 7);
  Draft draft;
  for (Index i = 0; i < around; ++i) {
    for (Index j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double side = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      const double up = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
      draft.add({(2 + side) * std::cos(u), (2 + side) * std::sin(u), up});
    }
  }
  const auto at = [=](Index i, Index j) {
    // The end meets the start turned over: v becomes -v.
    return i < around ? i * across + j % across : (across - j % across) % across;
  };
  for (Index i = 0; i < around; ++i) {
    for (Index j = 0; j < across; ++j) {
      const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      draft.faces.insert(draft.faces.end(), {{a, b, c}, {a, c, d}});
    }
  }
  return draft;
}

/// Pages that share the edges of a spine.
Draft book(Dice& dice) {
  const Index pages = dice.from(3, 6), n = dice.from(2, 4);
  Draft draft;
  for (Index j = 0; j <= n; ++j) draft.add({0, static_cast<double>(j) / n, 0});
  for (Index p = 0; p < pages; ++p) {
    const double angle = 2 * std::numbers::pi * (p + dice.between(0, 0.9)) / pages;
    const Index first = draft.vertex_count();
    for (Index j = 0; j <= n; ++j) {
      draft.add({std::cos(angle) / n, static_cast<double>(j) / n, std::sin(angle) / n});
    }
    for (Index j = 0; j < n; ++j) {
      draft.faces.insert(draft.faces.end(),
                         {{j, first + j, j + 1}, {first + j, first + j + 1, j + 1}});
    }
  }
  return draft;
}

Draft soup(Dice& dice) {
  Draft draft;
  for (Index n = dice.from(4, 12); n > 0; --n) draft.add(dice.in_cube());
  draft.faces = {{0, 1, 2}};
  add_soup(draft, dice, dice.from(4, 30));
  return draft;
}

/// Moves every vertex by up to a share of the size.
Draft shaken(Draft draft, Dice& dice) {
  const double by = dice.chance(0.5) ? 0 : 0.05 * size_of(draft);
  for (Vec3& p : draft.positions) p += by * dice.in_cube();
  return draft;
}

struct Shape {
  const char* name;
  Draft (*draft)(Dice& dice);
};

Index some(Dice& dice, Index low, Index high) { return dice.from(low, high); }

/// The first four are no surfaces to measure accuracy on.
constexpr Shape kShapes[] = {
    {"one triangle", one_triangle},
    {"pinwheel", pinwheel},
    {"soup", soup},
    {"book", book},
    {"grid",
     [](Dice& dice) {
       return shaken(plane_grid(some(dice, 1, 8), some(dice, 1, 8), dice.power(-1, 1), 1), dice);
     }},
    {"irregular plane",
     [](Dice& dice) {
       return jittered_plane(some(dice, 3, 9), 0.3, static_cast<unsigned>(dice.below(1000)));
     }},
    {"sphere", [](Dice& dice) { return shaken(sphere(static_cast<int>(dice.below(2))), dice); }},
    {"torus",
     [](Dice& dice) {
       return shaken(torus(some(dice, 5, 12), some(dice, 4, 7), dice.between(0.2, 0.7)), dice);
     }},
    {"prism",
     [](Dice& dice) { return prism(some(dice, 3, 10), some(dice, 1, 8), dice.between(0.2, 2)); }},
    {"Moebius strip",
     [](Dice& dice) { return shaken(moebius(some(dice, 7, 20), some(dice, 1, 4)), dice); }},
    {"Klein bottle", klein_bottle},
};
constexpr std::size_t kFirstSurface = 4;

std::string place(Draft& draft, Dice& dice) {
  const double scale = dice.power(-9, 9);
  const double size = size_of(draft) * scale;
  const double away = dice.chance(0.5) ? 0 : dice.power(-1, 6);
  draft = transformed(draft, scale, away * size * dice.in_cube(), dice.chance(0.5));
  return ", scale " + std::to_string(std::log10(scale)) + " decades, " + std::to_string(away) +
         " sizes away";
}

}  // namespace

BrokenMesh broken_mesh(std::uint64_t seed, const Breakage& how) {
  Dice dice(seed);
  const std::size_t first = how.defects > 0 ? 0 : kFirstSurface;
  const Shape& shape =
      kShapes[first + static_cast<std::size_t>(dice.below(std::size(kShapes) - first))];
  BrokenMesh out{shape.draft(dice), "mesh " + std::to_string(seed) + ": " + shape.name};
  const auto defects = mesh_defects();
  const Index count = how.defects > 0 ? dice.from(how.defects > 1 ? 0 : 1, how.defects) : 0;
  for (Index n = 0; n < count; ++n) {
    const MeshDefect& defect = defects[static_cast<std::size_t>(dice.below(defects.size()))];
    defect.apply(out.draft, dice);
    out.recipe += std::string(", ") + defect.name;
  }
  if (how.placed) out.recipe += place(out.draft, dice);
  return out;
}

}  // namespace geotherm::test
