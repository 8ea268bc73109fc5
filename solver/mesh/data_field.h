// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm {

/// Numbers on the vertices or faces of a mesh, as files hold them beside the distances.
struct DataField {
  enum class Place { kVertices, kFaces };
  enum class Type {
    kFloat64,
    kUint8,  ///< whole numbers, 0 to 255
  };

  std::string name;  ///< of a property or column: letters, digits, _
  Place place = Place::kVertices;
  Type type = Type::kFloat64;
  std::vector<double> values;  ///< V or F, in the order of the file; infinite: no value
};

}  // namespace geotherm
