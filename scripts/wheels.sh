#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the Python wheel for all x86-64 Linux systems with glibc 2.28 and later.
set -euo pipefail
# shellcheck source=scripts/common.sh
. "$(dirname "$0")/common.sh"

usage() {
  cat <<'TEXT'
usage: scripts/wheels.sh [FOLDER]

Builds one wheel for every Python into FOLDER (default: build/wheels), inside a container of
manylinux_2_28, whose packages it installs. Needs docker or podman, and the network.
TEXT
}

case ${1:-} in -h | --help) usage && exit 0 ;; -*) usage >&2 && exit 2 ;; esac
image=quay.io/pypa/manylinux_2_28_x86_64
folder=${1:-$root/build/wheels}
runner=$(command -v docker || command -v podman) || fail "there is neither docker nor podman"
mkdir -p "$folder"

say "building a wheel in $image"
# shellcheck disable=SC2016  # they are the shell's in the container
"$runner" run --rm -v "$root:/source:ro" -v "$(cd "$folder" && pwd):/wheels" "$image" bash -euc '
  dnf -q -y install epel-release
  dnf -q -y --enablerepo=powertools install libpng-devel zlib-devel
  pipx install "cmake<4" && pipx install ninja
  headers() {  # NAME VERSION TAG ADDRESS: what the distribution has is too old
    git clone -q --depth 1 --branch "$3" "$4" "/headers/$1-$2"
    cmake -S "/headers/$1-$2" -B "/headers/build/$1" -DBUILD_TESTING=OFF -DJSON_BuildTests=OFF \
      -DNANOFLANN_BUILD_EXAMPLES=OFF -DNANOFLANN_BUILD_TESTS=OFF
    cmake --install "/headers/build/$1"
  }
  headers Eigen3 3.4.0 3.4.0 https://gitlab.com/libeigen/eigen.git
  headers nlohmann_json 3.11.2 v3.11.2 https://github.com/nlohmann/json.git
  headers nanoflann 1.4.3 v1.4.3 https://github.com/jlblancoc/nanoflann.git
  cp -r /source /build && rm -rf /build/build
  python=/opt/python/cp311-cp311/bin/python
  $python -m pip wheel --no-deps -w /made /build \
    --config-settings=platform=manylinux_2_28_x86_64
  auditwheel show /made/*.whl || true  # it knows wheels with modules of one Python alone
  unzip -p /made/*.whl geotherm/libgeotherm.so.0 > /made/library
  readelf -V /made/library | grep -o "GLIBC_[0-9.]*" | sort -uV | tail -1
  cp /made/*.whl /wheels/'
say "done: $(ls "$folder"/*.whl)"
