// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/error.h"

// What a person is told of what the library says: settings are options of the command line.
namespace geotherm {
struct AccuracyReport;
}

namespace geotherm::app {

/// "SUBJECT: WHAT; try --backend cg, which needs no factor".
std::string told(const Error& error);
std::string told(const Hint& hint);
std::string told(const Warning& warning);
std::vector<std::string> told(const std::vector<Warning>& warnings);
std::string told(const AccuracyReport& report);

/// The error with where it happened in front: "WHERE: WHAT".
Error about(const std::string& where, Error error);
Error about(const std::string& where, Error error, ErrorCode code);

/// The error with this hint, unless it has one.
Error with_hint(Error error, Hint hint);

}  // namespace geotherm::app
