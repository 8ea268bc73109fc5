// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <numbers>

#include "bench/benches.h"
#include "bench/models/generate.h"
#include "geotherm/build_method.h"
#include "solver/core/stopwatch.h"

namespace geotherm::bench {
MovingRow measure_moving(MethodKind method, const std::string& name, const TriangleMesh& mesh,
                         int frames, int threads) {
  MovingRow row{.method = method, .mesh = name, .faces = mesh.face_count(), .frames = frames};
  MethodOptions options;
  options.method = method;
  options.threads = threads;
  const SourceSet sources = SourceSet::of_vertices({0});
  const QueryOptions query{.quality = false};
  double fresh_ms = 0, moved_ms = 0, query_ms = 0, difference = 0;
  std::shared_ptr<const DistanceMethod> earlier;
  for (int k = 0; k <= frames; ++k) {  // the first one has no earlier one
    const double phase = 2 * std::numbers::pi * k / frames;
    auto moved = mesh.moved(waving(mesh, phase));
    const auto frame = moved ? std::make_shared<const TriangleMesh>(*std::move(moved)) : nullptr;
    Stopwatch watch;
    auto fresh = build_method(frame, options);
    const auto alone = fresh ? (*fresh)->solve(sources, query) : fresh.error();
    const double fresh_time = watch.lap();
    auto next = build_method_moved(frame, options, earlier.get());
    const auto after = next ? (*next)->solve(sources, query) : next.error();
    const double moved_time = watch.lap();
    if (!alone || !after) {
      row.failure = sentence(alone ? after.error() : alone.error());
      return row;
    }
    earlier = *std::move(next);
    difference = std::max(difference, relative_difference(alone->distances, after->distances));
    if (k == 0) continue;
    fresh_ms += fresh_time;
    moved_ms += moved_time;
    query_ms += after->timing.query;
  }
  row.fresh_ms = fresh_ms / frames;
  row.moved_ms = moved_ms / frames;
  row.query_ms = query_ms / frames;
  row.difference = difference;
  return row;
}

}  // namespace geotherm::bench
