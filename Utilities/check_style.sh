#!/usr/bin/env bash
# Whether all C++ is formatted as .clang-format says, and clang-tidy finds nothing in the core, the
# filters and the command.
set -euo pipefail
cd "$(dirname "$0")/.."
source Utilities/build.sh

install_packages "${build_packages[@]}" clang-format clang-tidy
git ls-files '*.h' '*.cpp' '*.cxx' | xargs clang-format --dry-run --Werror
echo "clang-format: all well"

build build FiltersNeuralMesh -DNEURALMESH_WARNINGS_AS_ERRORS=ON
git ls-files 'Filters/*.cpp' 'Filters/*.cxx' 'Applications/*.cxx' |
  xargs -P "$(nproc)" -n 4 clang-tidy -p build --quiet --warnings-as-errors='*' 2>/dev/null
echo "clang-tidy: all well"
