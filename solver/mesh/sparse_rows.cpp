// SPDX-License-Identifier: MIT
// Sparse rows as a .npz: a zip file of arrays that are not compressed.
#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <cassert>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "geotherm/io.h"
#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/output_file.h"

namespace geotherm {
namespace {

constexpr std::size_t kAtOnce = std::size_t{1} << 20;

std::uint32_t checksum(std::uint32_t before, std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()),
                                            static_cast<z_size_t>(bytes.size())));
}

/// Bytes that wait on the disk, in a file without a name that goes with its descriptor.
class WaitingBytes {
 public:
  explicit WaitingBytes(const std::string& beside) : path_(beside) {
    namespace fs = std::filesystem;
    std::error_code unknown;
    fs::path folder = fs::path(beside).parent_path();
    if (beside == "-" || !fs::is_directory(folder.empty() ? "." : folder, unknown)) {
      folder = fs::temp_directory_path(unknown);
    }
    std::string name = (folder / ".geotherm-XXXXXX").string();
    file_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (file_ >= 0) ::unlink(name.c_str());
  }
  WaitingBytes(WaitingBytes&& other) noexcept { *this = std::move(other); }
  WaitingBytes& operator=(WaitingBytes&& other) noexcept {
    path_ = std::move(other.path_);
    buffer_ = std::move(other.buffer_);
    std::swap(file_, other.file_);
    size_ = other.size_;
    sum_ = other.sum_;
    return *this;
  }
  ~WaitingBytes() {
    if (file_ >= 0) ::close(file_);
  }

  bool is_open() const { return file_ >= 0; }
  std::uint64_t size() const { return size_; }
  std::uint32_t sum() const { return sum_; }

