#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_ranks.sh PROGRAM MODULE: work that several processes share under mpirun, against that of one.
# Exits 77 where mpirun or the library of MPI and PETSc is missing.
set -euo pipefail
program=$(realpath "$1") GEOTHERM_MPI_MODULE=$(realpath -m "$2")
command -v mpirun >/dev/null && [ -f "$2" ] || {
  echo "SKIPPED: no mpirun, or built without PETSc and MPI; scripts/setup.sh --dev installs them"
  exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
# The plain way of messages, which is not looked for among those of networks.
export OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_mpi_yield_when_idle=1 GEOTHERM_MPI_MODULE

fail() { printf 'FAILED: %s\n' "$*"; exit 1; }
ranks() { local count=$1; shift; mpirun --oversubscribe -q -n "$count" "$@"; }
# refused N WORDS COMMAND...: N ranks end with an error, of which WORDS are in the one line.
refused() {
  local count=$1 words=$2; shift 2
  if timeout 60 mpirun --oversubscribe -q -n "$count" "$@" >out 2>said; then fail "$* was not refused"; fi
  [ "$(grep -c 'geotherm: error' said)" = 1 ] || { cat said; fail "$*: not one line"; }
  grep -q -- "$words" said || { cat said; fail "$*: no '$words'"; }
}

# Rows and pairs have the bits of one process; more ranks than blocks leave some without work.
"$program" solve bunny -s random:70 --each --threads 1 -o one.npy >/dev/null
"$program" solve bunny -s random:40 --pairs --threads 1 -o one.csv >/dev/null
for count in 2 8; do
  ranks "$count" "$program" solve bunny -s random:70 --each --threads 1 -o rows.npy --json rows.json >/dev/null
  cmp one.npy rows.npy || fail "rows of $count ranks"
  grep -q "\"ranks\": $count" rows.json || fail "the report of $count ranks"
  rm rows.npy
done
ranks 2 "$program" solve bunny -s random:40 --pairs --threads 1 -o pairs.csv >/dev/null
cmp one.csv pairs.csv || fail "pairs of 2 ranks"

# Samples, too: each rank solves for one of those that are likely to come next.
"$program" sample bunny -n 40 --threads 1 -o one.csv --samples one_samples.csv >/dev/null
ranks 3 "$program" sample bunny -n 40 --threads 1 -o cells.csv --samples samples.csv --json samples.json >/dev/null
if ! cmp one.csv cells.csv || ! cmp one_samples.csv samples.csv; then fail "samples of 3 ranks"; fi
grep -q '"ranks": 3' samples.json || fail "the report of samples"
refused 2 'gone.ply: no such file; check the path' "$program" sample gone.ply -n 3

# One line of one rank, nothing left behind.
refused 2 'works in one process' "$program" info bunny
refused 2 'works in one process' "$program" solve bunny -s 0
refused 2 'standard output' "$program" solve bunny -s 0,1 --each -o -
refused 2 'gone.ply: no such file; check the path' "$program" solve gone.ply -s 0,1 --each -o rows.npy
# What one rank alone cannot do ends all: the model of others is whole, its disk is full, it has no MPI.
"$program" generate bunny -o bunny.ply >/dev/null
mkdir other && head -c 20000 bunny.ply >other/bunny.ply
cat >of_rank.sh <<'SH'
case $1 in
  truncated) [ "$OMPI_COMM_WORLD_RANK" = 1 ] && cd other && set -- x "../rows.npy" ;;
  full) [ "$OMPI_COMM_WORLD_RANK" = 1 ] && ulimit -f 800 ;;
  busy) [ "$OMPI_COMM_WORLD_RANK" = 1 ] && ulimit -f 800; set -- x rows.npy many.ply -s random:9000 --no-check ;;
  lone) [ "$OMPI_COMM_WORLD_RANK" = 1 ] && export GEOTHERM_MPI_MODULE=none ;;
