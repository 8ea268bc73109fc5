// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/progress.h"
#include "geotherm/types.h"

namespace geotherm::generate {

/// A mesh in the making: what TriangleMesh takes, still free to change.
struct DraftMesh {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
};

/// Brings the moved vertex `v` back onto the surface: from `target`, which lies near the surface,
/// to a point of it; `normal` is the mesh's unit normal at the vertex. Returns the vertex' old
/// place where it shall not move.
using Projection = std::function<Vec3(Index v, const Vec3& target, const Vec3& normal)>;

/// Evens out the triangles: every vertex moves along the surface towards the middle of its faces
/// (the mean of their centroids, weighted by area) and is projected; then the edges are flipped to
/// Delaunay. All vertices move at once: the result does not depend on their order.
void relax(DraftMesh& mesh, const Projection& project);

/// Moves the corners of the few bad triangles (an angle under 20 or over 125 degrees), which lie in
/// folds narrower than the triangles are wide, to the middle of their neighbours, a few times.
void smooth_slivers(DraftMesh& mesh);

/// A number in [0, 1) that depends on its arguments alone: the only randomness of the models.
double hash_unit(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

/// Gradient noise (Perlin 2002, quintic fade, hashed gradients): C2, about -1 to 1, 0 at every
/// point with whole coordinates, features of about unit size.
double gradient_noise(const Vec3& p, std::uint32_t seed);

/// Sum of `octaves` gradient noises, each of twice the frequency and half the height of the last.
double fractal_noise(const Vec3& p, int octaves, std::uint32_t seed);

/// Ridged multifractal noise (Musgrave 1994): about 0 to 1, sharp crests, smooth valleys; an octave
/// counts more where the coarser ones are high.
double ridged_noise(const Vec3& p, int octaves, std::uint32_t seed);

/// 0 below `from`, 1 above `to`, a cubic between (from < to).
double smooth_step(double from, double to, double x);

// Each makes its model with about `faces` faces (at least 500). Y is up, creatures face +Z.
// Error: kCancelled.

/// Mountains cut by rivers over the square [-1, 1]^2 of x and z; one boundary loop.
Result<DraftMesh> make_terrain(Index faces, const Progress& progress);
/// A bent garment sleeve, shoulder up; two boundary loops.
Result<DraftMesh> make_sleeve(Index faces, const Progress& progress);
/// The cube [-1, 1]^3, closed, with exact edges and corners.
Result<DraftMesh> make_cube(Index faces, const Progress& progress);
/// A winged, horned creature that crouches on a plinth; closed.
Result<DraftMesh> make_gargoyle(Index faces, const Progress& progress);
/// A sitting rabbit; closed.
Result<DraftMesh> make_bunny(Index faces, const Progress& progress);

}  // namespace geotherm::generate
