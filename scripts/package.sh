#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the Debian packages of geotherm into build/packages: the program, what it loads for MPI, the
# C library, the Python package and the headers of both libraries. They install with `apt install ./build/packages/*.deb` on Debian 12.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [ $# -gt 0 ]; then
  echo "usage: scripts/package.sh" >&2
  exit 2
fi
"$root/scripts/setup.sh" --package
build release geotherm
say "making the packages"
output=$root/build/packages
rm -rf "$output"
(cd "$root/build/release" && cpack -G DEB -B "$output") >"$output.log" 2>&1 || {
  cat "$output.log" >&2
  fail "cpack cannot make the packages; its output is above"
}
rm -rf "$output/_CPack_Packages"
ls "$output"/*.deb
