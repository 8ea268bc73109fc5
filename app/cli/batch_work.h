// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/session/report.h"
#include "geotherm/error.h"

// What `batch` works through, what of it is done, and the processes that do it.
namespace geotherm::app {

/// A model, and what its solve is to write.
struct BatchTask {
  std::string model;                 ///< as `solve` takes it
  std::string name;                  ///< of its files, below the folder, without an extension
  std::string output, report;        ///< whole paths
  std::vector<std::string> command;  ///< the words behind `geotherm`
};

/// The models that these words name: files, patterns of files (`shapes/*.ply`; ** is no more than
/// *), bundled models; each once, in the order of their paths. What stands before the first * of a
/// pattern is left out of the names. Errors: kBadFile (nothing fits), kBadInput (two that would
/// write the same file).
Result<std::vector<BatchTask>> batch_tasks(const std::vector<std::string>& models,
                                           const std::string& folder, const std::string& format,
                                           const std::vector<std::string>& options);

/// Whether it was done by the same command of the same version, after the model was written. The
/// report is written last, and both files appear whole: what is there is right.
bool is_done(const BatchTask& task);

/// Removes what a process that was killed has left beside the files of the task.
void remove_remains(const BatchTask& task);

/// The text that a report or a line of the manifest has under a name; empty where it has none, as
/// where a file is another program's.
std::string text_at(const Json& object, const char* name);

/// How a task ended.
struct BatchEnd {
  bool done = false;
  std::string message;  ///< why not
  double seconds = 0;
};

/// A line of the manifest: "model", "status" (done, refused), "output", "report" (of what is done),
/// "message" (of what is not), "seconds" (null: it was done before).
Json manifest_line(const BatchTask& task, const BatchEnd& end, bool before);

/// manifest.jsonl: one line for each model, the last of several counts. Lines are added by one
/// write each, from any process.
class Manifest {
 public:
  explicit Manifest(std::string path) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }

  /// The last line of each model. A line that a killed process did not end is none.
  std::map<std::string, Json> lines() const;
  Result<void> add(const Json& line) const;
  /// Writes it anew with one line a model.
  Result<void> tidy() const;

 private:
  std::string path_;
};

/// This program at work on a task, in a process that is ended with this one.
class BatchProcess {
 public:
  /// Errors: kOutOfMemory (the system starts no process).
  static Result<BatchProcess> start(const BatchTask& task, std::size_t number);

  std::size_t number = 0;  ///< of the task
  int errors = -1;         ///< reading end of its standard error
  int process = -1;
  std::string said;  ///< what came from there so far

  /// Once nothing more comes: waits for its end.
  BatchEnd end(double seconds) const;
};

}  // namespace geotherm::app
