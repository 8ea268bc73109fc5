// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/session/sources.h"

// Sources as sessions write them: short in what a test expects.
namespace geotherm::test {

inline std::vector<std::string> texts_of(const std::vector<app::SourceSpec>& sources) {
  std::vector<std::string> texts;
  for (const app::SourceSpec& source : sources) texts.push_back(app::to_text(source));
  return texts;
}

inline std::vector<app::SourceSpec> sources_in(const std::vector<std::string>& texts) {
  std::vector<app::SourceSpec> sources;
  for (const std::string& text : texts) sources.push_back(*app::parse_source(text));
  return sources;
}

}  // namespace geotherm::test
