# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# What the scripts share; sourced, never run.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n== %s\n' "$*" >&2; }

fail() {
  printf '%s: error: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Cores to build with; each compiler may want 2.6 GB.
job_count() {
  local cores memory
  cores=$(nproc 2>/dev/null || echo 2)
  memory=$(awk '/^MemAvailable/ { print int($2 / 2600000) }' /proc/meminfo 2>/dev/null || echo 2)
  if [ "${memory:-0}" -lt 1 ]; then memory=1; fi
  if [ "$cores" -lt "$memory" ]; then echo "$cores"; else echo "$memory"; fi
}

# build PRESET [TARGET [OPTIONS OF CMAKE...]]: configures and builds; says nothing but errors unless
# it takes long.
build() {
  local preset=$1 target=${2:-all} log
  if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
  say "building $preset${2:+ ($2)} in build/$preset"
  mkdir -p "$root/build"
  log=$root/build/$preset.configure.log
  if ! (cd "$root" && cmake --preset "$preset" "${@:3}") >"$log" 2>&1; then
    cat "$log" >&2
    fail "the preset $preset does not configure; its output is above"
  fi
  grep -A 3 'CMake Warning' "$log" >&2 || true
  (cd "$root" && cmake --build --preset "$preset" --target "$target" -j "$(job_count)") >&2 ||
    fail "the preset $preset does not build; its output is above"
}
