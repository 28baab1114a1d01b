#!/usr/bin/env bash
# Whether the version agrees wherever it stands, and whether Utilities/release.sh notices where it
# does not: check_version.sh ROOT BUILD
set -euo pipefail
root=$1 build=$2
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT

bash "$root/Utilities/release.sh" --check "$build"

# disagrees FILE PATTERN REPLACEMENT PLACE [BUILD]: another version in a copy of a file is found out,
# in that place.
disagrees()
{
  rm -rf "${copy:?}"/*
  mkdir -p "$copy/Utilities" "$copy/Documentation/Guide"
  cp "$root"/{CMakeLists.txt,CHANGELOG.md} "$copy"
  cp "$root/Documentation/Guide/Start.md" "$copy/Documentation/Guide"
  cp "$root/Utilities/release.sh" "$copy/Utilities"
  sed -i "s/$2/$3/" "$copy/$1"
  ! bash "$copy/Utilities/release.sh" --check "${@:5}" > "$copy/out" 2>&1 ||
    { cat "$copy/out"; echo "FAILED: another version in $1 is not noticed"; exit 1; }
  grep -A 1 "^$4 " "$copy/out" | grep -q "  is not " ||
    { cat "$copy/out"; echo "FAILED: it is not said where: $4"; exit 1; }
}

disagrees CHANGELOG.md '^## \[[0-9.]*\] - ' '## [99.0.0] - ' CHANGELOG.md
disagrees CHANGELOG.md '^## \[[0-9.]*\] - .*' '## [99.0.0]' CHANGELOG.md
disagrees Documentation/Guide/Start.md '^find_package(NeuralMesh [0-9.]*' 'find_package(NeuralMesh 99.0' \
  Documentation/Guide/Start.md,
disagrees CMakeLists.txt 'NeuralMesh VERSION [0-9.]*' 'NeuralMesh VERSION 99.0.0' "the command" "$build"
