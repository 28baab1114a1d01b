#!/usr/bin/env bash
# test_checkpoint.sh COMMAND CASE: what `neuralmesh reconstruct --checkpoint` promises to long runs.
source "$(dirname "$0")/command_testing.sh"

checkpoint=run.checkpoint
# Half a second of learning.
learning=(--vertices 1400 --set SamplesPerAddition=1500)

run() { "$neuralmesh" reconstruct cloud.xyz "$@"; }

# Runs until it has left a new checkpoint, and for so many seconds more; then kills it. Fails if the run
# had come to its end.
kill_after_checkpoint()
{
  local before status=0
  before=$(stat -c '%i %y' $checkpoint 2> stat_err || true)
  "$neuralmesh" reconstruct cloud.xyz mesh.ply "${learning[@]}" --checkpoint $checkpoint \
    --checkpoint-interval 0 > out 2> err &
  while kill -0 $! 2> stat_err && [ "$(stat -c '%i %y' $checkpoint 2> stat_err)" = "$before" ]; do
    sleep 0.005
  done
  sleep "$1"
  # On a busy machine it may have come to its end by now.
  kill -KILL $! 2> stat_err || true
  wait $! || status=$?
  ! cmp -s whole.ply mesh.ply || { rm mesh.ply; return 1; }
  [ "$status" -eq 137 ] || { cat err; fail "status $status of a killed run"; }
  [ ! -e mesh.ply ] || fail "a killed run wrote a mesh"
}

# Promise: killed at any moments by SIGKILL, the same command ends with the same bytes as without a
# break; it says where it went on, and leaves nothing but the mesh.
test_same_bytes_after_kills()
{
  expect 0 run whole.ply "${learning[@]}"
  local pause tries=0
  for pause in 0 0.013 0.002 0.007 0.004; do
    until kill_after_checkpoint $pause; do
      tries=$((tries + 1))
      [ $tries -lt 100 ] || fail "no run could be killed before its end"
    done
  done
  expect 0 run mesh.ply "${learning[@]}" --checkpoint $checkpoint
  grep -Eq "^resumed +at sample [1-9][0-9]*, from $checkpoint\$" out || fail "it does not say so"
  cmp whole.ply mesh.ply || fail "other bytes"
  [ -z "$(find . -name '*checkpoint*')" ] || { ls -A; fail "more is left than the mesh"; }
}

# Promise: Ctrl-C writes the mesh learnt so far and a checkpoint, says so, and the same command goes on.
test_ctrl_c()
{
  expect 130 interrupted 200 "$neuralmesh" reconstruct cloud.xyz mesh.ply \
    --vertices 100000000 --set FitRounds=0 --checkpoint $checkpoint
  [ -s mesh.ply ] || fail "no mesh"
  grep -q "^checkpoint $checkpoint: the same command goes on" out || fail "it does not say so"
  expect 1 run mesh.ply "${learning[@]}" --checkpoint $checkpoint
  grep -q 'SamplesPerAddition (50 there, 1500 here)' err || fail "what differs is not said"
}

# Promise: a run that has all its vertices and no time left to finish them is warned of, with status 3 if --strict; the
# same command, with the same limit, finishes the mesh.
test_all_vertices()
{
  local limit status
  local command=("$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 1000 --set FitRounds=60 --set FitSamples=200
    --strict --checkpoint $checkpoint)
  for limit in 0.05 0.08 0.12 0.18 0.27 0.4 0.6 0.9 1.4 2 3 4.5 7 10; do
    rm -f $checkpoint
    status=0
    "${command[@]}" --time-limit $limit > out 2> err || status=$?
    if grep -Eq '^vertices +1000$' out && grep -q 'ended by: time limit' out; then
      break
    fi
  done
  grep -Eq '^vertices +1000$' out && grep -q 'ended by: time limit' out || fail "no limit was in the finish"
  [ "$status" -eq 3 ] || fail "status $status of an unfinished mesh"
  grep -q '\[mesh-is-unfinished\]$' err || { cat err; fail "no warning"; }
  "${command[@]}" --time-limit $limit > out 2> err || { [ $? -eq 3 ] || fail "it cannot go on"; }
  grep -q 'ended by: vertices' out || { cat out err; fail "it was ended anew"; }
  ! grep -q 'mesh-is-unfinished' err || fail "a finished mesh is warned of"
  [ ! -e $checkpoint ] || fail "a checkpoint stays"
}

