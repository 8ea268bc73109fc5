#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a fresh clone to geodesic distances and a picture of them: installs what is missing, builds the
# command line, solves and draws. Where there is a display it builds the viewer, too, and opens it.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case ${1:-} in
  -h | --help)
    echo "usage: scripts/demo.sh [MODEL]    MODEL: a mesh file or a bundled name (default: gargoyle)"
    exit 0
    ;;
esac
if [ $# -gt 1 ]; then fail "one model at most, $# given; try scripts/demo.sh --help"; fi
model=${1:-gargoyle}
source=17
if [ -e "$model" ]; then
  model=$(realpath "$model")
  source=random:1  # a vertex that is on the surface, whatever the file holds
fi

# In a folder of its own, compiled to be there soon: the preset release builds everything at full speed.
output=$root/build/demo
program=$output/geotherm
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  "$root/scripts/setup.sh"
  build demo geotherm -DGEOTHERM_BUILD_VIEWER=ON
else
  "$root/scripts/setup.sh" --pictures
  build demo geotherm
fi

say "geotherm solve $model -s $source"
"$program" solve "$model" -s "$source" -o "$output/distances.ply" --json "$output/solve.json"

say "geotherm render $model -s $source --view contours"
"$program" render "$model" -s "$source" --view contours -o "$output/contours.png"

cat <<TEXT

Written: build/demo/contours.png  (a picture of them, drawn by Vulkan, with a GPU or without)
         build/demo/distances.ply (the mesh with its distances; ParaView and MeshLab open it)
         build/demo/solve.json    (every figure above and more)

Try next:
  build/demo/geotherm render $model -s $source --view heat-gradient -o arrows.png
  build/demo/geotherm solve bunny -s 3,99 -o distances.csv    several sources, one distance field
  build/demo/geotherm compare bunny terrain                   the same work through each backend
  build/demo/geotherm info $model
  build/demo/geotherm generate gargoyle --faces 1000000 -o big.ply
  build/demo/geotherm solve --help

All of it at full speed, the viewer, the backend cholmod, benchmark and tests among them:
  scripts/setup.sh && cmake --preset release && cmake --build --preset release
  build/release/geotherm $model                               the viewer, where there is a display
TEXT

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  say "geotherm $model -s $source   (Ctrl+Q quits, F1 shows the keys)"
  "$program" "$model" -s "$source" || say "the viewer could not open; what is listed above is there"
fi
