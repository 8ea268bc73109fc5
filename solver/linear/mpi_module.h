// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "geotherm/error.h"

namespace geotherm {

/// What MPI and PETSc do for this program: a table of functions in a shared library of its own
/// (geotherm-mpi.so), which is loaded when it is first needed, so that the program neither links to
/// them nor needs them. Texts that are returned say what went wrong; empty: nothing. PETSc is for
/// one thread at a time.
struct MpiModule {
  enum class Reduction { kSum, kMin, kMax };

  /// Starts MPI, once; this process has this rank of so many.
  const char* (*start)(int* rank, int* count);

  /// Hands the bytes of each rank to all of them, in the order of the ranks. All ranks call it.
  void (*all_gather)(const char* bytes, std::int64_t size, void* context,
                     void (*take)(void* context, const char* bytes, std::int64_t size));

  /// Hands to each rank the bytes that each has for it: of `bytes`, one rank's after the other's,
  /// sizes[r] are for rank r. `room` gives the place for all that comes, in the order of the ranks,
  /// when its sizes are known. All ranks call it.
  void (*all_to_all)(const char* bytes, const std::int64_t* sizes, void* context,
                     char* (*room)(void* context, const std::int64_t* sizes));

  /// Each number becomes the sum, the smallest or the largest of what the ranks have there. All
  /// ranks call it.
  void (*all_reduce)(double* values, std::int64_t count, Reduction how);

  /// Ends MPI. Nothing may follow.
  void (*finish)();

  /// A symmetric positive definite matrix (n, rows of all entries, columns ascending), which stays
  /// the caller's, and its BoomerAMG preconditioner; null with *problem.
  void* (*make_solver)(int n, int* start, int* column, double* value, const char** problem);
  /// The same of a matrix whose rows are shared out, each rank some that follow those of the rank
  /// before; columns are numbers of all rows. The arrays are copied. All ranks call it, and what
  /// else is done with it.
  void* (*make_shared_solver)(int rows, const int* start, const int* column, const double* value,
                              const char** problem);
  void (*free_solver)(void* solver);

  /// x = M^-1 b by conjugate gradients, to this residual relative to b's.
  const char* (*solve)(void* solver, const double* b, double* x, double tolerance, int* iterations);

  /// Waits until all ranks have called it, for so many seconds at most (negative: for ever). False:
  /// they have not; nothing but abort() may follow.
  bool (*barrier)(double seconds);
  /// Ends this process and all other ranks, whatever they are doing.
  void (*abort)(int exit_code);
};

/// The function that a module has, const MpiModule* geotherm_mpi_module_3(): the number grows where
/// the table changes.
inline constexpr const char* kMpiModuleEntry = "geotherm_mpi_module_3";

/// Whether there is such a library: the one that the variable GEOTHERM_MPI_MODULE names (any other
/// word: none), else the one beside the installed program, else that of the build. Cost: that of
/// looking for files, once.
bool has_mpi_module();

/// Loads it, once, for as long as the process lives. Errors: kNotAvailable (there is none, or what
/// it needs is missing), with what to install.
Result<const MpiModule*> mpi_module();

/// The rank of this process and how many there are.
struct RankOfCount {
  int rank = 0, count = 1;
};

/// Starts MPI where that has not been done. Errors: those of mpi_module(), kNotAvailable.
Result<RankOfCount> start_mpi();

/// Whether it was, and has not ended.
bool mpi_is_started();

/// Ends MPI where it was started; nothing of it may be used any more.
void finish_mpi();

/// Where MPI was started, ends this process and all other ranks, which wait for it.
void end_all_ranks(int exit_code);

}  // namespace geotherm