esac
[ "$1" = x ] && out=$2 || out=rows.npy
[ $# -gt 2 ] && shift 2 || set -- bunny.ply -s random:40
exec "$PROGRAM" solve "$@" --each --threads 1 -o "$out"
SH
PROGRAM=$program refused 2 'bunny.ply' sh of_rank.sh truncated
PROGRAM=$program refused 2 'geotherm-mpi' sh of_rank.sh lone
# Messages in shared memory would be files that are too large, too.
OMPI_MCA_btl=self,tcp PROGRAM=$program refused 2 'cannot be written' sh of_rank.sh full
# Rows that took longer than two seconds, as on a machine with other work, are kept beside it.
[ ! -e rows.npy ] || fail "rows of one rank: $(ls)"
rm -f rows.npy.part*
"$program" generate bunny --faces 40000 -o many.ply >/dev/null
# While the first one works on for long, the other says it itself.
OMPI_MCA_btl=self,tcp PROGRAM=$program refused 2 'rank 1: .*cannot be written' sh of_rank.sh busy
[ ! -e rows.npy ] || fail "rows of one rank: $(ls)"
rm -f rows.npy.part*
# So is memory that ends on one rank alone. Below what MPI itself takes, which differs between machines, nobody
# of this program speaks.
cat >little.sh <<'SH'
[ "$OMPI_COMM_WORLD_RANK" = 1 ] && ulimit -v "$1"
shift
exec "$@"
SH
for kilobytes in $(seq 215000 5000 400000); do
  if timeout 60 mpirun --oversubscribe -q -n 2 sh little.sh "$kilobytes" "$program" solve many.ply -s 0 --backend petsc \
    --no-check --threads 1 -o rows.npy >out 2>said; then fail "memory enough with $kilobytes kB"; fi
  if grep -aq 'geotherm: error.*memory' said; then break; fi
done
[ "$(grep -ac 'geotherm: error.*memory' said)" = 1 ] || { cat said; fail "little memory: not one line"; }
[ -z "$(find . -name 'rows.npy*')" ] || fail "something of rows.npy was left: $(ls)"
# No rank takes another backend than the others.
refused 2 'native: needs about' "$program" solve bunny -s 0,1 --each --memory-limit 1 -o rows.npy
refused 2 'native: needs about' "$program" sample bunny -n 3 --memory-limit 1
# A signal to the ranks or to mpirun ends all. mpirun asks ranks to end after so many seconds, and kills them after
# as many more. Nothing is left of rows that took less than two seconds; finished ones of more are kept.
for signal in "pkill -TERM -P" "kill -INT"; do
  OMPI_MCA_odls_base_sigkill_timeout=3 mpirun --oversubscribe -q -n 2 "$program" solve many.ply -s random:20000 --each \
    --no-check --threads 1 -o rows.npy >/dev/null 2>&1 &
  launcher=$!
  for _ in $(seq 300); do [ -z "$(find . -name 'rows.npy.*')" ] || break; sleep 0.1; done
  [ -n "$(find . -name 'rows.npy.*')" ] || fail "no rows before the signal"
  $signal "$launcher"
  wait "$launcher" && fail "a signal was survived"
  for _ in $(seq 50); do [ -n "$(find . -name 'rows.npy*')" ] || break; sleep 0.1; done
  if [ -s rows.npy.part ] && tail -n 1 rows.npy.part.done | grep -q 1; then rm rows.npy.part rows.npy.part.done; fi
  [ -z "$(find . -name 'rows.npy*')" ] || fail "$signal: something was left: $(ls)"
done
# What ranks that were killed have left, which nobody can remove then, the next run removes.
mpirun --oversubscribe -q -n 2 "$program" solve many.ply -s random:9000 --each --no-check --threads 1 -o rows.npy >/dev/null 2>&1 &
launcher=$!
for _ in $(seq 300); do [ -z "$(find . -name 'rows.npy.*' -size +0)" ] || break; sleep 0.1; done
for process in $(pgrep -P "$launcher"); do kill -KILL "$process" || true; done
wait "$launcher" && fail "ranks were killed, and mpirun is content"
[ -n "$(find . -name 'rows.npy.*')" ] || fail "nothing was left to be removed"
ranks 2 "$program" solve many.ply -s random:20 --each --no-check --threads 1 -o rows.npy >/dev/null
[ "$(find . -name 'rows.npy*' | wc -l)" = 1 ] || fail "what was abandoned is there still: $(ls)"
rm rows.npy
# Rows that ranks have finished are not solved for again, by however many others: the launcher ends all when
# one is killed.
many=("$program" solve many.ply -s random:1600 --each --no-check --threads 1 --json kept.json)
"${many[@]}" -o whole.npy >/dev/null
mpirun --oversubscribe -q -n 2 "${many[@]}" -o rows.npy >/dev/null 2>&1 &
launcher=$!
for _ in $(seq 300); do [ ! -s rows.npy.part.done ] || break; sleep 0.1; done
pkill -STOP -P "$launcher"
sleep 2.5 # what takes less is not kept
pkill -CONT -P "$launcher"
for _ in $(seq 300); do ! tail -n 1 rows.npy.part.done | grep -q 1 || break; sleep 0.1; done
kill -KILL "$(pgrep -P "$launcher" | tail -n 1)"
wait "$launcher" && fail "a rank was killed, and mpirun is content"
tail -n 1 rows.npy.part.done | grep -q 1 || fail "nothing was kept: $(ls)"
ranks 3 "${many[@]}" -o rows.npy >/dev/null
cmp whole.npy rows.npy || fail "kept rows differ"
grep -q '"done_before": [1-9]' kept.json || fail "all rows were solved for again"
[ "$(find . -name 'rows.npy*' | wc -l)" = 1 ] || fail "something was left: $(ls)"
rm rows.npy whole.npy
# Without the library of MPI.
GEOTHERM_MPI_MODULE=none refused 2 'geotherm-mpi' "$program" solve bunny -s 0,1 --each -o rows.npy

# A data set over ranks: the files of one process; what is done is not done again.
mkdir set && for name in a b c d; do "$program" generate bunny --faces 600 -o set/$name.ply >/dev/null; done
echo broken >set/e.ply
"$program" batch 'set/?.ply' -s 0,5 --each --out-dir single >/dev/null 2>&1 && fail "a broken mesh passed"
refused 3 '1 of 5 models' "$program" batch 'set/?.ply' -s 0,5 --each --out-dir shared
for name in a b c d; do cmp single/$name.npy shared/$name.npy || fail "batch of 3 ranks: $name"; done
[ "$(wc -l <shared/manifest.jsonl)" = 5 ] || fail "the manifest: $(cat shared/manifest.jsonl)"
[ "$(grep -c '"status":"done"' shared/manifest.jsonl)" = 4 ] || fail "the manifest: $(cat shared/manifest.jsonl)"
rm set/e.ply
# A machine that does not see one of the files yet.
mkdir late && cp set/[abc].ply late
cat >late.sh <<'SH'
[ "$OMPI_COMM_WORLD_RANK" = 1 ] && cd late && mkdir -p set && mv ./*.ply set
exec "$PROGRAM" batch 'set/?.ply' -s 0,5 --each --out-dir "$1"
SH
PROGRAM=$program refused 2 'rank 1 sees other models.*3 models' sh late.sh "$PWD/shared"
ranks 2 "$program" batch 'set/?.ply' -s 0,5 --each --out-dir shared --json again.json >/dev/null
grep -q '"done_before": 4' again.json || fail "done twice: $(cat again.json)"
echo "ranks: all checked"
