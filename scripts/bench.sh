#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and runs the benchmark: set-up, query, batch and memory of each backend beside a plain
# use of CHOLMOD, what the machine can do at best, and the reading of OBJ files beside tinyobjloader.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case ${1:-} in
  -h | --help)
    echo "usage: scripts/bench.sh [--quick] [--only REGEX] [--threads N]"
    echo "                        [--json FILE] [--markdown FILE] [--svg FILE]"
    echo "  --quick: under ten minutes on 2 cores, unless --only names other meshes; all of it takes
  about an hour and 16 GB"
    exit 0
    ;;
esac

"$root/scripts/setup.sh"
build release geotherm_bench
exec "$root/build/release/bench/geotherm_bench" "$@"
