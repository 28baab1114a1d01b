#!/usr/bin/env bash
# Prints how many bytes of a cloud move between processes, for clouds of 1, 4 and 16 million points on
# 2 and 4 of them: moved_bytes.sh [MILLIONS...]. About five minutes and 4 GB.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" openmpi-bin
build build all
[ "$#" -gt 0 ] || set -- 1 4 16
export NEURALMESH_PLUGIN_CONFIG="$PWD/build/lib/neuralmesh/neuralmesh.plugins.xml"
export PYTHONPATH="$PWD/build/lib/python3/dist-packages:Testing/ParaView"
echo "million points | processes | points wanted | bytes moved | of them per point of the cloud"
for millions in "$@"; do
  for processes in 2 4; do
    mpirun --allow-run-as-root --oversubscribe -np "$processes" \
      pvbatch --sym Testing/Benchmarks/moved_bytes.py "$millions"
  done
done
