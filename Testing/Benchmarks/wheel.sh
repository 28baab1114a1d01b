#!/usr/bin/env bash
# What pip installs beside the C++ filter: CPU time of 20,000 vertices of 200,000 points, memory beside the points,
# and how long the import takes. About a minute.
#
#   Testing/Benchmarks/wheel.sh PYTHON        that of an environment with the wheel
#
# The C++ filter is that of build/. Runs alternate; the medians of 7 are printed.
set -euo pipefail
cd "$(dirname "$0")/../.."
[ $# -eq 1 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
one_run=$PWD/Testing/Benchmarks/wheel.py
results=$(mktemp)
trap 'rm -f "$results"' EXIT
for _ in 1 2 3 4 5 6 7; do
  PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 "$one_run" filter >> "$results"
  "$1" "$one_run" wheel >> "$results"
done
/usr/bin/python3 "$one_run" table "$results"
