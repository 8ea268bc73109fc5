// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm {

/// An instruction set that inner loops are compiled for; all give the same answer to round-off.
enum class InstructionSet { kPlain, kAvx2, kAvx512 };

/// The best one that this build and this processor have.
InstructionSet best_instruction_set();

}  // namespace geotherm
