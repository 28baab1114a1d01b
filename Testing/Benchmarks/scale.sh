#!/usr/bin/env bash
# Prints what large meshes cost, from 20,000 to a million vertices, and what two threads gain:
# the tables of Documentation/Guide/Large.md. About ten minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libbenchmark-dev
build build-benchmark all -DNEURALMESH_BUILD_BENCHMARKS=ON -DNEURALMESH_BUILD_APPLICATIONS=OFF
build-benchmark/bin/NeuralMeshScaleTable
echo
build-benchmark/bin/NeuralMeshThreadTable
