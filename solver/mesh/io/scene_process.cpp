// SPDX-License-Identifier: MIT
// Assimp runs in a process of its own, which sends back what it read: on damaged files it may end
// by its assertions, or take time and memory without end.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "solver/core/memory.h"
#include "solver/core/text.h"
#include "solver/mesh/io/frame_array.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_mesh.h"
#include "solver/mesh/io/scene_reader.h"

namespace geotherm::io {

bool write_all(int descriptor, const void* data, std::size_t size) {
  const char* from = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::write(descriptor, from, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    from += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}
namespace {

enum class Outcome : std::uint64_t { kMesh = 1, kFailure, kNoMemory };

/// What stands in front of the arrays; sizes are counts.
struct SceneHeader {
  Outcome outcome = Outcome::kNoMemory;
  std::uint64_t positions = 0, faces = 0, polygons = 0, text = 0;
  std::int64_t up_axis = -1, frames = 0;
};

/// Frames are many times the work of the scene as it stands.
std::chrono::seconds longest_time(std::size_t bytes, bool frames) {
  return std::chrono::seconds((frames ? 30 : 1) * (10 + 2 * (bytes >> 20)));
}

/// What the process may take beyond what it has: scenes that are packed become much larger.
std::uint64_t most_memory(std::size_t bytes) {
  constexpr std::uint64_t kAtLeast = std::uint64_t{2} << 30, kTimes = 400;
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const auto free = static_cast<std::uint64_t>(
      std::max<std::int64_t>(free_memory().value_or(std::int64_t{1} << 50), 0));
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) +
         std::min(free, std::max(kAtLeast, kTimes * bytes));
}

/// Waits no longer than until `end`.
bool receive(int pipe, void* data, std::size_t size, std::chrono::steady_clock::time_point end) {
  char* to = static_cast<char*>(data);
  while (size > 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        end - std::chrono::steady_clock::now());
    pollfd ready{pipe, POLLIN, 0};
    const int found = ::poll(&ready, 1, std::max(static_cast<int>(left.count()), 0));
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) return false;
    const ssize_t got = ::read(pipe, to, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

/// The work of the process, which ends with it.
[[noreturn]] void read_and_send(int pipe, std::string_view bytes, std::string_view format,
                                const std::string& folder, SceneFrames* frames) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit memory{most_memory(bytes.size()), most_memory(bytes.size())};
  ::setrlimit(RLIMIT_AS, &memory);
  ::signal(SIGABRT, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  SceneHeader header;
  RawMesh raw;
  std::string text;
  try {
    raw = read_scene_here(bytes, format, folder, frames);
    for (const std::string& note : raw.notes) text += note + '\n';
    header = {
        Outcome::kMesh, raw.positions.size(),     raw.faces.size(),          raw.polygons.size(),
        text.size(),    raw.up_axis.value_or(-1), frames ? frames->count : 0};
  } catch (const ReadFailure& failure) {
    text = failure.message;
    header.outcome = Outcome::kFailure;
    header.text = text.size();
  } catch (...) {  // bad_alloc; Assimp's own exceptions have become failures
  }
  const bool sent = write_all(pipe, &header, sizeof header) &&
                    write_all(pipe, raw.positions.data(), header.positions * sizeof(Vec3)) &&
                    write_all(pipe, raw.faces.data(), header.faces * sizeof(Face)) &&
                    write_all(pipe, raw.polygons.data(), header.polygons * sizeof(Polygon)) &&
                    write_all(pipe, text.data(), text.size());
  ::_exit(sent ? 0 : 1);
}

class SceneProcess {
 public:
  /// `frames`: null: none are wanted; its `count` is filled by mesh().
  SceneProcess(std::string_view bytes, std::string_view format, const std::string& folder,
               SceneFrames* frames = nullptr)
      : frames_(frames), seconds_(longest_time(bytes.size(), frames != nullptr)) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_start();
    pipe_ = ends[0];
    child_ = ::fork();
    if (child_ == 0) read_and_send(ends[1], bytes, format, folder, frames);
    ::close(ends[1]);
    if (child_ < 0) fail_to_start();
  }
  SceneProcess(const SceneProcess&) = delete;
  SceneProcess& operator=(const SceneProcess&) = delete;
  ~SceneProcess() {
    ::close(pipe_);
    finish();
  }

  RawMesh mesh() {
    SceneHeader header;
    take(&header, sizeof header);
    if (header.outcome == Outcome::kNoMemory) throw std::bad_alloc();
    RawMesh raw;
    raw.positions.resize(header.positions);
    raw.faces.resize(header.faces);
    raw.polygons.resize(header.polygons);
    std::string text(header.text, '\0');
    take(raw.positions.data(), header.positions * sizeof(Vec3));
    take(raw.faces.data(), header.faces * sizeof(Face));
    take(raw.polygons.data(), header.polygons * sizeof(Polygon));
    take(text.data(), text.size());
    if (header.outcome == Outcome::kFailure) throw ReadFailure{text};
    for (std::size_t at = 0, end; (end = text.find('\n', at)) != text.npos; at = end + 1) {
      raw.notes.push_back(text.substr(at, end - at));
    }
    if (header.up_axis >= 0) raw.up_axis = static_cast<int>(header.up_axis);
    if (frames_ != nullptr) frames_->count = header.frames;
    return raw;
  }

 private:
  [[noreturn]] void fail_to_start() const {
    throw ReadFailure{"no process can be started that reads it: " +
                      std::generic_category().message(errno)};
  }

  void take(void* data, std::size_t size) {
    if (receive(pipe_, data, size, end_)) return;
    if (std::chrono::steady_clock::now() >= end_) {
      throw ReadFailure{"Assimp was not done with it after " + std::to_string(seconds_.count()) +
                            " s: it is damaged or too large",
                        0,
                        {},
                        {"save the model as .obj or .ply"}};
    }
    throw ReadFailure{"Assimp broke off while it read it: it is damaged",
                      0,
                      {},
                      {"save the model again, or as .obj or .ply"}};
  }

  void finish() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);  // it has sent what it had, or never will
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) continue;
  }

  SceneFrames* frames_;
  std::chrono::seconds seconds_;
  std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::now() + seconds_;
  int pipe_ = -1;
  pid_t child_ = -1;
};

}  // namespace

