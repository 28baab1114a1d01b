#!/usr/bin/env bash
# test_tune.sh COMMAND CASE: what `neuralmesh tune` and `reconstruct --automatic` promise to those who
# type them.
source "$(dirname "$0")/command_testing.sh"

# Promise: it says what it chose and why, and the command line it ends with does what --automatic
# does; it writes nothing.
test_table()
{
  expect 0 "$neuralmesh" tune noisy.xyz --vertices 4500
  grep -q '^  Fidelity high instead of default was not tried: under noise' out ||
    { cat out; fail "no word of Fidelity"; }
  check_line noisy.xyz
  expect 0 "$neuralmesh" tune cloud.xyz --vertices 4500
  grep -Eq '^Fidelity +high instead of default$' out || { cat out; fail "no choice"; }
  grep -Eq '^  Fidelity high instead of default: taken, squares .* less \(standard error' out ||
    { cat out; fail "no trial"; }
  [[ $(tail -n 1 out) = *' --fidelity high'* ]] || { cat out; fail "no --fidelity"; }
  check_line cloud.xyz
}

# Of the command line that was printed for a cloud.
check_line()
{
  [ ! -s err ] || { cat err; fail "there is something on stderr"; }
  [ "$(ls)" = "$(printf 'cloud.xyz\nerr\nnoisy.xyz\nout')" ] || fail "it wrote something"
  local line
  line=$(tail -n 1 out)
  [[ $line = "neuralmesh reconstruct $1 OUTPUT "* ]] || fail "no command line at the end"
  line=${line/#neuralmesh/"$neuralmesh"}
  # Some words.
  expect 0 ${line/OUTPUT/by_hand.ply} --quiet
  expect 0 "$neuralmesh" reconstruct "$1" automatic.ply --vertices 4500 --automatic --quiet
  cmp by_hand.ply automatic.ply || fail "--automatic gives another mesh than the command line"
  rm by_hand.ply automatic.ply
}

# Promise: --json prints one object with choices, trials and reasons.
test_json()
{
  expect 0 "$neuralmesh" tune cloud.xyz --vertices 4500 --json
  python3 -c 'import json; print(json.dumps(json.load(open("out"))))' > line && mv line out
  json 'lines[0]["file"] == "cloud.xyz" and lines[0]["vertices"] == 4500'
  json 'lines[0]["chosen"]["Fidelity"] == "high"'
  json 'all(trial["error"] > 0 and trial["standard_error"] > 0 for trial in lines[0]["trials"])'
  json 'lines[0]["trials"][0]["parameter"] == "Fidelity" and lines[0]["trials"][0]["value"] == "high"'
  json 'lines[0]["trials"][0]["before"] == "default"'
  json 'len(lines[0]["reasons"]) >= len(lines[0]["trials"])'
  expect 0 "$neuralmesh" tune noisy.xyz --vertices 4500 --json
  python3 -c 'import json; print(json.dumps(json.load(open("out"))))' > line && mv line out
  json 'any("not tried: under noise" in reason for reason in lines[0]["reasons"])'
  json 'all(trial["error"] > 0 and trial["standard_error"] > 0 for trial in lines[0]["trials"])'
}

# Promise: reconstruct --automatic tells what was chosen, and why.
test_automatic()
{
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 4500 --automatic
  grep -Eq '^chosen +Fidelity=high' out || { cat out; fail "the choice is not told"; }
  expect 0 "$neuralmesh" reconstruct noisy.xyz mesh.ply --vertices 4500 --automatic
  grep -q 'was not tried: under noise' out || { cat out; fail "the reason is not told"; }
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 4500
  ! grep -q 'chosen' out || { cat out; fail "something was chosen unasked"; }
}

# Promise: the same on any number of threads, and what is said does not depend on the order of
# points in one place, of which there may be any number.
test_coincident()
{
  awk '{ print NR % 3 ? $0 : "0.3 0.2 0.1" } NR % 2 { print "0.5 0.5 0.5" }' noisy.xyz > spots.xyz
  expect 0 "$neuralmesh" tune spots.xyz --vertices 20000 --threads 1
  cp out first
  expect 0 "$neuralmesh" tune spots.xyz --vertices 20000 --threads 3
  cmp out first || fail "threads change the choice"
  awk '{ print NR % 2 ? "1 2 3" : "3 2 1" }' noisy.xyz > two.xyz
  expect 0 "$neuralmesh" tune two.xyz
  grep -q 'too few points' out || { cat out; fail "not the reason"; }
}

# Promise: clear errors for clouds that are none, exit status 2 for wrong use.
test_wrong_use()
{
  expect 1 "$neuralmesh" tune missing.ply
  grep -q 'missing.ply' err || { cat err; fail "missing.ply is not told"; }
  printf '1 1 1\n1 1 1\n' > point.xyz
  expect 1 "$neuralmesh" tune point.xyz
  grep -q 'point.xyz: there are no two points apart from each other' err || fail "not the reason"
  [ ! -s out ] || fail "there is something on stdout"
  : > empty.xyz
  expect 1 "$neuralmesh" tune empty.xyz
  grep -q 'empty.xyz: there are no points in it' err || { cat err; fail "not the reason"; }
  printf 'nan nan nan\nnan 1 2\n' > nan.xyz
  expect 1 "$neuralmesh" tune nan.xyz
  grep -q 'nan.xyz: no point of it is finite' err || { cat err; fail "not the reason"; }
  local arguments
  while read -r arguments; do
    # Some words.
    expect 2 "$neuralmesh" tune $arguments
    [ -s err ] || fail "no message for: $arguments"
  done << 'CASES'

cloud.xyz mesh.ply
cloud.xyz --vertices 3
cloud.xyz --seed -1
cloud.xyz --threads many
CASES
  expect 0 "$neuralmesh" tune --help
  grep -q 'Exit status: 0' out || fail "the help does not tell the exit statuses"
}

# A clean torus, of which a finer fit makes more, and a noisy sphere.
awk 'BEGIN { srand(1); for (i = 0; i < 100000;) { a = 6.283185 * rand(); b = 6.283185 * rand(); r = 1 + 0.4 * cos(b)
  if (1.4 * rand() < r) { printf "%.9f %.9f %.9f\n", r * cos(a), r * sin(a), 0.4 * sin(b); ++i } } }' > cloud.xyz
awk 'function noise() { return 0.05 * (rand() + rand() + rand() - 1.5) }
  BEGIN { srand(1); for (i = 0; i < 40000; ++i) { z = 2 * rand() - 1; r = sqrt(1 - z * z); a = 6.283185 * rand()
  print r * cos(a) + noise(), r * sin(a) + noise(), z + noise() } }' > noisy.xyz
"test_$2"
