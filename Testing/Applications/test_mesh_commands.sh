#!/usr/bin/env bash
# test_mesh_commands.sh COMMAND CASE: what `neuralmesh compare` and `neuralmesh info` promise to
# those who type them.
source "$(dirname "$0")/command_testing.sh"

# Closed cubes of side 1 and 1.2 around the origin, the left half of the first one without its cut,
# and points without triangles.
make_meshes()
{
  local side name
  for name in cube large; do
    side=$([ "$name" = cube ] && echo 0.5 || echo 0.6)
    awk -v h="$side" 'BEGIN {
      for (i = 0; i < 8; ++i) print "v", i % 2 ? h : -h, int(i / 2) % 2 ? h : -h, int(i / 4) ? h : -h
      print "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6" }' > "$name.obj"
  done
  printf 'v -0.5 -0.5 -0.5\nv -0.5 0.5 -0.5\nv -0.5 0.5 0.5\nv -0.5 -0.5 0.5\nf 1 4 3 2\n' > left.obj
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' > points.obj
}

# Promise: a table with both directions, all figures in units and in percent; the sharp edges, and what is told
# of both directions together.
test_compare_table()
{
  expect 0 "$neuralmesh" compare cube.obj left.obj --samples 2000
  grep -Eq '^reference +cube.obj$' out || fail "the reference is not named"
  grep -Eq '^distance +mean +RMS +99 % +maximum +normals$' out || fail "no heads of columns"
  grep -Eq '^reference to result( +[0-9.e-]+){4} +[0-9.]+ deg$' out || fail "no first direction"
  grep -Eq '^result to reference( +[0-9.e-]+){4} +0.00 deg$' out || fail "no second direction"
  grep -Eq '^ +(0.0000 % *){4}$' out || fail "no percent, or it is not on the reference"
  grep -Eq '^sharp edges +length +to edges +to surface$' out || fail "no edges"
  grep -Eq '^reference to result +12 +nan +0\.[0-9]+$' out || fail "no edges of the reference"
  grep -Eq '^result to reference +0 +nan +nan$' out || fail "no edges of the result"
  grep -Eq '^F-score at 0.1 %: 0.2[0-9]+ \(precision 1.0000, recall 0.1[0-9]+\)$' out || fail "no F-score"
  grep -Eq '^F-score at 0.5 %: 0.[0-9]+ \(precision 1.0000, recall 0.[0-9]+\)$' out || fail "no second F-score"
  grep -Eq '^Chamfer distance [0-9.]+ \([0-9.]+ %\), squared [0-9.]+, of sharp edges nan \(nan %\)$' out ||
    fail "no Chamfer distance"
  grep -Eq '^Normal consistency 0\.[0-9]{4}$' out || fail "no normal consistency"
  grep -q '^Hausdorff distance 1 (57.7350 %)' out || fail "no Hausdorff distance"
  [ ! -s err ] || { cat err; fail "there is something on stderr"; }
  expect 0 "$neuralmesh" compare left.obj left.obj --samples 2000
  grep -Eq '^sharp edges +none$' out || fail "that there are no edges is not told"
}

# Promise: --json gives one object; the figures are right, and the same for the same seed.
test_compare_json()
{
  expect 0 "$neuralmesh" compare cube.obj large.obj --json --samples 20000
  json 'len(lines) == 1 and lines[0]["reference"] == "cube.obj" and lines[0]["seed"] == 1'
  json 'near(lines[0]["reference_diagonal"], 3 ** 0.5)'
  json 'all(near(lines[0]["reference_to_result"][key], 0.1)
            for key in ("mean", "rms", "percentile_99", "maximum"))'
  json 'near(lines[0]["hausdorff"], 0.03 ** 0.5) and near(lines[0]["hausdorff_percent"], 10)'
  json 'all(near(way[key + "_percent"], 100 * way[key] / 3 ** 0.5)
            for way in (lines[0]["reference_to_result"], lines[0]["result_to_reference"])
            for key in ("mean", "rms", "percentile_99", "maximum"))'
  json 'lines[0]["reference_to_result"]["normal_angle"] < 1e-6'
  json 'near(2 * lines[0]["normal_angle"], lines[0]["result_to_reference"]["normal_angle"])'
  json 'lines[0]["chamfer"] == (lines[0]["reference_to_result"]["mean"]
                                + lines[0]["result_to_reference"]["mean"]) / 2'
  json 'near(lines[0]["chamfer_squared"], 0.01 + lines[0]["result_to_reference"]["rms"] ** 2)'
  json 'all(lines[0][key + at] == 0 for key in ("precision", "recall", "f_score") for at in ("_0_1", "_0_5"))'
  json 'near(lines[0]["reference_to_result"]["edge_mean"], 0.02 ** 0.5)'
  json 'near(lines[0]["reference_to_result"]["edge_to_surface"], 0.1)'
  json 'near(lines[0]["result_to_reference"]["edge_length"], 14.4)'
  json 'near(lines[0]["edge_chamfer_percent"], 100 * lines[0]["edge_chamfer"] / 3 ** 0.5)'
  json 'lines[0]["reference_to_result"]["normal_consistency"] == 1 and 0.8 < lines[0]["normal_consistency"] < 1'
  cp out first
  expect 0 "$neuralmesh" compare cube.obj large.obj --json --samples 20000
  cmp out first || fail "the same seed gave other figures"
  expect 0 "$neuralmesh" compare cube.obj large.obj --json --seed 2 --samples 3000
  json 'lines[0]["seed"] == 2 and lines[0]["samples"] == 3000'
  expect 0 "$neuralmesh" compare left.obj left.obj --json --samples 1000
  json 'lines[0]["edge_chamfer"] is None and lines[0]["reference_to_result"]["edge_to_surface"] is None'
  json 'lines[0]["f_score_0_1"] == 1 and lines[0]["reference_to_result"]["edge_length"] == 0'
}

