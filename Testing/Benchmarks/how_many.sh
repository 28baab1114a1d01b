#!/usr/bin/env bash
# Prints how numbers of vertices that are found compare with what a search finds: the tables of
# Documentation/Research/Measurements.md.
#
#   how_many.sh [--seed N] [--tolerances PERCENT,...] [--measure rms|99|largest] [--no-ladder] [--no-search]
#               CLOUD[,REFERENCE]...
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}"
build build all
PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Benchmarks/how_many.py "$@"
