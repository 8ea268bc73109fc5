// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm::app {

/// Rows of cells under headings, as lines of aligned columns.
class TextTable {
 public:
  enum class Align { kLeft, kRight };
  struct Column {
    std::string heading;
    Align align = Align::kLeft;
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Precondition: one cell a column.
  void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  /// The heading (unless all are empty), then the rows; two spaces between columns.
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace geotherm::app