# Promise: exit status 1 and a message that names the file.
test_compare_bad_files()
{
  local bad
  cp cube.obj cube.unknown
  head -c 3000 /dev/urandom > garbage.ply
  printf 'solid\nendsolid\n' > empty.stl
  for bad in points.obj missing.ply cube.unknown garbage.ply empty.stl; do
    expect 1 "$neuralmesh" compare "$bad" cube.obj
    grep -q "$bad" err || { cat err; fail "the message does not name $bad"; }
    expect 1 "$neuralmesh" compare cube.obj "$bad" --json
    grep -q "$bad" err || { cat err; fail "the message does not name $bad"; }
    [ ! -s out ] || fail "there is something on stdout"
  done
  printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' > line.obj
  expect 1 "$neuralmesh" compare cube.obj line.obj
  grep -q 'result has no triangle with an area' err || { cat err; fail "not the reason"; }
}

# Promise: a paragraph for each mesh, with its name and its figures.
test_info_table()
{
  expect 0 "$neuralmesh" info cube.obj left.obj
  [ "$(grep -c '^[^ ]*\.obj$' out)" -eq 2 ] || { cat out; fail "not two meshes"; }
  grep -Eq '^  vertices +8$' out || fail "not 8 vertices"
  grep -Eq '^  closed +no \(4 boundary edges\)$' out || fail "the open mesh is not told"
  grep -Eq '^  genus +0$' out || fail "no genus"
  printf 'v 0 0 0\nv 1 0 0\nf 1 2 2\n' > line.obj
  expect 0 "$neuralmesh" info line.obj
  grep -Eq '^  closed +no \(no triangle of three points\)$' out || { cat out; fail "a line is closed"; }
}

# Promise: --json gives an object for each mesh, on a line of its own.
test_info_json()
{
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 -1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n' > fins.obj
  expect 0 "$neuralmesh" info --json cube.obj left.obj fins.obj
  json 'len(lines) == 3 and [line["file"] for line in lines] == ["cube.obj", "left.obj", "fins.obj"]'
  json 'lines[0]["closed"] is True and lines[0]["genus"] == 0 and lines[0]["components"] == 1'
  json 'lines[0]["triangles"] == 12 and sum(lines[0]["valences"].values()) == 8'
  json 'near(lines[0]["volume"], 1) and near(lines[0]["surface_area"], 6)'
  json 'lines[1]["closed"] is False and lines[1]["boundary_loops"] == 1 and lines[1]["volume"] is None'
  json 'lines[2]["edge_manifold"] is False and lines[2]["genus"] is None'
  printf 'v 0 0 0\nv 1 0 0\nf 1 2 2\n' > line.obj
  expect 0 "$neuralmesh" info --json line.obj
  json 'lines[0]["closed"] is False and lines[0]["components"] == 0'
}

# Promise: a mesh is the same in each format that is read; also corners of .stl become vertices.
test_info_formats()
{
  awk 'BEGIN { for (i = 0; i < 500; ++i) { z = 1 - (2 * i + 1) / 500; r = sqrt(1 - z * z);
    printf "%.9f %.9f %.9f\n", r * cos(2.39996 * i), r * sin(2.39996 * i), z } }' > cloud.xyz
  local extension
  for extension in vtp ply obj stl off vtk; do
    expect 0 "$neuralmesh" reconstruct cloud.xyz "mesh.$extension" --vertices 100 --quiet
  done
  expect 0 "$neuralmesh" info --json mesh.vtp mesh.ply mesh.obj mesh.stl mesh.off mesh.vtk
  json 'all(line["vertices"] == 100 and line["triangles"] == 196 and line["closed"] and
            line["oriented"] and line["genus"] == 0 and line["valences"] == lines[0]["valences"]
            for line in lines)'
}

# Promise: a file that cannot be used is told, exit status 1; the others are reported all the same.
test_info_bad_files()
{
  expect 1 "$neuralmesh" info --json points.obj cube.obj missing.ply
  grep -q 'points.obj: there are no triangles' err || { cat err; fail "points.obj is not told"; }
  grep -q 'missing.ply' err || { cat err; fail "missing.ply is not told"; }
  json 'len(lines) == 1 and lines[0]["file"] == "cube.obj"'
}

# Promise: exit status 2 and a message for wrong use; the help tells the exit statuses.
test_wrong_use()
{
  local arguments
  while read -r arguments; do
    # shellcheck disable=SC2086
    expect 2 "$neuralmesh" $arguments
    [ -s err ] || fail "no message for: $arguments"
  done <<'CASES'
compare
compare cube.obj
compare cube.obj large.obj --samples 10
compare cube.obj large.obj --samples many
compare cube.obj large.obj --seed -1
compare cube.obj large.obj left.obj
info
info cube.obj --samples 10
CASES
  local command
  for command in compare info; do
    expect 0 "$neuralmesh" "$command" --help
    grep -q 'Exit status: 0' out || fail "the help of $command does not tell the exit statuses"
  done
}

make_meshes
"test_$2"
