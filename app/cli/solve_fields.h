// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/picture/drawing.h"
#include "app/session/answer.h"
#include "geotherm/accuracy.h"
#include "geotherm/io.h"

// What `solve` writes beside the distances.
namespace geotherm::app {

/// What was asked for, as far as it goes with the method.
struct WantedFields {
  std::vector<QualityField> fields;
  bool all = false;  ///< asked for as "all": what there is none of is left out

  bool has_error() const;  ///< whether the distances have to be checked
  bool has_heat() const;   ///< whether the answer has to hold u
};

/// "all", or names with commas between them; empty: none. Each file of `paths` must hold every one
/// that is named, and one of them some of all.
/// Errors: kBadInput (unknown, of another method, no file) and kNotAvailable (a file that cannot
/// hold one), each with what helps.
Result<WantedFields> wanted_fields(const std::string& text, MethodKind method,
                                   const std::vector<std::string>& paths);

/// The fields of an answer, those of faces on the faces that are drawn of a space. Errors:
/// kBadInput where there is no error of it.
Result<std::vector<DataField>> make_fields(const WantedFields& wanted, Answer& figures);

/// Those of all fields that a file holds; what it has no place for is told to the warnings.
std::vector<DataField> fields_of_file(const std::string& path, const std::vector<DataField>& all,
                                      std::vector<Warning>& warnings);

/// The same for a file that holds the tets themselves: what is of triangles is left out.
std::vector<DataField> fields_of_tets(const WantedFields& wanted, const Answer& figures,
                                      const std::vector<DataField>& of_faces);

/// The colours of this map at the distances, as properties of a .ply file: near to far from one end
/// to the other, unreached vertices grey. Errors: kNotAvailable (no such map, no renderer).
Result<std::vector<DataField>> baked_colours(const Drawing& drawing, const std::string& map,
                                             std::span<const double> distances);

}  // namespace geotherm::app
