// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/explore/command.h"

namespace geotherm::app {

/// The state after a command. Pure: commands that save, compare, run a file, undo or quit change
/// nothing here. Errors: kBadInput, one sentence (no such source, nothing kept as B, ...).
Result<ViewerState> apply(const ViewerState& state, const Command& command);

/// Commands that lead from initial_state() to `state`, and back to it exactly.
std::vector<Command> commands_to(const ViewerState& state);

/// Whether undo takes the command back: what concerns sources, method, picture, A and B; not the
/// camera. `merged`: together with the one before it, as of a drag.
struct UndoRule {
  bool undoable = false, merged = false;
};
UndoRule undo_rule(const Command& command);

}  // namespace geotherm::app
