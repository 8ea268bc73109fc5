// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "geotherm/io.h"
#include "solver/mesh/io/byte_order.h"

namespace geotherm::io {

/// A file in VTK's XML that is made in two passes over the same arrays: the XML says where each
/// begins, and the appended bytes hold, one after the other, its 64-bit length and its numbers.
class VtkWriter {
 public:
  /// XML between the arrays.
  void text(std::string_view xml) {
    if (in_xml_) text_ += xml;
  }

  /// An array of `count` numbers: later, fill(put) calls put(number) for each. `more`: attributes.
  template <class T, class Fill>
  void array(const std::string& name, std::uint64_t count, const Fill& fill,
             const std::string& more = {}) {
    if (in_xml_) {
      declare(type_of<T>(), name + '"' + more, count * sizeof(T));
    } else {
      append_little(text_, std::uint64_t{count * sizeof(T)});
      fill([this](T number) { append_little(text_, number); });
    }
  }

  /// An array of these numbers, written as T.
  template <class T, class Number>
  void array(const std::string& name, std::span<const Number> numbers) {
    array<T>(name, numbers.size(), [numbers](const auto& put) {
      for (const Number number : numbers) put(static_cast<T>(number));
    });
  }

  /// The array `Points`, where for_each(use) calls use(place) for each of `count` places.
  template <class Each>
  void points(std::uint64_t count, const Each& for_each) {
    text("<Points>\n");
    array<double>(
        "Points", 3 * count,
        [&for_each](const auto& put) {
          for_each([&put](const Vec3& p) {
            for (int axis = 0; axis < 3; ++axis) put(p[axis]);
          });
        },
        " NumberOfComponents=\"3\"");
    text("</Points>\n");
  }

  /// The arrays `connectivity` and `offsets` of cells that have as many corners each.
  template <std::size_t kCorners>
  void cells(std::span<const std::array<Index, kCorners>> cells) {
    array<std::int32_t>("connectivity", kCorners * cells.size(), [cells](const auto& put) {
      for (const auto& cell : cells) std::ranges::for_each(cell, put);
    });
    array<std::int64_t>("offsets", cells.size(), [cells](const auto& put) {
      for (std::size_t i = 1; i <= cells.size(); ++i) put(static_cast<std::int64_t>(kCorners * i));
    });
  }

  /// The arrays `distance` and `nearest_source`, where there are such.
  void answers(std::span<const double> distances, std::span<const Index> nearest);

  /// The fields with this place.
  void fields(std::span<const DataField> fields, DataField::Place place);

 private:
  friend std::string vtk_bytes(const std::string&, const std::string&, const std::string&,
                               const std::function<void(VtkWriter&)>&);

  template <class T>
  static constexpr std::string_view type_of() {
    if (std::same_as<T, double>) return "Float64";
    if (std::same_as<T, std::uint8_t>) return "UInt8";
    return sizeof(T) == 8 ? "Int64" : "Int32";
  }
  void declare(std::string_view type, const std::string& name, std::uint64_t bytes);

  std::string text_;
  std::uint64_t offset_ = 0;
  bool in_xml_ = true;
};

/// The bytes of a file of one piece. `type`: "PolyData"; `attributes`: of its tag, after a space,
/// or empty; `piece`: attributes of the piece; `body`: what the piece holds, asked for twice.
std::string vtk_bytes(const std::string& type, const std::string& attributes,
                      const std::string& piece, const std::function<void(VtkWriter&)>& body);

}  // namespace geotherm::io
