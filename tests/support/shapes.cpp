// SPDX-License-Identifier: MIT
#include "tests/support/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <utility>

namespace geotherm::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Two triangles for every cell of a grid whose vertices `at(i, j)` numbers.
template <class At>
void add_cells(Draft& draft, Index columns, Index rows, At&& at) {
  for (Index j = 0; j < rows; ++j) {
    for (Index i = 0; i < columns; ++i) {
      const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      draft.faces.push_back({a, b, c});
      draft.faces.push_back({a, c, d});
    }
  }
}

}  // namespace

Index Draft::add(const Vec3& p) {
  positions.push_back(p);
  return vertex_count() - 1;
}

MeshPtr finish(Draft draft) {
  auto mesh = TriangleMesh::build(std::move(draft.positions), std::move(draft.faces));
  assert(mesh);
  return std::make_shared<const TriangleMesh>(std::move(*mesh));
}

void append(Draft& draft, const Draft& other) {
  const Index first = draft.vertex_count();
  draft.positions.insert(draft.positions.end(), other.positions.begin(), other.positions.end());
  for (const Face& f : other.faces)
    draft.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
}

Draft plane_grid(Index nx, Index ny, double width, double height) {
  Draft draft;
  for (Index j = 0; j <= ny; ++j) {
    for (Index i = 0; i <= nx; ++i) draft.add({width * i / nx, height * j / ny, 0});
  }
  add_cells(draft, nx, ny, [nx](Index i, Index j) { return grid_vertex(nx, i, j); });
  return draft;
}

Draft jittered_plane(Index n, double amount, unsigned seed) {
  Draft draft = plane_grid(n, n, 1, 1);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-amount / n, amount / n);
  for (Index j = 1; j < n; ++j) {
    for (Index i = 1; i < n; ++i) {
      Vec3& p = draft.positions[static_cast<std::size_t>(grid_vertex(n, i, j))];
      p.x() += move(random);
      p.y() += move(random);
    }
  }
  for (std::size_t f = 0; f < draft.faces.size(); f += 2) {
    if ((random() & 1U) == 0) continue;
    const auto [a, b, c] = draft.faces[f];
    const Index d = draft.faces[f + 1][2];
    draft.faces[f] = {a, b, d};
    draft.faces[f + 1] = {b, c, d};
  }
  return draft;
}

Draft random_delaunay(Index count, unsigned seed) {
  constexpr double kFar = 1e5;  // the first triangle's corners, which are left out in the end
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Draft out;
  for (Index i = 0; i < count; ++i) {
    const double x = uniform(random), y = uniform(random);
    out.add({x, y, 0});
  }
  for (const Vec3& far : {Vec3(-kFar, -kFar, 0), Vec3(2 * kFar, -kFar, 0), Vec3(0, 2 * kFar, 0)}) {
    out.add(far);
  }
  const auto in_circle = [&](const Face& f, const Vec3& p) {
    Eigen::Matrix3d m;
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = out.positions[f[k]] - p;
      m.row(k) << d.x(), d.y(), d.squaredNorm();
    }
    return m.determinant() > 0;
  };
  std::vector<Face> faces{{count, count + 1, count + 2}};
  for (Index p = 0; p < count; ++p) {
    std::set<std::pair<Index, Index>> hole;
    std::vector<Face> kept;
    for (const Face& f : faces) {
      if (!in_circle(f, out.positions[p])) {
        kept.push_back(f);
        continue;
      }
      for (int k = 0; k < 3; ++k) {
        const Index a = f[k], b = f[(k + 1) % 3];
        if (hole.erase({b, a}) == 0) hole.emplace(a, b);
      }
    }
    for (const auto& [a, b] : hole) kept.push_back({a, b, p});
    faces = std::move(kept);
  }
  for (const Face& f : faces) {
    if (std::max({f[0], f[1], f[2]}) < count) out.faces.push_back(f);
  }
  out.positions.resize(static_cast<std::size_t>(count));
  return out;
}