  std::string& buffer() { return buffer_; }
  Error failure() const {
    return {ErrorCode::kBadFile, io::printable(path_) +
                                     ": what waits beside it cannot be written: " +
                                     std::generic_category().message(errno)};
  }
  /// Writes the buffer where there is much in it.
  Result<void> settle(bool all = false) {
    if (!all && buffer_.size() < kAtOnce) return {};
    sum_ = checksum(sum_, buffer_);
    size_ += buffer_.size();
    std::string_view left = buffer_;
    while (!left.empty()) {
      const ssize_t written = ::write(file_, left.data(), left.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return failure();
      left.remove_prefix(static_cast<std::size_t>(written));
    }
    buffer_.clear();
    return {};
  }
  /// Appends all of it to `to`.
  Result<void> copy(GrowingFile& to) {
    if (::lseek(file_, 0, SEEK_SET) != 0) return failure();
    std::string bytes(kAtOnce, '\0');
    for (;;) {
      const ssize_t count = ::read(file_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return failure();
      if (count == 0) return {};
      const auto size = static_cast<std::size_t>(count);
      if (auto written = to.append(std::string_view(bytes).substr(0, size)); !written) {
        return written;
      }
    }
  }

 private:
  std::string path_;
  std::string buffer_;
  int file_ = -1;
  std::uint64_t size_ = 0;
  std::uint32_t sum_ = 0;
};

/// A zip file as it grows; sizes and places are those of zip64.
class ZipWriter {
 public:
  explicit ZipWriter(GrowingFile& file) : file_(file) {}

  /// `rest`: what follows `bytes` in the entry; may be null.
  Result<void> add(const std::string& name, const std::string& bytes,
                   WaitingBytes* rest = nullptr) {
    Entry entry{name, checksum(0, bytes), bytes.size(), place_};
    if (rest != nullptr) {
      entry.sum = static_cast<std::uint32_t>(
          crc32_combine(entry.sum, rest->sum(), static_cast<z_off_t>(rest->size())));
      entry.size += rest->size();
    }
    std::string header;
    io::append_little(header, std::uint32_t{0x04034b50});
    add_common(entry, header);
    io::append_little(header, std::uint16_t{20});  // bytes of what follows the name
    header += name;
    add_sizes(entry, header, false);
    if (auto written = append(header + bytes); !written) return written;
    if (rest != nullptr) {
      if (auto copied = rest->copy(file_); !copied) return copied;
      place_ += rest->size();
    }
    entries_.push_back(std::move(entry));
    return {};
  }

  Result<void> finish() {
    const std::uint64_t begins = place_;
    std::string list;
    for (const Entry& entry : entries_) {
      io::append_little(list, std::uint32_t{0x02014b50});
      io::append_little(list, std::uint16_t{45});
      add_common(entry, list);
      io::append_little(list, std::uint16_t{28});
      list.append(8, '\0');  // comment, disk, attributes
      list.append(2, '\0');
      io::append_little(list, std::uint32_t{0xffffffff});
      list += entry.name;
      add_sizes(entry, list, true);
    }
    const std::uint64_t bytes = list.size(), count = entries_.size();
    io::append_little(list, std::uint32_t{0x06064b50});
    io::append_little(list, std::uint64_t{44});
    io::append_little(list, std::uint16_t{45});
    io::append_little(list, std::uint16_t{45});
    list.append(8, '\0');
    for (const std::uint64_t number : {count, count, bytes, begins})
      io::append_little(list, number);
    io::append_little(list, std::uint32_t{0x07064b50});
    io::append_little(list, std::uint32_t{0});
    io::append_little(list, begins + bytes);
    io::append_little(list, std::uint32_t{1});
    io::append_little(list, std::uint32_t{0x06054b50});
    list.append(4, '\0');
    for (int i = 0; i < 2; ++i) io::append_little(list, static_cast<std::uint16_t>(count));
    io::append_little(list, static_cast<std::uint32_t>(bytes));
    io::append_little(list, std::uint32_t{0xffffffff});
    list.append(2, '\0');
    return append(list);
  }

 private:
  struct Entry {
    std::string name;
    std::uint32_t sum;
    std::uint64_t size, place;
  };

  /// Appends the fields that both headers of a zip entry share, from the version that can read it
  /// to the length of its name.
  static void add_common(const Entry& entry, std::string& to) {
    constexpr std::uint16_t kFirstDay = 33;  // 1980-01-01, the first that a zip file knows
    for (const std::uint16_t number :
         {std::uint16_t{45}, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, kFirstDay}) {
      io::append_little(to, number);
    }
    io::append_little(to, entry.sum);
    for (int i = 0; i < 2; ++i) io::append_little(to, std::uint32_t{0xffffffff});
    io::append_little(to, static_cast<std::uint16_t>(entry.name.size()));
  }
  static void add_sizes(const Entry& entry, std::string& to, bool with_place) {
    io::append_little(to, std::uint16_t{1});
    io::append_little(to, static_cast<std::uint16_t>(with_place ? 24 : 16));
    io::append_little(to, entry.size);
    io::append_little(to, entry.size);
    if (with_place) io::append_little(to, entry.place);
  }
  Result<void> append(const std::string& bytes) {
    place_ += bytes.size();
    return file_.append(bytes);
  }

  GrowingFile& file_;
  std::uint64_t place_ = 0;
  std::vector<Entry> entries_;
};

std::string npy_of(const std::vector<std::int64_t>& numbers) {
  const std::uint64_t shape[] = {numbers.size()};
  std::string bytes = io::npy_header("<i8", shape);
  for (const std::int64_t number : numbers) io::append_little(bytes, number);
  return bytes;
}

}  // namespace

struct SparseRows::State {
  GrowingFile file;
  std::string path;
  std::uint64_t columns;
  NpyType type;
  WaitingBytes data, indices;
  std::vector<std::int64_t> starts = {0};
};

SparseRows::SparseRows(std::unique_ptr<State> state) : state_(std::move(state)) {}
SparseRows::SparseRows(SparseRows&&) noexcept = default;
SparseRows& SparseRows::operator=(SparseRows&&) noexcept = default;
SparseRows::~SparseRows() = default;

Result<SparseRows> SparseRows::open(const std::string& path, std::uint64_t columns, NpyType type) {
  auto file = GrowingFile::open(path);
  if (!file) return file.error();
  auto state = std::make_unique<State>(
      State{*std::move(file), path, columns, type, WaitingBytes(path), WaitingBytes(path)});
  for (const WaitingBytes* bytes : {&state->data, &state->indices}) {
    if (!bytes->is_open()) return bytes->failure();
  }
  return SparseRows(std::move(state));
}

Result<void> SparseRows::append(std::span<const Index> columns, std::span<const double> values) {
  assert(columns.size() == values.size());
  State& s = *state_;
  if (s.type == NpyType::kFloat32) {
    if (auto fits = io::check_float_range(s.path, values); !fits) return fits;
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    io::append_little(s.indices.buffer(), static_cast<std::int32_t>(columns[i]));
    if (s.type == NpyType::kFloat64) {
      io::append_little(s.data.buffer(), values[i]);
    } else {
      io::append_little(s.data.buffer(), static_cast<float>(values[i]));
    }
  }
  s.starts.push_back(s.starts.back() + std::ssize(columns));
  if (auto written = s.indices.settle(); !written) return written;
  return s.data.settle();
}

std::uint64_t SparseRows::rows() const { return state_->starts.size() - 1; }
std::uint64_t SparseRows::entries() const {
  return static_cast<std::uint64_t>(state_->starts.back());
}

Result<void> SparseRows::finish() {
  State& s = *state_;
  for (WaitingBytes* bytes : {&s.indices, &s.data}) {
    if (auto written = bytes->settle(true); !written) return written;
  }
  const std::uint64_t count[] = {entries()};
  const std::string number = s.type == NpyType::kFloat64 ? "<f8" : "<f4";
  ZipWriter zip(s.file);
  Result<void> done = zip.add("indices.npy", io::npy_header("<i4", count), &s.indices);
  if (done) done = zip.add("indptr.npy", npy_of(s.starts));
  if (done) done = zip.add("format.npy", io::npy_header("|S3", {}) + "csr");
  if (done) {
    done =
        zip.add("shape.npy",
                npy_of({static_cast<std::int64_t>(rows()), static_cast<std::int64_t>(s.columns)}));
  }
  if (done) done = zip.add("data.npy", io::npy_header(number, count), &s.data);
  if (done) done = zip.finish();
  return done ? s.file.finish() : done;
}

}  // namespace geotherm
