// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace geotherm::test {

/// A process whose locale writes 0.5 as 0,5 and 1000 as 1.000, for C and C++, while this lives.
class CommaLocale {
 public:
  /// Makes it in `folder` (localedef of the package locales).
  explicit CommaLocale(const std::string& folder);
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  ~CommaLocale();

  /// Whether it could be made.
  bool holds() const { return holds_; }

 private:
  bool holds_ = false;
};

}  // namespace geotherm::test
