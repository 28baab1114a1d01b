#!/usr/bin/env bash
# Does all experiments of the laboratory, in laboratory/, and writes the verdicts and the pictures of
# the documentation anew. Options go to the laboratory. Half an hour on two cores; what was done before
# is not done again: to measure anew, remove laboratory/runs.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" "${laboratory_packages[@]}"
build build all
PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 -m neuralmesh.lab all \
  --output laboratory --markdown Documentation/LaboratoryVerdicts.md "$@"
for name in smoothing-rate smoothing-rate-meshes sparse-meshes cost models jumps; do
  cp "laboratory/$name.png" "Documentation/Pictures/laboratory_${name//-/_}.png"
done
