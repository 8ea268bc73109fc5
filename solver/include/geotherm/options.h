// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "geotherm/error.h"
#include "geotherm/names.h"
#include "geotherm/types.h"

// The options of the heat method, and their text. docs/numerics.md says what each does and what it
// is worth. Of these the other methods use the number of threads alone; what all methods on
// surfaces know beside it is MethodOptions::refine.
namespace geotherm {

/// How the diffusion time t (model units squared) is chosen. g is HeatMethod::grading(): 1 but on
/// some meshes and grids.
enum class TimeRule {
  kMeanEdge,      ///< t = m g h^2, h the mean edge length (Crane et al. 2013, section 3.2.4: g = 1)
  kMeanFaceArea,  ///< t = m g A / F, total area over number of faces
  kAbsolute,      ///< t = the given number
};
inline NamedValues<TimeRule> named_values(TimeRule) {
  using enum TimeRule;
  return {"'*' is no time step",
          {{kMeanEdge, "mean-edge"}, {kMeanFaceArea, "mean-face-area"}, {kAbsolute, "absolute"}}};
}

/// The diffusion time: a rule and its number.
struct TimeStep {
  TimeRule rule = TimeRule::kMeanEdge;  ///< where t comes from
  double factor = 1.0;                  ///< m of the two first rules, > 0
  double absolute = 0.0;                ///< t of kAbsolute, > 0

  bool operator==(const TimeStep&) const = default;
};

/// What makes the singular Poisson system solvable (docs/numerics.md, "Constraint modes").
enum class ConstraintMode {
  kPinSources,      ///< phi = 0 held on every source
  kPinVertex,       ///< phi = 0 held on one vertex of each component
  kPenalty,         ///< last row and column replaced by `penalty` on the diagonal
  kConserveEnergy,  ///< bordered with the masses: the total of phi is fixed
  kPseudoInverse,   ///< the minimum-norm solution
};
inline NamedValues<ConstraintMode> named_values(ConstraintMode) {
  using enum ConstraintMode;
  return {"'*' is no constraint mode",
          {{kPinSources, "pin-sources"},
           {kPinVertex, "pin-vertex"},
           {kPenalty, "penalty"},
           {kConserveEnergy, "conserve-energy"},
           {kPseudoInverse, "pseudo-inverse"}}};
}

/// A constraint mode and its number.
struct Constraint {
  ConstraintMode mode = ConstraintMode::kPinSources;  ///< which
  Index pin_vertex = kNoIndex;  ///< kPinVertex: this vertex in its component; otherwise chosen
  double penalty = 10.0;        ///< kPenalty: the number on the diagonal, > 0

  bool operator==(const Constraint&) const = default;
};

/// What the heat step diffuses.
enum class HeatMode {
  kUnit,     ///< right side 1 on every source
  kDiffuse,  ///< right side A u0: the source's mass (Crane et al. 2013, equation 3)
  kHold,     ///< u = 1 held on the sources
};
inline NamedValues<HeatMode> named_values(HeatMode) {
  using enum HeatMode;
  return {"'*' is no heat mode", {{kUnit, "unit"}, {kDiffuse, "diffuse"}, {kHold, "hold"}}};
}

/// The condition on u along the boundary; phi's is always Neumann.
enum class BoundaryRule {
  kAuto,       ///< kAverage in volumes, kNeumann elsewhere
  kNeumann,    ///< no heat leaves
  kDirichlet,  ///< u = 0 on the boundary
  kAverage,    ///< the mean of both solutions
};
inline NamedValues<BoundaryRule> named_values(BoundaryRule) {
  using enum BoundaryRule;
  return {
      "'*' is no boundary rule",
      {{kAuto, "auto"}, {kNeumann, "neumann"}, {kDirichlet, "dirichlet"}, {kAverage, "average"}}};
}

/// How the method is discretised (docs/numerics.md, "What is corrected").
enum class Variant {
  kCorrected,  ///< half-lumped mass, |X| < 1 where fronts meet, exact field in the source's
               ///< faces, near-exact distances around sources, none below the straight line
  kClassic,    ///< as published: lumped mass, |X| = 1 on every face
};
inline NamedValues<Variant> named_values(Variant) {
  using enum Variant;
  return {"'*' is no variant", {{kCorrected, "corrected"}, {kClassic, "classic"}}};
}

/// Which triangulation of the surface carries the operators.
enum class LaplacianKind {
  kAuto,               ///< kRefined where that inserts vertices, else kTufted where the surface is
                       ///< no oriented manifold, else kIntrinsicDelaunay where an edge has a
                       ///< negative weight, else kCotan
  kCotan,              ///< the mesh as it is
  kIntrinsicDelaunay,  ///< after intrinsic edge flips (Bobenko, Springborn 2007)
  kTufted,             ///< Delaunay flips on the tufted double cover (Sharp, Crane 2020)
  kRefined,            ///< Delaunay flips, on the cover where needed, and inserted vertices where
                       ///< faces are too large for t or the boundary is obtuse
};
inline NamedValues<LaplacianKind> named_values(LaplacianKind) {
  using enum LaplacianKind;
  return {"'*' is no Laplacian",
          {{kAuto, "auto"},
           {kCotan, "cotan"},
           {kIntrinsicDelaunay, "intrinsic-delaunay"},
           {kTufted, "tufted"},
           {kRefined, "refined"}}};
}

/// How accurately systems are solved (docs/numerics.md, "Precision"). Iterative backends, which
/// hold no factor and have a tolerance of their own, ignore it.
enum class Precision {
  kCompact,  ///< factors at half the size, where the backend can: distances to 1e-6 of the largest
  kRefined,  ///< the same factors, and a step of iterative refinement in double a solve
  kFull,     ///< factors in double
};
inline NamedValues<Precision> named_values(Precision) {
  using enum Precision;
  return {"'*' is no precision", {{kCompact, "compact"}, {kRefined, "refined"}, {kFull, "full"}}};
}

/// All options of the heat method. The defaults are the recommended ones.
struct HeatOptions {
  std::string backend;              ///< a name from backend_names(); empty: the first of them
  TimeStep time_step;               ///< the diffusion time
  Constraint constraint;            ///< of the Poisson equation
  HeatMode heat = HeatMode::kUnit;  ///< what diffuses
  BoundaryRule boundary = BoundaryRule::kAuto;     ///< of the diffusion, along the boundary
  LaplacianKind laplacian = LaplacianKind::kAuto;  ///< on which triangles
  Variant variant = Variant::kCorrected;           ///< how it is discretised
  Precision precision = Precision::kCompact;       ///< of the factors
  int threads = 0;                                 ///< >= 0; 0: all cores
  bool strict = false;         ///< a backend that fails is not replaced by the next one
  double memory_limit_mb = 0;  ///< most that factors may take, those being made with their
                               ///< working space, in 2^20 bytes; 0: what is free

  bool operator==(const HeatOptions&) const = default;
};

/// The text form of the options that are more than an enum, as programs read and show it.
/// parse_...(to_text(x)) == x for every x. Errors list the values there are.
std::string to_text(const TimeStep& step);          // mean-edge | mean-face-area | absolute:T
std::string to_text(const Constraint& constraint);  // pin-sources | pin-vertex[:V] | penalty:C ...

/// `factor` (m) is no part of the time step's text; it is kept from the argument.
Result<TimeStep> parse_time_step(std::string_view text, double factor = 1.0);
/// Inverse of to_text().
Result<Constraint> parse_constraint(std::string_view text);

}  // namespace geotherm
