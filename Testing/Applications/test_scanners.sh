#!/usr/bin/env bash
# test_scanners.sh COMMAND CASE: what `neuralmesh reconstruct` promises of files of scanners, and of
# several files at once.
source "$(dirname "$0")/command_testing.sh"

# sheet BEGIN END: points of a sheet in the plane z = 0, with x from BEGIN to END.
sheet()
{
  awk -v begin="$1" -v end="$2" 'BEGIN { for (i = 0; i < 2000; ++i)
    print begin + (end - begin) * ((0.7548776662 * i) % 1), 2 * ((0.569840291 * i) % 1) - 1, 0 }'
}

# pcd VIEWPOINT: the points of stdin as a .pcd.
pcd()
{
  cat > points
  printf 'VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH %s\n' "$(wc -l < points)"
  printf 'HEIGHT 1\nVIEWPOINT %s\nPOINTS %s\nDATA ascii\n' "$1" "$(wc -l < points)"
  cat points
}

# ptx HEIGHT: the points of stdin as a scan from (0, 0, HEIGHT), with a direction without a return.
ptx()
{
  awk -v height="$1" '{ line[NR] = $1 " " $2 " " $3 - height " 0.5" }
    END { print NR + 1 "\n1\n0 0 " height "\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 " height " 1"
      print "0 0 0 0.5"
      for (i = 1; i <= NR; ++i) print line[i] }'
}

# upwards FILE TEST: the part of the triangles of an .obj that look up, of those with a corner whose x is as
# the test says.
upwards()
{
  awk -v test="$2" '$1 == "v" { ++n; x[n] = $2; y[n] = $3 }
    $1 == "f" { split($2, a, "/"); split($3, b, "/"); split($4, c, "/")
      if (test == "left" && x[a[1]] > 0 || test == "right" && x[a[1]] < 0) next
      ++all
      up += (x[b[1]] - x[a[1]]) * (y[c[1]] - y[a[1]]) > (y[b[1]] - y[a[1]]) * (x[c[1]] - x[a[1]]) }
    END { print up / all }' "$1"
}

# looks LEFT RIGHT BY ARGUMENT...: whether the left and the right part of the mesh look up (1) or down (0).
looks()
{
  local left=$1 right=$2 by=$3
  shift 3
  expect 0 "$neuralmesh" reconstruct "$@" mesh.obj --vertices 300
  grep -q "^sides      $by\(, most looks up.*\)\?\$" out || { cat out; fail "the sides are not '$by': $*"; }
  [ "$(upwards mesh.obj left) $(upwards mesh.obj right)" = "$left $right" ] ||
    fail "$(upwards mesh.obj left) $(upwards mesh.obj right) look up: $*"
}

# Promise: the same points give the same mesh from each format that has no viewpoint.
test_formats()
{
  make_cloud
  local points
  points=$(wc -l < cloud.xyz)
  pcd '0 0 0 1 0 0 0' < cloud.xyz > cloud.pcd
  sed -i 's/^SIZE.*/SIZE 8 8 8/' cloud.pcd
  { printf 'OFF\n%s 0 0\n' "$points"; cat cloud.xyz; } > cloud.off
  expect 0 "$neuralmesh" reconstruct cloud.xyz wanted.ply --vertices 200
  local extension
  for extension in pcd off; do
    expect 0 "$neuralmesh" reconstruct "cloud.$extension" mesh.ply --vertices 200
    cmp wanted.ply mesh.ply || fail ".$extension gave another mesh"
    cp "cloud.$extension" "capitals.${extension^^}"
    expect 0 "$neuralmesh" reconstruct "capitals.${extension^^}" mesh.ply --vertices 200 --quiet
  done
  # Half of the points, twice, is all of them.
  head -n "$((points / 2))" cloud.xyz > first.xyz
  tail -n "+$((points / 2 + 1))" cloud.xyz > second.xyz
  expect 0 "$neuralmesh" reconstruct first.xyz second.xyz mesh.ply --vertices 200
  cmp wanted.ply mesh.ply || fail "two halves gave another mesh"
  # A .pwn has normals, which tell the side.
  { echo "$points"; cat cloud.xyz; sed 's/.*/0 0 1/' cloud.xyz; } > cloud.pwn
  expect 0 "$neuralmesh" reconstruct cloud.pwn mesh.ply --vertices 200
  # As a first mesh, and beside others.
  expect 0 "$neuralmesh" reconstruct cloud.xyz mesh.off --vertices 200
  expect 0 "$neuralmesh" compare wanted.ply mesh.off --samples 1000
  expect 0 "$neuralmesh" explain cloud.xyz mesh.off explained.vtp
  expect 0 "$neuralmesh" reconstruct cloud.xyz finer.ply --initial mesh.off --vertices 300
}

