// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/explore/command.h"
#include "geotherm/error.h"

// What commands may write. Scripts come from others: none may reach a file that is not its own.
namespace geotherm::app {

/// The file that a command writes; null: it writes none.
const std::string* saved_path(const Command& command);

/// Whether the file has an extension of the command's kind, and no part of its path is hidden; also
/// where links lead that are in it. Precondition: saved_path(command). Errors: kBadInput,
/// kNotAvailable.
Result<void> check_saved_name(const Command& command);

/// Whether nothing is at the command's path, so that a script that has not written there in this
/// run may. Precondition: saved_path(command). Errors: kBadInput.
Result<void> check_replaced_by_script(const Command& command);

}  // namespace geotherm::app
