// SPDX-License-Identifier: MIT
// `geotherm batch`: one solve for each of many models, in processes of their own.
#include <CLI/CLI.hpp>

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>

#include "app/cli/batch_work.h"
#include "app/cli/commands.h"
#include "app/session/progress.h"
#include "app/session/ranks.h"
#include "app/session/report.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

constexpr std::size_t kMaxRefusedShown = 5;

/// The options that a solve is to have, as they were typed; those of the batch itself are left out.
std::vector<std::string> typed_of_solve(const CLI::App& command,
                                        const std::vector<const CLI::Option*>& own) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || std::ranges::count(own, option) > 0) continue;
    const std::string name = "--" + option->get_lnames().front();
    const bool is_flag = option->get_expected_max() == 0;
    for (const std::string& value : option->results()) {
      words.push_back(is_flag ? name : name + "=" + value);
    }
  }
  return words;
}

/// What became of the tasks of one rank, or of all.
struct BatchSums {
  std::int64_t meshes = 0, done = 0, before = 0, refused = 0;
  std::vector<std::string> reasons;  ///< of the first that were refused
};

std::string text_of(const BatchSums& sums) {
  return Json{sums.meshes, sums.done, sums.before, sums.refused, sums.reasons}.dump(
      -1, ' ', false, Json::error_handler_t::replace);
}

BatchSums sum_of(const std::vector<std::string>& ranks) {
  BatchSums all;
  for (const std::string& text : ranks) {
    const Json each = Json::parse(text);
    all.meshes += each[0].get<std::int64_t>();
    all.done += each[1].get<std::int64_t>();
    all.before += each[2].get<std::int64_t>();
    all.refused += each[3].get<std::int64_t>();
    for (const Json& reason : each[4]) all.reasons.push_back(reason);
  }
  if (all.reasons.size() > kMaxRefusedShown) all.reasons.resize(kMaxRefusedShown);
  return all;
}

/// The tasks of one rank, some processes at a time.
class Batch {
 public:
  Batch(const std::vector<BatchTask>& tasks, const Manifest& manifest, std::size_t jobs)
      : tasks_(tasks), manifest_(manifest), jobs_(jobs) {}
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;
  ~Batch() {
    for (const BatchProcess& each : running_) {
      ::kill(each.process, SIGTERM);
      each.end(0);
    }
  }

  /// Errors: kBadFile (the manifest), kCancelled. Those of a task are in the manifest.
  Result<BatchSums> run(const Progress& progress) {
    sums_.meshes = std::ssize(tasks_);
    const auto known = manifest_.lines();
    std::size_t next = 0;
    while (next < tasks_.size() || !running_.empty()) {
      const auto ended = static_cast<double>(sums_.done + sums_.before + sums_.refused);
      if (!report(progress, "meshes", ended / static_cast<double>(tasks_.size()))) {
        return cancelled_error();
      }
      if (next < tasks_.size() && running_.size() < jobs_) {
        if (auto begun = begin(next, known); !begun) return begun.error();
        ++next;
      } else if (auto heard = listen(); !heard) {
        return heard.error();
      }
    }
    return sums_;
  }

 private:
  Result<void> begin(std::size_t number, const std::map<std::string, Json>& known) {
    const BatchTask& task = tasks_[number];
    if (is_done(task)) {
      ++sums_.before;
      const auto line = known.find(task.model);
      if (line != known.end() && text_at(line->second, "status") == "done") return {};
      return manifest_.add(manifest_line(task, {true, {}, 0}, true));
    }
    remove_remains(task);
    std::error_code code;
    std::filesystem::create_directories(std::filesystem::path(task.output).parent_path(), code);
    auto process = BatchProcess::start(task, number);
    if (!process) return take(number, {false, to_text(process.error()), 0});
    started_[process->process] = Stopwatch();
    running_.push_back(*std::move(process));
    return {};
  }

  /// Waits for words or ends of processes, a fifth of a second at most.
  Result<void> listen() {
    constexpr int kMilliseconds = 200;
    std::vector<pollfd> watched;
    for (const BatchProcess& each : running_) watched.push_back({each.errors, POLLIN, 0});
    if (::poll(watched.data(), watched.size(), kMilliseconds) <= 0) return {};
    std::array<char, 4096> bytes;
    for (std::size_t i = watched.size(); i-- > 0;) {
      if (watched[i].revents == 0) continue;
      const ssize_t count = ::read(running_[i].errors, bytes.data(), bytes.size());
      if (count > 0) running_[i].said.append(bytes.data(), static_cast<std::size_t>(count));
      if (count > 0 || (count < 0 && errno == EINTR)) continue;
      const BatchProcess ended = std::move(running_[i]);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      const double seconds = started_[ended.process].milliseconds() / 1000;
      if (auto taken = take(ended.number, ended.end(seconds)); !taken) return taken;
    }
    return {};
  }

