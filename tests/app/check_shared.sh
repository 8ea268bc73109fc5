#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_shared.sh PROGRAM MODULE FOLDER: one mesh over several ranks, against one process. FOLDER has
# shared_meshes.py. Exits 77 where mpirun, python3 or the library of MPI and PETSc is missing.
set -euo pipefail
program=$(realpath "$1") GEOTHERM_MPI_MODULE=$(realpath -m "$2") meshes=$(realpath "$3")/shared_meshes.py
if ! command -v mpirun >/dev/null || ! [ -x /usr/bin/python3 ] || ! [ -f "$2" ]; then
  echo "SKIPPED: no mpirun or python3, or built without PETSc and MPI; scripts/setup.sh --dev installs them"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
# The plain way of messages, which is not looked for among those of networks.
export OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_mpi_yield_when_idle=1 GEOTHERM_MPI_MODULE PROGRAM=$program

fail() { printf 'FAILED: %s\n' "$*"; exit 1; }
# shared N MESH SOURCES OPTIONS...: writes d.npy and d.json.
shared() {
  local count=$1 mesh=$2 sources=$3; shift 3
  timeout 100 mpirun --oversubscribe -q -n "$count" "$program" solve "$mesh" -s "$sources" --backend petsc \
    --threads 1 -o d.npy --json d.json "$@" >out 2>said || { cat said; fail "$count ranks on $mesh $*"; }
}
figure() { grep -o "\"$1\": [0-9.e+-]*" d.json | head -n 1 | cut -d' ' -f2; }
# agrees MESH SOURCES ITERATIONS RANKS OPTIONS...: the distances of one process, and few iterations and rounds.
agrees() {
  local mesh=$1 sources=$2 most=$3 counts=$4; shift 4
  "$program" solve "$mesh" -s "$sources" --precision full --no-check --threads 1 -o one.npy "$@" >/dev/null 2>&1
  for count in $counts; do
    shared "$count" "$mesh" "$sources" --precision full "$@"
    /usr/bin/python3 "$meshes" compare one.npy d.npy 1e-7 || fail "$count ranks on $mesh $*"
    [ "$(figure iterations_poisson)" -le "$most" ] || fail "$mesh: $(figure iterations_poisson) iterations"
    awk "BEGIN { exit !($(figure rounds) <= 2 * sqrt($(figure blocks)) + 6) }" || fail "$mesh: $(figure rounds) rounds"
    awk "BEGIN { exit !($(figure row_residual) <= 1e-4) }" || fail "$mesh: a row is off by $(figure row_residual)"
    rm d.npy
  done
}
# waves MESH SOURCES RANKS: near-exact distances of one process, but for the order within a band, which
# fitted waves feel.
waves() {
  "$program" solve "$1" -s "$2" --method wavefront --threads 1 -o one.npy >/dev/null 2>&1
  for count in $3; do
    shared "$count" "$1" "$2" --method wavefront
    /usr/bin/python3 "$meshes" compare one.npy d.npy 1e-3 || fail "waves of $count ranks on $1"
    rm d.npy
  done
}
# refused N WORDS COMMAND...: N ranks end with an error, of which WORDS are in the one line.
refused() {
  local count=$1 words=$2; shift 2
  if timeout 60 mpirun --oversubscribe -q -n "$count" "$@" >out 2>said; then fail "$* was not refused"; fi
  [ "$(grep -c 'geotherm: error' said)" = 1 ] || { cat said; fail "$*: not one line"; }
  grep -q -- "$words" said || { cat said; fail "$*: no '$words'"; }
  [ -z "$(find . -name 'r.npy*')" ] || fail "$*: something was left"
}

/usr/bin/python3 "$meshes" make
delaunay=(--laplacian intrinsic-delaunay)
agrees plane.ply 7 15 "1 2 4 8" --variant classic "${delaunay[@]}"
agrees sphere.ply 0 15 4 --variant classic "${delaunay[@]}"
agrees three.ply 5,40,3000 15 "2 8" --variant classic "${delaunay[@]}"
agrees obtuse.ply 0 15 "1 8" --variant classic "${delaunay[@]}"
agrees stretched.ply 3 40 "2 8" --variant classic "${delaunay[@]}"
# Farther than doubles reach in a block, and far more than in all.
agrees strip.ply 0 40 "2 8" --variant classic "${delaunay[@]}"
# Cotangents as they are; the correction, whose fading needs figures of whole components.
agrees plane.ply 7 15 4 --variant classic --laplacian cotan
agrees plane.ply 7,5000 15 "2 8" "${delaunay[@]}"
agrees three.ply 5,3000 15 4 "${delaunay[@]}" -m 4
agrees obtuse.ply 0 15 4 "${delaunay[@]}"
# As they are, near fields where the edges are Delaunay.
agrees plane.ply 7 15 "1 4" --laplacian cotan
agrees obtuse.ply 0 20 2 --laplacian cotan
# So few faces that the source alone is near it.
agrees little.ply 12 15 2 "${delaunay[@]}"
# Figures of the report are those of one process; compact factors are checked as well.
"$program" solve plane.ply -s 7 --no-check "${delaunay[@]}" --json one.json >/dev/null
shared 4 plane.ply 7
for key in eikonal_error_mean mean_edge_length area t max; do
  awk "BEGIN { a = $(figure $key); b = $(grep -o "\"$key\": [0-9.e+-]*" one.json | head -n 1 | cut -d' ' -f2)
               exit !(a - b <= 1e-5 * b && b - a <= 1e-5 * b) }" || fail "$key: $(figure $key)"
