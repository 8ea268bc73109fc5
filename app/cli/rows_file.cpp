// SPDX-License-Identifier: MIT
#include "app/cli/rows_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {

Error about_file(const Error& error) {
  return with_hint(error, {"make room there, or choose another place"});
}

struct SharedFile::State {
  std::optional<GrowingFile> file;  ///< of the first rank
  std::string path;
  int place = -1;  ///< where others write; -1: through the file, one piece after the other
  std::uint64_t header = 0;

  Error failure(int code) const {
    return {ErrorCode::kBadFile,
            one_line(path) + ": cannot be written: " + std::generic_category().message(code)};
  }
};

SharedFile::SharedFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
SharedFile::SharedFile(SharedFile&&) noexcept = default;
SharedFile::~SharedFile() {
  if (state_ && state_->place >= 0) ::close(state_->place);
}

Result<SharedFile> SharedFile::open(const std::string& path, std::string_view header,
                                    const Ranks& ranks) {
  SharedFile out(std::make_unique<State>());
  State& state = *out.state_;
  state.path = path;
  state.header = header.size();
  const auto begin = [&]() -> Result<void> {
    if (!ranks.is_first()) return {};
    if (!ranks.alone() && path == "-") {
      return Error{ErrorCode::kBadInput,
                   "several processes cannot share standard output; give -o FILE.npy"};
    }
    auto file = GrowingFile::open(path);
    if (!file) return file.error();
    state.file = *std::move(file);
    return state.file->append(header);
  };
  if (auto begun = ranks.agree(begin()); !begun) return begun.error();
  if (ranks.alone()) return out;
  const std::string place =
      ranks.exchange(ranks.is_first() ? state.file->place() : std::string()).front();
  state.place = ::open(place.c_str(), O_WRONLY | O_CLOEXEC);
  const auto opened = ranks.agree(state.place >= 0 ? Result<void>() : state.failure(errno));
  return opened ? Result<SharedFile>(std::move(out)) : opened.error();
}

Result<void> SharedFile::write(std::uint64_t at, std::string_view bytes) {
  State& state = *state_;
  if (state.place < 0) return state.file->append(bytes);
  for (at += state.header; !bytes.empty();) {
    const ssize_t written =
        ::pwrite(state.place, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return state.failure(errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
  return {};
}

Result<void> SharedFile::finish() { return state_->file->finish(); }

Result<SharedRows> SharedRows::open(const std::string& path, const ManySources& work, Index columns,
                                    NpyType type) {
  const std::uint64_t rows = work.sources.sets.size();
  const auto width = static_cast<std::uint64_t>(columns);
  auto file = SharedFile::open(path, io::npy_rows_header(rows, width, type), work.ranks);
  if (!file) return file.error();
  const std::uint64_t row = npy_bytes_of(1, width, type) - npy_bytes_of(0, width, type);
  return SharedRows(*std::move(file), path, row, type);
}

Result<void> SharedRows::write(std::size_t row, std::span<const double> distances) {
  if (auto made = io::npy_row(path_, distances, type_, bytes_); !made) return made;
  return file_.write(row * row_, bytes_);
}

Result<RowsFile> RowsFile::open(const std::string& path, const ManySources& work, NpyType type) {
  RowsFile out;
  const std::size_t targets = work.reach.targets.size();
  out.columns_ = targets > 0 ? static_cast<Index>(targets) : work.mesh.vertices;
  out.number_bytes_ = type == NpyType::kFloat64 ? 8 : 4;
  const auto columns = static_cast<std::uint64_t>(out.columns_);
  if (work.reach.sparse && !work.ranks.alone()) {
    return Error{ErrorCode::kBadInput,
                 one_line(path) + ": sparse rows are written by one process; give -o FILE.npy"};
  }
  if (work.reach.sparse) {
    auto file = SparseRows::open(path, columns, type);
    if (!file) return about_file(file.error());
    out.sparse_ = *std::move(file);
    return out;
  }
  const std::uint64_t rows = work.sources.sets.size();
  out.bytes_ = static_cast<double>(npy_bytes_of(rows, columns, type));
  if (auto fits = work.ranks.agree(check_room(path, out.bytes_)); !fits) return fits.error();
  auto file = SharedRows::open(path, work, out.columns_, type);
  if (!file) return about_file(file.error());
  out.rows_.emplace(*std::move(file));
  return out;
}

Result<void> RowsFile::write(std::size_t row, const DistanceResult& answer) {
  return rows_ ? rows_->write(row, answer.distances)
               : sparse_->append(answer.vertices, answer.distances);
}

std::optional<std::uint64_t> RowsFile::entries() const {
  return sparse_ ? std::optional(sparse_->entries()) : std::nullopt;
}

double RowsFile::bytes() const {
  if (!sparse_) return bytes_;
  return static_cast<double>(sparse_->entries()) * (number_bytes_ + sizeof(Index)) +
         static_cast<double>(sparse_->rows()) * sizeof(std::int64_t);
}

std::string RowsFile::size_in_words() const {
  if (!sparse_) return bytes_in_words(bytes_);
  const auto count = static_cast<std::int64_t>(sparse_->entries());
  if (count == 0) return "sparse rows";
  return counted(count, "entry", "entries") + " in " + bytes_in_words(bytes());
}

}  // namespace geotherm::app
