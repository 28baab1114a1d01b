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

# CPU time of a process that runs, in hundredths of a second; nothing if it has ended.
cpu_time_of()
{
  local stat
  stat=$(cat "/proc/$1/stat" 2> /dev/null) || return 0
  # Behind the name of the program: the state, and further on the time as user and in the system.
  read -ra stat <<< "${stat##*) }"
  [ "${stat[0]}" = Z ] || echo $((stat[11] + stat[12]))
}

# interrupted CENTISECONDS COMMAND...: runs it, and sends SIGINT, or $signal, when it has had so much CPU time: a busy
# machine gives that later. The exit status is that of the command.
interrupted()
{
  local after=$1 process time
  shift
  # The shell has what runs in the background ignore the signal.
  env --default-signal=INT "$@" &
  process=$!
  while time=$(cpu_time_of $process); [ -n "$time" ] && [ "$time" -lt "$after" ]; do
    sleep 0.01
  done
  kill "-${signal:-INT}" $process 2> /dev/null || true
  wait $process
}

# within_limits COMMAND...: ends it where it needs more than 30 s of CPU time, or hangs.
within_limits() { (ulimit -t 30; timeout 900 "$@"); }

# json EXPRESSION: whether it holds in Python for `lines`, the JSON objects of `out`; a difference
# of a and b of less than a hundredth is near(a, b).
json()
{
  /usr/bin/python3 - "$1" <<'PYTHON' || { cat out; fail "this does not hold: $1"; }
import json, sys
lines = [json.loads(line) for line in open("out")]
near = lambda a, b: abs(a - b) < 0.01 * abs(b)
sys.exit(0 if eval(sys.argv[1]) else 1)
PYTHON
}

# 3000 points of a unit sphere, or as many as are told, on a spiral.
make_cloud()
{
  awk -v n="${1:-3000}" 'BEGIN { for (i = 0; i < n; ++i) { z = 1 - (2 * i + 1) / n; r = sqrt(1 - z * z);
    printf "%.9f %.9f %.9f\n", r * cos(2.39996 * i), r * sin(2.39996 * i), z } }' > cloud.xyz
}
