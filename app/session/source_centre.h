// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/session/model.h"
#include "geotherm/directions.h"
#include "geotherm/path.h"
#include "geotherm/sources.h"

namespace geotherm::app {

/// The centre of the sources, and how one gets from it to them.
struct SourceCentre {
  CentreKind kind = CentreKind::kMean;
  Centres centres;                ///< one at least
  std::vector<SurfacePath> ways;  ///< from the first centre to the points, but to one that it is
};

/// The shortest paths from a centre to the points that it is of. Errors: those of wavefronts and
/// PathFinder.
Result<std::vector<SurfacePath>> ways_from(const Model& model, const Centre& centre,
                                           std::span<const SurfacePoint> points, int threads,
                                           const Progress& progress = {});

/// The centre, by waves. Errors: kBadInput (another domain, sources that are no points, points with
/// offsets), those of find_centres() and ways_from().
Result<SourceCentre> centre_of_sources(const Model& model, const SourceSet& sources,
                                       CentreKind kind, int threads, const Progress& progress = {});

}  // namespace geotherm::app
