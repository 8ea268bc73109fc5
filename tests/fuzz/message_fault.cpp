// SPDX-License-Identifier: MIT
#include <algorithm>

#include "tests/fuzz/fuzz_targets.h"

namespace geotherm::test {

std::string message_fault(const std::string& message, std::size_t quoted) {
  constexpr std::size_t kLongest = 600;  // bytes that a person still reads as one line
  if (message.empty()) return "an error without a message";
  if (message.size() > kLongest + quoted)
    return "a message of " + std::to_string(message.size()) + " bytes";
  const bool printable = std::all_of(message.begin(), message.end(),
                                     [](unsigned char c) { return c >= ' ' && c != 0x7f; });
  return printable ? "" : "a message that cannot be printed: " + message;
}

}  // namespace geotherm::test
