#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Writes what shells and manuals know of the program into DIRECTORY, a share/ folder: completions for
# bash, zsh and fish, and a manual page for each command where help2man is installed.
set -euo pipefail
if [ $# -ne 2 ]; then
  echo "usage: scripts/shell_files.sh PROGRAM DIRECTORY" >&2
  exit 2
fi
program=$(realpath "$1")
share=$2

install -d "$share/bash-completion/completions" "$share/zsh/vendor-completions" \
  "$share/fish/vendor_completions.d"
"$program" completion bash >"$share/bash-completion/completions/geotherm"
"$program" completion zsh >"$share/zsh/vendor-completions/_geotherm"
"$program" completion fish >"$share/fish/vendor_completions.d/geotherm.fish"

if ! command -v help2man >/dev/null; then
  echo "shell_files.sh: no manual pages, for help2man is not installed" >&2
  exit 0
fi
install -d "$share/man/man1"
# Examples are a line each, which help2man would join to a paragraph.
lines_apart() {
  awk '/^Examples:$/ { $0 = ".SH EXAMPLES" }
    /^\.SH/ { if (apart) print ".fi"; apart = 0; examples = /EXAMPLES/ }
    examples && /^\.IP/ { $0 = ".nf"; apart = 1 }
    { print }
    END { if (apart) print ".fi" }'
}
version=$("$program" --version | cut -d ' ' -f 2)
# help2man FILE NAME WHAT COMMAND...: the words of `geotherm COMMAND --help` as a page.
page() {
  help2man --no-info --section 1 --source geotherm --manual "geotherm" --name "$2" \
    --version-string "$1 $version" --help-option "${3:-} --help" "$program" |
    lines_apart | gzip -9n >"$share/man/man1/$1.1.gz"
}
page geotherm "geodesic distance on meshes, points, volumes and grids"
"$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\{1,\}\)  *\(.*\)/\1 \2/p' |
  while read -r command what; do page "geotherm-$command" "${what%.}" "$command"; done
