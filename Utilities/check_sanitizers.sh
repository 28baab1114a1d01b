#!/usr/bin/env bash
# Tests with sanitizers, and with the assertions of ours and of the standard library.
#
#   Utilities/check_sanitizers.sh [address|thread] [--all] [CTEST-OPTION...]
#
# address: memory and undefined behaviour; the fast and the sanitized tests of the filters and of what in
#   the core stands hostile data or any operation, and a short campaign of fuzzing. What both sanitizers
#   find, and accesses that are not aligned, are left to the first one and to --all.
# thread: those of what has threads.
#
# With --all, which takes an hour: address has every test of the core and the filters, of damaged files
# and of fuzzing, and thread every test of the core and the filters.
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

# A sanitizer has memory of its own, of which these tests would learn nothing; and a million operations on
# one thread take long for nothing with that of threads.
memory='^Filters\.TestNeuralMeshManyRuns$|^Core\.FitMemory\.A(LargeFit|SearchForGaps)TakesLittle$'
memory+='|^Core\.TouchedVector\.Takes'
million='^Core\.AnyOperation\.Million'
# What chooses parameters only calls what others test here; and how good a mesh comes out is no matter of memory or
# threads: the longest tests of that are left to --all.
choice='Tuning|Automatic'
quality='\.(CreaseRefinement\.MoreVertices|Fidelity\.(SharpensACube|MoreVertices|AveragesNoise)|ScatteredPoints\.'
quality+='|SmallMeshes\.KeepA|Levels\.OfThin|Levels\.AreAsGood|Warnings\.LostRod'
quality+='|SizedReconstruction\.ThinParts|FirstSurface\.HollowBodies'
quality+='|Uncertainty\.(Grows|IsThere|Knows|Holds|Leaves|IsLargest|Chance))'
# These tests, of the programs for threads, have one thread.
alone='\.(RandomRuns\.(Vary|Streams|Ensembles)|EnsembleRun\.(CanBeEnded|PlanesAre|TimeLimit)'
alone+='|ParallelLearner\.(IsAsGood|Subdivides|Sheets|GoesOn|StaysValid|Weights|Outliers|Wanders|WinnersFace)'
alone+='|Uncertainty\.(CanBeEnded|SaysWhere))'
programs='NeuralMeshCoreMemoryTests NeuralMeshCoreThreadTests NeuralMeshFilterTests
  NeuralMeshFilterThreadTests NeuralMeshFuzzEngineShortly'

check_address()
{
  if "$all"; then
    check sanitize-all "$programs NeuralMeshCoreTests NeuralMeshApplicationTests
      NeuralMeshFuzzReadersShortly" \
      -R '^(Core|Filters|Fuzzing)\.|^Applications\.(BadFiles|PointReader|MeshReader)\.' \
      -E "$memory" "$@"
  else
    NEURALMESH_RANDOM_RUNS=15 \
      check sanitize "$programs" -R '^(Core|Filters|Fuzzing.Engine)' -L 'fast|sanitized' \
      -E "$choice|$quality|$memory" "$@"
  fi
}

check_thread()
{
  if "$all"; then
    check sanitize-threads 'NeuralMeshCoreTests NeuralMeshCoreMemoryTests NeuralMeshCoreThreadTests
      NeuralMeshFilterTests NeuralMeshFilterThreadTests' -R '^(Core|Filters)\.' -E "$memory|$million" "$@"
  else
    # This sanitizer takes twenty times as long.
    NEURALMESH_RANDOM_RUNS=8 \
      check sanitize-threads 'NeuralMeshCoreThreadTests NeuralMeshFilterThreadTests' \
      -R '^(Core|Filters)\.' -L '(fast|sanitized)-threads' -E "$choice|$quality|$memory|$alone" "$@"
  fi
}

for kind in "${kinds[@]}"; do
  "check_$kind" "$@"
  echo "$kind sanitizer: all well"
done
