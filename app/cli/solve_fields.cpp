// SPDX-License-Identifier: MIT
#include "app/cli/solve_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

/// That of pictures, where there is no value.
constexpr double kUnreachedGrey = 158;

Error about_option(const Error& error) { return about("--fields", error); }

Result<std::vector<QualityField>> named_fields(const std::string& text, MethodKind method) {
  std::vector<QualityField> fields;
  for (const std::string_view name : split(text, ',')) {
    const auto field = parse<QualityField>(one_line(trimmed(name)));
    if (!field) return about_option(field.error());
    if (needs_heat(*field) && method != MethodKind::kHeat) {
      return Error{ErrorCode::kBadInput,
                   "--fields: " + to_text(*field) + " is about the heat u, which --method " +
                       to_text(method) + " has not",
                   {"leave it out"}};
    }
    if (std::ranges::find(fields, *field) == fields.end()) fields.push_back(*field);
  }
  return fields;
}

bool is_of_triangles(QualityField field) {
  return field == QualityField::kTriangleQuality || field == QualityField::kNonDelaunay;
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
    return Error{ErrorCode::kBadInput,
                 "--fields: they are written beside the distances",
                 {"give -o FILE.ply or -o FILE.vtp"}};
  }
  wanted.all = text == "all";
  if (wanted.all) {
    wanted.fields = all_values<QualityField>();
    if (method != MethodKind::kHeat) std::erase_if(wanted.fields, needs_heat);
  } else {
    auto named = named_fields(text, method);
    if (!named) return named.error();
    wanted.fields = *std::move(named);
  }
  if (wanted.all) {
    Result<void> held;
    const bool some = std::ranges::any_of(paths, [&](const std::string& path) {
      return std::ranges::any_of(wanted.fields, [&](QualityField field) {
        return static_cast<bool>(held = check_field(path, described(field)));
      });
    });
    if (some) return wanted;
    return about_option(held.error());
  }
  for (const std::string& path : paths) {
    const bool of_tets = io::file_extension(path) == ".vtu";
    for (const QualityField field : wanted.fields) {
      if (of_tets && is_of_triangles(field)) {
        return Error{ErrorCode::kBadInput,
                     "--fields: " + to_text(field) + " is of triangles, and " + one_line(path) +
                         " holds tets",
                     {"leave it out, or write .ply or .vtp"}};
      }
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
                              : figures.error ? to_text(*figures.error)
                                              : "the distances were not checked";
      if (!known && !wanted.all) {
        return Error{ErrorCode::kBadInput,
                     "--fields: there is no error: " + why,
                     {"leave the field error out"}};
      }
      if (!known) {
        figures.warnings.push_back({"--fields: the field error is left out: " + why});
        continue;
      }
      error = figures.error->values;
    }
    const auto& space = figures.model.space;
    if (space && is_of_cells(field)) {
      DataField& of_cells = made.emplace_back(described(field));
      of_cells.values = cell_field(*space, field, figures.result, space->cells_of_faces());
    } else {
      made.push_back(quality_field(field, *figures.model.mesh, figures.result, error));
    }
  }
  return made;
}

std::vector<DataField> fields_of_file(const std::string& path, const std::vector<DataField>& all,
                                      std::vector<Warning>& warnings) {
  std::vector<DataField> held;
  std::vector<std::string> left_out;
  for (const DataField& field : all) {
    if (check_field(path, field)) {
      held.push_back(field);
    } else {
      left_out.push_back(field.name);
    }
  }
  if (!left_out.empty()) {
    warnings.push_back({"--fields: " + one_line(path) + " has no place for " + joined(left_out) +
                        ", which " + (left_out.size() > 1 ? "are" : "is") + " left out there"});
  }
  return held;
}

std::vector<DataField> fields_of_tets(const WantedFields& wanted, const Answer& figures,
                                      const std::vector<DataField>& of_faces) {
  std::vector<Index> cells(static_cast<std::size_t>(figures.model.space->cell_count()));
  std::iota(cells.begin(), cells.end(), 0);
  std::vector<DataField> made;
  for (const DataField& field : of_faces) {
    if (field.place == DataField::Place::kVertices) made.push_back(field);
  }
  for (const QualityField field : wanted.fields) {
    if (!is_of_cells(field)) continue;
    made.push_back(described(field));
    made.back().values = cell_field(*figures.model.space, field, figures.result, cells);
  }
  return made;
}

Result<std::vector<DataField>> baked_colours(const Drawing& drawing, const std::string& map,
                                             std::span<const double> distances) {
  const auto table = drawing.colours(map);
  if (!table) return about("--bake-colours", table.error());
  double largest = 0;
  for (const double d : distances) largest = std::isfinite(d) ? std::max(largest, d) : largest;
  const auto steps = static_cast<double>(table->size() - 1);
  std::vector<DataField> made;
  for (std::size_t k = 0; k < 3; ++k) {
    constexpr std::array kNames = {"red", "green", "blue"};
    made.push_back({kNames[k], DataField::Place::kVertices, DataField::Type::kUint8, {}});
    for (const double d : distances) {
      const double share = largest > 0 ? std::max(d, 0.0) / largest : 0;
      const auto at = static_cast<std::size_t>(std::isfinite(d) ? std::lround(share * steps) : 0);
      made.back().values.push_back(std::isfinite(d) ? (*table)[at][k] : kUnreachedGrey);
    }
  }
  return made;
}

}  // namespace geotherm::app
