// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/many_work.h"
#include "app/session/model.h"
#include "app/session/report.h"
#include "geotherm/directions.h"
#include "geotherm/many.h"

// What `sample` has to say.
namespace geotherm::app {

/// All there is to say about samples.
struct SampleFigures {
  Model model;
  MeshReport mesh;
  std::shared_ptr<const DistanceMethod> method;
  MethodOptions options;
  FarthestPoints points;
  double sampling_ms = 0;
  double peak_rss_mb = 0;
  std::vector<Warning> warnings;
  std::optional<SampleCheck> error = {};           ///< of some samples, in the end; none: unchecked
  std::optional<SampleCheck> replaced = {};        ///< of the poor method that this one stands for
  std::optional<RelaxedPoints> relaxed = {};       ///< from the samples on
  MethodKind relaxed_by = MethodKind::kWavefront;  ///< whose distances led there
  double relaxed_separation = kUnreached;          ///< smallest distance between two of them
  double relaxing_ms = 0;
  int ranks = 1;  ///< that took the samples together

  /// The distance of every vertex to the nearest sample, where the samples are in the end.
  const std::vector<double>& distances() const {
    return relaxed ? relaxed->distances : points.distances;
  }
  const std::vector<Index>& nearest() const { return relaxed ? relaxed->nearest : points.nearest; }
  double radius() const;
  double separation() const { return relaxed ? relaxed_separation : points.separation(); }
};

/// The smallest distance between two points, each a source of its own, by a method with these
/// options on a mesh of which they are vertices; infinite where no two reach each other. Every
/// query goes as far as the smallest distance that is known. Errors: those of set-up and queries.
Result<double> separation_of(const std::vector<SurfacePoint>& points, const MethodOptions& options,
                             const std::shared_ptr<const TriangleMesh>& mesh,
                             const Progress& progress);

Json sample_json(const SampleFigures& figures);

/// What `sample` shows to people: the figures and the first samples.
std::string sample_table(const SampleFigures& figures);

/// `sample,vertex,x,y,z,distance,radius`, one sample a line; `sample,face,b0,b1,b2,x,y,z` where
/// they were relaxed.
std::string samples_csv(const SampleFigures& figures);

/// A sample a line, as `--source-file` reads it.
std::string samples_as_sources(const SampleFigures& figures);

/// The numbers of a line of samples_csv() but for the first, as a row of a .npy array.
std::vector<double> sample_row(const SampleFigures& figures, std::size_t sample);

}  // namespace geotherm::app