RawMesh read_scene(std::string_view bytes, std::string_view format, const std::string& folder) {
  return SceneProcess(bytes, format, folder).mesh();
}

namespace {

/// The folder of the files that a scene names, with its slash; empty: there is none.
std::string folder_of(const InputFile& file) {
  if (file.is_stream()) return "";
  const std::size_t slash = file.path().rfind('/');
  return slash == std::string::npos ? "./" : file.path().substr(0, slash + 1);
}

/// A file for as long as it is open, in the folder for temporary files.
class PassingFile {
 public:
  PassingFile() : path_(std::filesystem::temp_directory_path() / "geotherm-frames-XXXXXX") {
    descriptor_ = ::mkostemp(path_.data(), O_CLOEXEC);
    if (descriptor_ < 0) {
      throw ReadFailure{"no file can be made for its frames in " + printable(path_) + ": " +
                            std::generic_category().message(errno),
                        0,
                        {},
                        {"set TMPDIR to a folder with room"}};
    }
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  ~PassingFile() {
    ::close(descriptor_);
    ::unlink(path_.c_str());
  }

  int descriptor() const { return descriptor_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace

RawMesh read_scene(const InputFile& file) {
  return read_scene(FileBytes(file).bytes(), file.extension().substr(1), folder_of(file));
}

MovingScene read_moving_scene(const InputFile& file) {
  const PassingFile passing;
  SceneFrames frames{passing.descriptor()};
  const FileBytes bytes(file);
  RawMesh mesh =
      SceneProcess(bytes.bytes(), file.extension().substr(1), folder_of(file), &frames).mesh();
  auto written = InputFile::open_as_is(passing.path());
  if (!written) throw ReadFailure{written.error().message, 0, {}, written.error().hint};
  const auto vertices = static_cast<std::int64_t>(mesh.positions.size());
  return {
      std::move(mesh), *std::move(written), {frames.count, vertices, true, std::endian::native, 0}};
}

}  // namespace geotherm::io
