#!/usr/bin/env bash
# With assertions and the address and undefined-behaviour sanitizers: the tests of the core, of the
# filters and of damaged files, and short campaigns of fuzzing. With the thread sanitizer: the tests
# of the core.
#
#   Utilities/check_sanitizers.sh [address|thread] [CTEST-OPTION...]
set -euo pipefail
cd "$(dirname "$0")/.."
source Utilities/build.sh

kinds=(address thread)
case ${1:-} in
  address | thread) kinds=("$1"); shift ;;
esac
install_packages "${build_packages[@]}" libgtest-dev

# Of a sanitizer's own memory there is nothing to learn, nor of a million steps on one thread by that
# of threads.
left_out='^Filters\.TestNeuralMeshManyRuns$'

# check PRESET TARGETS TESTS [CTEST-OPTION...]
check()
{
  local preset=$1 targets=$2 tests=$3
  shift 3
  configure_preset "$preset"
  # Some names.
  cmake --build --preset "$preset" --target $targets
  ctest --preset "$preset" -R "$tests" -E "$left_out" -j "$(nproc)" --timeout 600 --no-tests=error \
    "$@"
}

for kind in "${kinds[@]}"; do
  if [ "$kind" = address ]; then
    check sanitize 'NeuralMeshCoreTests NeuralMeshFilterTests NeuralMeshApplicationTests
      NeuralMeshFuzzEngineShortly NeuralMeshFuzzReadersShortly' \
      '^(Core|Filters|Fuzzing)\.|^Applications\.(BadFiles|PointReader|MeshReader)\.' "$@"
  else
    left_out='^Core\.AnyOperation\.'
    check sanitize-threads NeuralMeshCoreTests '^Core\.' "$@"
  fi
  echo "$kind sanitizer: all well"
done
