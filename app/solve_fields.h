// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/session/answer.h"
#include "geotherm/error.h"
#include "geotherm/quality_fields.h"

// The fields that `solve --fields` writes beside the distances.
namespace geotherm::app {

/// What was asked for, as far as it goes with the method.
struct WantedFields {
  std::vector<QualityField> fields;
  bool all = false;  ///< asked for as "all": what there is none of is left out

  bool has_error() const;  ///< whether the distances have to be checked
  bool has_heat() const;   ///< whether the answer has to hold u
};

/// "all", or names with commas between them; empty: none. Each file of `paths` must hold every one.
/// Errors: kBadInput (unknown, of another method, no file) and kNotAvailable (a file that cannot
/// hold one), each with the cure.
Result<WantedFields> wanted_fields(const std::string& text, MethodKind method,
                                   const std::vector<std::string>& paths);

/// The fields of an answer. Errors: kBadInput where there is no error of it.
Result<std::vector<DataField>> make_fields(const WantedFields& wanted, Answer& figures);

}  // namespace geotherm::app
