#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the site is held against finds what is wrong: check_mistakes.sh FOLDER.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
folder=$1
rm -rf "$folder"
mkdir -p "$folder"

# finds WORDS COMMAND...: it fails, and says these words.
finds() {
  if "${@:2}" >"$folder/said" 2>&1; then
    echo "no mistake was found: ${*:2}" && exit 1
  fi
  grep -q "$1" "$folder/said" || { cat "$folder/said" && exit 1; }
}

check=(/usr/bin/python3 docs/site/check_links.py "$folder")
echo '<a href="other.html#here">' >"$folder/page.html"
finds 'page.html: other.html#here' "${check[@]}"
echo '<p id="there">' >"$folder/other.html"
finds '1 of 1 links' "${check[@]}"
echo '<p id="here">' >"$folder/other.html"
"${check[@]}" >"$folder/said"

if ! command -v doxygen >/dev/null; then
  echo "skipped: doxygen is not installed"
  exit 77
fi
doxygen=(doxygen "$folder/Doxyfile")
{ cat docs/site/Doxyfile && echo "INPUT = $folder docs/site/namespaces.dox" &&
  echo "OUTPUT_DIRECTORY = $folder"; } >"$folder/Doxyfile"
cat >"$folder/part.h" <<'TEXT'
namespace geotherm {
/// One.
int one(int a);
int one(double a);
/// Both.
inline constexpr int kOne = 1, kTwo = 2;
}  // namespace geotherm
TEXT
"${doxygen[@]}" >"$folder/said" 2>&1
sed -i 's/^}/int other();\n&/' "$folder/part.h"
finds 'other() (function) of namespace geotherm is not documented' "${doxygen[@]}"
