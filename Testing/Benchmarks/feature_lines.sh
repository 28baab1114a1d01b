#!/usr/bin/env bash
# Prints how much of the sharp edges of known shapes the feature lines find, and how many lines are none: the
# table of Documentation/Research/Measurements.md.
#
#   feature_lines.sh [--vertices N] [--points N] [ROW...]
#
# NEURALMESH_SCANS may name a folder with references of further shapes, as NAME_reference.ply.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" glmark2-data libcgal-demo
build build neuralmesh
PYTHONPATH=Testing/Support /usr/bin/python3 Testing/Benchmarks/feature_lines.py build/bin/neuralmesh "$@"
