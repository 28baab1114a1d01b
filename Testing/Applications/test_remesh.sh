#!/usr/bin/env bash
# test_remesh.sh COMMAND CASE: what the command promises of surfaces that it remeshes.
source "$(dirname "$0")/command_testing.sh"

# A sheet of squares of two triangles each, bent, with colours.
make_sheet()
{
  awk 'BEGIN { n = 30
    print "ply\nformat ascii 1.0\nelement vertex " (n + 1) ^ 2
    print "property float x\nproperty float y\nproperty float z"
    print "property uchar red\nproperty uchar green\nproperty uchar blue"
    print "element face " 2 * n * n "\nproperty list uchar int vertex_indices\nend_header"
    for (i = 0; i <= n; ++i) for (j = 0; j <= n; ++j)
      print i / n, j / n, 0.2 * sin(6 * i / n) * cos(5 * j / n), 200, 100, 50
    for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) { a = i * (n + 1) + j; b = a + n + 1
      print 3, a, b, b + 1; print 3, a, b + 1, a + 1 } }' > sheet.ply
}

# Promise: a surface comes out with as many vertices as are asked for, its boundary and its colours, and the same
# bytes again.
test_written()
{
  make_sheet
  expect 0 "$neuralmesh" reconstruct sheet.ply mesh.ply --remesh --vertices 200
  grep -Eq '^vertices   200$' out || { cat out; fail "other vertices"; }
  grep -Eq '^shape      1 piece, no handles, 1 boundary,' out || { cat out; fail "another shape"; }
  grep -aq "^property uchar red" mesh.ply || fail "the colours are gone"
  expect 0 "$neuralmesh" reconstruct sheet.ply again.ply --remesh --vertices 200 --threads 1 --quiet
  cmp mesh.ply again.ply || fail "other bytes"
}

# Promise: what is no surface is told, with status 1, and nothing is written.
test_no_surface()
{
  printf '0 0 0\n1 0 0\n0 1 0\n1 1 1\n' > points.xyz
  expect 1 "$neuralmesh" reconstruct points.xyz mesh.ply --remesh
  printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' > line.obj
  expect 1 "$neuralmesh" reconstruct line.obj mesh.ply --remesh
  grep -q 'no area' err || { cat err; fail "not the reason"; }
  [ ! -e mesh.ply ] || fail "something was written"
}

# Promise: wrong use is told before anything is done.
test_wrong_use()
{
  make_sheet
  for options in "--time-limit 5" "--levels 50,100" "--ensemble 3" "--automatic" "--checkpoint state" "--up 0,0,1" \
    "--initial sheet.ply" "--weights red" "--boundaries close" "--explain points.vtp" "--in-place" "--dry-run" \
    "--preset thesis"; do
    # Options are words.
    # shellcheck disable=SC2086
    expect 2 "$neuralmesh" reconstruct sheet.ply mesh.ply --remesh $options
    grep -q 'exclude each other' err || { cat err; fail "not the reason: $options"; }
  done
  expect 2 "$neuralmesh" reconstruct sheet.ply sheet.ply mesh.ply --remesh
  [ ! -e mesh.ply ] || fail "something was written"
}

"test_$2"
