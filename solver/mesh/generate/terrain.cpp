// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "solver/mesh/generate/erosion.h"
#include "solver/mesh/generate/models.h"
#include "solver/mesh/generate/noise.h"
#include "solver/mesh/generate/relax.h"

namespace geotherm::generate {
namespace {

// Rivers are carved on a grid of this side whatever the size of the mesh, so that more faces show
// the same mountains.
constexpr int kSide = 144;
constexpr int kEpochs = 8;
constexpr int kRoundsPerEpoch = 12;

/// The landscape as a function: the eroded grid, and rock too fine for it.
class Landscape {
 public:
  Landscape() : grid_{kSide, 2.0 / (kSide - 1), {}}, uplift_(kSide * kSide) {
    grid_.heights.resize(uplift_.size());
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const Vec3 p(grid_.step * column - 1, 0, grid_.step * row - 1);
        const Vec3 bent = p + 0.22 * Vec3(gradient_noise(1.7 * p + Vec3(0, 3.5, 0), 31), 0,
                                          gradient_noise(1.7 * p + Vec3(0, 7.5, 0), 32));
        const double edge = std::pow(std::pow(p.x(), 4) + std::pow(p.z(), 4), 0.25);
        const double ridges = ridged_noise(1.35 * bent + Vec3(0.3, 0.4, 0.9), 5, 21);
        const double hills = fractal_noise(1.9 * p + Vec3(0, 0.5, 0), 4, 25);
        grid_.at(column, row) = 0.07 * hills + 0.06 * ridges;
        // The range runs across the square in a bow; foothills around it.
        const double off = bent.z() + 0.10 - 0.35 * bent.x() * bent.x() - 0.25 * bent.x();
        const double range = std::exp(-off * off / 0.22);
        uplift_[grid_.index(column, row)] =
            0.0062 * (0.20 + 0.50 * range + 0.55 * ridges) * (1 - smooth_step(0.65, 1.12, edge));
      }
    }
  }

  void erode_epoch() { erode(grid_, uplift_, 0.11, 1.0, kRoundsPerEpoch); }

  double height(double x, double z) const {
    const double ground = grid_.interpolate((x + 1) / grid_.step, (z + 1) / grid_.step);
    const Vec3 p(x, 0.31, z);
    const double rock = ridged_noise(7 * p, 3, 41) - 0.5;
    return ground + 0.05 * smooth_step(0.03, 0.4, ground) * rock;
  }

 private:
  HeightGrid grid_;
  std::vector<double> uplift_;
};

/// A grid of `columns` x `rows` squares whose inner points are shifted at random.
DraftMesh shaken_grid(int columns, int rows, const Landscape& land) {
  DraftMesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const bool inner_x = i > 0 && i < columns;
      const bool inner_z = j > 0 && j < rows;
      const double x = i + (inner_x ? 0.6 * (hash_unit(i, j, 0, 51) - 0.5) : 0);
      const double z = j + (inner_z ? 0.6 * (hash_unit(i, j, 1, 51) - 0.5) : 0);
      const Vec3 p(2 * x / columns - 1, 0, 2 * z / rows - 1);
      mesh.positions.emplace_back(p.x(), land.height(p.x(), p.z()), p.z());
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Index a = j * (columns + 1) + i;
      const Index b = a + 1;
      const Index c = a + columns + 1;
      const Index d = c + 1;
      if ((i + j) % 2 == 0) {
        mesh.faces.push_back({a, c, d});
        mesh.faces.push_back({a, d, b});
      } else {
        mesh.faces.push_back({a, c, b});
        mesh.faces.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

}  // namespace

Result<DraftMesh> make_terrain(Index faces, const Progress& progress) {
  Landscape land;
  for (int epoch = 0; epoch < kEpochs; ++epoch) {
    if (!report(progress, "eroding", static_cast<double>(epoch) / kEpochs)) {
      return Error{ErrorCode::kCancelled, "making the model was cancelled"};
    }
    land.erode_epoch();
  }
  const int columns = static_cast<int>(std::lround(std::sqrt(faces / 2.0)));
  const int rows = static_cast<int>(std::lround(faces / (2.0 * columns)));
  DraftMesh mesh = shaken_grid(columns, rows, land);
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    if (!report(progress, "smoothing", static_cast<double>(round) / kRounds)) {
      return Error{ErrorCode::kCancelled, "making the model was cancelled"};
    }
    relax(mesh, 1, [&](Index v, const Vec3& target, const Vec3&) -> Vec3 {
      const int i = v % (columns + 1);
      const int j = v / (columns + 1);
      if (i == 0 || j == 0 || i == columns || j == rows) {
        return mesh.positions[static_cast<std::size_t>(v)];
      }
      return {target.x(), land.height(target.x(), target.z()), target.z()};
    });
  }
  return mesh;
}

}  // namespace geotherm::generate
