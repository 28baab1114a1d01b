#!/usr/bin/env bash
# Prints how good the meshes are that come out with no parameter touched, seeds 1 to 5:
#
#   quality.sh [NAME=VALUE...] [CLOUD,REFERENCE[,close]...]
#
# or with these properties set; without clouds, of some that it draws from models of Debian packages.
# Some minutes.
set -euo pipefail
runs=()
for run in "$@"; do
  if [[ $run == *=* ]]; then
    runs+=("$run")
    continue
  fi
  IFS=, read -r cloud reference boundaries <<< "$run"
  runs+=("$(realpath "$cloud"),$(realpath "$reference"),${boundaries:-keep}")
done
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libcgal-demo
build build neuralmesh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
PYTHONPATH=Testing/Support /usr/bin/python3 Testing/Benchmarks/quality.py \
  build/bin/neuralmesh "$folder" "${runs[@]}"
