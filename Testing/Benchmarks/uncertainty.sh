#!/usr/bin/env bash
# Prints how often the truth lies within the error bars of the vertices, on clouds whose surface is known: the
# tables of Documentation/Research/Measurements.md.
#
#   uncertainty.sh [--seeds 1,2,3] [--vertices N] [--set NAME=VALUE] [--picture FILE] [ROW...]
#
# ROW is a pattern of rows. NEURALMESH_SCANS may name a folder with scans as NAME.ply, NAME.npz with `view` and
# `eyes`, and references; else they are made. --picture draws the reliability curves. NEURALMESH names a command to use in place of that of this tree.
# Some minutes for all. Exit status 1: a row misses its goal.
set -euo pipefail
options=()
while [ $# -gt 0 ]; do
  if [ "$1" = --picture ]; then
    options+=("$1" "$(realpath "$2")") && shift 2
  else
    options+=("$1") && shift
  fi
done
command=${NEURALMESH:+$(realpath "$NEURALMESH")}
export NEURALMESH_SCANS=${NEURALMESH_SCANS:+$(realpath "$NEURALMESH_SCANS")}
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" glmark2-data libcgal-demo python3-matplotlib >&2
if [ -z "$command" ]; then
  build build neuralmesh >&2
  command=build/bin/neuralmesh
fi
PYTHONPATH=Testing/Support:Testing/Benchmarks/scans PYTHONDONTWRITEBYTECODE=1 \
  /usr/bin/python3 Testing/Benchmarks/uncertainty.py "$command" "${options[@]}"
