// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/session/model.h"
#include "app/session/model_solver.h"
#include "app/session/progress.h"
#include "app/session/ranks.h"
#include "app/session/report.h"
#include "app/session/sources.h"
#include "geotherm/io.h"
#include "geotherm/many.h"
#include "geotherm/mesh_report.h"

// What `solve --each` and `solve --pairs` have in common: many source sets, answers that come in a
// stream. Some of it serves `solve --sequence`, too.
namespace geotherm::app {

/// Sources that the heat method solves as one, and that are shared out whole, so that rows have the
/// bits of one process.
inline constexpr std::size_t kBlockRows = 16;

/// Set-up's share of the bar.
inline constexpr double kSetupShare = 0.1;

/// The work before its method is set up.
struct ManySources {
  Model model;
  MeshReport mesh;
  MethodOptions options;
  EachSource sources;
  Reach reach;
  CheckSettings check;
  std::size_t chunk = 1;             ///< sources solved at once
  Ranks ranks;                       ///< that share the sources
  std::vector<std::size_t> rows;     ///< of all ranks, ascending; others are there from before
  std::size_t first = 0, count = 0;  ///< those of this rank among them, in whole blocks

  std::size_t done_before() const { return sources.sets.size() - rows.size(); }
};

/// Shares out the blocks of rows that are still to be solved for: those with a 0. Where all have a
/// 1 the first becomes a 0, so that there is an answer to report on.
void share_out(ManySources& work, std::string& marks);

/// Statistics over all source sets; the distances have been streamed out.
struct ManyFigures {
  std::shared_ptr<const DistanceMethod> method;
  DistanceResult first;   ///< the first answer, without its distances
  double queries_ms = 0;  ///< from the first source to the last row
  double peak_rss_mb = 0;
  std::vector<Warning> warnings;
  MethodOptions options;                ///< of `method`
  std::optional<SampleCheck> error;     ///< of some of the sources; none: not to be checked
  std::optional<SampleCheck> replaced;  ///< of the poor method that this one stands for
};

/// The sums of all ranks, on each of them.
DistanceSummary sums_of_all(const DistanceSummary& mine, const Ranks& ranks);

/// Adds the warnings that are not there yet.
void add_warnings(std::vector<Warning>& all, const std::vector<Warning>& more);

/// Takes the answer to source number `row`, whose distances are those that the reach asks for. In
/// the order of the sources. An error ends the work and is what solve_many() returns.
using TakeRow = std::function<Result<void>(std::size_t row, const DistanceResult& answer)>;

/// What `--max-distance` and `--target` ask for. Errors: kBadInput, with the option.
Result<Reach> reach_of(const SolveArguments& arguments, const Model& model);

/// The vertices that --target names; none: there are no texts. Errors: the same.
Result<std::vector<Index>> targets_of(const std::vector<std::string>& texts, const Model& model);

/// The vertices of sources that are one each. `option`: for messages. Errors: kBadInput.
Result<std::vector<Index>> vertices_of_each(const EachSource& each, const std::string& option);

/// `--dtype` and `--float32`. Errors: kBadInput, kNotAvailable.
Result<NpyType> number_type(const SolveArguments& arguments);

/// Refuses options of a solve that have no meaning for many. Errors: kBadInput.
Result<void> refuse_single_options(const SolveArguments& arguments, const std::string& option);

/// What of --each and of --pairs can be refused before the model is read: other options and the
/// extensions of outputs. Errors: kBadInput, kNotAvailable.
Result<void> check_each(const SolveArguments& arguments);
Result<void> check_pairs(const SolveArguments& arguments);

/// Reads model and sources, and joins the other ranks. Errors: those of the options, of
/// load_model(), resolve_each() and Ranks::join(), and `before`, what came of checks so far: the
/// same on all ranks.
Result<ManySources> begin_many(const SolveArguments& arguments, const Result<void>& before,
                               const Progress& progress);

/// Whether a file of so many bytes fits where it is to be. Errors: kBadFile, with both sizes.
Result<void> check_room(const std::string& path, double bytes);

/// Sets the method up, checks it on some of the sources and hands every row of this rank to `take`.
/// All ranks come back with the same error, or none with any. `output`:
/// what will be written, for the estimate. Warnings: those of model, sources, method, the check and
/// the first answers. Errors: those of the work, kNumericalFailure (OnPoor::kFail, before any row).
Result<ManyFigures> solve_many(const ManySources& work, const SolveArguments& arguments,
                               const TakeRow& take, const std::string& output,
                               const Progress& progress, const Announce& announce);

/// Says why so many distances are infinite.
std::string unreached_note(const ManySources& work, std::int64_t unreached);

/// model, options, sources, timing_ms, memory_mb, warnings: what both reports begin with.
Json many_json(const ManySources& work, const ManyFigures& figures);

/// What people see: `first_rows`, then method, set-up and queries.
std::string many_table(const ManySources& work, const ManyFigures& figures,
                       std::vector<std::array<std::string, 2>> first_rows);

}  // namespace geotherm::app
