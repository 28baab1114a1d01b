#!/usr/bin/env bash
# test_orientation.sh COMMAND CASE: what `neuralmesh reconstruct` promises of the outer side of open
# surfaces.
source "$(dirname "$0")/command_testing.sh"

# 3000 points of a square in the plane z = 0; with `make_sheet NZ` a .ply that has normals (0, 0, NZ).
make_sheet()
{
  awk 'BEGIN { for (i = 0; i < 3000; ++i) print 2 * ((0.7548776662 * i) % 1) - 1,
    2 * ((0.569840291 * i) % 1) - 1, 0 }' > sheet.xyz
  [ "$#" -gt 0 ] || return 0
  { printf 'ply\nformat ascii 1.0\nelement vertex 3000\n'
    printf 'property float %s\n' x y z nx ny nz
    echo end_header
    sed "s/\$/ 0 0 $1/" sheet.xyz; } > sheet.ply
}

# upwards FILE: the part of the triangles of an .obj that look up.
upwards()
{
  awk '$1 == "v" { ++n; x[n] = $2; y[n] = $3 }
    $1 == "f" { split($2, a, "/"); split($3, b, "/"); split($4, c, "/"); ++all
      up += (x[b[1]] - x[a[1]]) * (y[c[1]] - y[a[1]]) > (y[b[1]] - y[a[1]]) * (x[c[1]] - x[a[1]]) }
    END { print up / all }' "$1"
}

# looks UP BY ARGUMENT...: whether the mesh looks up (1) or down (0), by what the report names.
looks()
{
  local up=$1 by=$2
  shift 2
  expect 0 "$neuralmesh" reconstruct "$@" mesh.obj --vertices 200
  [ "$(upwards mesh.obj)" = "$up" ] || fail "not $up of the triangles look up: $*"
  grep -q "^sides      by $by\$" out || { cat out; fail "the sides are not by $by: $*"; }
  [ ! -s err ] || { cat err; fail "there is something on stderr: $*"; }
}

# Promise: where nothing tells, the report says so; one sheet agrees with itself, and is not warned of.
test_unknown()
{
  make_sheet
  expect 0 "$neuralmesh" reconstruct sheet.xyz mesh.obj --vertices 200
  grep -q '^sides      unknown, most looks up' out || { cat out; fail "the report does not say so"; }
  [ ! -s err ] || { cat err; fail "there is a warning"; }
}

# Promise: the mesh looks up or to the scanner, or as normals in the file do, in place, too.
test_given()
{
  local side
  for side in 1 -1; do
    local up=$(((side + 1) / 2))
    make_sheet $side
    looks $up 'up direction' sheet.xyz --up 0,0.1,$side
    looks $up viewpoints sheet.xyz --viewpoint 0.5,0,${side}e3
    looks $up viewpoints sheet.xyz --viewpoint -0.5,0,${side} --viewpoint 0,-2,${side}
    looks $up viewpoints sheet.ply --viewpoint=-3,0,$side
    looks $up normals sheet.ply
    looks $up normals sheet.ply --normals Normals
    looks $up 'up direction' sheet.ply --normals off --up 0,0,$side
    expect 0 "$neuralmesh" reconstruct sheet.ply mesh.obj --vertices 200 --normals off
    grep -q '^sides      unknown, most looks up' out || { cat out; fail "normals count that are off"; }
    mv mesh.obj off.obj
    sed 's/ 0 0 [-1]*$//; /float n/d' sheet.ply > plain.ply
    expect 0 "$neuralmesh" reconstruct plain.ply mesh.obj --vertices 200
    cmp mesh.obj off.obj || fail "the mesh without use of normals is not that of points without"
    printf '1 1 %s\n0 0 %s\n' ${side} ${side} > stations.xyz
    looks $up viewpoints sheet.xyz --views stations.xyz
  done
}

# Promise: wrong use is told before anything is done.
test_wrong_use()
{
  make_sheet 1
  local place
  for place in 1,2 1,2,3,4 1,2,x nan,0,1 1,inf,2 '' '1, 2,3'; do
    expect 2 "$neuralmesh" reconstruct sheet.xyz mesh.obj --viewpoint "$place"
    grep -q 'three numbers' err || { cat err; fail "not the reason: $place"; }
    [ -z "$place" ] || expect 2 "$neuralmesh" reconstruct sheet.xyz mesh.obj --up "$place"
  done
  expect 2 "$neuralmesh" reconstruct sheet.xyz mesh.obj --up 0,0,0
  grep -q 'no direction' err || { cat err; fail "not the reason"; }
  expect 2 "$neuralmesh" reconstruct sheet.xyz mesh.obj --view-array View
  expect 2 "$neuralmesh" reconstruct sheet.xyz mesh.obj --views sheet.xyz --viewpoint 1,2,3
  expect 1 "$neuralmesh" reconstruct sheet.xyz mesh.obj --views missing.xyz
  grep -q 'missing.xyz' err || { cat err; fail "the message does not name the file"; }
  : > empty.xyz
  expect 1 "$neuralmesh" reconstruct sheet.xyz mesh.obj --views empty.xyz
  expect 1 "$neuralmesh" reconstruct sheet.xyz mesh.obj --viewpoint 0,0,1 --view-array Station
  grep -q 'called Station for the views' err || { cat err; fail "not the reason"; }
  expect 1 "$neuralmesh" reconstruct sheet.ply mesh.obj --normals Directions
  grep -q 'called Directions for the normals. Arrays with three components: Normals\.' err ||
    { cat err; fail "not the reason"; }
  [ ! -e mesh.obj ] || fail "there is a mesh"
}

"test_$2"
