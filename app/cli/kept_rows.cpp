// SPDX-License-Identifier: MIT
#include "app/cli/kept_rows.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "app/session/report.h"
#include "app/session/settings.h"
#include "app/text/text.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/mesh/output_file.h"

namespace geotherm::app {
namespace {

/// What takes less is not kept: a signal leaves nothing of it.
constexpr double kWaitMs = 2000;
/// Marks are this many times as far apart as the disk takes for one.
constexpr double kPauses = 20;

class Checksum {
 public:
  template <class T>
  void add(std::span<const T> values) {
    mix(values.size());
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    for (std::size_t left = values.size_bytes(); left > 0;) {
      const std::size_t size = std::min(left, sizeof(std::uint64_t));
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, size);
      mix(word);
      bytes += size;
      left -= size;
    }
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::span<const T>(values));
  }
  std::uint64_t value() const { return hash_; }

 private:
  void mix(std::uint64_t word) {
    hash_ = (hash_ ^ word) * 0xff51afd7ed558ccdULL;
    hash_ ^= hash_ >> 32;
  }
  std::uint64_t hash_ = 0x9e3779b97f4a7c15ULL;
};

std::string text_in(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string job_of(const ManySources& work, Index columns, NpyType type) {
  const TriangleMesh& mesh = *work.model.mesh;
  Checksum model, sources;
  model.add(mesh.positions());
  model.add(mesh.faces());
  model.add(mesh.same_as());
  for (const SourceSet& set : work.sources.sets) {
    sources.add(set.points);
    sources.add(set.edges);
    sources.add(set.offsets);
    for (const FaceSegment& segment : set.segments) {
      sources.add(std::span<const Index>(&segment.face, 1));
      sources.add(std::span<const double>(segment.from));
      sources.add(std::span<const double>(segment.to));
      sources.add(std::span<const Index>(&segment.curve, 1));
    }
  }
  sources.add(work.reach.targets);
  ViewerState state;
  state.options = work.options;
  Json options;
  for (const Setting& setting : settings()) {
    if (setting.group != SettingGroup::kMethod || setting.name == "threads") continue;
    options[key_of(setting)] = setting.get(state);
  }
  const bool replaces = work.check.on_poor == OnPoor::kBetter;
  const Json job = {{"version", GEOTHERM_VERSION},
                    {"model", model.value()},
                    {"points", work.model.from_points},
                    {"options", options},
                    {"better", replaces ? to_text(work.check.against) : ""},
                    {"sources", sources.value()},
                    {"max_distance", number_text(work.reach.max_distance)},
                    {"rows", work.sources.sets.size()},
                    {"columns", columns},
                    {"dtype", to_text(type)}};
  return job.dump();
}

struct KeptRows::State {
  std::string part, list, marks;
  std::size_t rows = 0, begin = 0;  ///< of marks in the list
  bool is_first = false, is_over = false;
  int file = -1;
  std::optional<FileGroup> nothing_yet;  ///< a signal removes both: no block is on the disk
  std::vector<std::size_t> finished;     ///< blocks without their mark
  Stopwatch since;
  double wait_ms = kWaitMs;

  ~State() {
    if (file >= 0) ::close(file);
    if (!is_first) return;
    if (is_over || text_in(list).find('1', begin) == std::string::npos) remove();
  }

  void remove() {
    std::error_code gone;
    std::filesystem::remove(list, gone);
    if (!is_over) std::filesystem::remove(part, gone);
  }

  Error failure(int code) const {
    return {ErrorCode::kBadFile,
            io::printable(list) + ": cannot be written: " + std::generic_category().message(code)};
  }

  /// On the first rank: takes up what is there, or begins anew.
  Result<void> begin_with(std::uint64_t bytes, const std::string& job) {
    std::error_code unknown;
    const std::string known = text_in(list);
    if (known.size() == begin + marks.size() && known.starts_with(job) &&
        std::filesystem::file_size(part, unknown) == bytes) {
      marks = known.substr(begin);
      for (char& mark : marks) mark = mark == '1' ? '1' : '0';
    } else {
      std::filesystem::remove(list, unknown);
    }
    if (marks.find('1') != std::string::npos) return {};
    nothing_yet.emplace();
    nothing_yet->add(part);
    nothing_yet->add(list);
    // Its bytes, if any, are all written over.
    if (::truncate(part.c_str(), static_cast<off_t>(bytes)) != 0) return failure(errno);
    return write_file(list, job + marks);
  }
};

KeptRows::KeptRows(std::unique_ptr<State> state) : state_(std::move(state)) {}
KeptRows::KeptRows(KeptRows&&) noexcept = default;
KeptRows::~KeptRows() = default;

Result<KeptRows> KeptRows::open(const std::string& part, std::uint64_t bytes,
                                const std::string& job, std::size_t rows, const Ranks& ranks) {
  KeptRows out(std::make_unique<State>());
  State& state = *out.state_;
  state.part = part;
  state.list = part + ".done";
  state.rows = rows;
  state.begin = job.size() + 1;
  state.marks.assign((rows + kBlockRows - 1) / kBlockRows, '0');
  state.is_first = ranks.is_first();
  const auto begun =
      ranks.agree(state.is_first ? state.begin_with(bytes, job + '\n') : Result<void>());
  if (!begun) return begun.error();
  state.marks = ranks.all_gather(state.marks).front();
  state.file = ::open(state.list.c_str(), O_WRONLY | O_CLOEXEC);
  const auto opened = ranks.agree(state.file >= 0 ? Result<void>() : state.failure(errno));
  return opened ? Result<KeptRows>(std::move(out)) : opened.error();
}

const std::string& KeptRows::marks() const { return state_->marks; }

Result<void> KeptRows::add(std::size_t row, const std::function<Result<void>()>& to_disk) {
  State& state = *state_;
  if ((row + 1) % kBlockRows == 0 || row + 1 == state.rows) {
    state.finished.push_back(row / kBlockRows);
  }
  if (state.finished.empty() || state.since.milliseconds() < state.wait_ms) return {};
  const Stopwatch watch;
  if (auto there = to_disk(); !there) return there;
  for (const std::size_t block : state.finished) {
    if (::pwrite(state.file, "1", 1, static_cast<off_t>(state.begin + block)) != 1) {
      return state.failure(errno);
    }
  }
  state.finished.clear();
  state.nothing_yet.reset();
  state.wait_ms = std::max(kWaitMs, kPauses * watch.milliseconds());
  state.since = Stopwatch();
  return {};
}

void KeptRows::finish() { state_->is_over = true; }

}  // namespace geotherm::app
