// SPDX-License-Identifier: MIT
// Distances on surfaces whose geodesics are known, under refinement.
//
// The heat method converges when edges shrink faster than the square root of t: with t ~ h (the
// factor m grows like 1 / h) fronts blend over sqrt(t), which leaves a largest error of the order
// h^1/2 at creases and a mean error of the order h, or h^1/2 where creases are not corrected.
// With a fixed factor, t ~ h^2, the direction in which heat decays keeps a share of the lattice's
// own anisotropy, however fine the lattice: the error falls at first, then stays below a per cent.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Exponents of h, measured over two refinements: mean 0.9 to 1.2 (theory 1), largest 0.43 to 1.2
// (theory 1/2 at creases, 1 without), published method's mean 0.56 to 1 (theory 1/2).
constexpr double kMeanRate = 0.75;
constexpr double kLargestRate = 0.35;
constexpr double kClassicMeanRate = 0.45;
// Fixed factor, coarse meshes: measured 0.5 on the square lattice to 1.7 on the sphere.
constexpr double kFixedFactorRate = 0.4;

struct Shape {
  const char* name;
  Draft (*draft)(Index n);
  Index (*source)(Index n);
  double (*exact)(const Draft&, Index n, Index v);
  double within;  ///< errors count up to this distance: a border bends the heat beside it
};

double in_plane(const Draft& draft, Index n, Index v) {
  return (draft.positions[v] - draft.positions[grid_vertex(n, n / 2, n / 2)]).norm();
}
double on_sphere(const Draft& draft, Index /*n*/, Index v) {
  const Vec3 &a = draft.positions[0], &b = draft.positions[v];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}
double on_prism(const Draft& draft, Index n, Index v) {
  const double along = static_cast<double>(v % n) / n;
  return std::hypot(std::min(along, 1 - along), draft.positions[v].z() - 0.5);
}
/// From the corner where both folds meet; the fold keeps distances to it.
double on_flat_torus(const Draft& draft, Index /*n*/, Index v) { return draft.positions[v].norm(); }
double from_apex(const Draft& draft, Index /*n*/, Index v) { return draft.positions[v].norm(); }

Index first_vertex(Index /*n*/) { return 0; }
Index centre(Index n) { return grid_vertex(n, n / 2, n / 2); }
Index half_way_up(Index n) { return n / 2 * n; }
constexpr double kEverywhere = 1e9;

const Shape kShapes[] = {
    {"plane", [](Index n) { return plane_grid(n, n, 1, 1); }, centre, in_plane, 0.4},
    {"irregular_plane", [](Index n) { return jittered_plane(n, 0.3, 7); }, centre, in_plane, 0.4},
    {"sphere", [](Index n) { return sphere(static_cast<int>(std::lround(std::log2(n))) - 2); },
     first_vertex, on_sphere, kEverywhere},
    {"cylinder", [](Index n) { return prism(n, n, 1); }, half_way_up, on_prism, kEverywhere},
    {"flat_torus", [](Index n) { return folded_flat_torus(n, 0.3, 3); }, first_vertex,
     on_flat_torus, kEverywhere},
    {"cone", [](Index n) { return pyramid(5, n / 2, 0.9); }, first_vertex, from_apex, kEverywhere},
};

struct Errors {
  double mean = 0, largest = 0;
};

class Convergence : public testing::TestWithParam<Shape> {
 protected:
  static constexpr Index kCoarse = 16, kFine = 64;
  static constexpr double kRefinements = 2;  // edges are halved twice

  static Errors errors(Index n, HeatOptions options, double factor) {
    const Draft draft = GetParam().draft(n);
    options.time_step.factor = factor;
    const auto d = solve(finish(draft), {GetParam().source(n)}, options).distances;
    Errors out;
    int count = 0;
    for (Index v = 0; v < static_cast<Index>(d.size()); ++v) {
      const double exact = GetParam().exact(draft, n, v);
      if (exact > GetParam().within) continue;
      const double error = std::abs(d[v] - exact);
      out.mean += error;
      out.largest = std::max(out.largest, error);
      ++count;
    }
    out.mean /= count;
    return out;
  }

  /// Exponents of h. `growing`: m = n / kCoarse, so that t ~ h.
  static Errors rates(const HeatOptions& options, bool growing) {
    const Errors coarse = errors(kCoarse, options, 1);
    const Errors fine = errors(kFine, options, growing ? double{kFine} / kCoarse : 1);
    return {std::log2(coarse.mean / fine.mean) / kRefinements,
            std::log2(coarse.largest / fine.largest) / kRefinements};
  }
};

TEST_P(Convergence, IsOfFirstOrderInTheMean) { EXPECT_GE(rates({}, true).mean, kMeanRate); }

TEST_P(Convergence, IsOfHalfOrderInTheLargestError) {
  EXPECT_GE(rates({}, true).largest, kLargestRate);
}

TEST_P(Convergence, OfThePublishedMethodIsOfHalfOrder) {
  HeatOptions classic;
  classic.variant = Variant::kClassic;
  EXPECT_GE(rates(classic, true).mean, kClassicMeanRate);
}

TEST_P(Convergence, WithAFixedFactorBeginsOnCoarseMeshes) {
  EXPECT_GE(rates({}, false).mean, kFixedFactorRate);
}

TEST_P(Convergence, OfTheCorrectedVariantIsAheadOfThePublishedMethod) {
  HeatOptions classic;
  classic.variant = Variant::kClassic;
  EXPECT_LT(errors(kFine, {}, 1).mean, errors(kFine, classic, 1).mean);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Convergence, testing::ValuesIn(kShapes),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace geotherm::test
