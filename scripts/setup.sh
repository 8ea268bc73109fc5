#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing to build geotherm, and nothing else. Debian 12, Ubuntu 24.04 and later.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: scripts/setup.sh [--pictures] [--tests] [--dev] [--lint] [--package] [--site] [--mpi]

Installs, through apt-get, the packages that building and running geotherm needs and that are not
there yet. Says nothing when nothing is missing. Needs root or sudo only when something is.

  --pictures  less: what the command line and its pictures need (the preset demo)
  --tests  also what building the tests uses: ccache, clang-format, NumPy, pytest, PETSc and MPI
  --dev    also what the tests use when they run: locales, Vulkan's validation layer, a display
           without a screen (Xvfb) and a hand for it (xdotool), models made to break readers, shells
           that complete words, the judges of Debian packages and a maker of bare systems, SciPy, pip
           and mypy for the Python package and what it works with (joblib, dask, mpi4py, tqdm,
           meshio), a browser for pages (Chromium)
  --lint   also what scripts/lint.sh needs: clang-tidy, shellcheck
  --package  also what scripts/package.sh needs: help2man
  --mpi    also PETSc and MPI: the backend petsc, work shared over mpirun; --dev has it, too
  --site   also what scripts/site.sh needs: Sphinx, Doxygen; the tests use it, so --dev has it, too
TEXT
}

cluster=(libpetsc-real-dev libhypre-dev libopenmpi-dev openmpi-bin)
tests=(ccache clang-format python3-numpy python3-pytest "${cluster[@]}")
site=(doxygen python3-sphinx python3-myst-parser python3-breathe furo python3-numpy)
packages=(g++ cmake ninja-build
  libeigen3-dev libnanoflann-dev zlib1g-dev libpng-dev  # the library
  libcli11-dev nlohmann-json3-dev libcairo2-dev pkg-config  # the program
  libvulkan-dev libglm-dev libstb-dev fonts-dejavu-core glslang-tools spirv-tools  # the renderer
  libvulkan1 mesa-vulkan-drivers)                   # drawing, without a GPU as well
others=(libsuitesparse-dev libopenblas-dev          # the backend cholmod
  libassimp-dev                                     # glTF, 3MF, Collada
  libglfw3-dev libimgui-dev                         # the viewer
  libgtest-dev libtinyobjloader-dev)                # tests, benchmark
for argument in "$@"; do
  case $argument in
    --pictures) others=() ;;
    --tests) packages+=("${tests[@]}") ;;
    --dev) packages+=(locales vulkan-validationlayers xvfb xauth xdotool assimp-testmodels zsh fish
      help2man man-db lintian desktop-file-utils appstream shared-mime-info mmdebstrap python3-scipy
      python3-pip python3-venv mypy chromium python3-jsonschema python3-joblib python3-dask
      python3-mpi4py python3-tqdm python3-meshio "${tests[@]}" "${site[@]}") ;;
    --mpi) packages+=("${cluster[@]}") ;;
    --site) packages+=("${site[@]}") ;;
    --package) packages+=(help2man dpkg-dev) ;;
    --lint) packages+=(ccache clang-format clang-tidy shellcheck git) ;;
    -h | --help) usage && exit 0 ;;
    *) usage >&2 && exit 2 ;;
  esac
done
packages+=("${others[@]}")

fail() {
  printf 'setup.sh: error: %s\n' "$*" >&2
  exit 1
}

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  if [ -n "${GEOTHERM_SKIP_SETUP:-}" ]; then exit 0; fi
  fail "this system has no apt-get; install what these packages hold by your own means, then set" \
    "GEOTHERM_SKIP_SETUP=1: ${packages[*]}"
fi
if [ -n "${GEOTHERM_SKIP_SETUP:-}" ]; then exit 0; fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  if [ "$status" != installed ]; then missing+=("$package"); fi
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    fail "${#missing[@]} packages are missing and there is neither root nor sudo to install them;" \
      "ask an administrator for: apt-get install ${missing[*]}"
  fi
  if [ ! -t 0 ] && ! sudo -n true 2>/dev/null; then
    fail "${#missing[@]} packages are missing and sudo asks for a password;" \
      "run first: sudo apt-get install ${missing[*]}"
  fi
  as_root=(sudo)
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 \
    -o Acquire::Retries=3 "$@" </dev/null
}

log=$(mktemp)
trap 'rm -f "$log"' EXIT
printf 'setup.sh: installing %s\n' "${missing[*]}" >&2
# The lists of packages may be stale or absent: one that does not suffice is brought up to date.
if ! apt install --no-install-recommends -y "${missing[@]}" >"$log" 2>&1; then
  if ! { apt update && apt install --no-install-recommends -y "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    fail "apt-get could not install ${missing[*]}; its last words are above"
  fi
fi
