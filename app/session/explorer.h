// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/session/explored.h"
#include "app/session/model_solver.h"
#include "app/session/sculpture.h"
#include "app/session/sources.h"
#include "app/session/state.h"
#include "app/session/surface_curve.h"
#include "geotherm/progress.h"
#include "solver/mesh/frames.h"

namespace geotherm::app {

/// Where the vertices of a model are.
struct Pose {
  std::string sequence;  ///< Frames::open()'s path; empty: where its file has them
  int frame = 0;
  Sculpture sculpture;  ///< on top of that

  bool operator==(const Pose&) const = default;
};

/// What a session asks for.
struct ExploreRequest : Question {
  std::uint64_t opening = 0;  ///< another number forces the model to be read again
  Pose pose;
  bool fields = false, quality = true;
  Check check = Check::kOff;
  bool nearest = false;  ///< DistanceResult::nearest_source of A

  /// Whether both need the same model and factors.
  bool same_setup(const ExploreRequest& other) const {
    return model == other.model && reading == other.reading && opening == other.opening &&
           options == other.options && kept == other.kept;
  }
  /// Whether what answers this also answers `other`.
  bool covers(const ExploreRequest& other) const {
    return same_setup(other) && pose == other.pose && sources == other.sources &&
           fields >= other.fields && quality >= other.quality && nearest >= other.nearest &&
           (check == other.check || other.check == Check::kOff) && target == other.target &&
           (centre == other.centre || !other.centre) && max_distance == other.max_distance &&
           field == other.field;
  }
};

/// What of a request is worked out at a time, in this order.
enum class ExplorePart { kModel, kFrame, kStrokes, kField, kSources, kMethod, kTarget };

/// Works requests out, one after the other, and keeps the model and its solver. For one thread at
/// a time.
class Explorer {
 public:
  /// Receives partial results: the model before it is solved on; answers before the model is
  /// described, lit and can be picked on, and before the centre of their sources and the check.
  using Early = std::function<void(Explored)>;

  /// Errors: those of load_model, resolve_sources and ModelSolver; kCancelled.
  Result<Explored> explore(const ExploreRequest& request, const Progress& progress,
                           const Early& early);

  /// The part that the last request came to: of one that failed, the part that did.
  ExplorePart part() const { return part_; }

 private:
  Result<void> load(const ExploreRequest& request, const Progress& progress, const Early& early);
  Result<void> move(const ExploreRequest& request, const Progress& progress);
  Result<std::shared_ptr<const TriangleMesh>> frame_mesh(const Pose& pose);
  Result<std::shared_ptr<const ExploredModel>> moved_model(std::shared_ptr<const TriangleMesh> mesh,
                                                           bool plays, const Progress& progress);
  Result<void> make_rays(ExploredModel& model, const Progress& progress);
  Result<void> inspect(const Progress& progress);
  Result<std::vector<Warning>> place_sources(const ExploreRequest& request, Explored& explored);
  MethodOptions live_options(const ExploreRequest& request) const;
  Result<std::shared_ptr<const Answer>> answer(const ExploreRequest& request,
                                               const MethodOptions& options,
                                               const ResolvedSources& sources, bool is_b,
                                               const Progress& progress);
  Result<void> find_paths(const ExploreRequest& request, Explored& explored,
                          const Progress& progress);
  Result<void> find_centre(const ExploreRequest& request, Explored& explored,
                           const Progress& progress);
  bool knows_centre(const ExploreRequest& request, Explored& explored) const;
  Result<Explored> work_out(const ExploreRequest& request, const Progress& progress);
  Result<void> make_whole(Result<Explored>& explored, const Progress& progress, const Early& early);
  Result<void> follow_up(const ExploreRequest& request, Explored& explored,
                         const Progress& progress, const Early& early);

  std::shared_ptr<const ExploredModel> read_;   ///< as its file has it
  std::shared_ptr<const ExploredModel> model_;  ///< in the pose `pose_`
  std::shared_ptr<const RayTree> rays_;         ///< the last that was made
  Pose pose_;
  struct Rest {
    MethodOptions options;
    std::optional<double> t;  ///< of the last heat method while nothing moved, model units squared
  };
  Rest rest_;
  struct Sequence {
    std::string path;
    Frames frames;
    int frame = -1;                            ///< that was read last; negative: none
    std::shared_ptr<const TriangleMesh> mesh;  ///< of that
  };
  std::optional<Sequence> sequence_;            ///< of `read_`
  std::shared_ptr<const TriangleMesh> carved_;  ///< what `sculptor_` began with
  std::optional<Sculptor> sculptor_;            ///< from the first stroke on
  bool is_whole_ = true;                        ///< `read_` is described, lit and can be picked on
  ExplorePart part_ = ExplorePart::kModel;
  bool inspected_ = true;  ///< `model_` is described as it is, or is `read_`
  std::string model_text_;
  ModelReading reading_;
  std::uint64_t opening_ = 0;
  std::optional<ModelSolver> solver_;  ///< of the model
  struct Placed {
    SourceSpec source;
    ResolvedSources places;
  };
  struct Middle {
    std::shared_ptr<const TriangleMesh> mesh;
    SourceSet of;
    std::shared_ptr<const SourceCentre> centre;
  };
  std::optional<Middle> middle_;       ///< the last centre that was found
  std::vector<Placed> placed_;         ///< entries of the last request, in their order
  std::optional<CurveJoiner> joiner_;  ///< of `read_`
};

}  // namespace geotherm::app
