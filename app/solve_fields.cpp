// SPDX-License-Identifier: MIT
#include "app/solve_fields.h"

#include <algorithm>

#include "app/text.h"
#include "app/told.h"
#include "geotherm/io.h"

namespace geotherm::app {
namespace {

Error about_option(const Error& error) { return about("--fields", error); }

Result<std::vector<QualityField>> named_fields(const std::string& text, MethodKind method) {
  std::vector<QualityField> fields;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const auto field =
        parse_quality_field(one_line(std::string(trimmed(text.substr(from, comma - from)))));
    if (!field) return about_option(field.error());
    if (needs_heat(*field) && method != MethodKind::kHeat) {
      return Error{ErrorCode::kBadInput, "--fields: " + to_text(*field) +
                                             " is about the heat u, which --method " +
                                             to_text(method) + " has not; leave it out"};
    }
    if (std::ranges::find(fields, *field) == fields.end()) fields.push_back(*field);
    from = comma + 1;
  }
  return fields;
}

}  // namespace

bool WantedFields::has_error() const {
  return std::ranges::find(fields, QualityField::kError) != fields.end();
}

bool WantedFields::has_heat() const { return std::ranges::any_of(fields, needs_heat); }

Result<WantedFields> wanted_fields(const std::string& text, MethodKind method,
                                   const std::vector<std::string>& paths) {
  WantedFields wanted;
  if (text.empty()) return wanted;
  if (paths.empty()) {
    return Error{
        ErrorCode::kBadInput,
        "--fields: they are written beside the distances; give -o FILE.ply or -o FILE.vtp"};
  }
  wanted.all = text == "all";
  if (wanted.all) {
    wanted.fields = all_quality_fields();
    if (method != MethodKind::kHeat) std::erase_if(wanted.fields, needs_heat);
  } else {
    auto named = named_fields(text, method);
    if (!named) return named.error();
    wanted.fields = *std::move(named);
  }
  for (const std::string& path : paths) {
    for (const QualityField field : wanted.fields) {
      const auto held = check_field(path, described(field));
      if (!held) return about_option(held.error());
    }
  }
  return wanted;
}

Result<std::vector<DataField>> make_fields(const WantedFields& wanted, Answer& figures) {
  std::vector<DataField> made;
  for (const QualityField field : wanted.fields) {
    std::span<const double> error;
    if (field == QualityField::kError) {
      const bool known = figures.error && !figures.error->values.empty();
      const std::string why = known           ? std::string()
                              : figures.error ? told(*figures.error)
                                              : "the distances were not checked";
      if (!known && !wanted.all) {
        return Error{ErrorCode::kBadInput,
                     "--fields: there is no error: " + why + "; leave the field error out"};
      }
      if (!known) {
        figures.warnings.push_back("--fields: the field error is left out: " + why);
        continue;
      }
      error = figures.error->values;
    }
    made.push_back(quality_field(field, *figures.model.mesh, figures.result, error));
  }
  return made;
}

}  // namespace geotherm::app
