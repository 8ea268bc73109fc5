// SPDX-License-Identifier: MIT
#include "app/cli/batch_work.h"

#include <fcntl.h>
#include <glob.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "app/session/model.h"
#include "app/session/ranks.h"
#include "app/text/text.h"
#include "solver/mesh/output_file.h"

extern char** environ;

namespace geotherm::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWildcards = "*?[";

/// The path without its extension, and without ".gz" before that.
std::string stem_of(fs::path path) {
  if (path.extension() == ".gz") path.replace_extension();
  return path.replace_extension().string();
}

/// Files that fit, with the name of each below what is the same in all.
Result<std::map<std::string, std::string>> models_of(const std::string& word) {
  std::error_code unknown;
  std::map<std::string, std::string> found;
  if (fs::is_regular_file(word, unknown)) {
    found[word] = stem_of(fs::path(word).filename());
    return found;
  }
  const std::size_t wild = word.find_first_of(kWildcards);
  if (wild == std::string::npos) {
    if (is_bundled(word)) return std::map<std::string, std::string>{{word, word}};
    return Error{ErrorCode::kBadFile,
                 one_line(word) + (fs::is_directory(word, unknown) ? ": this is a folder"
                                                                   : ": there is no such file"),
                 {"give files, or a pattern in quotes, such as 'shapes/*.ply'"}};
  }
  const std::size_t slash = word.rfind('/', wild);
  const std::string same = slash == std::string::npos ? "" : word.substr(0, slash + 1);
  glob_t files{};
  const int code = ::glob(word.c_str(), 0, nullptr, &files);
  for (std::size_t i = 0; code == 0 && i < files.gl_pathc; ++i) {
    const std::string path = files.gl_pathv[i];
    if (fs::is_regular_file(path, unknown)) found[path] = stem_of(path.substr(same.size()));
  }
  ::globfree(&files);
  if (!found.empty()) return found;
  return Error{ErrorCode::kBadFile,
               one_line(word) + ": no file fits this pattern",
               {"look for a slip in it"}};
}

/// The environment without what makes a process a rank.
std::vector<char*> environment_of_one() {
  std::vector<char*> kept;
  for (char** each = environ; *each != nullptr; ++each) {
    if (!is_of_launcher(*each)) kept.push_back(*each);
  }
  kept.push_back(nullptr);
  return kept;
}

/// The last line that is an error of this program, or else the last.
std::string last_words(const std::string& said) {
  constexpr std::string_view kBegin = "geotherm: error: ";
  std::istringstream lines(said);
  std::string last, error;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kBegin)) error = line.substr(kBegin.size());
    if (!line.empty()) last = line;
  }
  return error.empty() ? last : error;
}

}  // namespace

Result<std::vector<BatchTask>> batch_tasks(const std::vector<std::string>& models,
                                           const std::string& folder, const std::string& format,
                                           const std::vector<std::string>& options) {
  std::map<std::string, std::string> all, by_name;
  for (const std::string& word : models) {
    auto found = models_of(word);
    if (!found) return found.error();
    all.merge(*found);
  }
  std::vector<BatchTask> tasks;
  for (const auto& [model, name] : all) {
    const auto [other, is_new] = by_name.emplace(name, model);
    if (!is_new) {
      return Error{ErrorCode::kBadInput,
                   one_line(other->second) + " and " + one_line(model) + " would both write " +
                       one_line(name + "." + format),
                   {"give a pattern in quotes, whose folders become folders of the output, or "
                    "another folder for one of them"}};
    }
    const std::string path = (fs::path(folder) / name).string();
    BatchTask task{model, name, path + "." + format, path + ".json", {"solve", model}};
    task.command.insert(task.command.end(), options.begin(), options.end());
    task.command.insert(task.command.end(),
                        {"--output=" + task.output, "--json=" + task.report, "--quiet"});
    tasks.push_back(std::move(task));
  }
  return tasks;
}

