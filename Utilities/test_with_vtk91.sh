#!/usr/bin/env bash
# Runs the tests, those whose label matches NEURALMESH_TEST_LABELS, against Debian's plain VTK 9.1. It
# cannot be installed beside ParaView's: in a Debian 12 of its own, made by debootstrap.
# Root, about 3 GB and, the first time, some minutes.
#
#   Utilities/test_with_vtk91.sh [FOLDER] [CTEST-OPTION...]
#
# FOLDER holds that Debian (default: build-vtk91); the next run uses it again and builds what has
# changed. The archive is the one that apt uses here, or MIRROR.
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
source "$repository/Utilities/build.sh"
source "$repository/Utilities/debian.sh"
in_own_namespace "$0" "$@"

if [[ "${1:-}" =~ ^(-|$) ]]; then
  debian=$repository/build-vtk91
else
  debian=$(realpath -m "$1")
  shift
fi
cd "$repository"
[ -d "$debian" ] || make_debian "$debian"
enter_debian "$debian"
copy_sources "$debian"
in_debian "$debian" bash /neuralmesh/test.sh "$@"
