#!/usr/bin/env bash
# test_feature_lines.sh COMMAND CASE: what the command promises of feature lines.
source "$(dirname "$0")/command_testing.sh"

# A cube of side 2.
make_cube()
{
  awk 'BEGIN { n = 50; for (side = 0; side < 6; ++side) for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) {
    p[int(side / 2)] = side % 2 ? 1 : -1
    p[(int(side / 2) + 1) % 3] = (2 * i + 1) / n - 1; p[(int(side / 2) + 2) % 3] = (2 * j + 1) / n - 1
    print p[0], p[1], p[2] } }' > cube.xyz
}

# Promise: --feature-lines writes lines with their data in both formats, counts them in the report, and
# gives the mesh its creases; the mesh is the same else.
test_written()
{
  make_cube
  expect 0 "$neuralmesh" reconstruct cube.xyz mesh.vtp --vertices 1000 --feature-lines lines.vtp
  grep -Eq '^lines      [0-9]+ of the length 2[345]\.?[0-9]*, with [0-9]+ corners$' out ||
    { cat out; fail "the report does not say it"; }
  for name in Angle Chain Length Corner Vertex; do
    grep -q "Name=\"$name\"" lines.vtp || fail "the lines have no $name"
  done
  grep -q 'Name="Crease"' mesh.vtp || fail "the mesh has no creases"
  expect 0 "$neuralmesh" reconstruct cube.xyz mesh.ply --vertices 1000 --feature-lines lines.vtk
  grep -aq '^LINES' lines.vtk || fail "there are no lines"
  cp mesh.ply with.ply
  expect 0 "$neuralmesh" reconstruct cube.xyz mesh.ply --vertices 1000
  cmp mesh.ply with.ply || fail "--feature-lines changes the mesh"
  ! grep -q '^lines' out || fail "lines without being asked for"
}

# Promise: where there are no lines, stderr says that no file is written, also where nothing else is said;
# the angle decides.
test_none()
{
  make_cube
  expect 0 "$neuralmesh" reconstruct cube.xyz mesh.vtp --vertices 1000 --feature-lines lines.vtp \
    --set FeatureAngle=120 --quiet
  grep -q '^neuralmesh: there are no feature lines, so lines.vtp is not written$' err ||
    { cat err; fail "it does not say so"; }
  [ ! -e lines.vtp ] || fail "there is a file"
}

# Promise: wrong use is told before anything is done.
test_wrong_use()
{
  make_cube
  expect 2 "$neuralmesh" reconstruct cube.xyz mesh.vtp --feature-lines lines.ply
  grep -q 'lines.ply must be a .vtp or .vtk' err || { cat err; fail "not the reason"; }
  expect 2 "$neuralmesh" reconstruct cube.xyz mesh.vtp --feature-lines mesh.vtp
  expect 2 "$neuralmesh" reconstruct cube.xyz mesh.vtp --feature-lines lines.vtp --set FeatureAngle=0
  expect 1 "$neuralmesh" reconstruct cube.xyz mesh.vtp --feature-lines nowhere/lines.vtp
  [ ! -e mesh.vtp ] || fail "something was written"
}

"test_$2"
