// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/load_model.h"
#include "app/report_json.h"
#include "geotherm/build_method.h"
#include "geotherm/many.h"

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
  std::vector<std::string> warnings;
  std::optional<SampleCheck> error = {};     ///< of some samples; none: not to be checked
  std::optional<SampleCheck> replaced = {};  ///< of the poor method that this one stands for
};

Json sample_json(const SampleFigures& figures);

/// What `sample` shows to people: the figures and the first samples.
std::string sample_table(const SampleFigures& figures);

/// `sample,vertex,x,y,z,distance,radius`, one sample a line.
std::string samples_csv(const SampleFigures& figures);

/// The numbers of a line of that but for the first, as a row of a .npy array.
std::vector<double> sample_row(const SampleFigures& figures, std::size_t sample);
inline constexpr std::size_t kSampleColumns = 6;

}  // namespace geotherm::app
