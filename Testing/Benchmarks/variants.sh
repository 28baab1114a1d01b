#!/usr/bin/env bash
# Prints what each variant, jump, operation and stopping rule costs, and what comes out. A minute.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libcgal-demo
build build neuralmesh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
PYTHONPATH=Testing/Support /usr/bin/python3 Testing/Benchmarks/variants.py build/bin/neuralmesh "$folder"
