#!/usr/bin/env bash
# Runs what the gate (.ci/run) leaves out as it takes hours, and prints a table of what came of it.
#
#   Utilities/nightly.sh [STEP...]      all steps if none is named; --list names them
#
# Root, for the Debians of their own that packages and tests need; 30 GB. Each step writes
# nightly/STEP.log, the table goes to nightly/table.txt. The exit status is 1 if a step failed; the
# others run all the same.
set -euo pipefail
cd "$(dirname "$0")/.."
source Utilities/build.sh
export CI=true LC_ALL=C.UTF-8

# For fuzzing: seconds for each target.
fuzzing_seconds=${NEURALMESH_FUZZING_SECONDS:-600}
# For all parameters at once: runs, and other ones each night.
random_runs=${NEURALMESH_RANDOM_RUNS:-5000}
random_first=${NEURALMESH_RANDOM_FIRST:-$(($(date +%s) / 86400 * 1000000))}
debian=$PWD/build-debian

steps=(style alone tests random sweep address thread coverage fuzzing laboratory packages wheels debians)
declare -A what=(
  [style]="clang-format, cppcheck, and clang-tidy of every source"
  [alone]="every source compiled by itself, as a user's own configuration does"
  [tests]="the tests that have the label nightly or sanitized"
  [random]="$random_runs runs of each kind with any parameters, from number $random_first on"
  [sweep]="every method, order, jump and topology on real scans"
  [address]="tests of core, filters and readers with the address and undefined-behaviour sanitizers"
  [thread]="tests of core and filters with the thread sanitizer"
  [coverage]="lines of the engine that its tests run through"
  [fuzzing]="libFuzzer on engine and readers, $fuzzing_seconds s each"
  [laboratory]="all experiments of the thesis"
  [packages]="the packages for both Debians and both VTKs, each tried in a bare Debian"
  [wheels]="what pip installs, for both Debians, each tried in fresh environments and in a bare Debian"
  [debians]="all tests on Debian 12 and 13, against ParaView's VTK and plain VTK, and by clang"
)

step_style() { bash Utilities/check_style.sh --all; }

# Scripts compile some sources at a time, which hides what a source lacks. Warnings are no errors: GCC 12 has a false
# one of std::string (-Wrestrict) where a source stands alone.
step_alone()
{
  install_packages "${build_packages[@]}"
  configure build-alone -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
  cmake --build build-alone
}

build_for_tests()
{
  install_packages "${build_packages[@]}" "${test_packages[@]}" "${night_packages[@]}"
  fetch_nanobind build
  build build all -DNEURALMESH_BUILD_TESTING=ON -DNEURALMESH_WARNINGS_AS_ERRORS=ON \
    ${engine_options[@]+"${engine_options[@]}"}
}

step_tests()
{
  build_for_tests
  # It is not there where npm could not fetch what galleries show meshes with.
  ctest --test-dir build -N -R '^Python\.python3\.viewer$' --no-tests=error
  ctest --test-dir build -j "$(nproc)" -L 'nightly|sanitized' --output-on-failure --no-tests=error
}

step_random()
{
  build_for_tests
  # Not by ctest, which ends what takes half an hour.
  NEURALMESH_RANDOM_RUNS=$random_runs NEURALMESH_RANDOM_FIRST=$random_first \
    build/bin/NeuralMeshCoreThreadTests '--gtest_filter=RandomRuns.*'
}

# Scans that Debian packages bring.
step_sweep()
{
  build_for_tests
  local folder
  folder=$(mktemp -d)
  tar -xzf /usr/share/doc/libcgal-dev/data.tar.gz -C "$folder" --strip-components=2 \
    data/points_3/kitten.xyz data/points_3/oni.ply data/points_3/hippo1.ply
  PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Applications/sweep.py \
    build/bin/neuralmesh "$folder/kitten.xyz" "$folder/oni.ply" "$folder/hippo1.ply" \
    /usr/share/glmark2/models/bunny.obj
  rm -r "$folder"
}

step_address() { bash Utilities/check_sanitizers.sh address --all; }
step_thread() { bash Utilities/check_sanitizers.sh thread --all; }
step_coverage() { bash Utilities/check_coverage.sh; }

step_fuzzing()
{
  rm -rf build-fuzzing/found
  bash Testing/Fuzzing/run.sh "$fuzzing_seconds"
  local found
  found=$(find build-fuzzing/found -type f)
  [ -z "$found" ] || { echo "$found"; return 1; }
}

step_laboratory()
{
  build_for_tests
  # What an earlier night has measured is measured anew.
  rm -rf nightly/laboratory
  PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 -m neuralmesh.lab all \
    --output nightly/laboratory
}

step_packages()
{
  rm -rf packages
  bash Utilities/make_packages.sh all
  rm -rf --one-file-system "$debian"
  bash Utilities/test_packages.sh "$debian"
}

step_wheels()
{
  rm -f packages/*.whl packages/*.tar.gz
  bash Utilities/make_wheels.sh all
  bash Utilities/test_wheels.sh on bookworm
  bash Utilities/test_wheels.sh on trixie
}

# Those of the night, too.
step_debians()
{
  NEURALMESH_TEST_LABELS='fast|full|sanitized|nightly' bash Utilities/test_on.sh
}

if [ "${1:-}" = --list ]; then
  for step in "${steps[@]}"; do
    printf '%-12s %s\n' "$step" "${what[$step]}"
  done
  exit
fi
for step in "$@"; do
  [ -n "${what[$step]:-}" ] || { echo "$0: there is no step $step; --list names them" >&2; exit 2; }
done
[ $# -eq 0 ] || steps=("$@")

mkdir -p nightly
last_words='[0-9]+% tests passed.*|^lines: .*|[0-9]+ combinations run.*|^(Engine|Readers): .*'
last_words+='|\[  PASSED  \].*|all well in .*|: all well$|^report .*'
rows=() status=0
TIMEFORMAT='%R %U %S'
for step in "${steps[@]}"; do
  echo "$step: ${what[$step]}"
  result=passed
  # In a shell of its own: a command that fails ends the step, and -e holds within it.
  set +e
  all=$(declare -p fuzzing_seconds random_runs random_first debian \
    build_packages test_packages night_packages engine_options; declare -f)
  { time bash -euo pipefail -c "$all; step_$step" > "nightly/$step.log" 2>&1; } 2> nightly/time.txt
  ended=$?
  set -e
  [ "$ended" -eq 0 ] || { result="FAILED" status=1; tail -n 20 "nightly/$step.log"; }
  # Of a step that a signal ends, the shell says so in front of the times.
  read -r wall user system < <(tail -n 1 nightly/time.txt)
  said=$(grep -aoE "$last_words" "nightly/$step.log" | tail -n 1 || true)
  rows+=("$(awk -v step="$step" -v result="$result" -v wall="$wall" -v user="$user" \
    -v system_time="$system" -v said="$said" 'BEGIN {
      printf "%-10s  %-6s  %7.1f  %7.1f  %s", step, result, wall / 60, (user + system_time) / 60,
        said }')")
done

{
  echo
  echo "$(git log -1 --format='%h %s' 2> /dev/null), $(date -u +'%Y-%m-%d %H:%M') UTC"
  printf '%-10s  %-6s  %7s  %7s  %s\n' step result minutes "CPU min" "its last word"
  printf '%s\n' "${rows[@]}"
} | tee nightly/table.txt
exit "$status"
