// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "app/cli/kept_rows.h"
#include "app/cli/many_work.h"

// The files that `solve --each` writes as rows come.
namespace geotherm::app {

/// The error with what helps where a file cannot be written.
Error about_file(const Error& error);

/// A file that ranks write together: each its places in the file of the first one, which is renamed
/// when all are done.
class SharedFile {
 public:
  /// All ranks. `part`: GrowingFile::open_part(). Errors: kBadFile, the same on all.
  static Result<SharedFile> open(const std::string& path, std::string_view header,
                                 const Ranks& ranks, bool part = false);
  SharedFile(SharedFile&&) noexcept;
  ~SharedFile();

  /// Writes at a place counted from the header's end; alone, behind what was written last. Errors:
  /// kBadFile.
  Result<void> write(std::uint64_t at, std::string_view bytes);
  /// Of `part` alone: reads so many bytes from a place, and waits for the disk. Errors: kBadFile.
  Result<void> read(std::uint64_t at, std::string& bytes) const;
  Result<void> to_disk() const;
  /// On the first rank, when the others have written theirs.
  Result<void> finish();

  const std::string& place() const;

 private:
  struct State;
  explicit SharedFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Takes a row of distances.
using TakeDistances =
    std::function<Result<void>(std::size_t row, std::span<const double> distances)>;

/// Rows of a .npy array that ranks write together. Those of surfaces are kept where the work is
/// ended from outside, and the same work goes on there (KeptRows).
class SharedRows {
 public:
  /// All ranks. Leaves to be solved for what is not there, and hands each row that is to `take` on
  /// one of the ranks. Errors: kBadFile, those of `take`, the same on all.
  static Result<SharedRows> open(const std::string& path, ManySources& work, Index columns,
                                 NpyType type, const TakeDistances& take);

  /// Errors: kBadFile, kBadInput (a row that does not fit the type).
  Result<void> write(std::size_t row, std::span<const double> distances);
  /// On the first rank, when the others have written theirs.
  Result<void> finish();
  /// Likewise: removes the file, of which there is no more use.
  void discard();

 private:
  SharedRows(SharedFile file, std::string path, std::uint64_t row, NpyType type)
      : file_(std::move(file)), path_(std::move(path)), row_(row), type_(type) {}
  Result<void> take_kept(const ManySources& work, const std::string& marks, Index columns,
                         const TakeDistances& take) const;
  SharedFile file_;
  std::optional<KeptRows> kept_;  ///< goes first, while the file is locked
  std::string path_, bytes_;
  std::uint64_t row_;  ///< bytes
  NpyType type_;
};

/// The rows of --each as they come: an array, or what is reached alone.
class RowsFile {
 public:
  /// All ranks, as SharedRows. Errors: also kBadFile (no room), kBadInput (sparse rows of several
  /// ranks).
  static Result<RowsFile> open(const std::string& path, ManySources& work, NpyType type,
                               const TakeDistances& take);

  /// Errors: those of SharedRows and SparseRows.
  Result<void> write(std::size_t row, const DistanceResult& answer);
  Result<void> finish() { return rows_ ? rows_->finish() : sparse_->finish(); }

  Index columns() const { return columns_; }
  /// How many distances sparse rows hold; nothing for an array.
  std::optional<std::uint64_t> entries() const;
  /// The size of the file; of sparse rows, that of the numbers written so far.
  double bytes() const;
  std::string size_in_words() const;

 private:
  std::optional<SharedRows> rows_;
  std::optional<SparseRows> sparse_;
  Index columns_ = 0;
  double bytes_ = 0, number_bytes_ = 8;
};

}  // namespace geotherm::app
