#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the site of the pages, docs/*.md, and of the interfaces' own comments: build/site/index.html.
# Ends with an error where a link leads nowhere or a public name has no comment.
#   scripts/site.sh                    installs what is missing, builds the program, makes the site
#   scripts/site.sh BUILD [FOLDER]     makes it with the program of that build, and installs nothing
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case ${1:-} in
  -h | --help) sed -n '3,6s/^# \{0,1\}//p' "$0" && exit 0 ;;
  "")
    "$root/scripts/setup.sh" --site
    build release geotherm
    build release geotherm_c
    ;;
esac
for tool in "doxygen --version" "/usr/bin/python3 -c 'import sphinx, myst_parser, breathe, furo, numpy'"; do
  if ! eval "$tool" >/dev/null 2>&1; then
    echo "skipped: scripts/setup.sh --site installs what makes the site" >&2
    exit 77
  fi
done
built=$(realpath "${1:-$root/build/release}")
site=$(realpath -m "${2:-$root/build/site}")
work=$site.work
cd "$root"

export GEOTHERM_LIBRARY=${GEOTHERM_LIBRARY:-$built/lib/libgeotherm.so.0}
export PYTHONPATH=$root/app/python PYTHONDONTWRITEBYTECODE=1 GEOTHERM_SITE_XML=$work
if [ -n "$(ls -A "$site" 2>/dev/null)" ] && [ ! -e "$site/.buildinfo" ] && [ ! -e "$work" ]; then
  fail "$site is there and no site that Sphinx made; name another folder"
fi
rm -rf "$site" "$work"

# comments NAME INPUT [SETTING...]: the comments of an interface, as XML.
comments() {
  mkdir -p "$work/$1"
  { cat docs/site/Doxyfile && printf '%s\n' "OUTPUT_DIRECTORY = $work/$1" "INPUT = $2" "${@:3}"; } |
    doxygen - || fail "public names of $2 are not documented; they are above"
}
say "reading the comments of the interfaces"
comments cpp "solver/include/geotherm docs/site/namespaces.dox" "STRIP_FROM_PATH = solver/include"
comments c "app/c/geotherm.h" OPTIMIZE_OUTPUT_FOR_C=YES TYPEDEF_HIDES_STRUCT=YES

say "making the pages"
/usr/bin/python3 docs/site/pages.py "$work/pages" "$built/geotherm"
/usr/bin/python3 -m sphinx -q -n -W --keep-going -j "$(job_count)" -c docs/site -d "$work/doctrees" \
  "$work/pages" "$site" || fail "the pages have mistakes; they are above"
/usr/bin/python3 docs/site/check_links.py "$site"
say "written: ${site#"$root"/}/index.html"
