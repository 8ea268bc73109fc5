// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/error.h"

namespace geotherm::app {

/// Arrays of whole numbers as bytes that compress well: differences from the element before, small
/// ones near 0 whatever their sign, and all first bytes before all second ones. Their counterpart
/// is app/drawing/page/data.js.
class PackedArrays {
 public:
  using Json = nlohmann::ordered_json;

  /// `parts`: numbers of an element. `more`: what the index says about the array as well.
  void add(const std::string& name, std::span<const std::uint32_t> numbers, std::size_t parts,
           const Json& more = Json::object());

  /// Floats between their least and their largest, rounded to so many bits; those that are
  /// kNoPictureValue become 0, and all others at least 1.
  void add_floats(const std::string& name, std::span<const float> floats, std::size_t parts,
                  int bits);

  /// One entry an array, in the order of the bytes.
  const Json& index() const { return index_; }

  /// The bytes in zlib's format. Errors: kOutOfMemory.
  Result<std::string> deflated() const;

 private:
  std::string bytes_;
  Json index_ = Json::array();
};

std::string base64(std::string_view bytes);

}  // namespace geotherm::app
