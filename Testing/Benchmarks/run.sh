#!/usr/bin/env bash
# Prints the tables of the README and of Documentation/Guide/Large.md, and the benchmarks of the parts
# of the loop. About three minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libbenchmark-dev
build build-benchmark all -DNEURALMESH_BUILD_BENCHMARKS=ON -DNEURALMESH_BUILD_APPLICATIONS=OFF
build-benchmark/bin/NeuralMeshGrowthTable
echo
build-benchmark/bin/NeuralMeshCheckpointTable
echo
build-benchmark/bin/NeuralMeshBenchmarks
