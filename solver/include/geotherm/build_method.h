// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/distance_method.h"
#include "geotherm/domains.h"
#include "geotherm/mesh.h"
#include "geotherm/options.h"
#include "geotherm/progress.h"

// Any method by its options: what most programs need.
namespace geotherm {

/// What the methods of polyhedral_methods.h walk over; build_wave_surface() makes it.
struct WaveSurface;
/// A triangulation of a surface that may have other edges than the mesh; internal.
struct IntrinsicSurface;

/// A method with its options: those of the heat method, of which the others use `threads` alone.
struct MethodOptions : HeatOptions {
  MethodKind method = MethodKind::kHeat;  ///< which one
  int refine = 0;  ///< how often every face is cut into four before anything is solved; >= 0

  bool operator==(const MethodOptions&) const = default;
};

/// Whether one serves instead of the other: options that a method does not use do not count.
bool same_method(const MethodOptions& a, const MethodOptions& b);

/// Makes a mesh ready for a method. `waves`: the mesh's, where it is there already; made otherwise
/// by the methods that walk over it. Vertices that are one (TriangleMesh::same_as()) have one
/// distance, and are one as sources. With MethodOptions::refine the faces are subdivided (errors of
/// subdivide()) and that is solved on; sources, answers and numbers stay those of the mesh, while
/// the quality figures are of the fine one. Cost and errors: those of HeatMethod::build(),
/// WavefrontMethod::build(), ...
Result<std::shared_ptr<const DistanceMethod>> build_method(
    std::shared_ptr<const TriangleMesh> mesh, const MethodOptions& options = {},
    const Progress& progress = {}, std::shared_ptr<const WaveSurface> waves = nullptr);

/// Any method for a volume: heat and, as the near-exact one, fast marching. Errors: kNotAvailable
/// (another method, MethodOptions::refine), those of cells_of() and HeatMethod::build().
Result<std::shared_ptr<const DistanceMethod>> build_method(std::shared_ptr<const TetMesh> mesh,
                                                           const MethodOptions& options = {},
                                                           const Progress& progress = {});

/// The same for a grid. Errors: kNotAvailable, kBadInput (check_grid()), those of
/// HeatMethod::build().
Result<std::shared_ptr<const DistanceMethod>> build_method(std::shared_ptr<const Grid> grid,
                                                           const MethodOptions& options = {},
                                                           const Progress& progress = {});

/// The same where there is a method on the same mesh, `other`, or null: a heat method shares with
/// another one what stays the same (HeatMethod::with()).
Result<std::shared_ptr<const DistanceMethod>> build_method_sharing(
    std::shared_ptr<const TriangleMesh> mesh, const MethodOptions& options,
    const DistanceMethod* other, const Progress& progress = {});

/// The same surface with its vertices elsewhere: frames of an animation, a mesh that is sculpted.
/// `earlier`: a method on a mesh of the same faces, or null; a heat method and waves take over what
/// stays the same from one of their kind (HeatMethod::with_positions()). Errors: those of
/// check_moved() and build_method().
Result<std::shared_ptr<const DistanceMethod>> build_method_moved(
    std::shared_ptr<const TriangleMesh> moved, const MethodOptions& options,
    const DistanceMethod* earlier, const Progress& progress = {});

/// The triangulation that a heat method has made, where waves on the same mesh may share it. Null
/// where `method` is none, or has another triangulation or mesh.
std::shared_ptr<const IntrinsicSurface> triangulation_for_waves(const DistanceMethod& method);

}  // namespace geotherm
