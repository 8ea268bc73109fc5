// SPDX-License-Identifier: MIT
#include "app/session/ranks.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "app/session/wording.h"
#include "app/text/text.h"

namespace geotherm::app {
namespace {

/// The variables by which Open MPI, MPICH with its relatives, and Slurm's srun tell a process its
/// rank and their number. A batch script of Slurm, which srun has not started, has SLURM_PROCID,
/// but no step.
constexpr std::array<std::array<const char*, 2>, 3> kLaunchers = {
    {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
     {"PMI_RANK", "PMI_SIZE"},
     {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}}};

std::optional<int> number_of(const char* variable) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? number_in<int>(text) : std::nullopt;
}

}  // namespace

RankOfCount launched_as() {
  for (const auto& [rank, count] : kLaunchers) {
    const auto ours = number_of(rank), all = number_of(count);
    if (ours && all && *all > 1 && *ours >= 0 && *ours < *all) return {*ours, *all};
  }
  return {};
}

bool has_launcher() {
  return std::ranges::any_of(kLaunchers, [](const auto& each) {
    return number_of(each[0]).has_value() && number_of(each[1]).has_value();
  });
}

Result<void> refuse_ranks(const std::string& what) {
  const int count = launched_as().count;
  if (count == 1) return {};
  return Error{
      ErrorCode::kBadInput,
      what + " works in one process, and was started as " + std::to_string(count),
      {"start it without mpirun; batch, sample and solve with each or pairs share their work, "
       "and solve shares one mesh with ",
       SettingHint{"backend", {"petsc"}}, " or ", SettingHint{"method", {"wavefront"}}}};
}

bool is_of_launcher(const std::string& variable) {
  for (const std::string_view begin : {"OMPI_", "PMIX_", "PMI_", "SLURM_PROCID", "SLURM_STEP_"}) {
    if (variable.starts_with(begin)) return true;
  }
  return false;
}

Result<Ranks> Ranks::join() {
  const RankOfCount launched = launched_as();
  if (launched.count == 1) return Ranks({});
  const auto started = start_mpi();
  if (!started) {
    Error error = started.error();
    error.message = "started as " + std::to_string(launched.count) +
                    " processes that are to work together: " + error.message;
    return error;
  }
  if (started->count == launched.count) return Ranks(*started);
  return Error{ErrorCode::kNotAvailable,
               "started as " + std::to_string(launched.count) + " processes, of which MPI knows " +
                   std::to_string(started->count),
               {"use the mpirun of the MPI that this program is built with (Open MPI)"}};
}

double seconds_for_others(int rank) {
  constexpr double kToBeEnded = 0.5;  // that a launcher takes to end all
  constexpr int kMax = 10;
  return kToBeEnded * std::min(rank, kMax);
}

std::vector<std::string> Ranks::all_gather(const std::string& mine) const {
  if (alone()) return {mine};
  std::vector<std::string> all;
  (*mpi_module())
      ->all_gather(mine.data(), static_cast<std::int64_t>(mine.size()), &all,
                   [](void* context, const char* bytes, std::int64_t size) {
                     static_cast<std::vector<std::string>*>(context)->emplace_back(
                         bytes, static_cast<std::size_t>(size));
                   });
  return all;
}

Result<std::vector<std::string>> Ranks::all_gather_or_fail(const Result<std::string>& mine) const {
  if (alone() && !mine) return mine.error();
  if (alone()) return std::vector<std::string>{*mine};
  // Others may be busy for long, or wait for what this rank will never send.
  constexpr double kPatience = 2, kForEver = -1;
  const double seconds = mine ? kForEver : kPatience + seconds_for_others(rank());
  if (!(*mpi_module())->barrier(seconds)) throw UnheardError{mine.error()};
  // A blank before what is said; the code of an error before that.
  const std::string code = mine ? "" : std::to_string(static_cast<int>(mine.error().code));
  std::vector<std::string> all = all_gather(code + ' ' + (mine ? *mine : to_text(mine.error())));
  for (std::string& each : all) {
    const std::size_t blank = each.find(' ');
    const auto failed = number_in<int>(std::string_view(each).substr(0, blank));
    each.erase(0, blank + 1);
    if (failed) return Error{static_cast<ErrorCode>(*failed), std::move(each)};
  }
  return all;
}

Result<void> Ranks::agree(const Result<void>& mine) const {
  const auto all = all_gather_or_fail(mine ? Result<std::string>("") : mine.error());
  return all ? Result<void>() : all.error();
}

}  // namespace geotherm::app
