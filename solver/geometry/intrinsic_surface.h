// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
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
  /// Measure lengths in the unit of an earlier surface, where the mean edge is near it.
  bool same_unit = false;
  /// What triangles are in the end. Methods that walk over them need no more than kHeights.
  Strictness strictness = Strictness::kInequalities;
};

/// What a surface keeps of the clean faces of its mesh, before flips. It says nothing of where
/// vertices are, and serves all surfaces of a mesh that moves.
struct KeptFaces : CleanFaces {  ///< without `original` and `corners`
  std::vector<Index> of_face;    ///< F of the mesh: number in `faces`, or kNoIndex
  std::vector<char> on_surface;  ///< V: the vertex is a corner of one of `faces`
  Components parts;              ///< of the mesh's vertices, as IntrinsicSurface has them
};

/// Takes the clean faces of the mesh, and leaves `corners` alone in `clean`. `parts`: whether to
/// fill in KeptFaces::parts.
std::shared_ptr<KeptFaces> keep_faces(CleanFaces& clean, const TriangleMesh& mesh, bool parts,
                                      int threads = 1);

/// A mesh made ready for numerical work: cleaned, and triangulated intrinsically. Immutable; every
/// distance method starts from one; only the heat method asks for covers. Surface (heat/) extends
/// it by matrices and an elimination order, WaveSurface (polyhedral/) by edges.
struct IntrinsicSurface {
  std::shared_ptr<const TriangleMesh> mesh;
  /// Before flips; shared where the mesh has moved. Never null.
  std::shared_ptr<const KeptFaces> kept = std::make_shared<const KeptFaces>();
  IntrinsicMesh intrinsic;  ///< after all edits; vertices from V on were inserted
  /// The corner table of intrinsic.faces, for the set-up, which may drop it. Empty where an earlier
  /// surface was given.
  CornerTable corners;
  std::vector<Edit> edits;  ///< from kept->faces (and backs) to intrinsic.faces
  Index flips = 0;          ///< edits that are flips
  Refinement refinement;    ///< what was inserted
  /// Which connected part a vertex (V and inserted ones) belongs to, kNoIndex where in no face.
  Components parts;
  std::vector<double> part_edge;  ///< per part: mean length of the mesh's edges, in length_unit()
  bool delaunay = false;          ///< flips were asked for or needed
  bool tufted = false;            ///< some component is its tufted cover
  double mean_edge = 0;           ///< of the mesh, model units
  /// What lengths and distances within it are measured by, in model units: the mean edge or nearly.
  double length_unit() const { return intrinsic.unit; }
  /// V and inserted vertices.
  Index vertex_count() const { return mesh->vertex_count() + refinement.points; }
  /// Where a vertex of the mesh or an inserted one is, in model units.
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
/// cannot be added up), kCancelled. The same bits with any number of threads, and with an `earlier`
/// surface of the same faces and vertices elsewhere, whose clean faces it shares. Cost: O(F +
/// edits).
Result<IntrinsicSurface> build_intrinsic_surface(std::shared_ptr<const TriangleMesh> mesh,
                                                 const SurfaceRules& rules,
                                                 const Progress& progress = {}, int threads = 1,
                                                 const IntrinsicSurface* earlier = nullptr);

/// Whether both have the same triangulation: the same faces, joined in the same way; lengths may
/// differ. Cost: O(F), nothing where neither was edited.
bool same_triangles(const IntrinsicSurface& a, const IntrinsicSurface& b, int threads = 1);

/// What was left out, one sentence each.
std::vector<Warning> cleaning_notes(const CleanFaces& clean);

/// Whether every source lies on the surface, of which `mesh`, `mean_edge` and `kept` are asked.
/// Errors (kBadInput, with the numbers): no source, a vertex or face out of range, a vertex in no
/// face, bad weights, a face that was left out, an edge that is none, offsets that are negative,
/// not finite or not one a point. An edge may have two ends that are one vertex. Cost: O(log F) a
/// source, in a duplicate face beside the faces at one of its edges.
Result<void> check_sources(const IntrinsicSurface& surface, const SourceSet& sources);

/// Whether offsets, if any, are of all points, not negative, and finite in `unit`. Errors:
/// kBadInput, with `hint` where one is wrong.
Result<void> check_offsets(const SourceSet& sources, double unit, const std::string& hint);

/// Weights (and distances over edge lengths) nearer to a corner or a side than this are on it.
inline constexpr double kAtCorner = 1e-12;

/// A source point as a vertex, where it is within kAtCorner of one; else in a face of kept->faces,
/// with weights that sum to 1. Precondition: check_sources().
SurfacePoint clean_point(const IntrinsicSurface& surface, const SurfacePoint& point);

/// A piece of a curve with both ends as clean_point() has them; the ends stay in its face.
FaceSegment clean_segment(const IntrinsicSurface& surface, const FaceSegment& segment);

/// Number in kept->edges of the edge between two vertices, kNoIndex where there is none. Cost:
/// O(log F).
Index find_clean_edge(const IntrinsicSurface& surface, Index a, Index b);

}  // namespace geotherm
