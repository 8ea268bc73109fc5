#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_packages.sh BUILD FOLDER: makes the packages of BUILD in FOLDER and has the judges of Debian look
# at them. Exits 77 where these judges are not installed.
set -euo pipefail
build=$1 folder=$2

for judge in lintian desktop-file-validate appstreamcli update-mime-database help2man man; do
  if ! command -v "$judge" >/dev/null; then
    echo "SKIPPED: $judge is not installed; scripts/setup.sh --dev installs it"
    exit 77
  fi
done
rm -rf "$folder"
mkdir -p "$folder"
# What is inside is judged: xz, by which they are shipped, takes ten times as long.
(cd "$build" && cpack -G DEB -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip -B "$folder/made")
lintian --allow-root --fail-on error "$folder"/made/*.deb

for package in "$folder"/made/*.deb; do dpkg-deb -x "$package" "$folder/root"; done
share=$folder/root/usr/share
desktop-file-validate "$share"/applications/*.desktop
appstreamcli validate --no-net "$share"/metainfo/*.xml
cp -r "$share/mime" "$folder/mime"
update-mime-database "$folder/mime"
grep -q 'model/x-ply' "$folder/mime/globs2"
# A page for each command, which says what the command says of itself.
"$build/geotherm" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\{1,\}\) .*/\1/p' |
  while read -r command; do
    page=$share/man/man1/geotherm-$command.1.gz
    MANWIDTH=200 man --warnings -l "$page" >"$folder/page" 2>"$folder/said"
    test ! -s "$folder/said" || { cat "$folder/said"; exit 1; }
    test "$(lexgrog "$page" | sed 's/.*: "\([^ ]*\) - .*/\1/')" = "geotherm-$command" ||
      { echo "the page of $command has another name"; exit 1; }
    grep -q "geotherm $command" "$folder/page" || { echo "no page of $command"; exit 1; }
    "$build/geotherm" "$command" --help | sed -n '/^Examples:/,$s/^  //p' >"$folder/examples"
    while read -r example; do  # each on its line
      sed 's/^ *//' "$folder/page" | grep -xF -- "$example" >/dev/null ||
        { echo "the page of $command has no line: $example"; exit 1; }
    done <"$folder/examples"
  done
for library in geotherm geotherm-solver; do
  PKG_CONFIG_PATH=$folder/root/usr/lib/pkgconfig \
    pkg-config --define-prefix --libs "$library" | grep -q -- "-l${library/-/_}"
done