Draft graded_plane(Index n, double ratio) {
  Draft out = plane_grid(n, n, 1, 1);
  for (Vec3& p : out.positions) {
    for (int axis = 0; axis < 2; ++axis)
      p[axis] = std::expm1(std::log(ratio) * p[axis]) / (ratio - 1);
  }
  return out;
}

Draft graded_book(Index n) {
  Draft draft;
  for (int page = 0; page < 3; ++page) {
    Draft leaf = graded_plane(n, 60);
    const double angle = 2.1 * page;
    for (Vec3& p : leaf.positions) p = {p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()};
    append(draft, leaf);
  }
  const Index leaf = (n + 1) * (n + 1);
  for (Face& face : draft.faces) {
    for (Index& v : face) {
      if (v % leaf % (n + 1) == 0) v %= leaf;  // the spine is the first page's
    }
  }
  return draft;
}

Draft spiky_sphere() {
  Draft draft = sphere(3);
  for (const Index v : {5, 300}) draft.positions[v] *= 15;
  return draft;
}

Draft sphere(int level) {
  Draft draft;
  const double g = std::numbers::phi;
  for (const auto& [x, y] : {std::pair{1.0, g}, {-1.0, g}, {1.0, -g}, {-1.0, -g}}) {
    draft.add({0, x, y});
    draft.add({x, y, 0});
    draft.add({y, 0, x});
  }
  // The faces of an icosahedron are its triples of vertices at distance 2.
  const auto near = [&draft](Index a, Index b) {
    const auto& p = draft.positions;
    return std::abs((p[static_cast<std::size_t>(a)] - p[static_cast<std::size_t>(b)]).norm() - 2) <
           1e-6;
  };
  for (Index a = 0; a < 12; ++a) {
    for (Index b = a + 1; b < 12; ++b) {
      for (Index c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const Vec3 &p = draft.positions[static_cast<std::size_t>(a)],
                   &q = draft.positions[static_cast<std::size_t>(b)],
                   &r = draft.positions[static_cast<std::size_t>(c)];
        const bool outwards = (q - p).cross(r - p).dot(p) > 0;
        draft.faces.push_back(outwards ? Face{a, b, c} : Face{a, c, b});
      }
    }
  }
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto between = [&](Index a, Index b) {
      const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), draft.vertex_count());
      if (fresh) {
        draft.add(draft.positions[static_cast<std::size_t>(a)] +
                  draft.positions[static_cast<std::size_t>(b)]);
      }
      return it->second;
    };
    std::vector<Face> finer;
    for (const auto& [a, b, c] : draft.faces) {
      const Index ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    draft.faces = std::move(finer);
    for (Vec3& p : draft.positions) p.normalize();
  }
  for (Vec3& p : draft.positions) p.normalize();
  return draft;
}

