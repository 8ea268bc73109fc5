// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/mesh/triangle_mesh.h"
#include "solver/method/distance_method.h"

namespace geotherm {

/// The stage that farthest_points() reports after each sample, with the share of queries that are
/// done.
inline constexpr std::string_view kSamplesStage = "samples";

struct FarthestOptions {
  /// The first sample; kNoIndex: the vertex farthest from the lowest one that belongs to a face, in
  /// its component, for which one more query is made.
  Index first = kNoIndex;
};

struct FarthestSample {
  Index vertex = kNoIndex;
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
