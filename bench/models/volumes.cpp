// SPDX-License-Identifier: MIT
#include "bench/models/volumes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace geotherm {
namespace {

/// Turns the tet to be positive.
Tet turned(const std::vector<Vec3>& positions, Tet tet) {
  const auto edge = [&](std::size_t k) -> Vec3 { return positions[tet[k]] - positions[tet[0]]; };
  if (edge(1).dot(edge(2).cross(edge(3))) < 0) std::swap(tet[2], tet[3]);
  return tet;
}

TetMesh built(std::vector<Vec3> positions, std::vector<Tet> tets) {
  for (Tet& tet : tets) tet = turned(positions, tet);
  return *TetMesh::build(std::move(positions), std::move(tets));
}

/// A point of a sector: how many steps from the centre towards each of the sector's three corners.
using Steps = std::array<int, 3>;

class BallMaker {
 public:
  explicit BallMaker(int layers) : layers_(layers) {
    // Three golden rectangles; neighbours are at distance 2.
    const double golden = (1 + std::sqrt(5.0)) / 2;
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-golden, golden}) {
        corners_.insert(corners_.end(), {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)});
      }
    }
    positions_.emplace_back(Vec3::Zero());
    places_.emplace(0, 0);
  }

  TetMesh make() && {
    for (int layer = 1; layer <= layers_; ++layer) {
      for_each_sector([this, layer] { add_layer(layer); });
    }
    return built(std::move(positions_), std::move(tets_));
  }

 private:
  template <class Use>
  void for_each_sector(const Use& use) {
    const auto near = [this](int a, int b) { return (corners_[a] - corners_[b]).norm() < 2.1; };
    for (int a = 0; a < 12; ++a) {
      for (int b = a + 1; b < 12; ++b) {
        for (int c = b + 1; c < 12; ++c) {
          if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
          sector_ = {a, b, c};
          use();
        }
      }
    }
  }

  /// The vertex at these steps. Sectors share those on their sides: the key has the corners with
  /// steps towards them alone.
  Index vertex(const Steps& steps) {
    std::uint64_t key = 0;
    Vec3 sum = Vec3::Zero();
    int shell = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (steps[k] == 0) continue;
      key = key << 20 | static_cast<std::uint64_t>(sector_[k] << 16 | steps[k]);
      sum += steps[k] * corners_[sector_[k]];
      shell += steps[k];
    }
    const auto [at, fresh] = places_.try_emplace(key, static_cast<Index>(positions_.size()));
    if (fresh) positions_.emplace_back(sum.normalized() * shell / layers_);
    return at->second;
  }

  /// The regular subdivision of the sector, which is a tet, has in each layer upright tets, between
  /// them octahedra, each cut into four along its shortest diagonal, and inverted tets.
  void add_layer(int layer) {
    for (int i = 0; i < layer; ++i) {
      for (int j = 0; i + j < layer; ++j) {
        const int rest = layer - 1 - i - j;
        add_upright({i, j, rest});
        if (rest >= 1) add_octahedron({i, j, rest - 1});
        if (rest >= 2) add_inverted({i, j, rest - 2});
      }
    }
  }

  void add_upright(const Steps& s) {
    tets_.push_back({vertex(s), vertex({s[0] + 1, s[1], s[2]}), vertex({s[0], s[1] + 1, s[2]}),
                     vertex({s[0], s[1], s[2] + 1})});
  }

  void add_inverted(const Steps& s) {
    tets_.push_back({vertex({s[0] + 1, s[1] + 1, s[2] + 1}), vertex({s[0], s[1] + 1, s[2] + 1}),
                     vertex({s[0] + 1, s[1], s[2] + 1}), vertex({s[0] + 1, s[1] + 1, s[2]})});
  }

  void add_octahedron(const Steps& s) {
    std::array<Index, 3> inner, outer;  // opposite ones have the same number
    for (std::size_t k = 0; k < 3; ++k) {
      Steps in = s, out = {s[0] + 1, s[1] + 1, s[2] + 1};
      ++in[k];
      --out[k];
      inner[k] = vertex(in);
      outer[k] = vertex(out);
    }
    const auto length = [&](std::size_t k) {
      return (positions_[inner[k]] - positions_[outer[k]]).norm();
    };
    std::size_t k = 0;
    for (const std::size_t other : {1U, 2U}) {
      if (length(other) < length(k) * (1 - 1e-9)) k = other;
    }
    const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
    const std::array<Index, 4> ring = {inner[p], inner[q], outer[p], outer[q]};
    for (std::size_t i = 0; i < 4; ++i) {
      tets_.push_back({inner[k], outer[k], ring[i], ring[(i + 1) % 4]});
    }
  }

  int layers_;
  std::vector<Vec3> corners_;
  std::array<int, 3> sector_{};
  std::vector<Vec3> positions_;
  std::unordered_map<std::uint64_t, Index> places_;
  std::vector<Tet> tets_;
};

