/* SPDX-License-Identifier: MIT */
/* The C interface as it is installed. */
#include <geotherm.h>
#include <stdio.h>

int main(void) {
  if (geotherm_interface() != GEOTHERM_INTERFACE) return 1;
  return printf("geotherm %s\n", geotherm_version()) > 0 ? 0 : 1;
}
