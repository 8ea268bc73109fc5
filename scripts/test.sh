#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds three ways and runs all tests in one ctest, whose summary comes
# last: release (all tests), asan (address and undefined behaviour), tsan (threads, and without
# SuiteSparse). Pictures are drawn and checked with Vulkan's
# software device; --require-vulkan makes their tests fail, not skip, where there is none.
# Other arguments go to ctest: scripts/test.sh -R Reader
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [ "${1:-}" = --require-vulkan ]; then
  export GEOTHERM_REQUIRE_VULKAN=1
  shift
fi

# What the tests use only when they run is installed while they are built, unless sudo may have to ask.
"$root/scripts/setup.sh" --tests
installing=
if [ "$(id -u)" -eq 0 ]; then
  "$root/scripts/setup.sh" --dev &
  installing=$!
  trap wait EXIT
else
  "$root/scripts/setup.sh" --dev
fi

# Meshes and exact distances that are not part of the project, used where they exist.
skipped=()
use_data() {
  local variable=$1 folder=$2 tests=$3
  if [ -z "${!variable:-}" ] && [ -d "$folder" ]; then export "$variable=$(realpath "$folder")"; fi
  if [ -z "${!variable:-}" ]; then skipped+=("$tests: set $variable to their folder"); fi
}
use_data GEOTHERM_TEST_MESHES "$root/../shared/meshes" "tests on scanned meshes"
use_data GEOTHERM_TEST_EXACT "$root/../shared/exact" "tests against exact distances"
use_data GEOTHERM_TEST_CASES "$root/../shared/cases" "tests on graded meshes and slivers"

suites=(release asan tsan)
for suite in "${suites[@]}"; do
  build "$suite"
  # A suite without tests is a mistake, not a success.
  (cd "$root" && ctest --preset "$suite" -N) | grep -qE '^Total Tests: [1-9]' ||
    fail "the build $suite has no tests"
done

if [ -n "$installing" ]; then
  wait "$installing" || fail "what the tests use could not be installed; why is above the builds"
fi

# One ctest over all of them.
mkdir -p "$root/build/all"
printf 'subdirs("%s")\n' "${suites[@]/#/$root/build/}" >"$root/build/all/CTestTestfile.cmake"

say "running all tests"
for line in "${skipped[@]}"; do printf 'not run: %s\n' "$line"; done
# One more at a time than there are cores: some wait for a window, or for the launcher of ranks.
ctest --test-dir "$root/build/all" --output-on-failure --no-tests=error -j "$(($(job_count) + 1))" "$@" |
  { grep --line-buffered -vE '^ +Start +[0-9]+: ' || true; }
