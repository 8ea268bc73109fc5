// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "app/cli/many_work.h"

// Rows that outlive the process: where work that writes FILE is ended from outside, FILE.part and a
// list beside it hold what is finished, and the same work goes on there.
namespace geotherm::app {

/// The line by which work is known again: version, options, sources, reach, shape and type of the
/// array, and what the model holds, wherever its file lies. Threads and ranks do not change rows,
/// and are not part of it. Precondition: the model has no space.
std::string job_of(const ManySources& work, Index columns, NpyType type);

/// FILE.part.done: the line of the job, and then for each block of sixteen rows a 1 where it is on
/// the disk, else a 0. Ranks write their places of it.
class KeptRows {
 public:
  /// All ranks; `part`: FILE.part, which the first one has open. Where it is not of this job, or
  /// has another size, it gets that of `bytes`, and no block is there. Errors: kBadFile, the
  /// same on all.
  static Result<KeptRows> open(const std::string& part, std::uint64_t bytes, const std::string& job,
                               std::size_t rows, const Ranks& ranks);
  KeptRows(KeptRows&&) noexcept;
  /// On the first rank: where no block is on the disk, nothing is left of the two files.
  ~KeptRows();

  /// A 0 or 1 for each block, as it was when the work began.
  const std::string& marks() const;

  /// A row was written; those of a block come one after the other. Now and then `to_disk` is
  /// called, which puts what was written on the disk, and its blocks are marked. Errors: kBadFile,
  /// those of `to_disk`.
  Result<void> add(std::size_t row, const std::function<Result<void>()>& to_disk);

  /// The list goes with this object, and FILE.part is another's by now. On the first rank.
  void finish();

 private:
  struct State;
  explicit KeptRows(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace geotherm::app
