// SPDX-License-Identifier: MIT
#include "app/model_reading.h"

#include <cmath>

#include "app/text.h"
#include "geotherm/io.h"

namespace geotherm::app {

Result<std::string> parse_format(const std::string& text) {
  if (text.empty() || text == "auto") return std::string();
  const auto known = check_mesh_format(text);
  if (!known) return known.error();
  return text;
}

Result<std::optional<double>> parse_weld(const std::string& text) {
  if (text.empty() || text == "off") return std::optional<double>();
  const auto distance = number_in<double>(text);
  if (distance && *distance >= 0 && std::isfinite(*distance)) return std::optional(*distance);
  return Error{ErrorCode::kBadInput,
               "'" + one_line(text) +
                   "' is no distance; give a length in model units, or 0 for vertices that are "
                   "equal"};
}

}  // namespace geotherm::app
