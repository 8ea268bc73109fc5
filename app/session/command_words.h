// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/sources.h"
#include "app/session/state.h"
#include "geotherm/directions.h"
#include "geotherm/error.h"
#include "geotherm/types.h"

namespace geotherm::app {

/// Larger numbers mean nothing in a command.
inline constexpr double kLargestNumber = 1e300;

/// What ViewerState::max_distance may be. Errors: kBadInput.
Result<double> parse_max_distance(const std::string& text);

/// A word as it stands in a command: in quotes where it has to. $, `, !, control characters and
/// bytes that are no UTF-8 are \xNN, so that neither shells nor terminals act on them.
std::string command_word(const std::string& word);

/// Files and folders whose path begins so, in order; those whose name would have to be quoted are
/// left out.
std::vector<std::string> paths_that_begin(std::string_view begun);

/// The words of one line, handed out one by one. Errors: kBadInput, "column N: ..." (from 1).
class WordReader {
 public:
  /// Errors: a quote that is not closed, a character that does not belong there.
  static Result<WordReader> of(std::string_view line);

  bool at_end() const { return next_ == words_.size(); }
  std::size_t left() const { return words_.size() - next_; }
  void skip(std::size_t count) { next_ += count; }
  const std::string& peek() const { return words_[next_].text; }  ///< precondition: !at_end()
  const std::string& next() { return words_[next_++].text; }      ///< precondition: !at_end()

  // Each of these reads the next word. Precondition: !at_end().
  Result<std::vector<Index>> vertices();
  Result<std::string> one_of(const std::vector<std::string>& names);

  // What a member of a command may be; the word `none` is none of these.
  Result<void> take(double& number, double least = -kLargestNumber, double most = kLargestNumber);
  Result<void> take(int& index);  ///< of a source or a frame, as the first word of the line says
  Result<void> take(bool& on);
  Result<void> take(std::string& text);
  Result<void> take(Shown& shown);
  Result<void> take(SourceSpec& source);
  Result<void> take(FacePoint& touch);  ///< without an offset
  Result<void> take(std::optional<FacePoint>& point);
  Result<void> take(std::optional<SourceSpec>& point);  ///< is_single_point()
  Result<void> take(std::optional<CentreKind>& kind);

  /// As many as there are words, which may be none.
  template <class Value>
  Result<void> take(std::vector<Value>& all) {
    while (!at_end()) {
      if (auto taken = take(all.emplace_back()); !taken) return taken;
    }
    return {};
  }

  /// "column N: expected WHAT", of the next word or the end of the line.
  Error fail(const std::string& what) const;
  /// The error as "column N: WHY", of the word before.
  Error blame_last(Error why) const;

 private:
  struct Word {
    std::string text;
    std::size_t column;
  };
  std::vector<Word> words_;
  std::size_t next_ = 0;
  std::size_t end_column_ = 1;
};

}  // namespace geotherm::app
