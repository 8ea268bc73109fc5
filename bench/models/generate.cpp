// SPDX-License-Identifier: MIT
#include "bench/models/generate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "bench/models/draft_mesh.h"

namespace geotherm {
namespace {

struct Maker {
  std::string_view name;
  Result<generate::DraftMesh> (*make)(Index faces, const Progress& progress);
};
constexpr Maker kMakers[] = {{"terrain", generate::make_terrain},
                             {"sleeve", generate::make_sleeve},
                             {"cube", generate::make_cube},
                             {"gargoyle", generate::make_gargoyle},
                             {"bunny", generate::make_bunny}};

std::string all_names() {
  std::string names;
  for (const Maker& maker : kMakers) {
    names += (names.empty() ? "" : ", ") + std::string(maker.name);
  }
  return names;
}

}  // namespace

Result<TriangleMesh> generate_model(std::string_view name, Index faces, const Progress& progress) {
  const auto* const maker = std::ranges::find(kMakers, name, &Maker::name);
  if (maker == std::end(kMakers)) {
    return Error{ErrorCode::kNotAvailable, "there is no bundled model \"" + std::string(name) +
                                               "\"; there are " + all_names()};
  }
  if (faces < kMinModelFaces || faces > kMaxModelFaces) {
    return Error{ErrorCode::kBadInput,
                 std::to_string(faces) + " faces were asked for; the model \"" + std::string(name) +
                     "\" can have " + std::to_string(kMinModelFaces) + " to " +
                     std::to_string(kMaxModelFaces)};
  }
  Result<generate::DraftMesh> made = maker->make(faces, progress);
  if (!made) return made.error();
  return TriangleMesh::build(std::move(made->positions), std::move(made->faces));
}

std::vector<Vec3> waving(const TriangleMesh& mesh, double phase) {
  constexpr double kHeight = 0.08;  // of the box's longest side
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.positions()) box.extend(p);
  Eigen::Index along = 0;
  const double length = box.sizes().maxCoeff(&along);
  const Eigen::Index first = (along + 1) % 3, second = (along + 2) % 3;
  std::vector<Vec3> moved(mesh.positions().begin(), mesh.positions().end());
  if (!(length > 0)) return moved;
  for (Vec3& p : moved) {
    const double angle = 2 * std::numbers::pi * (p[along] - box.min()[along]) / length - phase;
    p[first] += kHeight * length * std::sin(angle);
    p[second] += kHeight * length * std::cos(angle);
  }
  return moved;
}

}  // namespace geotherm
