// SPDX-License-Identifier: MIT
#include "app/told.h"

#include <utility>

#include "geotherm/accuracy.h"

namespace geotherm::app {
namespace {

constexpr const char* kBeforeOption = "--";

}  // namespace

std::string told(const Error& error) { return sentence(error, kBeforeOption); }

std::string told(const Hint& hint) { return hint_text(hint, kBeforeOption); }

std::string told(const Warning& warning) { return sentence(warning, kBeforeOption); }

std::vector<std::string> told(const std::vector<Warning>& warnings) {
  std::vector<std::string> sentences;
  for (const Warning& warning : warnings) sentences.push_back(told(warning));
  return sentences;
}

std::string told(const AccuracyReport& report) { return sentence(report, kBeforeOption); }

Error about(const std::string& where, Error error) {
  const Hint hint = std::exchange(error.hint, {});
  return {error.code, where + ": " + sentence(error), hint};
}

Error about(const std::string& where, Error error, ErrorCode code) {
  error.code = code;
  return about(where, std::move(error));
}

Error with_hint(Error error, Hint hint) {
  if (error.hint.empty()) error.hint = std::move(hint);
  return error;
}

}  // namespace geotherm::app
