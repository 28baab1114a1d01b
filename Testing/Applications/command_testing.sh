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
