// SPDX-License-Identifier: MIT
// Poisson systems by PETSc, windows of conjugate gradients and their multigrid. What all backends
// must do, and that their distances agree, is tested for the registry.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/linear/mpi_module.h"
#include "solver/linear/multigrid.h"
#include "solver/linear/window_solver.h"
#include "tests/linear/backend_fixture.h"

namespace geotherm::test {
namespace {

constexpr double kAgree = 1e-9;

class Petsc : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_mpi_module()) GTEST_SKIP() << "built without PETSc and MPI";
  }
};

TEST(PetscRegistry, ListsTheBackendWhereItsLibraryIsAndSaysOtherwiseWhatToInstall) {
  const std::vector<std::string> names = backend_names();
  EXPECT_EQ(std::ranges::count(names, "petsc"), has_mpi_module() ? 1 : 0);
  const auto backend = find_backend("petsc");
  EXPECT_EQ(backend.has_value(), has_mpi_module());
  if (backend) return;
  EXPECT_NE(sentence(backend.error()).find("geotherm-mpi"), std::string::npos);
}

TEST_F(Petsc, TakesFewIterationsForPoissonOnStretchedMeshes) {
  constexpr int kMaxIterations = 40;  // to 1e-12, of a mesh stretched ten times
  const MeshPtr mesh = finish(plane_grid(120, 120, 1200, 120));
  const DistanceResult answer = solve(mesh, {0}, with_backend("petsc"));
  EXPECT_GT(answer.quality.iterations_poisson, 0);
  EXPECT_LE(answer.quality.iterations_poisson, kMaxIterations);
  EXPECT_EQ(answer.quality.iterations_heat, 0);
  EXPECT_LE(
      relative_difference(answer.distances, solve(mesh, {0}, with_backend("native")).distances),
      kAgree);
}

TEST_F(Petsc, IsRightInComponentsOfAnySize) {
  Draft draft = plane_grid(20, 20, 1, 1);
  append(draft, transformed(sphere(3), 1e-7, {3, 0, 0}, false));
  append(draft, transformed(torus(30, 20, 0.4), 1e6, {0, 0, 1e7}, false));
  const MeshPtr mesh = finish(draft);
  const Index sphere_vertex = 441, torus_vertex = mesh->vertex_count() - 1;
  const auto native = solve(mesh, {0, sphere_vertex, torus_vertex}, with_backend("native"));
  const auto petsc = solve(mesh, {0, sphere_vertex, torus_vertex}, with_backend("petsc"));
  const auto part = [&](const DistanceResult& answer, Index begin, Index end) {
    return std::span(answer.distances).subspan(begin, end - begin);
  };
  const Index third = mesh->vertex_count() - 600;
  for (const auto& [begin, end] :
       std::vector<std::pair<Index, Index>>{{0, 441}, {441, third}, {third, torus_vertex + 1}}) {
    EXPECT_LE(relative_difference(part(petsc, begin, end), part(native, begin, end)), kAgree);
  }
}

TEST(MultigridLevels, TakeInTheNeighboursOfAHub) {
  // Right angles at the hub: neighbours along the rim are not coupled, each with the hub alone.
  constexpr int kValence = 3000;
  for (const bool hub_first : {true, false}) {
    Draft draft;
    if (hub_first) draft.add({0, 0, 0});
    const auto begin = static_cast<Index>(draft.positions.size());
    for (int i = 0; i < kValence; ++i) {
      const double turn = i * 1e-3, up = i % 2 == 0 ? 1 : -1;
      draft.add({std::cos(turn), std::sin(turn), up});
      const Index hub = hub_first ? 0 : kValence;
      if (i > 0) draft.faces.push_back({begin + i - 1, begin + i, hub});
    }
    if (!hub_first) draft.add({0, 0, 0});
    const Analysed surface = analysed(*finish(draft), backend_named("cg"));
    const FemOperator poisson(surface.operators, 1, 1000);
    EXPECT_NE(Multigrid::build(poisson), nullptr) << (hub_first ? "first" : "last");
  }
}

TEST(Windows, HaveTheAnswersOfTheWholeMatrix) {
  // A strip of a window's width: what is far from the support is beyond any tolerance.
  const Backend& native = backend_named("native");
  const Analysed surface = analysed(*finish(plane_grid(3000, 3, 3000, 3)), native);
  for (const double t : {0.3, 1.0, 20.0}) {
    const auto matrix = std::make_shared<FemOperator>(surface.operators, 1, t);
    const WindowSolver windows(*matrix, *matrix);
    const std::vector<Index> support = {5, 6000, 6001};
    Block b = Block::Zero(matrix->size(), 2);
    b(5, 0) = b(6000, 0) = 1;
    b(6001, 1) = 3;
    const Block expected = solved(*factored(*surface.analysis, matrix), b);
    for (const Eigen::Index column : {0, 1}) {
      EXPECT_GT(windows.solve(b, column, support, 1e-13, 2000), 0) << t;
    }
    EXPECT_LE(relative_difference(values(b), values(expected)), 1e-12) << t;
  }
}

TEST(Windows, AreLeftWhereTheyWouldBeMostOfTheMatrix) {
  const Analysed surface = analysed(*finish(plane_grid(20, 20, 20, 20)), backend_named("native"));
  const auto matrix = std::make_shared<FemOperator>(surface.operators, 1, 1);
  Block b = Block::Zero(matrix->size(), 1);
  b(7, 0) = 2;
  const Block before = b;
  const std::vector<Index> support = {7};
  EXPECT_EQ(WindowSolver(*matrix, *matrix).solve(b, 0, support, 1e-13, 2000), 0);
  EXPECT_EQ(b, before);
}

TEST(Windows, LetConjugateGradientsReachThousandsOfEdges) {
  const MeshPtr mesh = finish(plane_grid(2500, 3, 2500, 3));
  const auto native = solve(mesh, {0}, with_backend("native"));
  const auto cg = solve(mesh, {0}, with_backend("cg"));
  EXPECT_EQ(cg.backend, "cg");
  EXPECT_LE(relative_difference(cg.distances, native.distances), 1e-6);
}

}  // namespace
}  // namespace geotherm::test
