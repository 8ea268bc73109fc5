#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Counts the source without its tests: files, lines, the median file, small and large ones, the
# headers that are installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

git ls-files -co --exclude-standard -- '*.cpp' '*.h' '*.inl' '*.glsl' '*.vert' '*.frag' '*.comp' ':!tests' |
  while read -r file; do if [ -f "$file" ]; then wc -l <"$file"; fi; done | sort -n |
  awk '{ lines += $1; of[NR] = $1; small += $1 < 40; large += $1 > 350 }
       END { printf "files %d\nlines %d\nmedian file %d\nbelow 40 lines %d\nabove 350 lines %d\n",
                    NR, lines, of[int((NR + 1) / 2)], small, large }'
printf 'installed headers %d\n' "$(find solver/include/geotherm -name '*.h' 2>/dev/null | wc -l)"
