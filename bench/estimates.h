// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure.h"

namespace geotherm::bench {

/// A text formatted as by printf, of at most 511 characters.
__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...);

/// A number, a dash where there is none.
std::string number_text(double value, int decimals, const char* unit = "");

/// Three significant digits where that takes no more than two decimals.
std::string digits_text(double value);

/// Milliseconds as "0.45 ms", "12.3 ms", "1.25 s" or "161 s".
std::string time_text(double milliseconds);

/// 2^20 bytes as "12.3 MB" or "1.25 GB".
std::string memory_text(double megabytes);

/// Padded on the left.
std::string in_columns(const std::string& text, int width);

/// What a contender is expected to need on a mesh.
struct Estimate {
  double setup_ms = 0, query_ms = 0;
  double peak_mb = 0;  ///< of set-up and first query
};

/// Learns from smaller meshes what larger ones will take.
class Estimates {
 public:
  /// Figures that are not there are left out.
  void learn(Index faces, const Figures& figures);

  /// By powers of the number of faces, from the two largest sizes that differ by half at least, or
  /// from one size and usual powers. Empty for a contender of which nothing is known.
  std::optional<Estimate> of(const std::string& name, Index faces) const;

 private:
  struct Known {
    double faces;
    Estimate figures;
  };
  std::map<std::string, std::vector<Known>> known_;
};

/// What a row may cost before it is left out.
struct Limits {
  double most_ms;         ///< one set-up and as many queries as are taken at least
  double most_memory_mb;  ///< of one contender
};

/// Why a contender with this estimate is not measured, with the numbers; empty: it is.
/// `may_be_slow`: it is measured however long it takes.
std::string reason_not_to_run(const Estimate& estimate, const Limits& limits, bool may_be_slow);

}  // namespace geotherm::bench
