#!/usr/bin/env bash
# Prints the battery of scans: what is to be reached on each, what is reached, and whether it is met.
#
#   scans.sh [--seeds 1,2,3,4,5] [--data FOLDER] [ROW...]
#
# ROW is a row, a cloud or a pattern of either; `--list` names them. The worst of the seeds counts; 20,000
# vertices, or a fifth of the points where that is less; no parameter touched. Clouds are made or come from
# Debian packages, but for those of the same names in FOLDER (NEURALMESH_SCANS): CLOUD.ply, CLOUD_reference.ply,
# CLOUD.npz with `view` and `eyes`. What is to be had from neither is "not here".
# What was measured with the same build is not measured again: a run that is broken off goes on where it was.
# NEURALMESH names a command to use in place of that of this tree. Exit status 1: a row misses its goal.
# An hour.
set -euo pipefail
data=${NEURALMESH_SCANS:+$(realpath "$NEURALMESH_SCANS")}
arguments=()
while [ $# -gt 0 ]; do
  case $1 in
    --data)
      data=$(realpath "$2")
      shift
      ;;
    --seeds)
      arguments+=(--seeds "$2")
      shift
      ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
command=${NEURALMESH:+$(realpath "$NEURALMESH")}
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libcgal-demo glmark2-data >&2
if [ -z "$command" ]; then
  build build neuralmesh >&2
  command=build/bin/neuralmesh
fi
PYTHONPATH=Testing/Support:Testing/Benchmarks/scans /usr/bin/python3 Testing/Benchmarks/scans/table.py \
  "$command" build/scans --data "$data" "${arguments[@]}"