  Result<void> take(std::size_t number, const BatchEnd& end) {
    const BatchTask& task = tasks_[number];
    ++(end.done ? sums_.done : sums_.refused);
    if (!end.done && sums_.reasons.size() < kMaxRefusedShown) {
      sums_.reasons.push_back(one_line(task.model) + ": " + end.message);
    }
    return manifest_.add(manifest_line(task, end, false));
  }

  const std::vector<BatchTask>& tasks_;
  const Manifest& manifest_;
  const std::size_t jobs_;
  std::vector<BatchProcess> running_;
  std::map<int, Stopwatch> started_;
  BatchSums sums_;
};

/// The tasks of a rank: large models first, dealt out in turn. Errors (the same on all): kBadFile,
/// not all see the same files, so that some would be solved twice or by nobody.
Result<std::vector<BatchTask>> share_of(std::vector<BatchTask> tasks, const Ranks& ranks) {
  if (ranks.alone()) return tasks;
  const auto bytes = [](const BatchTask& task) {
    std::error_code unknown;
    const auto size = std::filesystem::file_size(task.model, unknown);
    return unknown ? 0 : size;
  };
  std::ranges::stable_sort(tasks, std::greater(), bytes);
  std::string seen;
  for (const BatchTask& task : tasks) seen += task.model + '\n';
  Result<void> same;
  if (ranks.all_gather(seen).front() != seen) {
    same = Error{ErrorCode::kBadFile,
                 "rank " + std::to_string(ranks.rank()) +
                     " sees other models, or of other sizes, than the first one (" +
                     counted(std::ssize(tasks), "model", "models") + " here)",
                 {"start it again when the files are the same on all machines"}};
  }
  if (auto all = ranks.agree(same); !all) return all.error();
  std::vector<BatchTask> share;
  for (auto i = static_cast<std::size_t>(ranks.rank()); i < tasks.size();
       i += static_cast<std::size_t>(ranks.count())) {
    share.push_back(std::move(tasks[i]));
  }
  return share;
}

Result<std::size_t> jobs_of(const BatchArguments& arguments, const Ranks& ranks) {
  if (arguments.jobs.empty()) {
    return ranks.alone() ? static_cast<std::size_t>(thread_count(0)) : std::size_t{1};
  }
  const auto jobs = whole_in("--jobs", arguments.jobs, "number of processes", 1);
  if (!jobs) return jobs.error();
  return static_cast<std::size_t>(*jobs);
}

/// What every model would be refused for. Errors: kBadInput, kNotAvailable.
Result<void> check_words(const SolveArguments& typed, const std::string& format) {
  if (const auto asked = settings_in(typed.settings); !asked) return asked.error();
  if (const auto named = some_sources_of(typed.sources); !named) return named.error();
  if (const auto check = check_settings(typed.check); !check) return check.error();
  SolveArguments solve = typed;
  solve.outputs = {"FILE.npy"};
  if (auto fits = check_solve(solve); !fits) return fits;
  solve.outputs = {"FILE." + format};
  const auto fits = check_solve(solve);
  return fits ? fits : about("--output-format", fits.error());
}

}  // namespace