done
cp d.json "${KEEP_REPORT:-/dev/null}"
waves plane.ply 7 "1 8"
waves sphere.ply 0,2000 4
waves three.ply 5,40,3000 2
waves obtuse.ply 0 8
waves stretched.ply 3 4
waves strip.ply 0 8
waves book.ply 0 4
# Heat is held against waves unless --no-check says otherwise: the figures of one process, but for the order
# within a band, which moves fitted waves by some 1e-5.
"$program" solve obtuse.ply -s 0 "${delaunay[@]}" --json one.json >/dev/null
shared 4 obtuse.ply 0
for key in mean_relative max_of_range; do
  awk "BEGIN { a = $(figure $key); b = $(grep -o "\"$key\": [0-9.e+-]*" one.json | head -n 1 | cut -d' ' -f2)
               few = 1e-2 * b + 1e-5; exit !(a - b <= few && b - a <= few) }" || fail "$key: $(figure $key)"
done
shared 2 plane.ply 7 --no-check
if grep -q '"error"' d.json; then fail "--no-check: checked"; fi
# A time step of thousands of edges: as good as no distances.
refused 2 'poor distances.*against wavefront' "$program" solve plane.ply -s 7 -m 1e6 --backend petsc -o r.npy --on-poor fail

# Lengths whose squares no double holds; random sources and their type of numbers.
agrees wide.ply 7 15 4 --variant classic "${delaunay[@]}"
"$program" solve plane.ply -s random:5:3 --no-check --threads 1 --json one.json >/dev/null 2>&1
shared 2 plane.ply random:5:3 --float32
/usr/bin/python3 - <<'PY' || fail "random sources"
import json
one, shared = (json.load(open(name)) for name in ("one.json", "d.json"))
assert sorted(one["sources"]) == shared["sources"], shared["sources"]
assert b"<f4" in open("d.npy", "rb").read(80)
PY
# warns WORDS: the last solve, each line once.
warns() { [ "$(grep -c -- "$1" said)" = 1 ] || { cat said; fail "no warning '$1'"; }; }
# What is poor is said in the words of one process, with its numbers.
for run in "plane.ply 7 -m 0.001" "twice.ply 7" "three.ply 7"; do
  read -r mesh source options <<<"$run"
  # shellcheck disable=SC2086
  "$program" solve "$mesh" -s "$source" $options --no-check "${delaunay[@]}" >/dev/null 2>one
  # shellcheck disable=SC2086
  shared 3 "$mesh" "$source" $options --no-check "${delaunay[@]}"
  [ -s one ] || fail "$run: nothing to warn of"
  diff one said || fail "$run: other warnings"
done
# Where one process would insert vertices: as many needs as it counts.
"$program" solve obtuse.ply -s 0 --no-check >one 2>&1
needs=$(grep -o '[0-9,]* obtuse boundary edges' one | tr -dc '0-9')
shared 3 obtuse.ply 0
warns "^geotherm: warning: $needs edges of the boundary .*one process would insert vertices"

solve=(--backend petsc -o r.npy)
# Seen by one rank alone: the last face, a file that is cut short, a disk that is full.
refused 4 'vertex 6300 is used.*face 12282 of 12282' "$program" solve range.ply -s 0 "${solve[@]}"
mkdir other && head -c 200000 plane.ply >other/plane.ply
cat >of_rank.sh <<'SH'
case $1 in
  truncated) [ "$OMPI_COMM_WORLD_RANK" = 1 ] && cd other ;;
  full) [ "$OMPI_COMM_WORLD_RANK" = 1 ] && ulimit -f 30 ;;
esac
exec "$PROGRAM" solve plane.ply -s 0 --backend petsc --threads 1 -o ../$(basename "$PWD")/r.npy
SH
refused 2 'the file ends' sh of_rank.sh truncated
OMPI_MCA_btl=self,tcp refused 2 'cannot be written' sh of_rank.sh full
refused 2 'no vertex 6300' "$program" solve plane.ply -s 0,6300 "${solve[@]}"
refused 2 'gone.ply: no such file; check the path' "$program" solve gone.ply -s 0 "${solve[@]}"
refused 2 'gone/r.npy: cannot be written: there is no folder gone; make it first' "$program" solve plane.ply -s 0 --backend petsc -o gone/r.npy
# What one process alone does is said, not left out.
"$program" generate bunny -o bunny.obj >/dev/null
refused 2 'binary .ply' "$program" solve bunny.obj -s 0 "${solve[@]}"
for option in --check --labels '--target 3' '--max-distance 1' '--weld 0.1' '--boundary dirichlet' \
  '--method exact' '--constraint pin-vertex' '--heat hold' '--laplacian refined' '--memory-limit 99' \
  '--fields all' '--refine 1' '--on-poor better' '--grid mask' '--domain polygons' '--mask no.txt'; do
  # A launcher's words alone make it one rank, without the time that mpirun takes.
  # shellcheck disable=SC2086
  if PMI_RANK=0 PMI_SIZE=1 "$program" solve plane.ply -s 0 $option "${solve[@]}" >out 2>said; then fail "$option"; fi
  grep -q -- "${option%% *} .*is for one process" said || { cat said; fail "$option"; }
done
refused 2 'give -o FILE.npy' "$program" solve plane.ply -s 0 --backend petsc -o d.csv
refused 2 '7000 different vertices\|7,000 different vertices' "$program" solve plane.ply -s random:7000 "${solve[@]}"
refused 2 'vertices by their numbers' "$program" solve plane.ply -s xyz:0:0:0 "${solve[@]}"
GEOTHERM_MPI_MODULE=none refused 2 'geotherm-mpi' "$program" solve plane.ply -s 0 "${solve[@]}"
echo "shared: all checked"
