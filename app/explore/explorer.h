// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/explore/explored.h"
#include "app/resolve_sources.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// What a session asks for.
struct ExploreRequest {
  std::string model;
  ModelReading reading;
  std::uint64_t opening = 0;  ///< another number: the model is read anew
  std::vector<std::string> sources;
  MethodOptions options;              ///< A
  std::optional<MethodOptions> kept;  ///< B
  bool fields = false, quality = true;
  Check check = Check::kOff;
  bool nearest = false;               ///< Explored::nearest
  std::optional<std::string> target;  ///< Explored::paths

  /// Whether both need the same model and factors.
  bool same_setup(const ExploreRequest& other) const {
    return model == other.model && reading == other.reading && opening == other.opening &&
           options == other.options && kept == other.kept;
  }
  /// Whether what answers this also answers `other`.
  bool covers(const ExploreRequest& other) const {
    return same_setup(other) && sources == other.sources && fields >= other.fields &&
           quality >= other.quality && nearest >= other.nearest &&
           (check == other.check || other.check == Check::kOff) && target == other.target;
  }
};

/// Works requests out, one after the other, and keeps what the next one can use: the model, and
/// both methods with their factors. For one thread at a time.
class Explorer {
 public:
  /// What is there before the whole is: the model alone, or answers before they are checked.
  using Early = std::function<void(Explored)>;

  /// Errors: those of load_model, resolve_sources and HeatMethod; kCancelled.
  Result<Explored> explore(const ExploreRequest& request, const Progress& progress,
                           const Early& early);

 private:
  Result<void> load(const ExploreRequest& request, const Progress& progress, const Early& early);
  Result<std::shared_ptr<const Answer>> answer(const ExploreRequest& request,
                                               const MethodOptions& options, bool is_b,
                                               const Explored& explored,
                                               const std::vector<std::string>& source_warnings,
                                               const Progress& progress);

  Result<std::vector<std::string>> place_sources(const ExploreRequest& request, Explored& explored);

  Result<std::shared_ptr<const DistanceMethod>> make(const MethodOptions& options,
                                                     const DistanceMethod* near,
                                                     const Progress& progress);
  Result<void> make_waves(const Progress& progress);
  Result<void> find_nearest(Explored& explored, const Progress& progress);
  Result<void> find_paths(const ExploreRequest& request, Explored& explored,
                          const Progress& progress);
  MethodKind reference_of(const ExploreRequest& request, const Answer& answer) const;
  Result<void> check(const ExploreRequest& request, const SourceSet& sources, Answer& answer,
                     const Progress& progress);
  Result<void> check_afterwards(const ExploreRequest& request, Explored& explored,
                                const Progress& progress, const Early& early);

  struct Method {
    std::shared_ptr<const DistanceMethod> method;
    MethodOptions options;
    SetupTiming setup;
    double setup_ms;
  };
  Result<void> prepare(const MethodOptions& options, std::optional<Method>& kept,
                       const std::optional<Method>& other, const Progress& progress);

  std::shared_ptr<const ExploredModel> model_;
  std::string model_text_;
  ModelReading reading_;
  std::uint64_t opening_ = 0;
  std::optional<Method> a_, b_;
  std::map<std::string, ResolvedSources> placed_;  ///< of the last request, by entry
  std::shared_ptr<const WaveSurface> waves_;       ///< of the model; null: not needed so far
  struct OnWaves {
    std::shared_ptr<const DistanceMethod> method;
    int threads = 0, refine = 0;
  };
  /// Methods beside heat that were needed so far, by kind and whether on a refined mesh.
  std::map<std::pair<MethodKind, bool>, OnWaves> on_waves_;
  /// The last distances that others were held against.
  struct Reference {
    std::vector<std::string> sources;
    ReferenceAnswers answers;
  };
  std::optional<Reference> reference_;
  /// What finds paths on the streamlines of `method`; for as long as A has that.
  struct Paths {
    std::shared_ptr<const DistanceMethod> method;
    std::shared_ptr<const TargetPathFinder> finder;
  };
  std::optional<Paths> paths_;
};

}  // namespace geotherm::app
