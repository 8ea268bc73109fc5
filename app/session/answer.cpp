// SPDX-License-Identifier: MIT
#include "app/session/answer.h"

#include <algorithm>
#include <cmath>

#include "app/session/wording.h"
#include "app/text/text.h"

namespace geotherm::app {

DistanceSummary summarize(std::span<const double> distances) {
  DistanceSummary summary;
  summary.min = kUnreached;
  double mean = 0;
  double reached = 0;
  for (const double d : distances) {
    if (!std::isfinite(d)) {
      ++summary.unreached;
      continue;
    }
    summary.min = std::min(summary.min, d);
    summary.max = std::max(summary.max, d);
    mean += (d - mean) / ++reached;  // a sum could leave the range of doubles
  }
  summary.mean = mean;
  return summary;
}

CheckedAnswers checked_answers(const Answer& answer) {
  return {*answer.method, answer.options, {&answer.sources, 1}, {&answer.result.distances, 1}};
}

std::vector<Warning> unreached_notes(const MeshSummary& mesh, Index unreached) {
  std::vector<Warning> notes;
  const Index loose = mesh.unreferenced_vertices;
  if (loose > 0) {
    notes.push_back({counted(loose, "vertex belongs", "vertices belong") +
                     " to no face; their distance is infinite"});
  }
  const Index lost = unreached - loose;
  if (lost > 0) {
    notes.push_back({counted(lost, "vertex lies", "vertices lie") +
                     " in components without a source (there are " +
                     counted(mesh.components, "component", "components") +
                     "); their distance is infinite"});
  }
  return notes;
}

Error about_model(const std::string& name, const Error& error) {
  const ErrorCode code = error.code == ErrorCode::kBadInput ? ErrorCode::kBadFile : error.code;
  if (!name.empty()) return about(one_line(name), error, code);
  return {code, error.message, error.hint, error.subject};
}

std::vector<Region> regions_of(const SourceSet& sources, std::span<const Index> nearest) {
  const SourceGroups groups = source_groups(sources);
  std::vector<Region> regions(static_cast<std::size_t>(groups.count));
  for (Index label = 0; label < groups.count; ++label) regions[label].label = label;
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    Region& region = regions[groups.of_point[i]];
    if (!region.point) region.point = sources.points[i];
  }
  for (const Index group : groups.of_edge) ++regions[group].edges;
  for (const Index group : nearest) {
    if (group != kNoIndex) ++regions[group].vertices;
  }
  return regions;
}

}  // namespace geotherm::app
