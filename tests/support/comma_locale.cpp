// SPDX-License-Identifier: MIT
#include "tests/support/comma_locale.h"

#include <clocale>
#include <cstdlib>
#include <locale>
#include <stdexcept>

namespace geotherm::test {

CommaLocale::CommaLocale(const std::string& folder) {
  constexpr const char* kName = "de_DE.UTF-8";
  const std::string command =
      "localedef -i de_DE -f UTF-8 '" + folder + "/" + kName + "' >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) return;
  ::setenv("LOCPATH", folder.c_str(), 1);
  try {
    std::locale::global(std::locale(kName));  // and that of C
  } catch (const std::runtime_error&) {
    return;
  }
  holds_ = std::string(std::localeconv()->decimal_point) == ",";
}

CommaLocale::~CommaLocale() {
  std::locale::global(std::locale::classic());
  ::unsetenv("LOCPATH");
}

}  // namespace geotherm::test
