#!/usr/bin/env bash
# test_levels.sh COMMAND CASE: what the command promises of levels of detail.
source "$(dirname "$0")/command_testing.sh"

# Promise: the largest level is OUTPUT, the others lie beside it with their numbers in their names, and the
# report has a line for each.
test_written()
{
  make_cloud 5000
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 100,300,900
  grep -Eq '^vertices   900$' out || { cat out; fail "the largest is not OUTPUT"; }
  for level in 100 300; do
    grep -Eq "^level      $level vertices, residual .*: mesh_$level.ply$" out || { cat out; fail "no line"; }
    grep -aq "^element vertex $level$" mesh_$level.ply || fail "mesh_$level.ply has other vertices"
  done
  grep -aq "^element vertex 900$" mesh.ply || fail "mesh.ply has other vertices"
  [ "$(ls ./*.ply | wc -l)" -eq 3 ] || fail "there are other files"
}

# Promise: wrong use is told before anything is done.
test_wrong_use()
{
  make_cloud 5000
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 300,100
  grep -q 'must ascend' err || { cat err; fail "not the reason"; }
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 100,300 --vertices 500
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 3,300
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 100,many
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 100,300 --time-limit 5
  grep -q 'stopping rule' err || { cat err; fail "not the reason"; }
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 100,300 --ensemble 3
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 100,300 --automatic
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 100,300 --checkpoint state
  expect 2 "$neuralmesh" reconstruct cloud.xyz mesh.ply --levels 100,300 --statistics mesh_100.ply
  [ -z "$(ls ./*.ply state 2> /dev/null)" ] || fail "something was written"
}

"test_$2"
