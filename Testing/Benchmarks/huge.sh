#!/usr/bin/env bash
# Prints what it takes to make a mesh from a file of 200 million points (or so many million as are
# given) that is sampled in place, and from one of 1 % of that. 2.5 GB of disk and some minutes.
set -euo pipefail
millions=${1:-200}
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libcgal-demo
build build all
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
PYTHONPATH=Testing/Support:build/lib/python3/dist-packages /usr/bin/python3 \
  Testing/Benchmarks/huge.py build/bin/neuralmesh "$folder" "$millions"
