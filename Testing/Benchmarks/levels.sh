#!/usr/bin/env bash
# Prints how levels of detail compare with runs of their own: the table of Documentation/Research/Measurements.md.
#
#   levels.sh [--seeds N] [--levels N1,N2,...] CLOUD,REFERENCE...
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}"
build build neuralmesh
/usr/bin/python3 Testing/Benchmarks/levels.py build/bin/neuralmesh "$@"