# Promise: the surface looks to the scanner, wherever a file tells it, without being asked.
test_viewpoints()
{
  sheet -1 1 > sheet.xyz
  looks "$(upwards_of_plain)" "$(upwards_of_plain)" unknown sheet.xyz
  local height
  for height in 5 -5; do
    local up=$((height > 0))
    pcd "0 0 $height 1 0 0 0" < sheet.xyz > sheet.pcd
    looks $up $up 'by viewpoints' sheet.pcd
    ptx $height < sheet.xyz > sheet.ptx
    looks $up $up 'by viewpoints' sheet.ptx
  done
  # A depth image knows its camera, and that it saw all points, whatever the file says.
  awk 'BEGIN { for (i = 0; i < 4096; ++i) { x = (i % 64 - 32) / 32; y = (int(i / 64) - 32) / 32
    depth = 3 + 0.1 * x * x * x; print depth * x, depth * y, -depth } }' > image.xyz
  pcd '0 0 0 1 0 0 0' < image.xyz | sed 's/^WIDTH.*/WIDTH 64/; s/^HEIGHT.*/HEIGHT 64/' > image.pcd
  looks 1 1 'by viewpoints' image.pcd
  # What programs write which know none tells nothing.
  pcd '0 0 0 1 0 0 0' < sheet.xyz > sheet.pcd
  looks "$(upwards_of_plain)" "$(upwards_of_plain)" unknown sheet.pcd
}

upwards_of_plain()
{
  "$neuralmesh" reconstruct sheet.xyz plain.obj --vertices 300 > plain.out 2>&1
  upwards plain.obj left
}

# Promise: points of each file, and of each scan of one, look to their own scanner.
test_several_inputs()
{
  # Two sheets beside each other, one seen from above and one from below.
  sheet -3 -1 > left.xyz
  sheet 1 3 > right.xyz
  pcd '-2 0 5 1 0 0 0' < left.xyz > left.pcd
  pcd '2 0 -5 1 0 0 0' < right.xyz > right.pcd
  looks 1 0 'by viewpoints' left.pcd right.pcd
  ptx 5 < left.xyz > left.ptx
  ptx -5 < right.xyz > right.ptx
  cat left.ptx right.ptx > both.ptx
  looks 1 0 'by viewpoints' both.ptx
  looks 1 0 'by viewpoints' left.ptx right.pcd
  grep -q '^points     4000 ' out || { cat out; fail "not the points of both"; }
  expect 0 "$neuralmesh" reconstruct left.xyz right.xyz mesh.obj --vertices 300
  grep -q '^points     4000 ' out || { cat out; fail "not the points of both"; }
  expect 1 "$neuralmesh" reconstruct left.xyz missing.xyz mesh.ply
  grep -q '^neuralmesh: missing.xyz: ' err || { cat err; fail "the message does not name the file"; }
  expect 2 "$neuralmesh" reconstruct left.xyz left.xyz right.ply left.xyz
  expect 2 "$neuralmesh" reconstruct mesh.obj left.xyz mesh.obj
}

# Promise: viewpoints that are given count in place of those of the files: as many as there are files, or
# scans, are one for each; of others it is told by what hides nothing.
test_given_viewpoints()
{
  sheet -3 -1 > left.xyz
  sheet 1 3 > right.xyz
  looks 1 0 'by viewpoints' left.xyz right.xyz --viewpoint=-2,0,5 --viewpoint=2,0,-5
  printf -- '-2 0 -5\n2 0 5\n' > stations.xyz
  looks 0 1 'by viewpoints' left.xyz right.xyz --views stations.xyz
  pcd '-2 0 5 1 0 0 0' < left.xyz > left.pcd
  pcd '2 0 -5 1 0 0 0' < right.xyz > right.pcd
  looks 0 1 'by viewpoints' left.pcd right.pcd --views stations.xyz
  looks 1 1 'by viewpoints' left.pcd right.pcd --viewpoint 0,0,9
  { ptx 5 < left.xyz; ptx -5 < right.xyz; } > both.ptx
  looks 0 1 'by viewpoints' both.ptx --views stations.xyz
  looks 1 1 'by viewpoints' both.ptx --viewpoint 0,0,9
  echo '0 0 9' >> stations.xyz
  expect 0 "$neuralmesh" reconstruct left.pcd right.pcd mesh.obj --vertices 300 --views stations.xyz
}

# Promise: directions without a return are no points, and are counted.
test_no_returns()
{
  sheet -1 1 | ptx 5 > sheet.ptx
  cp sheet.ptx again.ptx
  expect 0 "$neuralmesh" reconstruct sheet.ptx again.ptx mesh.obj --vertices 300
  grep -q '^points     4000 (0 dropped)$' out || { cat out; fail "not 4000 points"; }
  grep -q '^no return  2 ' out || { cat out; fail "not 2 directions"; }
}

# Promise: for files that libraries of Python read the message has the command that converts them.
test_conversions()
{
  local name
  for name in scan.las scan.LAZ "a scan.e57"; do
    echo LASF > "$name"
    expect 1 "$neuralmesh" reconstruct "$name" mesh.ply
    [ "$(wc -l < err)" -eq 1 ] || { cat err; fail "not one line"; }
    grep -q "^neuralmesh: $name: .*neuralmesh\[lidar\].*python3 -c " err || { cat err; fail "no command"; }
    # The shell and Python understand it, as far as the library.
    sed 's/.*, then //' err > convert.sh
    bash -n convert.sh || fail "no command of the shell"
    sed "s/import sys, [a-z0-9]*, [a-z0-9]*/import sys; print(sys.argv[1]); sys.exit(0)/" convert.sh > try.sh
    [ "$(bash try.sh)" = "$name" ] || { cat try.sh; fail "it does not reach Python"; }
  done
}

"test_$2"
