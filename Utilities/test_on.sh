#!/usr/bin/env bash
# Runs the tests, those whose label matches NEURALMESH_TEST_LABELS, in a Debian of its own, made by
# debootstrap, and prints a table at the end.
#
#   Utilities/test_on.sh                                everything below, one after the other
#   Utilities/test_on.sh SUITE WORLD [CTEST-OPTION...]
#
# SUITE is bookworm or trixie. WORLD says what to build with: paraview (5.11 or 5.13, with a VTK of its
# own), plain (VTK 9.1 or 9.3), or clang (the same VTK, by clang instead of GCC). Each needs root, about
# 3 GB and, the first time, some minutes. Its Debian stays in build-SUITE-WORLD, with a log beside it: the
# next run builds what has changed.
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
source "$repository/Utilities/build.sh"
source "$repository/Utilities/debian.sh"
in_own_namespace "$0" "$@"
cd "$repository"

# test_on SUITE WORLD [CTEST-OPTION...]
test_on()
{
  local suite=$1 world=$2 debian=$repository/build-$1-$2
  shift 2
  [ -d "$debian" ] || make_debian "$suite" "$debian"
  enter_debian "$debian"
  copy_sources "$debian"
  in_debian "$debian" "$world" bash /neuralmesh/test.sh "$@"
}

# What stands in the cache of CMake: cached SUITE WORLD NAME.
cached()
{
  sed -nE "s/^$3:[A-Z]*=//p" "build-$1-$2/neuralmesh/build/CMakeCache.txt" 2> /dev/null | head -n 1
}

# The row of what has been tested: row SUITE WORLD RESULT SECONDS.
row()
{
  local compiler vtk ran
  compiler=$(in_debian "build-$1-$2" "$2" "$(cached "$1" "$2" CMAKE_CXX_COMPILER)" --version 2>&1 |
    sed -nE '1s/.*(clang|g\+\+|c\+\+).* ([0-9]+\.[0-9]+\.[0-9]+).*/\1 \2/p')
  vtk=$(sed -nE 's/^VTK_VERSION = "(.*)"/\1/p' \
    "build-$1-$2/neuralmesh/build/lib/python3/dist-packages/neuralmesh/_build.py" 2> /dev/null || true)
  ran=$(grep -aoE '[0-9]+% tests passed.*' "build-$1-$2.log" | tail -n 1 || true)
  printf '%-9s %-9s %-14s %-13s %-7s %6.1f  %s\n' \
    "$1" "$2" "${compiler:-none}" "${vtk:-none}" "$3" "$(awk "BEGIN { print $4 / 60 }")" "$ran"
}

all=()
if [ $# -eq 0 ]; then
  for suite in "${suites[@]}"; do
    for world in "${worlds[@]}"; do
      all+=("$suite $world")
    done
  done
else
  [ $# -ge 2 ] || { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }
  require_suite_and_world "$0" "$1" "$2"
  all=("$1 $2")
  shift 2
fi

rows=() status=0
for one in "${all[@]}"; do
  read -r suite world <<< "$one"
  echo "$suite $world: see build-$suite-$world.log"
  start=$SECONDS result=passed
  # In a shell of its own: a command that fails ends it, and -e holds within it.
  set +e
  (set -e; test_on "$suite" "$world" "$@") 2>&1 | tee "build-$suite-$world.log"
  [ "${PIPESTATUS[0]}" -eq 0 ] || { result=FAILED status=1; }
  set -e
  rows+=("$(row "$suite" "$world" "$result" $((SECONDS - start)))")
  leave_debian "build-$suite-$world"
done

echo
printf '%-9s %-9s %-14s %-13s %-7s %6s\n' suite world compiler VTK result minutes
printf '%s\n' "${rows[@]}"
exit "$status"
