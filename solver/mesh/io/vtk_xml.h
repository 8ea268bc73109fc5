// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "geotherm/error.h"
#include "solver/mesh/io/vtu_arrays.h"

// The tags that the formats of VTK in XML share ("VTK XML formats", Kitware).
namespace geotherm::io {

struct XmlTag {
  std::string_view name;        ///< "/NAME" for one that closes
  std::string_view attributes;  ///< what stands behind the name
  std::size_t behind = 0;       ///< the byte behind >
};

/// The tags of a file, one after the other; comments and declarations are passed over.
class XmlTags {
 public:
  explicit XmlTags(std::string_view text) : text_(text) {}

  std::optional<XmlTag> next();

 private:
  void pass(std::size_t open, std::string_view end);
  XmlTag tag_at(std::size_t open);

  std::string_view text_;
  std::size_t at_ = 0;
};

std::optional<std::string_view> attribute(const XmlTag& tag, std::string_view name);

// What follows throws ReadFailure with the line of the tag in `bytes`.

[[noreturn]] void fail_at_tag(std::string_view bytes, const XmlTag& tag, const std::string& cause,
                              Hint hint = {});

/// The encoding that the tag VTKFile states. `type`: what it has to hold, `hint`: what to do where
/// it holds another.
VtuEncoding read_vtk_file_tag(std::string_view bytes, const XmlTag& tag, std::string_view type,
                              Hint hint);

/// Type and place of a DataArray.
VtuArray read_vtk_array_tag(std::string_view bytes, const XmlTag& tag);

/// The place of the data behind the tag AppendedData.
void read_vtk_appended_tag(std::string_view bytes, const XmlTag& tag, VtuEncoding& encoding);

/// A count or an offset that a file of this size may have.
std::int64_t vtk_number(std::string_view bytes, const XmlTag& tag, std::string_view name);

inline constexpr std::uint64_t kMaxVtkNumbers = 1100;  ///< a byte, as compressed as can be

}  // namespace geotherm::io
