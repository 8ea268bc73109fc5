// SPDX-License-Identifier: MIT
#include "app/cli/film.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "app/text/text.h"
#include "geotherm/io.h"
#include "solver/core/text.h"
#include "solver/mesh/output_file.h"

extern char** environ;

namespace geotherm::app {
namespace {

namespace fs = std::filesystem;

std::string reason() { return std::generic_category().message(errno); }

/// The program's place; empty: it is in no folder of PATH.
std::string ffmpeg_path() {
  const char* const folders = std::getenv("PATH");
  std::string rest = folders != nullptr ? folders : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const std::string path = rest.substr(0, end) + "/ffmpeg";
    std::error_code unknown;
    if (end > 0 && fs::is_regular_file(path, unknown) && ::access(path.c_str(), X_OK) == 0) {
      return path;
    }
    rest.erase(0, end + 1);
  }
  return {};
}

/// What becomes of the frames, which come as raw RGBA on standard input.
std::vector<std::string> words_for(const std::string& path, const std::string& into,
                                   const DrawnPicture& first, int rate,
                                   const std::string& comment) {
  const std::string size = std::to_string(first.width) + "x" + std::to_string(first.height);
  char corner[16];  // what an odd side is made even with
  std::snprintf(corner, sizeof corner, "0x%02X%02X%02X", first.pixels[0], first.pixels[1],
                first.pixels[2]);
  std::vector<std::string> words = {"ffmpeg",
                                    "-hide_banner",
                                    "-loglevel",
                                    "error",
                                    "-nostdin",
                                    "-y",
                                    "-f",
                                    "rawvideo",
                                    "-pixel_format",
                                    "rgba",
                                    "-video_size",
                                    size,
                                    "-framerate",
                                    std::to_string(rate),
                                    "-i",
                                    "pipe:0",
                                    "-fflags",
                                    "+bitexact",
                                    "-flags:v",
                                    "+bitexact",
                                    "-metadata",
                                    "comment=" + comment};
  const std::vector<std::string> format =
      io::file_extension(path) == ".gif"
          ? std::vector<std::string>{"-filter_complex",
                                     "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-f", "gif"}
          // Players need even sides and colours at half the resolution.
          : std::vector<std::string>{
                "-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=" + std::string(corner),
                "-c:v",      "libx264",
                "-crf",      "18",
                "-pix_fmt",  "yuv420p",
                "-movflags", "+faststart",
                "-f",        "mp4"};
  words.insert(words.end(), format.begin(), format.end());
  words.push_back("file:" + into);
  return words;
}

}  // namespace

struct Film::State {
  std::string path;           ///< for messages
  std::string target, into;   ///< where it goes, and where it is until then
  int frames = -1;            ///< our end of what ffmpeg reads
  std::FILE* said = nullptr;  ///< what ffmpeg says of errors
  pid_t process = 0;          ///< 0: it has ended
  FileGroup unfinished;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (process > 0) {
      ::kill(process, SIGKILL);
      wait();
    }
    if (frames >= 0) ::close(frames);
    if (said != nullptr) std::fclose(said);
    if (!into.empty()) ::unlink(into.c_str());
  }

  /// The exit status, -1 where a signal ended it.
  int wait() {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    process = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Error failed() {
    std::string words;
    std::rewind(said);
    char piece[256];
    while (std::fgets(piece, sizeof piece, said) != nullptr) words += piece;
    std::string line(trimmed(words));
    line.erase(std::min(line.find('\n'), line.size()));
    return {ErrorCode::kBadFile, one_line(path) + ": ffmpeg could not make the film" +
                                     (line.empty() ? std::string() : ": " + one_line(line))};
  }
};

bool is_film(const std::string& path) {
  const std::string extension = io::file_extension(path);
  return extension == ".mp4" || extension == ".gif";
}

Result<void> find_ffmpeg() {
  if (!ffmpeg_path().empty()) return {};
  return Error{ErrorCode::kNotAvailable,
               "films are made by ffmpeg, which is in no folder of PATH",
               {"install it (apt-get install ffmpeg), or give a .png name for pictures"}};
}

Result<Film> Film::open(const std::string& path, const std::string& place,
                        const DrawnPicture& first, int frames_per_second,
                        const std::string& comment) {
  const std::string program = ffmpeg_path();
  if (program.empty()) return find_ffmpeg().error();
  auto state = std::make_unique<State>();
  state->path = path;
  state->target = end_of_links(place);
  const std::string into = state->target + "." + std::to_string(::getpid()) + ".part";
  int ends[2] = {-1, -1};
  state->said = std::tmpfile();
  if (state->said == nullptr || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    return Error{ErrorCode::kBadFile, one_line(path) + ": cannot be made: " + reason()};
  }
  state->frames = ends[0];
  state->unfinished.add(into);
  state->into = into;

  std::vector<std::string> words = words_for(path, into, first, frames_per_second, comment);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(state->said), STDERR_FILENO);
  const int failure =
      ::posix_spawn(&state->process, program.c_str(), &actions, nullptr, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (failure != 0) {
    state->process = 0;
    errno = failure;
    return Error{ErrorCode::kBadFile, one_line(program) + " does not start: " + reason()};
  }
  return Film(std::move(state));
}

Film::Film(std::unique_ptr<State> state) : state_(std::move(state)) {}
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;
Film::~Film() = default;

Result<void> Film::add(const DrawnPicture& picture) {
  const std::uint8_t* next = picture.pixels.data();
  std::size_t left = picture.pixels.size();
  while (left > 0) {
    // Where ffmpeg has ended this is an error and no signal.
    const ssize_t sent = ::send(state_->frames, next, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) {
      state_->wait();
      return state_->failed();
    }
    next += sent;
    left -= static_cast<std::size_t>(sent);
  }
  return {};
}

Result<void> Film::finish() {
  ::close(std::exchange(state_->frames, -1));
  if (state_->process == 0 || state_->wait() != 0) return state_->failed();
  if (::rename(state_->into.c_str(), state_->target.c_str()) != 0) {
    return Error{ErrorCode::kBadFile, one_line(state_->path) + ": cannot be written: " + reason()};
  }
  state_->into.clear();
  return {};
}

}  // namespace geotherm::app
