// SPDX-License-Identifier: MIT
// VTK's XML format for images: one array of values at the points.
#include <cmath>
#include <utility>

#include "solver/core/text.h"
#include "solver/grid/io/raw_grid.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"
#include "solver/mesh/io/vtk_xml.h"

namespace geotherm::io {
namespace {

class VtiFile {
 public:
  explicit VtiFile(std::string_view bytes) : bytes_(bytes) {}

  RawGrid read() {
    read_tags();
    if (!is_vti_) fail_at_line(bytes_, bytes_.data(), "there is no tag VTKFile");
    if (pieces_ == 0) throw ReadFailure{"the file has no image"};
    if (array_.format == VtuArray::Format::kNone) {
      throw ReadFailure{
          "the image has no values of one number at its points",
          0,
          {},
          cell_data_ ? Hint{"in ParaView, Cell Data to Point Data makes them of cells"} : Hint{}};
    }
    const std::size_t count = count_samples(grid_.size);
    if (count / kMaxVtkNumbers > bytes_.size()) {
      throw ReadFailure{"there are to be " + std::to_string(count) + " points in a file of " +
                        std::to_string(bytes_.size()) + " bytes"};
    }
    grid_.values = read_vtu_reals(bytes_, encoding_, array_, name_.c_str(),
                                  static_cast<std::int64_t>(count), false);
    grid_.type = values_of(array_.type);
    if (arrays_ > 1) grid_.notes.push_back("of several arrays " + name_ + " was taken");
    return std::move(grid_);
  }

 private:
  void read_tags() {
    XmlTags tags(bytes_);
    bool in_points = false;
    std::string active;
    while (const auto tag = tags.next()) {
      if (tag->name == "VTKFile") {
        is_vti_ = true;
        encoding_ = read_vtk_file_tag(bytes_, *tag, "ImageData", {"a grid is an image"});
      } else if (tag->name == "ImageData") {
        read_image_tag(*tag);
      } else if (tag->name == "Piece") {
        if (++pieces_ > 1 || extent(*tag, "Extent") != whole_) {
          fail_at_tag(bytes_, *tag, "the image is cut into pieces", {"save it as one"});
        }
      } else if (tag->name == "PointData") {
        in_points = true;
        active = std::string(attribute(*tag, "Scalars").value_or(""));
      } else if (tag->name == "/PointData") {
        in_points = false;
      } else if (tag->name == "CellData") {
        cell_data_ = true;
      } else if (tag->name == "DataArray" && in_points) {
        add_array(*tag, active);
      } else if (tag->name == "AppendedData") {
        read_vtk_appended_tag(bytes_, *tag, encoding_);
        return;
      }
    }
  }

  /// The active scalars, else the first array of one number.
  void add_array(const XmlTag& tag, const std::string& active) {
    if (attribute(tag, "NumberOfComponents").value_or("1") != "1") return;
    const std::string_view name = attribute(tag, "Name").value_or("");
    if (++arrays_ > 1 && name != active) return;
    array_ = read_vtk_array_tag(bytes_, tag);
    name_ = printable(name);
  }

  template <std::size_t N>
  std::array<double, N> numbers(const XmlTag& tag, std::string_view name,
                                std::array<double, N> otherwise) const {
    const auto text = attribute(tag, name);
    if (!text) return otherwise;
    const char* p = text->data();
    const char* const end = p + text->size();
    std::array<double, N> out{};
    for (double& value : out) {
      while (p < end && (*p == ' ' || *p == '\n' || *p == '\t')) ++p;
      const char* const behind = p < end ? parse_double(p, value) : nullptr;
      if (behind == nullptr || behind > end || !std::isfinite(value)) {
        fail_at_tag(bytes_, tag,
                    std::string(name) + " is " + quoted(*text, text->data()) + "; it has " +
                        std::to_string(N) + " numbers");
      }
      p = behind;
    }
    return out;
  }

  std::array<double, 6> extent(const XmlTag& tag, std::string_view name) const {
    return numbers<6>(tag, name, {0, -1, 0, -1, 0, -1});
  }

  void read_image_tag(const XmlTag& tag) {
    whole_ = extent(tag, "WholeExtent");
    grid_.spacing = numbers<3>(tag, "Spacing", {1, 1, 1});
    const auto origin = numbers<3>(tag, "Origin", {0, 0, 0});
    const auto direction = numbers<9>(tag, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
    for (std::size_t k = 0; k < 9; ++k) {
      const bool along = k % 4 == 0;
      if (along ? std::abs(direction[k]) == 1 : direction[k] == 0) continue;
      fail_at_tag(bytes_, tag, "the image is turned (Direction)", {"save it along the axes"});
    }
    for (std::size_t e = 0; e < 3; ++e) grid_.spacing[e] *= direction[4 * e];
    for (std::size_t e = 0; e < 3; ++e) {
      const double count = whole_[2 * e + 1] - whole_[2 * e] + 1;
      constexpr double kMaxCount = 1e9;
      if (!(count >= 1 && count <= kMaxCount) || count != std::floor(count)) {
        fail_at_tag(bytes_, tag, "WholeExtent has no points along axis " + std::to_string(e));
      }
      grid_.size[e] = static_cast<std::int64_t>(count);
      grid_.origin[static_cast<Eigen::Index>(e)] = origin[e] + grid_.spacing[e] * whole_[2 * e];
    }
  }

  std::string_view bytes_;
  bool is_vti_ = false, cell_data_ = false;
  int pieces_ = 0, arrays_ = 0;
  std::array<double, 6> whole_{};
  VtuEncoding encoding_;
  VtuArray array_;
  std::string name_;
  RawGrid grid_;
};

}  // namespace

RawGrid read_vti(std::string_view bytes) { return VtiFile(bytes).read(); }

}  // namespace geotherm::io
