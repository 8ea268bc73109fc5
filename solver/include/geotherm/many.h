// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/mesh.h"

// Answers to many source sets in little memory, and farthest-point sampling.
namespace geotherm {

/// The stage that stream_answers() reports after each chunk: its share is that of the sets that are
/// solved, while those in between are the method's guesses.
inline constexpr std::string_view kSourcesStage = "sources";

/// Takes the answer to source set number `set`, on any thread, but one at a time and in the order
/// of the sets. An error ends the work.
using AnswerSink = std::function<Result<void>(std::size_t set, DistanceResult&& answer)>;

/// Source sets that a method solves as one block, at most: the heat method reads its factors once
/// for all of them, and their numbers at a vertex fill two of the widest registers.
inline constexpr std::size_t kSetsInBlock = 16;

/// How a stream of answers is cut into chunks.
struct StreamOptions {
  /// Source sets solved by one call of solve_each(); >= 1. Two chunks of answers are in memory: one
  /// that is solved, one that is taken. In multiples of kSetsInBlock the answers of the heat method
  /// have the bits of one call for all sets, in other chunks they agree to round-off.
  std::size_t chunk = kSetsInBlock;
  /// What each query computes beside the distances; the quality figures in the first chunk alone,
  /// which has kSetsInBlock sets at most: they tell whether mesh and options suit each other,
  /// and would cost every answer a pass over the faces.
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

/// A good chunk: a block (kSetsInBlock) for each thread, or two on small meshes, so that threads
/// seldom wait for each other; fewer, but one block at least, where two chunks of answers would
/// take more than half of `free_bytes` (empty: unknown). A multiple of kSetsInBlock.
/// `threads`: 0 for all cores.
std::size_t good_chunk(Index vertices, int threads, std::optional<std::int64_t> free_bytes);

/// Bytes that the answers of two chunks take.
std::int64_t chunk_bytes(Index vertices, std::size_t chunk);

/// The stage that farthest_points() reports after each sample, with the share of queries that are
/// done.
inline constexpr std::string_view kSamplesStage = "samples";

/// How farthest_points() begins.
struct FarthestOptions {
  /// The first sample; kNoIndex: the vertex farthest from the lowest one that belongs to a face, in
  /// its component, for which one more query is made.
  Index first = kNoIndex;
};

/// One of the samples.
struct FarthestSample {
  Index vertex = kNoIndex;  ///< where it is
  /// From the nearest sample before it, model units; infinite for the first of a component.
  double distance = kUnreached;
  /// The cover radius with this sample and those before it: the largest distance of a vertex to the
  /// nearest of them; infinite while a component has none. It does not grow from one to the next.
  double radius = kUnreached;
  /// To the nearest sample before it as its own query has it. By the heat method the two directions
  /// differ by the discretisation error.
  double back = kUnreached;
};

/// Samples of a surface and the cells around them.
struct FarthestPoints {
  std::vector<FarthestSample> samples;  ///< in the order in which they were chosen
  std::vector<double> distances;        ///< V: to the nearest sample; kUnreached: in no face
  std::vector<Index> nearest;           ///< V: number of that sample, kNoIndex: in no face
  DistanceResult first;                 ///< answer to the first query, without its distances
  double query_ms = 0;                  ///< mean of all queries

  /// With all samples: the largest distance of a vertex to the nearest. Precondition: there is one.
  double radius() const { return samples.back().radius; }
  /// The smallest distance between two samples, in either direction; infinite where no two reach
  /// each other.
  double separation() const;
};

/// Whether so many samples can be had, and with this first one: what farthest_points() asks before
/// it begins. Errors: kBadInput (`count` below 1 or above the number of vertices in faces, `first`
/// that is not one of them), kBadFile (no face with an edge of any length). Cost: O(F).
Result<void> check_sampling(const TriangleMesh& mesh, Index count,
                            const FarthestOptions& options = {});

/// Farthest-point sampling (Gonzalez 1985; on surfaces: Eldar, Lindenbaum, Porat, Zeevi 1997): each
/// sample is the vertex farthest from all before it, the lowest of several. Where distances are a
/// metric no choice of as many samples covers the surface with less than half the radius, and the
/// samples lie at least that radius apart; where the two directions differ, each sample lies at
/// least so far from those before it. Unreached vertices count as infinitely far, so that every
/// component gets a sample before any gets a second one. The same on any number of threads.
///
/// `method`: on `mesh`. Cost: `count` queries one after another, O(V) each beside, and V numbers.
/// Errors: those of check_sampling() and of the queries.
Result<FarthestPoints> farthest_points(const DistanceMethod& method, const TriangleMesh& mesh,
                                       Index count, const FarthestOptions& options = {},
                                       const Progress& progress = {});

}  // namespace geotherm
