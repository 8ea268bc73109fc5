#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_bare_system.sh FOLDER: installs the packages that check_packages.sh made there in a bare Debian
# of its own, runs what they bring, and removes them again. Exits 77 where it cannot.
set -euo pipefail
folder=$1

skip() {
  echo "SKIPPED: $*"
  exit 77
}
[ "$(id -u)" -eq 0 ] || skip "only root may make a system to install packages in"
command -v mmdebstrap >/dev/null || skip "mmdebstrap is not installed; scripts/setup.sh --dev does it"
ls "$folder"/made/*.deb >/dev/null 2>&1 || skip "there are no packages"

bare=$(mktemp -d)
mounted=
clean_up() {
  if [ -n "$mounted" ]; then umount "$bare/proc"; fi
  rm -rf "$bare"
}
trap clean_up EXIT
. /etc/os-release
# What is thrown away need not reach the disk: half of the time.
mmdebstrap --quiet --variant=apt --mode=root --dpkgopt=force-unsafe-io "$VERSION_CODENAME" "$bare" \
  >"$folder/bare.log" 2>&1 || {
  cat "$folder/bare.log"
  skip "no bare system could be made, most likely for want of a network; what was said is above"
}
mount --bind /proc "$bare/proc" 2>/dev/null || skip "this root may not mount"
mounted=yes
for file in /etc/resolv.conf /etc/apt/apt.conf.d/*; do cp "$file" "$bare$file" 2>/dev/null || true; done
for package in geotherm libgeotherm0 python3-geotherm; do
  cp "$folder"/made/"$package"_*.deb "$bare/tmp/$package.deb"
done
inside() { chroot "$bare" env DEBIAN_FRONTEND=noninteractive "$@"; }

inside apt-get update -qq
inside apt-get install -y -qq --no-install-recommends libvulkan1 mesa-vulkan-drivers \
  /tmp/geotherm.deb /tmp/libgeotherm0.deb /tmp/python3-geotherm.deb >"$folder/install.log" 2>&1 || {
  cat "$folder/install.log"
  exit 1
}
test "$(inside geotherm solve bunny -s 17 -o - --no-check | wc -l)" -gt 1000
inside geotherm render bunny -s 17 --no-check -o /tmp/bunny.png
test "$(head -c 4 "$bare/tmp/bunny.png" | tail -c 3)" = PNG
inside python3 -c '
import geotherm
solver = geotherm.Solver(geotherm.read("bunny"))
distance = solver.distance(17)
assert distance[17] == 0 and distance.max() > 1, distance
'
inside apt-get purge -y -qq geotherm libgeotherm0 python3-geotherm >"$folder/purge.log" 2>&1
left=$(find "$bare" -xdev -name '*geotherm*' -not -path "$bare/tmp/*" -not -path "$bare/var/log/*")
test -z "$left" || { echo "left behind: $left"; exit 1; }
