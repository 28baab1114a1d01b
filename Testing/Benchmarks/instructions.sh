#!/usr/bin/env bash
# Counts the instructions that the learning loop takes a sample, growth and all, on the way from a
# tetrahedron to 10,000 vertices, by callgrind.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libbenchmark-dev valgrind
build build-benchmark NeuralMeshGrowthRun -DNEURALMESH_BUILD_BENCHMARKS=ON \
  -DNEURALMESH_BUILD_APPLICATIONS=OFF > /dev/null
log=$(mktemp)
trap 'rm -f "$log"' EXIT
samples=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null \
  --toggle-collect='neuralmesh::Learner::learn(*' \
  build-benchmark/bin/NeuralMeshGrowthRun 10000 2> "$log")
instructions=$(sed -n 's/.*Collected : //p' "$log")
((instructions > 0)) || { echo "$0: callgrind has not seen the loop" >&2; exit 1; }
echo "$((instructions / samples)) instructions a sample ($instructions / $samples)"