# Promise: a run that meets the time limit leaves its checkpoint, and goes on with a longer one.
test_time_limit()
{
  expect 0 run whole.ply "${learning[@]}"
  expect 0 run mesh.ply "${learning[@]}" --checkpoint $checkpoint --time-limit 0.1
  grep -q 'ended by: time limit' out || fail "it did not end by the time limit"
  [ -e $checkpoint ] || fail "no checkpoint"
  expect 0 run mesh.ply "${learning[@]}" --checkpoint $checkpoint --time-limit 1000
  cmp whole.ply mesh.ply || fail "other bytes"
  [ ! -e $checkpoint ] || fail "the checkpoint is left"
  # Also where there was no time to learn anything.
  expect 0 run mesh.ply "${learning[@]}" --checkpoint $checkpoint --time-limit 1e-9
  [ -e $checkpoint ] || fail "no checkpoint of a run that has learnt nothing"
  expect 0 run mesh.ply "${learning[@]}" --checkpoint $checkpoint
  cmp whole.ply mesh.ply || fail "other bytes"
  [ ! -e $checkpoint ] || fail "the checkpoint is left"
}

# Promise: whatever of a run is interrupted before it goes on from its checkpoint, the members of an ensemble
# or the choice of parameters, the mesh of the checkpoint is written, the file stays as it is, and the same
# command goes on from there.
test_ctrl_c_before_learning()
{
  # So noisy that there is something to choose; seconds pass before anything is learnt.
  make_cloud 20000
  awk 'function noise() { return 0.05 * (rand() + rand() + rand() - 1.5) }
    BEGIN { srand(1) } { print $1 + noise(), $2 + noise(), $3 + noise() }' cloud.xyz > noisy.xyz
  mv noisy.xyz cloud.xyz
  local options
  for options in "--automatic" \
    "--ensemble 3 --set VerticesPerMember=1500 --set MemberSamplesPerAddition=500"; do
    # Some words.
    read -ra learning <<< "$options --vertices 4500"
    rm -f mesh.ply
    expect 0 run whole.ply "${learning[@]}"
    until kill_after_checkpoint 0; do
      :
    done
    cp $checkpoint before
    # The command asks for signals once it has read the cloud.
    expect 130 interrupted 40 "$neuralmesh" reconstruct cloud.xyz mesh.ply "${learning[@]}" \
      --checkpoint $checkpoint
    grep -q "^resumed " out || { cat out; fail "not the mesh of the checkpoint: $options"; }
    [ -s mesh.ply ] || fail "no mesh: $options"
    cmp $checkpoint before || fail "another checkpoint: $options"
    expect 0 run mesh.ply "${learning[@]}" --checkpoint $checkpoint --time-limit 1e-9
    grep -q "^resumed " out || { cat out; fail "not the mesh of the checkpoint: $options"; }
    cmp $checkpoint before || fail "another checkpoint: $options"
    expect 0 run mesh.ply "${learning[@]}" --checkpoint $checkpoint
    cmp whole.ply mesh.ply || fail "other bytes: $options"
    [ ! -e $checkpoint ] || fail "the checkpoint is left"
  done
}

# Promise: exit status 1, a message on one line that names the file, and neither mesh nor checkpoint are
# touched, where that is not a checkpoint, is damaged, or cannot be written.
test_refusals()
{
  local name
  echo "what was there" > mesh.ply
  expect 0 run part.ply "${learning[@]}" --checkpoint good.checkpoint --time-limit 0.1
  head -c 2000 good.checkpoint > short.checkpoint
  { cat good.checkpoint; echo more; } > long.checkpoint
  echo "a text" > text.checkpoint
  mkdir folder.checkpoint
  for name in short.checkpoint long.checkpoint text.checkpoint folder.checkpoint \
    nowhere/run.checkpoint; do
    [ ! -f "$name" ] || cp "$name" before
    expect 1 run mesh.ply "${learning[@]}" --checkpoint "$name"
    [ "$(wc -l < err)" -eq 1 ] || { cat err; fail "not one line for $name"; }
    grep -q "$name" err || { cat err; fail "the message does not name $name"; }
    [ ! -f "$name" ] || cmp "$name" before || fail "$name was changed"
  done
  [ "$(cat mesh.ply)" = "what was there" ] || fail "the mesh was changed"
  expect 2 run mesh.ply --checkpoint-interval 5
}

make_cloud
"test_$2"