std::string text_at(const Json& object, const char* name) {
  if (!object.is_object()) return {};
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool is_done(const BatchTask& task) {
  std::error_code missing;
  if (!fs::is_regular_file(task.output, missing)) return false;
  std::ifstream file(task.report);
  const Json report = Json::parse(file, nullptr, false);
  const Json program = report.is_object() ? report.value("program", Json()) : Json();
  if (text_at(program, "version") != GEOTHERM_VERSION ||
      text_at(program, "command") != shell_command("geotherm", task.command)) {
    return false;
  }
  // The report is written last: what is younger was changed after it.
  const auto reported = fs::last_write_time(task.report, missing);
  if (fs::last_write_time(task.output, missing) > reported) return false;
  const auto read = fs::last_write_time(task.model, missing);
  return missing || read <= reported;
}

void remove_remains(const BatchTask& task) {
  std::error_code unknown;
  for (const std::string& path : {task.output, task.report}) {
    const std::string begin = fs::path(path).filename().string() + ".tmp-";
    std::vector<fs::path> remains;
    for (const auto& entry : fs::directory_iterator(fs::path(path).parent_path(), unknown)) {
      if (entry.path().filename().string().starts_with(begin)) remains.push_back(entry.path());
    }
    for (const fs::path& each : remains) fs::remove(each, unknown);
  }
}

Json manifest_line(const BatchTask& task, const BatchEnd& end, bool before) {
  Json line = {{"model", task.model}, {"status", end.done ? "done" : "refused"}};
  if (end.done) {
    line["output"] = task.output;
    line["report"] = task.report;
  } else {
    line["message"] = end.message;
  }
  line["seconds"] = before ? Json() : Json(std::round(1000 * end.seconds) / 1000);
  return line;
}

std::map<std::string, Json> Manifest::lines() const {
  std::map<std::string, Json> last;
  std::ifstream file(path_);
  for (std::string line; std::getline(file, line);) {
    Json each = Json::parse(line, nullptr, false);
    const std::string model = text_at(each, "model");
    if (!model.empty()) last[model] = std::move(each);
  }
  return last;
}

Result<void> Manifest::add(const Json& line) const {
  const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
  const int file = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  const bool written =
      file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int code = errno;
  if (file >= 0) ::close(file);
  if (written) return {};
  return Error{ErrorCode::kBadFile,
               one_line(path_) + ": cannot be written: " + std::generic_category().message(code)};
}

Result<void> Manifest::tidy() const {
  std::string text;
  for (const auto& [model, line] : lines()) {
    text += line.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
  }
  return write_file(path_, text);
}

Result<BatchProcess> BatchProcess::start(const BatchTask& task, std::size_t number) {
  // All that needs memory comes before the process is split.
  std::vector<std::string> words = {"geotherm"};
  words.insert(words.end(), task.command.begin(), task.command.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::vector<char*> environment = environment_of_one();
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    return Error{ErrorCode::kOutOfMemory,
                 "the system starts no process: " + std::generic_category().message(errno)};
  }
  const pid_t parent = ::getpid(), process = ::fork();
  if (process == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);  // it had gone before
    const int nothing = ::open("/dev/null", O_RDWR);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(nothing, STDOUT_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ::execve("/proc/self/exe", arguments.data(), environment.data());
    ::_exit(127);
  }
  const int code = errno;
  ::close(ends[1]);
  if (process < 0) {
    ::close(ends[0]);
    return Error{ErrorCode::kOutOfMemory,
                 "the system starts no process: " + std::generic_category().message(code)};
  }
  BatchProcess out;
  out.number = number;
  out.errors = ends[0];
  out.process = process;
  return out;
}

BatchEnd BatchProcess::end(double seconds) const {
  ::close(errors);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  BatchEnd out{WIFEXITED(status) && WEXITSTATUS(status) == 0, {}, seconds};
  if (out.done) return out;
  if (WIFSIGNALED(status)) {
    out.message = std::string("ended by a signal: ") + ::strsignal(WTERMSIG(status));
  } else {
    out.message = one_line(last_words(said));
  }
  return out;
}

}  // namespace geotherm::app
