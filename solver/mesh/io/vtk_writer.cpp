// SPDX-License-Identifier: MIT
#include "solver/mesh/io/vtk_writer.h"

#include <utility>

namespace geotherm::io {

void VtkWriter::declare(std::string_view type, const std::string& name, std::uint64_t bytes) {
  text_ += "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name +
           " format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
  offset_ += sizeof(std::uint64_t) + bytes;
}

void VtkWriter::answers(std::span<const double> distances, std::span<const Index> nearest) {
  if (!distances.empty()) array<double>("distance", distances);
  if (!nearest.empty()) array<std::int32_t>("nearest_source", nearest);
}

void VtkWriter::fields(std::span<const DataField> fields, DataField::Place place) {
  for (const DataField& field : fields) {
    if (field.place != place) continue;
    const std::span<const double> values = field.values;
    if (field.type == DataField::Type::kUint8) {
      array<std::uint8_t>(field.name, values);
    } else {
      array<double>(field.name, values);
    }
  }
}

std::string vtk_bytes(const std::string& type, const std::string& attributes,
                      const std::string& piece, const std::function<void(VtkWriter&)>& body) {
  VtkWriter file;
  file.text("<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
            "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" + type +
            attributes + ">\n<Piece " + piece + ">\n");
  body(file);
  file.text("</Piece>\n</" + type + ">\n<AppendedData encoding=\"raw\">\n_");
  file.text_.reserve(file.text_.size() + file.offset_ + 64);
  file.in_xml_ = false;
  body(file);
  return std::move(file.text_) + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace geotherm::io
