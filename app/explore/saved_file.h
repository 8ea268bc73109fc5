// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/explore/command.h"
#include "solver/core/result.h"

// What commands may write. Scripts come from others: none may reach a file that is not its own.
namespace geotherm::app {

/// First bytes of every session and log that the program writes.
inline constexpr const char* kScriptMark = "# geotherm commands";

/// The file that a command writes; null: it writes none.
const std::string* saved_path(const Command& command);

/// Whether the file has an extension of the command's kind and no hidden name; of a link also what
/// it leads to. Precondition: saved_path(command). Errors: kBadInput, kNotAvailable.
Result<void> check_saved_name(const Command& command);

/// Whether a script may replace what is at the command's path: nothing, or a file that begins as
/// the program itself writes this kind. An array in .npy holds no such mark. Precondition:
/// saved_path(command). Errors: kBadInput. Cost: reads 4 KB.
Result<void> check_replaced_by_script(const Command& command);

}  // namespace geotherm::app
