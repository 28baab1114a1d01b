#!/usr/bin/env bash
# Prints what large meshes cost, from 20,000 to a million vertices, what two threads gain, and what sixteen
# would: the tables of Documentation/Guide/Large.md. About ten minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libbenchmark-dev
build build-benchmark all -DNEURALMESH_BUILD_BENCHMARKS=ON -DNEURALMESH_BUILD_APPLICATIONS=OFF
build-benchmark/bin/NeuralMeshScaleTable
echo
build-benchmark/bin/NeuralMeshThreadTable
echo
build-benchmark/bin/NeuralMeshCriticalPathTable
