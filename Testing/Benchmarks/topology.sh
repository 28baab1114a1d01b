#!/usr/bin/env bash
# Prints how far each way to learn topology gets, on clouds that it makes and on those given. A few
# minutes.
set -euo pipefail
clouds=()
for cloud in "$@"; do
  clouds+=("$(realpath "$cloud")")
done
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libcgal-demo
build build neuralmesh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
PYTHONPATH=Testing/Support /usr/bin/python3 Testing/Benchmarks/topology.py build/bin/neuralmesh "$folder" "${clouds[@]}"
