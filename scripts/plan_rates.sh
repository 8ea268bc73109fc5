#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# plan_rates.sh [PROGRAM]: measures what `geotherm plan` counts with for one mesh over ranks, in seconds of one
# processor for a vertex: the constants of app/cli/cmd_plan.cpp. For a machine that has nothing else to do. Needs
# the library of MPI and PETSc (scripts/setup.sh --mpi); takes some minutes and 1 GB of memory.
set -euo pipefail
program=$(realpath "${1:-$(dirname "$0")/../build/release/geotherm}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# The words of a launcher make one process the only rank.
export PMI_RANK=0 PMI_SIZE=1 OMP_NUM_THREADS=1
# measure NAME FACES OPTIONS...: the report of each of three runs.
measure() {
  local name=$1 faces=$2; shift 2
  [ -f "$faces.ply" ] || env -u PMI_RANK -u PMI_SIZE "$program" generate terrain --faces "$faces" -o "$faces.ply" >/dev/null
  for run in 1 2 3; do
    "$program" solve "$faces.ply" -s 0 --backend petsc --threads 1 --no-check "$@" -o d.npy --json "$name.$run" >/dev/null
  done
}
measure block 280000   # one block, which solves once
measure heat 1100000
measure waves 1100000 --method wavefront
/usr/bin/python3 - <<'PYTHON'
import json
AMG = 9.6  # BoomerAMG's set-up, in iterations

def least(name, *stages):
    """The least seconds a vertex of the three runs, and the last of them."""
    runs = [json.load(open(f"{name}.{run}")) for run in (1, 2, 3)]
    seconds = min(sum(run["timing_ms"][stage] for stage in stages) for run in runs) / 1000
    return seconds / runs[-1]["model"]["vertices"], runs[-1]

block, report = least("block", "diffuse")
assert report["shared"]["blocks"] == 1, "more than one block"
sharing, _ = least("heat", "load", "share")
blocks, _ = least("heat", "setup", "gradient")
poisson, report = least("heat", "poisson")
iteration = poisson / (AMG + report["quality"]["iterations_poisson"])
cutting, _ = least("waves", "setup")
waves, report = least("waves", "query")
print(f"kSharing = {sharing:.2g}, kBlocks = {blocks:.2g}, kBlockSolve = {block:.2g},")
print(f"kAmg = {AMG * iteration:.2g}, kIteration = {iteration:.2g},")
print(f"kCutting = {cutting:.2g}, kWaves = {waves:.2g}")
PYTHON
