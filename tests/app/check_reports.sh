#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_reports.sh PROGRAM SCHEMA: runs each command that writes a report, and holds what it wrote
# against the schema, in which every key must be. Exits 77 where python3-jsonschema is not installed.
set -euo pipefail
program=$(realpath "$1") schema=$(realpath "$2")
/usr/bin/python3 -c 'import jsonschema' 2>/dev/null || {
  echo "SKIPPED: python3-jsonschema is not installed; scripts/setup.sh --dev installs it"
  exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

report() { "$program" "${@:2}" --json "$1.json" >/dev/null 2>said || { cat said; exit 1; }; }
"$program" generate ball-tets --tets 3000 -o ball.mesh >/dev/null
"$program" generate bunny --frames 3 -o waving.npy >/dev/null
/usr/bin/python3 - <<'PYTHON'
import struct
def grid(name, shape, samples):
    head = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}"
    head += ' ' * (117 - len(head)) + '\n'
    with open(name, 'wb') as file:
        file.write(b'\x93NUMPY\x01\x00' + struct.pack('<H', len(head)) + head.encode())
        file.write(struct.pack(f'<{len(samples)}d', *samples))
grid('maze.npy', (5, 6), [0 if 8 < i < 11 else 1 for i in range(30)])
grid('block.npy', (4, 5, 6), [1 + i % 2 for i in range(120)])
PYTHON
printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n5 5 5\n3 0 1 2\n3 0 1 1\n' >poor.ply

report solve solve bunny -s 17
report waves solve bunny -s 17 -s 99@0.5 --method wavefront --labels -o d.csv
report better solve bunny -s 3,9 -m 40 --on-poor better
report border solve terrain -s boundary --boundary dirichlet --backend cg
report point solve bunny -s face:3:0.2:0.3:0.5 --no-check --time-step absolute:0.01
report curve solve bunny -s curve:0,9 -s 5
report across solve bunny -s curve:face:3:0.2:0.3:0.5,face:40:0.2:0.3:0.5 -s 5 --method wavefront --labels -o d.csv
report tets solve ball.mesh -s xyz:0:0:0
report polygons solve bunny -s 0 --domain polygons
report grid solve maze.npy -s 0
report block solve block.npy -s xyz:1.5:1.5:1.5
report grid_isolines isolines maze.npy -s 0 --count 3 -o lines.csv
report poor solve poor.ply -s 0
report each solve bunny -s random:5 --each -o rows.npy
report near solve bunny -s 17 --method wavefront --max-distance 0.3 --target 5,900
report sparse solve bunny -s random:5 --each --method wavefront --max-distance 0.3 -o rows.npz
report pairs solve bunny -s 3,9,40 --pairs -o pairs.csv
report sequence solve bunny -s 0 --sequence waving.npy -o frames.npy
report info info bunny
report info_tets info ball.mesh
report info_poor info poor.ply
report info_polygons info bunny --domain polygons
report info_grid info maze.npy
report info_block info block.npy
report compare compare bunny
report study study bunny -s 0
report path path bunny --from 0 --to 99
report tree path bunny --from face:3:0.2:0.3:0.5 --to 99 --to 300
report tree_of_vertices path bunny --from 0 --to 1,2,440
report stops path bunny --from 0 --via 300 --via face:3:0.2:0.3:0.5 --to 99 --to 440
report streamline path bunny --from 0 --to 99 --field distance
report isolines isolines bunny -s 0 --count 5 -o lines.csv
report log_map logmap bunny -s 17
report trace trace bunny --from 17 --fan 3 --length 1
report centre centre bunny --of 17,900,1500 --weights 1,2,3
report relaxed sample bunny -n 5 --relax 3 --no-check
report transport transport bunny --vector 17:1:0
report extend extend bunny --value 17:1 --value 99:2
report signed signed bunny --through 17 --through 900 --through 1500 --closed
report sample sample bunny -n 5 -o samples.ply
report backends backends
report models models
report batch batch bunny -s 0,3 --each --out-dir batch
report plan plan --vertices 1e6 --sources 100 --ranks 8
report plan_shared plan --vertices 1e9 --ranks 256
# One mesh over ranks, where there is a launcher.
if command -v mpirun >/dev/null && "$program" backends | grep -q petsc; then
  "$program" generate bunny -o bunny.ply >/dev/null
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -q -n 2 \
    "$program" solve bunny.ply -s 0 --backend petsc --threads 1 --json shared.json >/dev/null
fi
if "$program" devices >/dev/null 2>&1; then
  report devices devices
  report render render bunny -s 0 --path 99 --size 160x120 -o a.png
  report flat render bunny --view flat --size 160x120 -o b.png
  report page render bunny -s 0 -o page.html
  report several render bunny cube -s 0 --size 160x120 -o several.png
  report several_points render bunny ball.mesh -s xyz:0:0:0 --size 160x120 -o several.png
  report several_waves render bunny cube -s 0 --method wavefront --size 160x120 -o several.png
  report several_exact render bunny bunny -s 0 --method exact --size 160x120 -o several.png
  report several_kinds render maze.npy ball.mesh -s 0,5 --size 160x120 -o several.png
  report moving render bunny -s 0 --sequence waving.npy --size 160x120 -o 'f_%03d.png'
fi

/usr/bin/python3 - "$schema" ./*.json <<'PYTHON'
import json, sys
import jsonschema

def strict(schema):
    """The schema with every key in it and no other."""
    if isinstance(schema, dict):
        schema = {key: strict(value) for key, value in schema.items()}
        if "properties" in schema:
            schema["additionalProperties"] = False
    return schema

schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(strict(schema))
wrong = 0
for path in sys.argv[2:]:
    for error in validator.iter_errors(json.load(open(path))):
        wrong += 1
        print(f"{path}: {'/'.join(map(str, error.absolute_path))}: {error.message[:200]}")
print(f"{len(sys.argv) - 2} reports, {wrong} errors")
sys.exit(wrong > 0)
PYTHON