Draft torus(Index around, Index across, double minor) {
  Draft draft;
  for (Index j = 0; j < across; ++j) {
    for (Index i = 0; i < around; ++i) {
      const double u = 2 * kPi * i / around, v = 2 * kPi * j / across;
      const double r = 1 + minor * std::cos(v);
      draft.add({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
    }
  }
  add_cells(draft, around, across,
            [=](Index i, Index j) { return (j % across) * around + i % around; });
  return draft;
}

Draft prism(Index around, Index along, double height) {
  Draft draft;
  const double radius = 0.5 / (around * std::sin(kPi / around));  // sides of length 1 / around
  for (Index j = 0; j <= along; ++j) {
    for (Index i = 0; i < around; ++i) {
      const double u = 2 * kPi * i / around;
      draft.add({radius * std::cos(u), radius * std::sin(u), height * j / along});
    }
  }
  add_cells(draft, around, along, [=](Index i, Index j) { return j * around + i % around; });
  return draft;
}

Draft pyramid(Index sectors, Index rings, double sector_angle) {
  // A corner of ring r stands at r / rings of the way to a corner of the base.
  Draft draft;
  const double radius = std::sin(sector_angle / 2) / std::sin(kPi / sectors);
  const double height = std::sqrt(1 - radius * radius);
  draft.add({0, 0, 0});
  const auto corner = [&](Index s) {
    const double u = 2 * kPi * s / sectors;
    return Vec3(radius * std::cos(u), radius * std::sin(u), -height);
  };
  std::vector<Index> first = {0};
  for (Index r = 1; r <= rings; ++r) {
    first.push_back(draft.vertex_count());
    for (Index s = 0; s < sectors; ++s) {
      for (Index k = 0; k < r; ++k) {
        draft.add((corner(s) * (r - k) + corner(s + 1) * k) / rings);
      }
    }
  }
  const auto at = [&](Index s, Index r, Index k) {
    return r == 0 ? 0 : first[static_cast<std::size_t>(r)] + (s * r + k) % (sectors * r);
  };
  for (Index s = 0; s < sectors; ++s) {
    for (Index r = 0; r < rings; ++r) {
      for (Index k = 0; k <= r; ++k) {
        draft.faces.push_back({at(s, r, k), at(s, r + 1, k), at(s, r + 1, k + 1)});
        if (k < r) draft.faces.push_back({at(s, r, k), at(s, r + 1, k + 1), at(s, r, k + 1)});
      }
    }
  }
  return draft;
}

Draft folded_flat_torus(Index cells, double jitter, unsigned seed) {
  assert(cells % 2 == 0);
  Draft draft;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-jitter / cells, jitter / cells);
  const auto fold = [](double x) { return x <= 0.5 ? x : 1 - x; };
  for (Index j = 0; j < cells; ++j) {
    for (Index i = 0; i < cells; ++i) {
      const double dx = move(random), dy = move(random);
      const double x = static_cast<double>(i) / cells + (i % (cells / 2) == 0 ? 0 : dx);
      const double y = static_cast<double>(j) / cells + (j % (cells / 2) == 0 ? 0 : dy);
      draft.add({fold(x), fold(y), 0});
    }
  }
  add_cells(draft, cells, cells, [=](Index i, Index j) { return (j % cells) * cells + i % cells; });
  return draft;
}

Draft moebius(Index around, Index across) {
  Draft draft;
  for (Index i = 0; i < around; ++i) {
    for (Index j = 0; j <= across; ++j) {
      const double u = 2 * kPi * i / around;
      const double v = 0.6 * (static_cast<double>(j) / across - 0.5);
      const double r = 1 + v * std::cos(u / 2);
      draft.add({r * std::cos(u), r * std::sin(u), v * std::sin(u / 2)});
    }
  }
  add_cells(draft, around, across, [=](Index i, Index j) {
    return i < around ? i * (across + 1) + j : across - j;  // the end meets the start turned over
  });
  return draft;
}

Draft transformed(const Draft& draft, double scale, const Vec3& shift, bool rotate) {
  Draft out = draft;
  const Eigen::Matrix3d rotation =
      rotate ? Eigen::AngleAxisd(1.1, Vec3(0.3, -0.7, 0.5).normalized()).toRotationMatrix()
             : Eigen::Matrix3d::Identity();
  for (Vec3& p : out.positions) p = scale * (rotation * p) + shift;
  return out;
}

Draft renumbered(const Draft& draft, unsigned seed, std::vector<Index>& new_number) {
  std::mt19937 random(seed);
  new_number.resize(draft.positions.size());
  std::iota(new_number.begin(), new_number.end(), 0);
  std::shuffle(new_number.begin(), new_number.end(), random);
  Draft out = draft;
  for (std::size_t v = 0; v < new_number.size(); ++v) {
    out.positions[static_cast<std::size_t>(new_number[v])] = draft.positions[v];
  }
  std::shuffle(out.faces.begin(), out.faces.end(), random);
  for (Face& face : out.faces) {
    for (Index& corner : face) corner = new_number[static_cast<std::size_t>(corner)];
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random() % 3), face.end());
  }
  return out;
}

}  // namespace geotherm::test