void add_batch_options(CLI::App& command, BatchArguments& arguments) {
  std::vector<const CLI::Option*> own = {command.get_help_ptr()};
  own.push_back(command
                    .add_option("MODELS", arguments.models,
                                "files, patterns in quotes such as 'shapes/*.ply', bundled models")
                    ->type_name("")
                    ->required());
  own.push_back(command
                    .add_option("--out-dir", arguments.folder,
                                "folder of the outputs, of a report beside each, and of "
                                "manifest.jsonl; what is done there is not done again")
                    ->type_name("FOLDER")
                    ->required());
  own.push_back(command
                    .add_option("--output-format", arguments.format,
                                "extension of the outputs: npy (default) or another that solve "
                                "writes")
                    ->type_name("EXTENSION"));
  own.push_back(command
                    .add_option("-j,--jobs", arguments.jobs,
                                "models solved at the same time, each in a process of its own; "
                                "default: one a core, and one a rank under mpirun")
                    ->type_name("N"));
  own.push_back(add_json_option(command, arguments.json, "how many were done,"));
  add_quiet_option(command, arguments.quiet);
  own.push_back(command.get_option("--quiet"));
  add_source_options(command, arguments.solve.sources);
  add_many_options(command, arguments.solve);
  add_check_options(command, arguments.solve.check);
  add_setting_options(command, arguments.solve.settings, names_of(SettingGroup::kModel));
  add_setting_options(command, arguments.solve.settings, names_of(SettingGroup::kMethod));
  command.parse_complete_callback(
      [&command, &arguments, own] { arguments.passed = typed_of_solve(command, own); });
  command.footer(
      "Each model is solved as geotherm solve MODEL does it with the other options, by one thread "
      "unless --threads says otherwise. Runs under mpirun, too.\n"
      "Examples:\n"
      "  geotherm batch 'shapes/*.ply' -s random:50:1 --each --out-dir rows\n"
      "  geotherm batch 'shapes/*/*.obj' -s 0 --method wavefront --out-dir distances --jobs 4");
}

Result<CommandOutput> run_batch(const BatchArguments& arguments, const Progress& progress) {
  const auto ranks = Ranks::join();
  if (!ranks) return ranks.error();
  const auto jobs = jobs_of(arguments, *ranks);
  if (!jobs) return jobs.error();
  std::string format = arguments.format.empty() ? "npy" : arguments.format;
  if (format.starts_with('.')) format.erase(0, 1);
  if (auto fits = check_words(arguments.solve, format); !fits) return fits.error();
  std::vector<std::string> options = arguments.passed;
  if (!arguments.solve.settings.has("threads")) options.push_back("--threads=1");
  Outputs outputs;
  if (auto fits = expect_report(arguments.json, outputs); !fits) return fits.error();
  const auto begin = [&]() -> Result<std::vector<BatchTask>> {
    auto tasks = batch_tasks(arguments.models, arguments.folder, format, options);
    if (!tasks) return tasks;
    std::error_code code;
    std::filesystem::create_directories(arguments.folder, code);
    if (!code) return tasks;
    return Error{ErrorCode::kBadFile,
                 one_line(arguments.folder) + ": no such folder can be made: " + code.message(),
                 {"choose another place"}};
  };
  auto tasks = ranks->agree_on(begin());
  if (!tasks) return tasks.error();

  const Stopwatch watch;
  const Manifest manifest((std::filesystem::path(arguments.folder) / "manifest.jsonl").string());
  const auto share = share_of(*std::move(tasks), *ranks);
  if (!share) return share.error();
  const auto ours = ranks->agree_on(Batch(*share, manifest, *jobs).run(progress));
  if (!ours) return ours.error();
  const BatchSums sums = sum_of(ranks->all_gather(text_of(*ours)));
  CommandOutput out;
  if (!ranks->is_first()) return out;
  if (auto tidied = manifest.tidy(); !tidied) return tidied.error();
  const double seconds = watch.milliseconds() / 1000;
  const auto report = [&]() -> Json {
    return {{"batch",
             {{"meshes", sums.meshes},
              {"done", sums.done},
              {"done_before", sums.before},
              {"refused", sums.refused},
              {"ranks", ranks->count()},
              {"seconds", seconds},
              {"manifest", manifest.path()}}}};
  };
  const auto table = [&] {
    TextTable rows({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
    rows.add_row({"models", grouped(sums.meshes)});
    rows.add_row({"done", grouped(sums.done) + ", " + grouped(sums.before) + " before"});
    rows.add_row({"refused", grouped(sums.refused)});
    for (const std::string& reason : sums.reasons) rows.add_row({"", reason});
    rows.add_row({"time", seconds_in_words(seconds)});
    rows.add_row({"manifest", one_line(manifest.path())});
    return rows.text();
  };
  if (sums.refused > 0) {
    out.failure = Error{ErrorCode::kBadFile,
                        grouped(sums.refused) + " of " + counted(sums.meshes, "model", "models") +
                            " could not be solved",
                        {"see " + one_line(manifest.path()) + ", and start it again to try those"}};
  }
  return finish_command(std::move(out), outputs, arguments.json, report, table);
}

}  // namespace geotherm::app
