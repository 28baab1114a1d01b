# Sourced by the tests of the command, which are called as SCRIPT COMMAND CASE. Leaves them in an
# empty folder that is removed at the end.
set -euo pipefail
neuralmesh=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() { echo "FAILED: $*"; exit 1; }

# expect STATUS COMMAND...: runs it, output to `out` and `err`, and compares the exit status.
expect()
{
  local expected=$1 status=0
  shift
  "$@" > out 2> err || status=$?
  [ "$status" -eq "$expected" ] || { cat out err; fail "status $status, not $expected: $*"; }
}

# 3000 points of a unit sphere, on a spiral.
make_cloud()
{
  awk 'BEGIN { for (i = 0; i < 3000; ++i) { z = 1 - (2 * i + 1) / 3000; r = sqrt(1 - z * z);
    printf "%.9f %.9f %.9f\n", r * cos(2.39996 * i), r * sin(2.39996 * i), z } }' > cloud.xyz
}
