#!/usr/bin/env bash
# Tests with sanitizers, and with the assertions of ours and of the standard library.
#
#   Utilities/check_sanitizers.sh [address|thread] [--all] [CTEST-OPTION...]
#
# address: memory and undefined behaviour; the fast tests of the core, of the filters and of damaged
#   files, and short campaigns of fuzzing.
# thread: the tests of what has threads.
#
# With --all, which takes an hour: every test of these, nightly ones too; and all of the core's with the
# thread sanitizer.
set -euo pipefail
cd "$(dirname "$0")/.."
source Utilities/build.sh

kinds=(address thread)
case ${1:-} in
  address | thread) kinds=("$1"); shift ;;
esac
all=false
if [ "${1:-}" = --all ]; then
  all=true
  shift
fi
install_packages "${build_packages[@]}" libgtest-dev

# check PRESET TARGETS CTEST-OPTION...
check()
{
  local preset=$1 targets=$2
  shift 2
  configure_preset "$preset"
  # Some names.
  cmake --build --preset "$preset" --target $targets
  ctest --preset "$preset" -j "$(nproc)" --no-tests=error "$@"
}

check_address()
{
  local tests='^(Core|Filters|Fuzzing)\.|^Applications\.(BadFiles|PointReader|MeshReader)\.'
  local labels=fast
  if "$all"; then
    labels='fast|full|nightly'
  fi
  # The sanitizer keeps memory of its own, of which that test would learn nothing.
  check sanitize 'NeuralMeshCoreTests NeuralMeshCoreThreadTests NeuralMeshFilterTests
    NeuralMeshApplicationTests NeuralMeshFuzzEngineShortly NeuralMeshFuzzReadersShortly' \
    -R "$tests" -L "$labels" -E '^Filters\.TestNeuralMeshManyRuns$' "$@"
}

check_thread()
{
  if "$all"; then
    # A million operations on one thread take too long for nothing.
    check sanitize-threads 'NeuralMeshCoreTests NeuralMeshCoreThreadTests NeuralMeshFilterTests' \
      -R '^(Core|Filters)\.' -E '^Core\.AnyOperation\.|^Filters\.TestNeuralMeshManyRuns$' "$@"
  else
    check sanitize-threads 'NeuralMeshCoreThreadTests NeuralMeshFilterTests' \
      -R '^(Core|Filters)\.' -L threads "$@"
  fi
}

for kind in "${kinds[@]}"; do
  "check_$kind" "$@"
  echo "$kind sanitizer: all well"
done
