// SPDX-License-Identifier: MIT
#include "geotherm/many.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// Blocks of a thread in a chunk, at most.
constexpr std::size_t kMaxBlocks = 2;
/// Beyond this, more blocks would cost memory for little: a block takes long enough by itself.
constexpr std::int64_t kAmpleBytes = std::int64_t{256} << 20;

using Answers = std::vector<DistanceResult>;

/// Hands a chunk over and lets it go.
Result<void> hand_over(Answers answers, std::size_t first, const AnswerSink& sink) try {
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (auto taken = sink(first + i, std::move(answers[i])); !taken) return taken;
    answers[i] = {};
  }
  return {};
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory,
               "the memory ended where answers are taken",
               {"solve fewer sources at once"}};
}

}  // namespace

Result<void> stream_answers(const DistanceMethod& method, std::span<const SourceSet> sets,
                            const StreamOptions& options, const AnswerSink& sink,
                            const Progress& progress) try {
  const std::size_t chunk = std::max<std::size_t>(options.chunk, 1);
  const auto count = static_cast<double>(std::max<std::size_t>(sets.size(), 1));
  QueryOptions query = options.query;
  Answers waiting;
  std::size_t first_waiting = 0;
  std::size_t size = 0;
  for (std::size_t first = 0; first < sets.size(); first += size) {
    size = std::min(query.quality ? std::min(chunk, kSetsInBlock) : chunk, sets.size() - first);
    const Progress part = part_of(progress, static_cast<double>(first) / count,
                                  static_cast<double>(first + size) / count);
    Result<void> taken;
    Result<Answers> solved = Answers();
    std::exception_ptr thrown;
    std::atomic<bool> refused{false};
    {
      const auto take = [&] {
        try {
          taken = hand_over(std::move(waiting), first_waiting, sink);
        } catch (...) {
          thrown = std::current_exception();
        }
        refused = thrown || !taken;
      };
      const Progress unless_refused = [&](std::string_view stage, double share) {
        return !refused && report(part, stage, share);
      };
      const std::jthread taker = waiting.empty() ? std::jthread() : try_thread(take);
      if (!waiting.empty() && !taker.joinable()) take();
      if (taker.joinable() || !refused) {
        solved = method.solve_each(sets.subspan(first, size), query, unless_refused);
      }
    }
    if (thrown) std::rethrow_exception(thrown);
    if (!taken) return taken;
    if (!solved) return solved.error();
    if (!report(part, kSourcesStage, 1.0)) return cancelled_error();
    waiting = *std::move(solved);
    first_waiting = first;
    query.quality = false;
  }
  return hand_over(std::move(waiting), first_waiting, sink);
} catch (const std::bad_alloc&) {
  return Error{
      ErrorCode::kOutOfMemory, "the memory ended between queries", {"solve fewer sources at once"}};
}

std::size_t good_chunk(Index vertices, int threads, std::optional<std::int64_t> free_bytes) {
  const std::size_t least = kSetsInBlock * static_cast<std::size_t>(thread_count(threads));
  std::size_t chunk = least * kMaxBlocks;
  while (chunk > least && chunk_bytes(vertices, chunk) > kAmpleBytes) chunk -= least;
  if (!free_bytes) return chunk;
  const std::int64_t most = *free_bytes / 2;
  while (chunk > kSetsInBlock && chunk_bytes(vertices, chunk) > most) chunk -= kSetsInBlock;
  return chunk;
}

std::int64_t chunk_bytes(Index vertices, std::size_t chunk) {
  return 2 * static_cast<std::int64_t>(chunk) * vertices *
         static_cast<std::int64_t>(sizeof(double));
}

}  // namespace geotherm
