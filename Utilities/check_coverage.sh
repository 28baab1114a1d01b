#!/usr/bin/env bash
# How many lines of the engine its own tests run through: prints each file and the sum, and fails if
# that is below the limit.
#
#   Utilities/check_coverage.sh [PERCENT]     the limit is 90 if none is given
set -euo pipefail
cd "$(dirname "$0")/.."
source Utilities/build.sh

limit=${1:-90}
install_packages "${build_packages[@]}" libgtest-dev gcovr
configure_preset coverage
cmake --build --preset coverage --target NeuralMeshCoreTests NeuralMeshCoreMemoryTests \
  NeuralMeshCoreThreadTests
find build-coverage -name '*.gcda' -delete
ctest --preset coverage -R '^Core\.' -j "$(nproc)" --no-tests=error --quiet
gcovr --root . --filter Filters/Core/ --exclude-throw-branches --print-summary \
  --fail-under-line "$limit" build-coverage
