// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geotherm/error.h"

// How a model is read, beside its name.
namespace geotherm::app {

struct ModelReading {
  std::string format;          ///< obj, ply, off or stl; empty: what the extension says
  std::optional<double> weld;  ///< vertices this near are one, model units; none: as in the file

  bool operator==(const ModelReading&) const = default;
};

/// The name that is standard input.
inline constexpr std::string_view kStandardInput = "-";

/// "auto", and empty, are the extension's.
Result<std::string> parse_format(const std::string& text);
/// "off", and empty, are none.
Result<std::optional<double>> parse_weld(const std::string& text);

}  // namespace geotherm::app
