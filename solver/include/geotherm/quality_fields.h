// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/io.h"

// How right an answer is, and where: numbers on the vertices and faces of the mesh of the file.
namespace geotherm {

/// What the numbers say.
enum class QualityField {
  kError,            ///< vertices: d - d_better, model units
  kEikonalError,     ///< faces: | |grad d| - 1 |, which is 0 for distances away from creases
  kGradientAngle,    ///< faces: degrees between X and grad d; heat method
  kLostGradients,    ///< faces: 1 where the heat has no direction though it gets there, else 0
  kTriangleQuality,  ///< faces: 4 sqrt(3) area / (sum of squared sides); 1: equilateral
  kNonDelaunay,      ///< faces: how many of their edges have a negative cotangent weight, 0 to 3
};

/// error | eikonal-error | gradient-angle | lost-gradients | triangle-quality | non-delaunay
std::string to_text(QualityField field);
/// Inverse of to_text(). Errors: kBadInput, with the names there are.
Result<QualityField> parse_quality_field(std::string_view text);
/// In the order above.
std::vector<QualityField> all_quality_fields();

/// Whether a field is about u, which only answers of the heat method with QueryOptions::fields
/// have.
bool needs_heat(QualityField field);

/// Name, place and type of a field, without values.
DataField described(QualityField field);

/// One of the fields, in the order of the file. The values are infinite where there is none: on
/// faces without area or with a corner that is not reached (eikonal error, angle), and where one of
/// both directions is missing (angle). `error`: V, of signed_error(); used by kError alone.
/// Preconditions: `answer` belongs to the mesh, and has u where needs_heat(). Cost: O(F).
DataField quality_field(QualityField field, const TriangleMesh& mesh, const DistanceResult& answer,
                        std::span<const double> error = {});

/// X = -grad u / |grad u| on every face of the mesh (F), from ln u at its vertices (V; -inf: u is
/// 0). 0 where u is 0 at all corners or has no slope, and on faces without area. Cost: O(F).
/// Source: Crane, Weischedel, Wardetzky (2013), section 3.1.
std::vector<Vec3> heat_directions(const TriangleMesh& mesh, std::span<const double> log_heat);

/// The values of a field alone: kEikonalError. `distances`: V.
std::vector<double> eikonal_errors(const TriangleMesh& mesh, std::span<const double> distances);
/// kLostGradients. `distances`: V; `log_heat`: V, ln u.
std::vector<double> lost_gradients(const TriangleMesh& mesh, std::span<const double> distances,
                                   std::span<const double> log_heat);
/// kTriangleQuality. Of the mesh alone.
std::vector<double> triangle_qualities(const TriangleMesh& mesh);
/// kNonDelaunay. Of the mesh alone.
std::vector<double> non_delaunay_edges(const TriangleMesh& mesh);

/// The angle between two vectors of each face, degrees; infinite where either is 0. Exact for small
/// angles and for those near 180, too. Precondition: the same size. Source: W. Kahan (2006).
std::vector<double> angles_between(std::span<const Vec3> a, std::span<const Vec3> b);

}  // namespace geotherm
