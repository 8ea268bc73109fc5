// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/error.h"
#include "solver/linear/mpi_module.h"

// Several processes that work on one command (mpirun -n 4 geotherm ...), each of which is a rank.
namespace geotherm::app {

/// What the launcher (mpirun, srun) says of this process; one of one without any. Cost: none, MPI
/// is not started.
RankOfCount launched_as();

/// Whether there was one, even where this process is the only one.
bool has_launcher();

/// Refuses to be one of several, where each would do the same. `what`: a command. Errors:
/// kBadInput.
Result<void> refuse_ranks(const std::string& what);

/// Whether a variable of the environment makes a process a rank: one that a rank starts must not
/// have it.
bool is_of_launcher(const std::string& variable);

/// Thrown where the others do not hear of an error, because they work or wait elsewhere: the
/// program says it and ends them all (end_all_ranks()).
struct UnheardError {
  Error error;
};

/// How long a rank lets those before it speak first, where several met the same at the same time.
double seconds_for_others(int rank);

/// The ranks of one command. What it offers is called by all of them, in the same order.
class Ranks {
 public:
  /// Starts MPI where more than one process was launched. Errors: kNotAvailable, with what to
  /// install.
  static Result<Ranks> join();

  int rank() const { return ours_.rank; }
  int count() const { return ours_.count; }
  bool alone() const { return ours_.count == 1; }
  bool is_first() const { return ours_.rank == 0; }

  /// What each rank has to say, in the order of the ranks, on all of them.
  std::vector<std::string> all_gather(const std::string& mine) const;

  /// The same, or the error of the lowest rank that has one instead, on all of them. Where one
  /// waits in this and another in agree(), they hear of each other's error. Throws UnheardError.
  Result<std::vector<std::string>> all_gather_or_fail(const Result<std::string>& mine) const;

  /// The error of the lowest rank that has one, on all of them: all go on or none does. Throws
  /// UnheardError where others do not come to hear this rank's within seconds.
  Result<void> agree(const Result<void>& mine) const;

  /// The same for what has a value.
  template <class Value>
  Result<Value> agree_on(Result<Value> mine) const {
    const auto all = agree(mine ? Result<void>() : Result<void>(mine.error()));
    return all ? std::move(mine) : Result<Value>(all.error());
  }

 private:
  explicit Ranks(RankOfCount ours) : ours_(ours) {}
  RankOfCount ours_;
};

}  // namespace geotherm::app
