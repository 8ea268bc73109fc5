// SPDX-License-Identifier: MIT
#include "solver/path/shorten.h"

#include "solver/path/other_sides.h"
#include "solver/path/release.h"
#include "solver/path/shorten_loop.h"
#include "solver/path/within_memory.h"

namespace geotherm {
namespace {

Result<SurfacePath> shortened(const PathSurface& surface, const SurfacePath& start, bool search,
                              const Progress& progress) {
  if (start.points.empty()) {
    return Error{ErrorCode::kBadInput, "the path has no points", {"give one at least"}};
  }
  const auto first = surface.into(start.points.front());
  if (!first) return first.error();
  auto legs = tight_legs(surface, start);
  if (!legs) return legs.error();
  ShortenBudget budget(surface, progress);
  auto released = release_bends(surface, *legs, budget);
  if (released && start.closed) released = shorten_loop(surface, *legs, budget);
  if (released && !start.closed && search) released = try_other_sides(surface, *legs, budget);
  if (!released) return released.error();
  SurfacePath path = path_of(surface, *legs, *first);
  path.closed = start.closed;
  return path;
}

}  // namespace

Result<SurfacePath> shorten(const PathSurface& surface, const SurfacePath& start, bool search,
                            const Progress& progress) {
  return within_memory("a shorter path", *surface.mesh(), progress, [&](const Progress& watched) {
    return shortened(surface, start, search, watched);
  });
}

}  // namespace geotherm
