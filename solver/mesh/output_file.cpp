// SPDX-License-Identifier: MIT
#include "solver/mesh/output_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "solver/core/text.h"

namespace geotherm {
namespace {

namespace fs = std::filesystem;

/// Follows the name of a file that is being written.
constexpr const char* kBeside = ".tmp-";
constexpr const char* kPart = ".part";

enum State : int { kFree, kTaken, kOpening, kOpen };

struct Slot {
  std::atomic<int> state = kFree;
  std::array<char, PATH_MAX> path;
};
static_assert(std::atomic<int>::is_always_lock_free);

std::array<Slot, 32> slots;
std::atomic<bool> closed = false;

/// A slot with the path in it, or -1.
int take_slot(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = kFree;
    if (!slots[i].state.compare_exchange_strong(expected, kTaken)) continue;
    std::copy_n(path.c_str(), path.size() + 1, slots[i].path.begin());
    return static_cast<int>(i);
  }
  return -1;
}

/// While it lives, signals are handled by other threads: the handler waits for this one.
class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;
  ~NoSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

/// A name that is removed by remove_unfinished_files() while this lives. For several threads. Where
/// more than 32 live at once, those above are left behind.
class UnfinishedFile {
 public:
  /// Creates the file, which must not exist: descriptor(), or -1 with errno. From the first moment
  /// on it is known; the calling thread takes no signal in between.
  explicit UnfinishedFile(const std::string& path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int slot_ = -1;
  int descriptor_ = -1;
};

UnfinishedFile::UnfinishedFile(const std::string& path) : slot_(take_slot(path)) {
  int code = 0;
  {
    const NoSignals undisturbed;
    if (slot_ >= 0) slots[slot_].state = kOpening;
    // Set before the handler looks at the slots: it sees kOpening, or nothing is opened here.
    if (closed) {
      code = EINTR;
    } else {
      descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      code = errno;
    }
    if (slot_ >= 0) slots[slot_].state = descriptor_ >= 0 ? kOpen : kTaken;
  }
  errno = code;
}

UnfinishedFile::~UnfinishedFile() {
  if (slot_ >= 0) slots[slot_].state = kFree;
}

Error failure(const std::string& path, int code) {
  return {ErrorCode::kBadFile,
          io::printable(path) + ": cannot be written: " + std::generic_category().message(code)};
}

/// 0, or the system's error code.
int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Removes what programs that were killed have left of this file: each locks what it writes, and a
/// lock ends with its owner.
void remove_abandoned(const std::string& target) {
  const fs::path path(target);
  const std::string begin = path.filename().string() + kBeside;
  std::error_code unknown;
  std::vector<std::string> found;
  fs::directory_iterator at(path.has_parent_path() ? path.parent_path() : ".", unknown);
  for (; !unknown && at != fs::directory_iterator(); at.increment(unknown)) {
    if (!at->path().filename().string().starts_with(begin)) continue;
    // One without a byte may have been opened just now, and be locked next.
    std::error_code gone;
    if (at->is_regular_file(gone) && at->file_size(gone) > 0) found.push_back(at->path().string());
  }
  for (const std::string& name : found) {
    const int file = ::open(name.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) continue;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(name.c_str());
    ::close(file);
  }
}

}  // namespace

std::string end_of_links(const std::string& path) {
  constexpr int kMaxLinks = 40;
  std::error_code unresolved;
  fs::path end = fs::weakly_canonical(path, unresolved);
  if (unresolved) return path;
  // Links to what is not there yet stand in it as they are.
  for (int i = 0; i < kMaxLinks && fs::is_symlink(end, unresolved); ++i) {
    const fs::path next = end.parent_path() / fs::read_symlink(end, unresolved);
    if (unresolved) break;
    end = fs::weakly_canonical(next, unresolved);
    if (unresolved) return path;
  }
  return end.string();
}

/// Never freed: the handler of a signal may be reading the list at any moment.
struct FileGroup::File {
  std::string path;
  std::atomic<bool> lives = true;
  File* next = nullptr;

  inline static std::atomic<File*> last = nullptr;
};

void FileGroup::add(const std::string& path) {
  auto* const file = new File{path};
  file->next = File::last;
  while (!File::last.compare_exchange_weak(file->next, file)) {
  }
  files_.push_back(file);
}

FileGroup::~FileGroup() {
  for (File* const file : files_) file->lives = false;
}

void remove_unfinished_files() noexcept {
  constexpr int kMaxWaits = 1000, kMilliseconds = 1;
  closed = true;
  for (Slot& slot : slots) {
    for (int i = 0; slot.state == kOpening && i < kMaxWaits; ++i) {
      ::poll(nullptr, 0, kMilliseconds);
    }
    if (slot.state == kOpen) ::unlink(slot.path.data());
  }
  // After those: what is renamed in between is among these.
  for (const FileGroup::File* file = FileGroup::File::last; file; file = file->next) {
    if (file->lives) ::unlink(file->path.c_str());
  }
}

struct GrowingFile::State {
  std::string path;       ///< as given, for messages
  std::string target;     ///< what the temporary file becomes
  std::string temporary;  ///< empty: written in place
  bool stays = false;     ///< the temporary file, where finish() is not reached
  std::unique_ptr<UnfinishedFile> unfinished;
  int file = -1;  ///< -1: standard output

  ~State() { abandon(); }

  void abandon() {
    if (file >= 0) ::close(std::exchange(file, -1));
    if (!temporary.empty() && !stays) ::unlink(std::exchange(temporary, {}).c_str());
    unfinished.reset();
  }

