#!/usr/bin/env bash
# Prints how far the volume tells the outer side of open shapes: the table of Documentation/Research/Measurements.md.
#
#   orientation.sh [--vertices N] [--seeds N] [CLOUD...]
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}"
build build neuralmesh
/usr/bin/python3 Testing/Benchmarks/orientation.py build/bin/neuralmesh "$@"
