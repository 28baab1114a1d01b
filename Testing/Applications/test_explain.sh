#!/usr/bin/env bash
# test_explain.sh COMMAND CASE: what the command promises of points that are left out, and of warnings.
source "$(dirname "$0")/command_testing.sh"

# sphere COUNT X Y Z: points of a sphere around a place.
sphere()
{
  awk -v n="$1" -v x="$2" -v y="$3" -v z="$4" 'BEGIN { for (i = 0; i < n; ++i) {
    h = 1 - 2 * (i + 0.5) / n; r = sqrt(1 - h * h); a = 2.399963 * i
    print x + r * cos(a), y + r * sin(a), z + h } }'
}

# Two spheres, and a mesh of the first one alone.
make_clouds()
{
  sphere 4000 0 0 0 > first.xyz
  { cat first.xyz; sphere 1000 4 0 0; } > both.xyz
  expect 0 "$neuralmesh" reconstruct first.xyz first.ply --vertices 500
}

# Promise: explain counts what a mesh leaves out, says where, and writes the points with their reasons.
test_any_mesh()
{
  make_clouds
  expect 0 "$neuralmesh" explain both.xyz first.ply out.vtp
  grep -q '^points     5000$' out || { cat out; fail "not the points"; }
  grep -q '^left out   0 outliers, 0 in small pieces, 1000 unreachable: 20 % unexplained$' out ||
    { cat out; fail "not the reasons"; }
  grep -Eq '^missed     1000 points around \(4(\.0|,)|^missed     1000 points around \(3\.99' out ||
    { cat out; fail "not the place"; }
  expect 0 "$neuralmesh" explain both.xyz first.ply out.vtp --keep-pieces 0.5
  grep -q '1000 in small pieces, 0 unreachable' out || { cat out; fail "the limit does not count"; }
  grep -q 'Name="Distance"' out.vtp && grep -q 'Name="Reason"' out.vtp || fail "arrays are missing"
}

# Promise: the report of a run counts what is left out, and --explain writes it point by point.
test_of_a_run()
{
  make_clouds
  expect 0 "$neuralmesh" reconstruct first.xyz mesh.vtp --vertices 500 --explain points.vtp --strict
  grep -q '^left out   0 outliers, 0 in small pieces, 0 unreachable: 0 % unexplained$' out ||
    { cat out; fail "the report does not say it"; }
  [ ! -s err ] || { cat err; fail "there is something on stderr"; }
  grep -q 'NumberOfPoints="4000"' points.vtp || fail "these are not the points"
  for name in Residual Support Boundary; do
    grep -q "Name=\"$name\"" mesh.vtp || fail "the mesh has no $name"
  done
  expect 0 "$neuralmesh" reconstruct first.xyz without.vtp --vertices 500
  expect 0 "$neuralmesh" info --json mesh.vtp
  cp out with.json
  expect 0 "$neuralmesh" info --json without.vtp
  cmp <(sed 's/without/mesh/g' out) with.json || fail "--explain changes the mesh"
}

# Promise: warnings are printed whole, with their tags, however many places with however many digits they name.
test_whole_warnings()
{
  sphere 4000 500000 5400000 0 > first.xyz
  { cat first.xyz; sphere 400 500004 5400000 0; sphere 400 500000 5400004 0; sphere 400 500000 5400000 4; } > many.xyz
  expect 0 "$neuralmesh" reconstruct first.xyz first.vtp --vertices 500
  expect 0 "$neuralmesh" reconstruct many.xyz mesh.vtp --vertices 500 --initial first.vtp
  [ "$(awk '{ print length }' err | sort -n | tail -1)" -gt 325 ] || { cat err; fail "no long warning"; }
  ! grep '^neuralmesh: warning: ' err | grep -v '\[[a-z-]*\]$' || fail "a warning without its tag"
}

# Promise: with --strict a warning is exit status 3, and the mesh is written; without it, 0.
test_strict()
{
  sphere 1000 0 0 0 > few.xyz
  expect 0 "$neuralmesh" reconstruct few.xyz mesh.ply --vertices 700
  grep -q '^neuralmesh: warning: The mesh is finer than its data' err || { cat err; fail "no warning"; }
  rm mesh.ply
  expect 3 "$neuralmesh" reconstruct few.xyz mesh.ply --vertices 700 --strict --quiet
  [ -s mesh.ply ] || fail "there is no mesh"
  [ ! -s out ] || fail "there is something on stdout"
  expect 0 "$neuralmesh" reconstruct few.xyz mesh.ply --vertices 400 --strict
  # So is one of a reader, before anything is learnt.
  (echo Easting Northing Height; cat few.xyz) > named.xyz
  expect 3 "$neuralmesh" reconstruct named.xyz mesh.ply --vertices 400 --strict
}

# Promise: holes are filled up to a length, and pieces dropped below a part.
test_holes_and_pieces()
{
  sphere 20000 0 0 0 | awk '{ hole = $3 > 0.97 || ($1 > 0.9) }  !hole' > holes.xyz
  # Outlines of about 1.5 and 2.7.
  local most expected
  for most in 0:2 1:2 2:1 4:no; do
    expected=${most#*:}
    expect 0 "$neuralmesh" reconstruct holes.xyz mesh.ply --vertices 2000 \
      --close-holes-below "${most%:*}"
    grep -Eq "^shape .* $expected boundar(y|ies)," out || { cat out; fail "not $expected: $most"; }
  done
  { sphere 8000 0 0 0; sphere 2000 4 0 0; } > two.xyz
  expect 0 "$neuralmesh" reconstruct two.xyz mesh.ply --vertices 1000
  grep -q '^shape      2 pieces,' out || { cat out; fail "not two pieces"; }
  expect 0 "$neuralmesh" reconstruct two.xyz mesh.ply --vertices 1000 --keep-pieces 0.6
  grep -q '^shape      1 piece,' out || { cat out; fail "not one piece"; }
  grep -q ' 2000 in small pieces' out || { cat out; fail "what is dropped is not counted"; }
}

# Promise: wrong use is told before anything is done, and bad files are an error that names them.
test_wrong_use()
{
  make_clouds
  expect 2 "$neuralmesh" explain both.xyz first.ply out.ply
  expect 2 "$neuralmesh" reconstruct both.xyz mesh.ply --explain points.ply
  grep -q 'points.ply must be a .vtp' err || { cat err; fail "not the reason"; }
  expect 2 "$neuralmesh" reconstruct both.xyz mesh.vtp --explain mesh.vtp
  expect 2 "$neuralmesh" explain both.xyz first.ply out.vtp --keep-pieces 2
  expect 2 "$neuralmesh" reconstruct both.xyz mesh.ply --close-holes-below -1
  expect 1 "$neuralmesh" explain both.xyz missing.ply out.vtp
  grep -q 'missing.ply' err || { cat err; fail "the message does not name the file"; }
  : > empty.xyz
  expect 1 "$neuralmesh" explain empty.xyz first.ply out.vtp
  [ ! -e out.vtp ] && [ ! -e mesh.ply ] || fail "something was written"
}

"test_$2"
