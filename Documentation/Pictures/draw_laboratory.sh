#!/usr/bin/env bash
# Does all experiments of the laboratory, in laboratory/, and draws the pictures of the documentation
# again; laboratory/verdicts.md has the verdicts. Options go to the laboratory. Half an hour on two cores;
# what was done before is not done again: to measure again, remove laboratory/runs.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" "${laboratory_packages[@]}"
build build all
PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 -m neuralmesh.lab all \
  --output laboratory "$@"
for name in smoothing-rate smoothing-rate-meshes sparse-meshes cost models jumps; do
  cp "laboratory/$name.png" "Documentation/Pictures/laboratory_${name//-/_}.png"
done
