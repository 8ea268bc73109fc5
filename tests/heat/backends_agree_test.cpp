// SPDX-License-Identifier: MIT
// The same distances from every backend, whatever the options. Judged by the distance: a residual
// says nothing about the far field.
#include <gtest/gtest.h>

#include <functional>
#include <tuple>

#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// The tolerance is a share of the largest distance: what is promised.
constexpr double kDirect = 1e-9;
constexpr double kIterative = 1e-6;

struct OptionCase {
  const char* name;
  void (*set)(HeatOptions&);
};

const OptionCase kOptions[] = {
    {"default", [](HeatOptions&) {}},
    {"classic", [](HeatOptions& o) { o.variant = Variant::kClassic; }},
    {"small_time", [](HeatOptions& o) { o.time_step.factor = 0.3; }},
    {"large_time", [](HeatOptions& o) { o.time_step.factor = 20; }},
    {"mean_face_area", [](HeatOptions& o) { o.time_step.rule = TimeRule::kMeanFaceArea; }},
    {"absolute_time",
     [](HeatOptions& o) {
       o.time_step = {TimeRule::kAbsolute, 1, 0.003};
     }},
    {"diffuse", [](HeatOptions& o) { o.heat = HeatMode::kDiffuse; }},
    {"hold", [](HeatOptions& o) { o.heat = HeatMode::kHold; }},
    {"dirichlet", [](HeatOptions& o) { o.boundary = BoundaryRule::kDirichlet; }},
    {"average", [](HeatOptions& o) { o.boundary = BoundaryRule::kAverage; }},
    {"pin_vertex", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPinVertex; }},
    {"penalty", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPenalty; }},
    {"conserve_energy",
     [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kConserveEnergy; }},
    {"pseudo_inverse", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPseudoInverse; }},
    {"hold_dirichlet_pseudo_inverse",
     [](HeatOptions& o) {
       o.heat = HeatMode::kHold;
       o.boundary = BoundaryRule::kDirichlet;
       o.constraint.mode = ConstraintMode::kPseudoInverse;
     }},
    {"cotan", [](HeatOptions& o) { o.laplacian = LaplacianKind::kCotan; }},
    {"refined", [](HeatOptions& o) { o.precision = Precision::kRefined; }},
    {"refined_hold_average",
     [](HeatOptions& o) {
       o.precision = Precision::kRefined;
       o.heat = HeatMode::kHold;
       o.boundary = BoundaryRule::kAverage;
     }},
};

void PrintTo(const OptionCase& c, std::ostream* out) { *out << c.name; }

using AgreementCase = std::tuple<ZooMesh, OptionCase>;

class BackendsAgree : public testing::TestWithParam<AgreementCase> {};

TEST_P(BackendsAgree, OnTheDistance) {
  const MeshPtr mesh = std::get<0>(GetParam()).mesh();
  HeatOptions options;
  std::get<1>(GetParam()).set(options);
  const std::vector<Index> sources = {3, mesh->vertex_count() / 3, mesh->vertex_count() / 2};
  const auto reference = solve(mesh, sources, with_backend(direct_backends().front(), options));
  for (const std::string& name : direct_backends()) {
    EXPECT_LE(relative_difference(solve(mesh, sources, with_backend(name, options)).distances,
                                  reference.distances),
              kDirect)
        << name;
  }
  for (const std::string& name : iterative_backends()) {
    EXPECT_LE(relative_difference(solve(mesh, sources, with_backend(name, options)).distances,
                                  reference.distances),
              kIterative)
        << name;
  }
}

std::vector<ZooMesh> meshes() {
  std::vector<ZooMesh> out;
  for (const ZooMesh& mesh : zoo()) {
    for (const std::string name : {"jittered_plane", "torus", "two_components", "fin", "caps"}) {
      if (name == mesh.name) out.push_back(mesh);
    }
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Zoo, BackendsAgree,
                         testing::Combine(testing::ValuesIn(meshes()), testing::ValuesIn(kOptions)),
                         [](const auto& each) {
                           return std::string(std::get<0>(each.param).name) + "_" +
                                  std::get<1>(each.param).name;
                         });

}  // namespace
}  // namespace geotherm::test
