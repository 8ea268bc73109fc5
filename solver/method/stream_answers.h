// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "solver/method/distance_method.h"

namespace geotherm {

/// The stage that stream_answers() reports after each chunk: its share is that of the sets that are
/// solved, while those in between are the method's guesses.
inline constexpr std::string_view kSourcesStage = "sources";

/// Takes the answer to source set number `set`, on any thread, but one at a time and in the order
/// of the sets. An error ends the work.
using AnswerSink = std::function<Result<void>(std::size_t set, DistanceResult&& answer)>;

/// How a stream of answers is cut into chunks.
struct StreamOptions {
  /// Source sets solved by one call of solve_each(); >= 1. Two chunks of answers are in memory: one
  /// that is solved, one that is taken. In multiples of sixteen the answers of the heat method have
  /// the bits of one call for all sets, in other chunks they agree to round-off.
  std::size_t chunk = 16;
  /// What each query computes beside the distances; the quality figures in the first chunk alone,
  /// where they tell whether mesh and options suit each other. They would cost every answer a pass
  /// over the faces.
  QueryOptions query{};
};

/// One answer for each source set, each handed to `sink` as soon as its chunk is there and then let
/// go: any number of sets in the memory of two chunks of answers. They do not depend on the number
/// of threads. `sink` works beside the next chunk, where the
/// system has a thread for it. Shares of `progress` are those of the sets.
/// Errors: those of solve_each() and of the sink; after one, the sink is not called again.
Result<void> stream_answers(const DistanceMethod& method, std::span<const SourceSet> sets,
                            const StreamOptions& options, const AnswerSink& sink,
                            const Progress& progress = {});

/// A good chunk: sixteen sets for each thread, which is what the heat method solves as one block,
/// twice as many on small meshes, so that threads seldom wait for each other; fewer, but sixteen at
/// least, where two chunks of answers would take more than half of `free_bytes` (empty:
/// unknown). A multiple of sixteen.
/// `threads`: 0 for all cores.
std::size_t good_chunk(Index vertices, int threads, std::optional<std::int64_t> free_bytes);

/// Bytes that the answers of two chunks take.
std::int64_t chunk_bytes(Index vertices, std::size_t chunk);

}  // namespace geotherm
