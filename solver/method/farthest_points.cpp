// SPDX-License-Identifier: MIT
#include "solver/method/farthest_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <utility>

#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

/// Whether some face has an edge of any length; without one no method can be set up.
bool has_extent(const TriangleMesh& mesh) {
  const auto& at = mesh.positions();
  return std::ranges::any_of(mesh.faces(), [&at](const Face& f) {
    return !repeats_corner(f) && (at[f[0]] != at[f[1]] || at[f[0]] != at[f[2]]);
  });
}

class Sampler {
 public:
  Sampler(const SampleCrew& crew, const TriangleMesh& mesh, const Progress& progress)
      : crew_(crew),
        mesh_(mesh),
        progress_(progress),
        open_(vertices_in_faces(mesh.vertex_count(), mesh.faces())) {
    out_.distances.assign(open_.size(), kUnreached);
    out_.nearest.assign(open_.size(), kNoIndex);
  }

  Result<FarthestPoints> run(Index count, Index first) {
    queries_ = count + (first == kNoIndex ? 1 : 0);
    Index next = first;
    if (first == kNoIndex) {
      const auto lowest = static_cast<Index>(std::ranges::find(open_, 1) - open_.begin());
      const auto from = distances_from(lowest);
      if (!from) return from.error();
      next = farthest(*from, true);
      if (next == kNoIndex) next = lowest;  // nothing was reached
    }
    for (Index i = 0; i < count; ++i) {
      const double before = out_.distances[next];
      const auto from = distances_from(next);
      if (!from) return from.error();
      double back = kUnreached;
      for (const FarthestSample& other : out_.samples) {
        back = std::min(back, (*from)[other.vertex]);
      }
      take(i, next, *from);
      const Index chosen = std::exchange(next, farthest(out_.distances, false));
      out_.samples.push_back({chosen, before, next == kNoIndex ? 0.0 : out_.distances[next], back});
    }
    out_.query_ms = watch_.milliseconds() / done_;
    return std::move(out_);
  }

 private:
  Result<std::vector<double>> distances_from(Index v) {
    const double begun = static_cast<double>(done_) / queries_;
    const double ended = static_cast<double>(done_ + 1) / queries_;
    if (const auto guessed = ahead_.find(v); guessed != ahead_.end()) {
      std::vector<double> distances = std::move(guessed->second);
      ahead_.erase(guessed);
      ++done_;
      if (!report(progress_, kSamplesStage, ended)) return cancelled_error();
      return distances;
    }
    ahead_.clear();
    const std::vector<Index> asked = worth_asking(v);
    const bool is_first = done_ == 0;
    auto answers = crew_.solve(asked, {.quality = is_first}, part_of(progress_, begun, ended));
    if (!answers) return answers.error();
    std::vector<double> distances = std::move(answers->front().distances);
    if (is_first) out_.first = std::move(answers->front());
    for (std::size_t i = 1; i < asked.size(); ++i) {
      ahead_[asked[i]] = std::move((*answers)[i].distances);
    }
    ++done_;
    if (!report(progress_, kSamplesStage, ended)) return cancelled_error();
    return distances;
  }

  /// This vertex, and those that are likely to follow it.
  std::vector<Index> worth_asking(Index v) const {
    std::vector<Index> out = {v};
    const std::size_t most =
        std::min(crew_.at_once, static_cast<std::size_t>(std::max(queries_ - done_, Index{1})));
    if (most == 1 || !(out_.distances[v] < kUnreached)) return out;
    std::vector<char> may_follow = open_;
    may_follow[v] = 0;
    while (out.size() < most) {
      const Vec3 from = mesh_.positions()[out.back()];
      Index best = kNoIndex;
      for (std::size_t i = 0; i < may_follow.size(); ++i) {
        if (!may_follow[i]) continue;
        const double d = out_.distances[i];
        if ((mesh_.positions()[i] - from).squaredNorm() < d * d) {
          may_follow[i] = 0;
        } else if (best == kNoIndex || d > out_.distances[best]) {
          best = static_cast<Index>(i);
        }
      }
      if (best == kNoIndex) break;
      may_follow[best] = 0;
      out.push_back(best);
    }
    return out;
  }

