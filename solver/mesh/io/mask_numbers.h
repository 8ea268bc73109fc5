// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace geotherm::io {

/// What the words in front of and behind the name of a mask's file say: "keep:faces:FILE.ply:SEEN".
struct MaskText {
  bool keeps = false, of_faces = false;
  std::string path, property;
};
MaskText parse_mask_text(std::string text);

/// The numbers of a mask.
struct MaskNumbers {
  std::vector<double> values;
  bool flags = false;  ///< one for each vertex or face, whatever they are
  bool ids = false;    ///< those of what is marked, whatever they are
};

/// `extension`: ".npy", ".label", ".ply", ".gii", else text; `property`: of the vertices of a .ply.
/// Throws ReadFailure.
MaskNumbers read_mask_numbers(std::string_view bytes, const std::string& extension,
                              const std::string& property);

}  // namespace geotherm::io
