#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Layout and names of the sources: clang-format, clang-tidy, shellcheck; changes nothing.
#   scripts/lint.sh --format    clang-format alone
#   scripts/lint.sh FILE...     clang-tidy on these sources alone
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$root"

# Paths of the project's files with one of the given endings, separated by zeros.
sources() {
  local ending
  local -a patterns=()
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    for ending in "$@"; do patterns+=("*.$ending"); done
    git ls-files -z --cached --others --exclude-standard -- "${patterns[@]}" |
      while IFS= read -r -d '' file; do
        if [ -f "$file" ]; then printf '%s\0' "$file"; fi
      done
  else
    for ending in "$@"; do patterns+=(-o -name "*.$ending"); done
    find solver engine shaders app bench tests -type f \( "${patterns[@]:1}" \) -print0
  fi
}

check_format() {
  sources h cpp inl | xargs -0 -r "${CLANG_FORMAT:-clang-format}" --dry-run -Werror
}

if [ "${1:-}" = --format ]; then
  check_format
  exit 0
fi

"$root/scripts/setup.sh" --lint
say "clang-format"
check_format
say "shellcheck"
shellcheck -x -P SCRIPTDIR scripts/*.sh

build dev
say "headers on their own"
cmake --build --preset dev --target all_verify_interface_header_sets -j "$(job_count)" >&2
say "clang-tidy"
if [ $# -gt 0 ]; then files=("$@"); else mapfile -d '' files < <(sources cpp); fi
printf '%s\0' "${files[@]}" | grep -zv '^tests/consumer/' |
  xargs -0 -r -n 1 -P "$(job_count)" clang-tidy -p build/dev --quiet --warnings-as-errors='*'
