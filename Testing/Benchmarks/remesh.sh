#!/usr/bin/env bash
# Prints surfaces that we remesh to 50, 10 and 1 % of their triangles beside those of VTK, pyacvd, fast-simplification
# and PyMeshLab: the tables of Documentation/Research/Measurements.md.
#
#   remesh.sh [MODEL.ply...]
#
# Without models they are two of the Debian package libcgal-demo. The last table is that of an isosurface, which is
# made. What is on PyPI goes into a virtual environment, build/remeshers, by PYTHON (python3); where it cannot be
# installed, VTK is all there is beside us. NEURALMESH names a command to use in place of that of this tree.
set -euo pipefail
command=${NEURALMESH:+$(realpath "$NEURALMESH")}
models=()
for model in "$@"; do
  models+=("$(realpath "$model")")
done
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" python3-venv python3-numpy libcgal-demo >&2
if [ -z "$command" ]; then
  build build neuralmesh >&2
  command=build/bin/neuralmesh
fi
tools=$PWD/build/remeshers packages=(pyacvd==0.4.0 fast-simplification==0.2.0 pymeshlab==2025.7)
mkdir -p "$tools"
python=$tools/venv/bin/python
if [ "$(cat "$tools/packages" 2> /dev/null)" != "${packages[*]}" ]; then
  if "${PYTHON:-python3}" -m venv "$tools/venv" && "$python" -m pip install -q "${packages[@]}" >&2; then
    echo "${packages[*]}" > "$tools/packages"
  else
    echo "what is on PyPI cannot be installed" >&2
    python=
  fi
fi
PYTHONPATH=Testing/Support PYTHONDONTWRITEBYTECODE=1 \
  /usr/bin/python3 Testing/Benchmarks/remesh.py "$command" "$python" "$tools/work" ${models[@]+"${models[@]}"}
