// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"
#include "geotherm/sources.h"
#include "solver/geometry/clean_faces.h"
#include "solver/geometry/delaunay.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/geometry/intrinsic_refinement.h"

namespace geotherm {

/// When the edges of a mesh are flipped to Delaunay.
enum class FlipRule { kNever, kWhereNeeded, kAlways };

/// Which components become their tufted cover: none, those that are no oriented manifold along all
/// their edges, or all.
enum class CoverRule { kNever, kWhereNeeded, kAlways };

/// Whether vertices are inserted where a triangulation cannot carry the heat method.
enum class RefineRule { kNever, kWhereNeeded };

/// How a mesh becomes an IntrinsicSurface.
struct SurfaceRules {
  FlipRule flip = FlipRule::kNever;
  CoverRule cover = CoverRule::kNever;
  RefineRule refine = RefineRule::kNever;
  bool parts = false;  ///< name connected parts; where it is refined they are named in any case
};

/// A mesh made ready for numerical work: cleaned, and triangulated intrinsically. Immutable; every
/// distance method starts from one; only the heat method asks for covers. Surface (heat/) extends
/// it by matrices and an elimination order, WaveSurface (polyhedral/) by edges.
struct IntrinsicSurface {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<Face> clean_faces;     ///< before flips, as CleanFaces
  EdgeTable clean_edges;             ///< of clean_faces
  std::vector<Index> clean_of_face;  ///< F of the mesh: number in clean_faces, or kNoIndex
  std::vector<char> on_surface;      ///< V: the vertex is a corner of a clean face
  IntrinsicMesh intrinsic;           ///< after all edits; vertices from V on were inserted
  CornerTable corners;               ///< of intrinsic.faces; for the set-up, which may drop it
  std::vector<Edit> edits;           ///< from clean_faces (and backs) to intrinsic.faces
  Index flips = 0;                   ///< edits that are flips
  Refinement refinement;             ///< what was inserted
  /// Which connected part a vertex (V and inserted ones) belongs to, kNoIndex where in no face.
  Components parts;
  std::vector<double> part_edge;  ///< per part: mean length of the mesh's edges, in units
  bool delaunay = false;          ///< flips were asked for or needed
  bool tufted = false;            ///< some component is its tufted cover
  double mean_edge = 0;           ///< of the mesh, model units; also the unit of `intrinsic`
  /// V and inserted vertices.
  Index vertex_count() const { return mesh->vertex_count() + refinement.points; }
  /// Of a vertex of the mesh or an inserted one, model units.
  const Vec3& position(Index vertex) const {
    const Index own = mesh->vertex_count();
    return vertex < own ? mesh->positions()[vertex] : refinement.positions[vertex - own];
  }
  std::vector<Warning> warnings;

  struct Times {           ///< milliseconds
    double clean = 0;      ///< faces, edges, orientation
    double intrinsic = 0;  ///< lengths, mollification, cover
    double flips = 0;      ///< looking for edges to flip, and flips; refinement
  } times;
};

/// `progress` is asked as stage "operators". Errors: kBadInput (no face with area, edges that
/// cannot be added up), kCancelled. The same bits with any number of threads. Cost: O(F + edits).
Result<IntrinsicSurface> build_intrinsic_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                 const SurfaceRules& rules,
                                                 const Progress& progress = {}, int threads = 1);

/// What was left out, one sentence each.
std::vector<Warning> cleaning_notes(const CleanFaces& clean);

/// Sets clean_faces, clean_edges, clean_of_face, on_surface and corners (of clean_faces); sources
/// are checked and placed with these, `mesh` and `mean_edge` alone. Precondition: `clean` is of
/// surface.mesh.
void keep_clean_faces(CleanFaces clean, IntrinsicSurface& surface, int threads = 1);

/// Whether every source lies on the surface. Errors (kBadInput, with the numbers): no source, a
/// vertex or face out of range, a vertex in no face, bad weights, a face that was left out, an edge
/// that is none, offsets that are negative, not finite or not one a point. An edge may have two
/// ends that are one vertex. Cost: O(log F) a source,
/// in a duplicate face beside the faces at one of its edges.
Result<void> check_sources(const IntrinsicSurface& surface, const SourceSet& sources);

/// Weights (and distances over edge lengths) nearer to a corner or a side than this are on it.
inline constexpr double kAtCorner = 1e-12;

/// A source point as a vertex, where it is within kAtCorner of one; else in a face of clean_faces,
/// with weights that sum to 1. Precondition: check_sources().
SurfacePoint clean_point(const IntrinsicSurface& surface, const SurfacePoint& point);

/// Number in clean_edges of the edge between two vertices, kNoIndex where there is none. Cost:
/// O(log F).
Index find_clean_edge(const IntrinsicSurface& surface, Index a, Index b);

}  // namespace geotherm
