// SPDX-License-Identifier: MIT
#include "app/cli/rows_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {

namespace {

/// What FILE.part has of the disk already.
double bytes_of_part(const std::string& path) {
  constexpr double kBytesOfBlock = 512;
  struct stat status {};
  return ::stat((path + ".part").c_str(), &status) == 0
             ? kBytesOfBlock * static_cast<double>(status.st_blocks)
             : 0.0;
}

}  // namespace

Error about_file(const Error& error) {
  return with_hint(error, {"make room there, or choose another place"});
}

struct SharedFile::State {
  std::optional<GrowingFile> file;  ///< of the first rank
  std::string path, name;
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
                                    const Ranks& ranks, bool part) {
  SharedFile out(std::make_unique<State>());
  State& state = *out.state_;
  state.path = path;
  state.header = header.size();
  const auto begin = [&]() -> Result<void> {
    if (!ranks.is_first()) return {};
    if (!ranks.alone() && path == "-") {
      return Error{ErrorCode::kBadInput,
                   "several processes cannot share standard output",
                   {"give -o FILE.npy"}};
    }
    auto file = part ? GrowingFile::open_part(path) : GrowingFile::open(path);
    if (!file) return file.error();
    state.file = *std::move(file);
    return state.file->append(header);
  };
  if (auto begun = ranks.agree(begin()); !begun) return begun.error();
  if (ranks.alone() && !part) return out;
  state.name = ranks.all_gather(ranks.is_first() ? state.file->place() : std::string()).front();
  state.place = ::open(state.name.c_str(), O_RDWR | O_CLOEXEC);
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

Result<void> SharedFile::read(std::uint64_t at, std::string& bytes) const {
  const State& state = *state_;
  at += state.header;
  for (std::size_t have = 0; have < bytes.size();) {
    const ssize_t count = ::pread(state.place, bytes.data() + have, bytes.size() - have,
                                  static_cast<off_t>(at + have));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      return Error{ErrorCode::kBadFile,
                   one_line(state.name) + ": cannot be read: " +
                       std::generic_category().message(count < 0 ? errno : EIO)};
    }
    have += static_cast<std::size_t>(count);
  }
  return {};
}

Result<void> SharedFile::to_disk() const {
  return ::fdatasync(state_->place) == 0 ? Result<void>() : state_->failure(errno);
}

Result<void> SharedFile::finish() { return state_->file->finish(); }

const std::string& SharedFile::place() const { return state_->name; }

Result<SharedRows> SharedRows::open(const std::string& path, ManySources& work, Index columns,
                                    NpyType type, const TakeDistances& take) {
  const std::uint64_t rows = work.sources.sets.size();
  const auto width = static_cast<std::uint64_t>(columns);
  const bool keeps = !work.model.space && is_renamed(path);
  const std::string header = io::npy_rows_header(rows, width, type);
  auto file = SharedFile::open(path, header, work.ranks, keeps);
  if (!file) return file.error();
  const std::uint64_t row = npy_bytes_of(1, width, type) - npy_bytes_of(0, width, type);
  SharedRows out(*std::move(file), path, row, type);
  if (!keeps) return out;
  auto list = KeptRows::open(out.file_.place(), header.size() + rows * row,
                             job_of(work, columns, type), rows, work.ranks);
  if (!list) return list.error();
  out.kept_.emplace(*std::move(list));
  std::string marks = out.kept_->marks();
  share_out(work, marks);
  const auto taken = work.ranks.agree(out.take_kept(work, marks, columns, take));
  return taken ? Result<SharedRows>(std::move(out)) : taken.error();
}

Result<void> SharedRows::take_kept(const ManySources& work, const std::string& marks, Index columns,
                                   const TakeDistances& take) const {
  std::vector<double> distances(static_cast<std::size_t>(columns));
  std::string bytes(row_, '\0');
  const auto ranks = static_cast<std::size_t>(work.ranks.count());
  for (std::size_t row = 0; row < work.sources.sets.size(); ++row) {
    const std::size_t block = row / kBlockRows;
    if (marks[block] == '0' || block % ranks != static_cast<std::size_t>(work.ranks.rank())) {
      continue;
    }
    if (auto read = file_.read(row * row_, bytes); !read) return read;
    for (std::size_t v = 0; v < distances.size(); ++v) {
      distances[v] = type_ == NpyType::kFloat64
                         ? io::load<double>(bytes.data() + 8 * v, std::endian::little)
                         : io::load<float>(bytes.data() + 4 * v, std::endian::little);
    }
    if (auto taken = take(row, distances); !taken) return taken;
  }
  return {};
}

Result<void> SharedRows::write(std::size_t row, std::span<const double> distances) {
  if (auto made = io::npy_row(path_, distances, type_, bytes_); !made) return made;
  auto written = file_.write(row * row_, bytes_);
  if (!written || !kept_) return written;
  return kept_->add(row, [this] { return file_.to_disk(); });
}

Result<void> SharedRows::finish() {
  auto finished = file_.finish();
  if (finished && kept_) kept_->finish();
  return finished;
}

void SharedRows::discard() {
  std::error_code gone;
  std::filesystem::remove(file_.place(), gone);
  if (kept_) kept_->finish();
}

Result<RowsFile> RowsFile::open(const std::string& path, ManySources& work, NpyType type,
                                const TakeDistances& take) {
  RowsFile out;
  const std::size_t targets = work.reach.targets.size();
  out.columns_ = targets > 0 ? static_cast<Index>(targets) : work.mesh.vertices;
  out.number_bytes_ = type == NpyType::kFloat64 ? 8 : 4;
  const auto columns = static_cast<std::uint64_t>(out.columns_);
  if (work.reach.sparse && !work.ranks.alone()) {
    return Error{ErrorCode::kBadInput,
                 one_line(path) + ": sparse rows are written by one process",
                 {"give -o FILE.npy"}};
  }
  if (work.reach.sparse) {
    auto file = SparseRows::open(path, columns, type);
    if (!file) return about_file(file.error());
    out.sparse_ = *std::move(file);
    return out;
  }
  const std::uint64_t rows = work.sources.sets.size();
  out.bytes_ = static_cast<double>(npy_bytes_of(rows, columns, type));
  const double more = out.bytes_ - bytes_of_part(path);
  if (auto fits = work.ranks.agree(check_room(path, more)); !fits) return fits.error();
  auto file = SharedRows::open(path, work, out.columns_, type, take);
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
