// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "app/compare_run.h"
#include "app/machine.h"

namespace geotherm::app {

/// One heading, one row a backend and model, then the messages.
std::string compare_table(const Machine& machine, std::span<const CompareRow> rows);

/// The keys of a row as heading; an empty field where there is no figure.
std::string compare_csv(std::span<const CompareRow> rows);

/// {"machine", "rows"}; null where there is no figure.
std::string compare_json(const Machine& machine, std::span<const CompareRow> rows);

/// A page that needs nothing else: the table, and bars of set-up and query on a logarithmic scale.
std::string compare_html(const Machine& machine, std::span<const CompareRow> rows);

}  // namespace geotherm::app