  /// FILE.part; 0, or the system's error code, EWOULDBLOCK where another process has it.
  int open_part(std::optional<mode_t> mode) {
    const std::string name = target + kPart;
    for (;;) {
      file = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (file < 0) return errno;
      if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return EWOULDBLOCK;
      // The one before may have renamed it in between.
      struct stat ours {};
      struct stat there {};
      if (::fstat(file, &ours) != 0) return errno;
      if (::stat(name.c_str(), &there) == 0 && ours.st_ino == there.st_ino) break;
      ::close(std::exchange(file, -1));
    }
    temporary = name;
    stays = true;
    if (mode) ::fchmod(file, *mode & 07777);
    return 0;
  }

  /// A file of a new name beside the target; 0, or the system's error code.
  int open_beside(std::optional<mode_t> mode) {
    constexpr int kMaxAttempts = 1000;
    const std::string stem = target + kBeside + std::to_string(::getpid()) + '-';
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
      const std::string name = stem + std::to_string(attempt);
      unfinished.reset();  // before errno is set
      unfinished = std::make_unique<UnfinishedFile>(name);
      if (unfinished->descriptor() < 0 && errno == EEXIST) continue;
      if (unfinished->descriptor() < 0) return errno;
      file = unfinished->descriptor();
      temporary = name;
      ::flock(file, LOCK_EX | LOCK_NB);  // remove_abandoned()
      if (mode) ::fchmod(file, *mode & 07777);
      return 0;
    }
    return EEXIST;
  }
};

GrowingFile::GrowingFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
GrowingFile::GrowingFile(GrowingFile&&) noexcept = default;
GrowingFile& GrowingFile::operator=(GrowingFile&&) noexcept = default;
GrowingFile::~GrowingFile() = default;

Result<GrowingFile> GrowingFile::open(const std::string& path) {
  auto state = std::make_unique<State>();
  state->path = path;
  if (path == "-") return GrowingFile(std::move(state));
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) return failure(path, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {  // a device or a pipe must stay what it is
    state->file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (state->file < 0) return failure(path, errno);
    return GrowingFile(std::move(state));
  }
  if (exists && ::access(path.c_str(), W_OK) != 0) return failure(path, errno);
  state->target = end_of_links(path);
  remove_abandoned(state->target);
  const int code =
      state->open_beside(exists ? std::optional(status.st_mode) : std::optional<mode_t>());
  if (code != 0) return failure(path, code);
  return GrowingFile(std::move(state));
}

Result<GrowingFile> GrowingFile::open_part(const std::string& path) {
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && ::access(path.c_str(), W_OK) != 0) return failure(path, errno);
  auto state = std::make_unique<State>();
  state->path = path;
  state->target = end_of_links(path);
  const int code =
      state->open_part(exists ? std::optional(status.st_mode) : std::optional<mode_t>());
  if (code == EWOULDBLOCK) {
    return Error{ErrorCode::kBadFile,
                 io::printable(path) + ": another process is writing it",
                 {"wait for its end, or choose another name"}};
  }
  if (code != 0) return failure(path, code);
  return GrowingFile(std::move(state));
}

Result<void> GrowingFile::append(std::string_view bytes) {
  if (state_->path == "-") {
    // Through the C stream: what the program wrote before must come before.
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size()) return {};
    return failure("standard output", errno);
  }
  const int code = write_all(state_->file, bytes);
  if (code == 0) return {};
  state_->abandon();  // at once: it may have filled the disk
  return failure(state_->path, code);
}

const std::string& GrowingFile::place() const {
  return state_->temporary.empty() ? state_->path : state_->temporary;
}

Result<void> GrowingFile::finish() {
  if (state_->path == "-") {
    if (std::fflush(stdout) == 0) return {};
    return failure("standard output", errno);
  }
  const int owned = ::dup(state_->file);  // keeps the lock until it has its name
  const int closed = ::close(std::exchange(state_->file, -1));
  int code = closed == 0 ? 0 : errno;
  if (code == 0 && !state_->temporary.empty()) {
    if (::rename(state_->temporary.c_str(), state_->target.c_str()) != 0) code = errno;
    if (code == 0) state_->temporary.clear();
  }
  if (owned >= 0) ::close(owned);
  state_->abandon();
  return code == 0 ? Result<void>() : failure(state_->path, code);
}

bool is_renamed(const std::string& path) {
  std::error_code unknown;
  return path != "-" && (!fs::exists(path, unknown) || fs::is_regular_file(path, unknown));
}

std::optional<std::uint64_t> room_for(const std::string& path) {
  std::error_code unknown;
  if (!is_renamed(path)) return {};
  const fs::path folder = fs::path(end_of_links(path)).parent_path();
  const fs::space_info space = fs::space(folder.empty() ? "." : folder, unknown);
  if (unknown || space.available == static_cast<std::uintmax_t>(-1)) return {};
  return space.available;
}

Result<void> write_file(const std::string& path, std::string_view bytes) {
  auto file = GrowingFile::open(path);
  if (!file) return file.error();
  if (auto written = file->append(bytes); !written) return written;
  return file->finish();
}

Result<void> check_written(const std::string& path, const std::string& known,
                           const std::string& of) {
  const std::string extension = io::file_extension(path);
  if (path == "-" || (!extension.empty() && (known + ' ').find(extension + ' ') != known.npos)) {
    return {};
  }
  return Error{ErrorCode::kNotAvailable,
               io::printable(path) + ": unknown extension \"" + io::printable(extension) + '"' + of,
               {"there are " + known}};
}

Result<void> write_made(const std::string& path,
                        const std::function<Result<std::string>()>& make_bytes) try {
  const Result<std::string> bytes = make_bytes();
  if (bytes) return write_file(path, *bytes);
  Error error = bytes.error();
  error.message = io::printable(path) + ": " + error.message;
  return error;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, io::printable(path) + ": not enough memory to write it"};
}

}  // namespace geotherm
