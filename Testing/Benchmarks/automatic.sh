#!/usr/bin/env bash
# Prints what Automatic chooses for clouds, and the errors with it and without: the table of
# Documentation/Research/Measurements.md.
#
#   automatic.sh [--seeds N] CLOUD,REFERENCE[,close]...
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}"
build build neuralmesh
/usr/bin/python3 Testing/Benchmarks/automatic.py build/bin/neuralmesh "$@"
