#!/usr/bin/env bash
# Compares the results of two builds to the byte: same_bytes.sh BEFORE AFTER CLOUD...
#
# BEFORE and AFTER are build folders. From each cloud each build makes meshes with three seeds in every
# way: all methods, ensemble, topology learning, activity list, closed boundaries, all thesis values,
# feature strength, in place, with a checkpoint half way, and streamed; as .ply and as .vtp. A mesh of
# one build is compared to that of the other. For ten clouds some twenty minutes on two cores. The
# exit status is 1 if a byte differs.
#
#   VERTICES=N   vertices of a mesh, 4000 if it is not set
#   SEEDS="..."  1 2 3 if it is not set
set -euo pipefail
[ $# -ge 3 ] || { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }
before=$(realpath "$1") after=$(realpath "$2")
shift 2
vertices=${VERTICES:-4000}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

ways=(
  "noise.ply"
  "noise.vtp"
  "basic.ply --method basic"
  "normal.ply --method normal"
  "features.vtp --features"
  "ensemble.ply --ensemble 5"
  "topology.ply --topology on"
  "list.ply --order list"
  "jump.ply --order list --jump weighted"
  "close.ply --boundaries close"
  "thesis.ply --preset thesis --topology on"
  "in-place.ply --in-place --set MaximumPoints=50000"
)

# make BUILD FOLDER CLOUD SEED: all meshes of a build.
make_meshes()
{
  local build=$1 out=$2 cloud=$3 seed=$4 way
  local -x LD_LIBRARY_PATH=$build/lib
  local -x PYTHONPATH=$build/lib/python3/dist-packages
  local run=("$build/bin/neuralmesh" reconstruct "$cloud")
  local options=(--quiet --vertices "$vertices" --seed "$seed")
  mkdir -p "$out"
  for way in "${ways[@]}"; do
    # shellcheck disable=SC2086  # words
    "${run[@]}" "$out/"${way%% *} "${options[@]}" $(case $way in *\ *) echo "${way#* }" ;; esac) \
      2> "$out/errors.txt" || { cat "$out/errors.txt" >&2; return 1; }
  done
  # The first command ends half way, the second one goes on.
  local state=(--checkpoint "$out/state")
  "${run[@]}" "$out/checkpoint.ply" "${options[@]}" "${state[@]}" --time-limit 0.15 2> /dev/null
  "${run[@]}" "$out/checkpoint.ply" "${options[@]}" "${state[@]}" 2> /dev/null
  rm -f "$out/state" "$out/errors.txt"
  /usr/bin/python3 - "$cloud" "$out/stream.ply" "$vertices" "$seed" <<'STREAM'
import sys

import neuralmesh
from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter

cloud, output, vertices, seed = sys.argv[1:]
reader = vtkPLYReader()
reader.SetFileName(cloud)
reader.Update()
points = WrapDataObject(reader.GetOutput()).Points
stream = neuralmesh.stream(vertices=int(vertices), seed=int(seed))
for part in (points[::2], points[1::2]):
    stream.add_points(part)
    stream.learn(100000)
stream.learn()
writer = vtkPLYWriter()
writer.SetFileName(output)
writer.SetInputData(stream.mesh())
writer.Write()
STREAM
}

differences=0 compared=0
for cloud in "$@"; do
  for seed in ${SEEDS:-1 2 3}; do
    make_meshes "$before" "$folder/before" "$cloud" "$seed" &
    make_meshes "$after" "$folder/after" "$cloud" "$seed"
    wait $!
    # Both have made all of them, or the script has ended.
    for mesh in "$folder"/before/*; do
      compared=$((compared + 1))
      if ! cmp -s "$mesh" "$folder/after/$(basename "$mesh")"; then
        echo "$(basename "$cloud"), seed $seed: $(basename "$mesh") differs"
        differences=$((differences + 1))
      fi
    done
    rm -r "$folder/before" "$folder/after"
  done
done
echo "$compared meshes compared, $differences differ"
[ "$differences" -eq 0 ]