  /// Every vertex that is nearer to the new sample becomes its own.
  void take(Index sample, Index vertex, const std::vector<double>& from) {
    open_[vertex] = 0;
    for (std::size_t v = 0; v < from.size(); ++v) {
      if (!(from[v] < out_.distances[v])) continue;
      out_.distances[v] = from[v];
      out_.nearest[v] = sample;
    }
    out_.distances[vertex] = 0;
    out_.nearest[vertex] = sample;
  }

  /// The lowest of the open vertices with the largest value; kNoIndex where none is open.
  Index farthest(const std::vector<double>& values, bool finite) const {
    Index best = kNoIndex;
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (!open_[v] || (finite && !std::isfinite(values[v]))) continue;
      if (best == kNoIndex || values[v] > values[best]) best = static_cast<Index>(v);
    }
    return best;
  }

  const SampleCrew& crew_;
  const TriangleMesh& mesh_;
  const Progress& progress_;
  std::map<Index, std::vector<double>> ahead_;  ///< distances from vertices that may be next
  std::vector<char> open_;                      ///< in a face, and no sample yet
  FarthestPoints out_;
  Index queries_ = 0, done_ = 0;
  Stopwatch watch_;
};

}  // namespace

double FarthestPoints::separation() const {
  double least = kUnreached;
  for (const FarthestSample& sample : samples) {
    least = std::min({least, sample.distance, sample.back});
  }
  return least;
}

Result<void> check_sampling(const TriangleMesh& mesh, Index count, const FarthestOptions& options) {
  if (!has_extent(mesh)) {
    return Error{ErrorCode::kBadFile,
                 "the mesh has no face with area (" +
                     counted_text(static_cast<std::size_t>(mesh.face_count()), "face", "faces") +
                     ", each with a corner twice or all in one place)",
                 {"check how it was exported"}};
  }
  const std::vector<char> used = vertices_in_faces(mesh.vertex_count(), mesh.faces());
  const auto vertices = static_cast<Index>(std::ranges::count(used, 1));
  if (count < 1 || count > vertices) {
    return Error{
        ErrorCode::kBadInput,
        counted_text(static_cast<std::size_t>(std::max(count, Index{0})), "sample was",
                     "samples were") +
            " asked for, and " +
            counted_text(static_cast<std::size_t>(vertices), "vertex belongs", "vertices belong") +
            " to a face",
        {"ask for 1 to " + std::to_string(vertices)}};
  }
  const Index first = options.first;
  if (first == kNoIndex) return {};
  if (first < 0 || first >= mesh.vertex_count()) {
    return Error{ErrorCode::kBadInput,
                 "there is no vertex " + std::to_string(first) + " to begin with",
                 {"vertices are 0 to " + std::to_string(mesh.vertex_count() - 1)}};
  }
  if (!used[mesh.standing_for(first)]) {
    return Error{
        ErrorCode::kBadInput,
        "vertex " + std::to_string(first) + " belongs to no face and cannot be the first sample",
        {"choose another"}};
  }
  return {};
}

Result<FarthestPoints> farthest_points(const DistanceMethod& method, const TriangleMesh& mesh,
                                       Index count, const FarthestOptions& options,
                                       const Progress& progress) {
  const SampleCrew alone = {
      .solve = [&method](std::span<const Index> vertices, const QueryOptions& query,
                         const Progress& part) -> Result<std::vector<DistanceResult>> {
        auto answer = method.solve(SourceSet::of_vertices({vertices.front()}), query, part);
        if (!answer) return answer.error();
        std::vector<DistanceResult> out;
        out.push_back(*std::move(answer));
        return out;
      }};
  return farthest_points_by(alone, mesh, count, options, progress);
}

Result<FarthestPoints> farthest_points_by(const SampleCrew& crew, const TriangleMesh& mesh,
                                          Index count, const FarthestOptions& options,
                                          const Progress& progress) try {
  if (auto valid = check_sampling(mesh, count, options); !valid) return valid.error();
  const Index first = options.first;
  return Sampler(crew, mesh, progress)
      .run(count, first == kNoIndex ? first : mesh.standing_for(first));
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory,
               "the memory ended between queries",
               {"take a mesh with fewer faces"}};
}

}  // namespace geotherm
