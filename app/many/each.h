// SPDX-License-Identifier: MIT
#pragma once

#include "app/announce.h"
#include "app/cmd_solve.h"
#include "app/command_output.h"

namespace geotherm::app {

/// `solve --each`: one row of distances for each source, streamed into a .npy array of K x V.
Result<CommandOutput> run_each(const SolveArguments& arguments, const Progress& progress,
                               const Announce& announce);

}  // namespace geotherm::app