/// Cells of about the same size in each direction.
TetMesh make_box_of(Index tets) {
  const Vec3 size(2, 1.5, 1);
  const double side = std::cbrt(6 * size.prod() / tets);
  const auto cells = [side](double length) {
    return std::max<Index>(1, static_cast<Index>(std::lround(length / side)));
  };
  return make_box_tets(cells(size.x()), cells(size.y()), cells(size.z()), size);
}

TetMesh make_ball_of(Index tets) {
  return make_ball_tets(
      std::max<Index>(1, static_cast<Index>(std::lround(std::cbrt(tets / 20.0)))));
}

struct VolumeMaker {
  std::string_view name;
  TetMesh (*make)(Index tets);
};
constexpr VolumeMaker kVolumeMakers[] = {{"box-tets", make_box_of}, {"ball-tets", make_ball_of}};

}  // namespace

std::vector<std::string> volume_names() {
  std::vector<std::string> names;
  for (const VolumeMaker& maker : kVolumeMakers) names.emplace_back(maker.name);
  return names;
}

bool is_volume_name(std::string_view name) {
  return std::ranges::find(kVolumeMakers, name, &VolumeMaker::name) != std::end(kVolumeMakers);
}

Result<TetMesh> generate_volume(std::string_view name, Index tets) {
  const auto* const maker = std::ranges::find(kVolumeMakers, name, &VolumeMaker::name);
  if (maker == std::end(kVolumeMakers)) {
    return Error{ErrorCode::kNotAvailable,
                 "there is no volume \"" + std::string(name) + "\"; there are box-tets, ball-tets"};
  }
  if (tets < kMinVolumeTets || tets > kMaxVolumeTets) {
    return Error{ErrorCode::kBadInput,
                 std::to_string(tets) + " tetrahedra were asked for; a volume can have " +
                     std::to_string(kMinVolumeTets) + " to " + std::to_string(kMaxVolumeTets)};
  }
  return maker->make(tets);
}

TetMesh make_box_tets(Index nx, Index ny, Index nz, const Vec3& size) {
  std::vector<Vec3> positions;
  for (Index z = 0; z <= nz; ++z) {
    for (Index y = 0; y <= ny; ++y) {
      for (Index x = 0; x <= nx; ++x) {
        positions.emplace_back(size.x() * x / nx, size.y() * y / ny, size.z() * z / nz);
      }
    }
  }
  const std::array<Index, 3> stride = {1, nx + 1, (nx + 1) * (ny + 1)};
  std::vector<Tet> tets;
  tets.reserve(static_cast<std::size_t>(nx) * ny * nz * 6);
  for (Index z = 0; z < nz; ++z) {
    for (Index y = 0; y < ny; ++y) {
      for (Index x = 0; x < nx; ++x) {
        const Index corner = x + stride[1] * y + stride[2] * z;
        std::array<int, 3> axes = {0, 1, 2};  // a way along three edges to the opposite corner
        do {
          const Index second = corner + stride[axes[0]], third = second + stride[axes[1]];
          tets.push_back({corner, second, third, third + stride[axes[2]]});
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  return built(std::move(positions), std::move(tets));
}

TetMesh make_ball_tets(Index layers) { return BallMaker(layers).make(); }

}  // namespace geotherm
