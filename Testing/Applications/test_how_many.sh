#!/usr/bin/env bash
# test_how_many.sh COMMAND CASE: what the command promises where a number of vertices is to be found.
source "$(dirname "$0")/command_testing.sh"

# Promise: the report says why the mesh has as many vertices as it has, and what other numbers would give.
test_chosen()
{
  make_cloud 5000
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices auto
  grep -Eq '^how many   no noise was measured' out || { cat out; fail "not why"; }
  grep -Eq '^ +tried: [0-9]+ vertices ' out || { cat out; fail "not what was tried"; }
  grep -Eq '^ +predicted .*, reached ' out || { cat out; fail "not what was reached"; }
  grep -Eq '^ +half as many would give about .*, twice as many about ' out || { cat out; fail "no other numbers"; }
  grep -Eq '^phases .*choice ' out || { cat out; fail "the time of the choice is missing"; }
}

# Promise: a tolerance is met, in units of the input and in percent, by fewer vertices the larger it is.
test_tolerance()
{
  make_cloud 5000
  local length vertices last=1000000
  for length in 0.002 0.3% 0.03; do
    expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --tolerance "$length"
    grep -Eq '^how many   the fewest vertices that meet the tolerance of ' out || { cat out; fail "not why"; }
    vertices=$(awk '/^vertices/ { print $2 }' out)
    [ "$vertices" -lt "$last" ] || { cat out; fail "$length takes $vertices vertices"; }
    last=$vertices
  done
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --tolerance 0.03 --tolerance-of largest
  [ "$(awk '/^vertices/ { print $2 }' out)" -ge "$last" ] || { cat out; fail "the largest takes fewer"; }
}

# Promise: wrong use is told before anything is done, and a cloud that tells nothing in words; nothing is written.
test_wrong_use()
{
  make_cloud 5000
  local options
  for options in "--vertices automatic" "--vertices 3" "--tolerance 0" "--tolerance 0%" "--tolerance -1" \
    "--tolerance wide" "--tolerance nan" "--tolerance 1 --vertices 100" "--tolerance 1 --levels 100,200" \
    "--tolerance-of largest" "--tolerance 1 --tolerance-of mean" "--vertices auto --automatic" \
    "--vertices auto --ensemble 3" "--vertices auto --checkpoint state" "--tolerance 1% --time-limit 5" \
    "--vertices auto --dry-run"; do
    # Options are words.
    # shellcheck disable=SC2086
    expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply $options
    [ -s err ] || fail "$options: no words"
  done
  expect 1 "$neuralmesh" reconstruct cloud.xyz mesh.ply --tolerance 100
  grep -q 'any mesh meets it' err || { cat err; fail "not the reason"; }
  printf '0 0 0\n1 0 0\n0 1 0\n' > three.xyz
  expect 1 "$neuralmesh" reconstruct three.xyz mesh.ply --vertices auto
  grep -q 'There are 3 points' err || { cat err; fail "not the reason"; }
  [ -z "$(ls ./*.ply state 2> /dev/null)" ] || fail "something was written"
}

"test_$2"
