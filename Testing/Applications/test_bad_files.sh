#!/usr/bin/env bash
# test_bad_files.sh COMMAND CASE: what `neuralmesh reconstruct` does with files that are not as they
# should be. A run that takes long is stuck, which is a failure.
source "$(dirname "$0")/command_testing.sh"

readable=(ply vtp vtk vtu obj stl off pcd ptx pwn xyz pts txt csv)
writable=(vtp ply obj stl glb off vtk)

# reconstruct INPUT OUTPUT: with a limit of time, and few vertices.
reconstruct() { within_limits "$neuralmesh" reconstruct "$1" "$2" --vertices 100; }

# refused INPUT: status 1, one line that names the file, nothing written.
refused()
{
  expect 1 reconstruct "$1" mesh.ply
  is_one_line_about "$1"
  [ ! -e mesh.ply ] || fail "something was written for $1"
  nothing_left_behind
}

is_one_line_about()
{
  [ "$(wc -l < err)" -eq 1 ] || { cat err; fail "not one line about $1"; }
  grep -q "^neuralmesh: $1" err || { cat err; fail "the message does not name $1"; }
}

nothing_left_behind()
{
  [ -z "$(find . -name '.*mesh*')" ] || { find .; fail "a temporary file was left behind"; }
}

# Promise: what is not there, no file, of another kind or not to be read is refused in one line.
test_no_file()
{
  local extension
  for extension in "${readable[@]}"; do
    refused "missing.$extension"
    ln -s nowhere "dangling.$extension"
    refused "dangling.$extension"
    mkdir "folder.$extension"
    refused "folder.$extension"
    mkfifo "pipe.$extension"
    refused "pipe.$extension"
    ln -s /dev/zero "device.$extension"
    refused "device.$extension"
    # Opening succeeds, even for root; reading fails.
    ln -s /proc/self/mem "unreadable.$extension"
    refused "unreadable.$extension"
  done
  cp cloud.xyz cloud.unknown
  refused cloud.unknown
  cp cloud.xyz cloud
  refused cloud
}

# Promise: so are empty files, garbage, and text where a format has another form.
test_no_points()
{
  local extension
  for extension in "${readable[@]}"; do
    : > "empty.$extension"
    refused "empty.$extension"
    seq 5000 | gzip --no-name > "garbage.$extension"
    refused "garbage.$extension"
    printf 'this is not\na point\n' > "text.$extension"
    refused "text.$extension"
  done
  printf '0 0 0\n1 0 0\n0 x 0\n' > broken.xyz
  refused broken.xyz
  grep -q 'line 3' err || fail "the line is not named"
  head -c 1000000 /dev/zero | tr '\0' x > long.xyz
  refused long.xyz
  [ "$(wc -c < err)" -lt 1000 ] || fail "the message is as long as the file"
}

# Promise: formats that say how much they hold are refused if they end too soon, wherever that is, be it
# as a scan or as a first mesh; so is text that ends within a line.
test_truncated()
{
  local extension size part
  for extension in ply vtp stl off; do
    expect 0 reconstruct cloud.xyz "whole.$extension"
    size=$(stat -c %s "whole.$extension")
    for part in 1 5 20 40 60 80 95; do
      head -c "$((size * part / 100))" "whole.$extension" > "part.$extension"
      refused "part.$extension"
      expect 1 "$neuralmesh" info "part.$extension"
      is_one_line_about "part.$extension"
    done
  done
  { printf 'ply\nformat ascii 1.0\nelement vertex 3000\nproperty double x\nproperty double y\n'
    printf 'property double z\nend_header\n'; cat cloud.xyz; } > whole.ply
  expect 0 reconstruct whole.ply mesh.obj
  for part in 50 2000 70000; do
    head -c "$part" whole.ply > part.ply
    refused part.ply
  done
  sed 's/$/ 255/' cloud.xyz > whole.xyz
  sed 's/ /,/g; s/$/,255/' cloud.xyz > whole.csv
  for extension in xyz csv; do
    head -c 50000 "whole.$extension" > "part.$extension"
  done
  { wc -l < cloud.xyz; head -n 2000 cloud.xyz; } > part.pts
  for extension in xyz csv pts; do
    # As far as the cut falls between the numbers of a line.
    [ "$extension" = pts ] || sed -i '$ s/[^ ,]*$//' "part.$extension"
    refused "part.$extension"
  done
}

# Promise: clouds without any extent, or without a number, are refused; two points are enough.
test_few_points()
{
  echo '1 2 3' > one.xyz
  refused one.xyz
  printf '1 2 3\n%.0s' {1..100} > equal.xyz
  refused equal.xyz
  printf 'nan inf -inf\n%.0s' {1..100} > nan.xyz
  refused nan.xyz
  printf '1 2 3\n2 3 4\n' > two.xyz
  expect 0 reconstruct two.xyz mesh.obj
  grep -q '^neuralmesh: warning: 100 vertices for 2 points' err || fail "there was no warning"
  [ "$(grep -c '^v ' mesh.obj)" -eq 100 ] || fail "not 100 vertices"
  printf 'nan 0 0\n' | cat - cloud.xyz > some.xyz
  expect 0 reconstruct some.xyz mesh.obj
  grep -q '(1 dropped)' out || fail "the dropped point was not counted"
}

# Promise: a mesh with cells and attributes is a cloud as any other.
test_cells_and_attributes()
{
  local extension
  for extension in vtp ply obj stl off vtk; do
    expect 0 reconstruct cloud.xyz "first.$extension"
    expect 0 "$neuralmesh" reconstruct "first.$extension" "second.$extension" --vertices 50
    [ ! -s err ] || { cat err; fail "there is something on stderr"; }
  done
}

# Promise: a file that vanishes, ends or begins while it is read gives a mesh or one line.
test_gone_while_reading()
{
  local extension status
  cp cloud.xyz whole.xyz
  expect 0 reconstruct cloud.xyz whole.ply
  expect 0 reconstruct cloud.xyz whole.vtp
  for extension in xyz ply vtp; do
    # It ends by itself: what a killed loop has just started would go on writing.
    while [ ! -e enough ]; do
      cp "whole.$extension" "input.$extension"
      head -c 2000 "whole.$extension" > "input.$extension"
      rm "input.$extension"
    done &
    for _ in $(seq 25); do
      status=0
      reconstruct "input.$extension" mesh.obj > out 2> err || status=$?
      case $status in
        0) [ "$(grep -c '^v ' mesh.obj)" -eq 100 ] || fail "not 100 vertices" ;;
        1) is_one_line_about "input.$extension" ;;
        *) cat err; fail "status $status" ;;
      esac
    done
    touch enough
    wait $!
    rm enough
  done
}

# Promise: where nothing can be written one line says so, before anything is learnt if that can be
# told, and nothing stays behind.
test_unwritable()
{
  local extension output
  mkdir closed
  chmod 555 closed
  for extension in "${writable[@]}"; do
    mkdir "taken.$extension"
    # Not even root makes files in /proc.
    for output in "nowhere/mesh.$extension" "taken.$extension" "/proc/mesh.$extension" \
      "cloud.xyz/mesh.$extension"; do
      expect 1 reconstruct cloud.xyz "$output"
      is_one_line_about "$output"
      nothing_left_behind
    done
    [ "$(id -u)" -eq 0 ] || expect 1 reconstruct cloud.xyz "closed/mesh.$extension"
  done
  expect 1 within_limits "$neuralmesh" reconstruct cloud.xyz nowhere/mesh.ply --vertices 100000000
  expect 1 reconstruct cloud.xyz mesh.unknown
  is_one_line_about mesh.unknown
  expect 1 reconstruct cloud.xyz mesh
  is_one_line_about mesh
}

# Promise: if writing fails, what was there stays, and nothing else is left behind.
test_disk_full()
{
  local extension
  for extension in "${writable[@]}"; do
    echo "what was there" > "mesh.$extension"
    (
      ulimit -f 16 # blocks of 1 KiB: too few for the mesh
      trap '' XFSZ
      expect 1 "$neuralmesh" reconstruct cloud.xyz "mesh.$extension" --vertices 1500
    ) || fail "a failed write of .$extension was not noticed"
    is_one_line_about "mesh.$extension"
    [ "$(cat "mesh.$extension")" = "what was there" ] || fail "the old .$extension is gone"
    nothing_left_behind
  done
}

# on_small_disk COMMAND...: in a folder `small` with room for 64 KiB. Where users may mount nothing,
# there is no room for larger files instead.
on_small_disk()
{
  if unshare --map-root-user --mount true 2> /dev/null; then
    unshare --map-root-user --mount bash -c \
      'mkdir -p small && mount -t tmpfs -o size=64k none small && "$@"' bash "$@"
  else
    (ulimit -f 16; trap '' XFSZ; mkdir -p small; "$@")
  fi
}

# Promise: on a disk that is full it is the same.
test_full_disk()
{
  local extension
  for extension in "${writable[@]}"; do
    echo "what was there" > old
    export output="small/mesh.$extension" neuralmesh
    expect 1 on_small_disk bash -c 'cp old "$output"
      "$neuralmesh" reconstruct cloud.xyz "$output" --vertices 1500; status=$?
      cmp -s old "$output" || exit 3
      [ -z "$(find small -name ".*mesh*")" ] || exit 4
      exit $status'
    is_one_line_about "$output"
  done
}

# Promise: nothing can be written into a folder that is read-only, for root neither, and that is said
# before anything is learnt.
test_read_only_folder()
{
  local extension
  mkdir locked
  for extension in "${writable[@]}"; do
    echo "what was there" > "locked/mesh.$extension"
    if unshare --map-root-user --mount true 2> /dev/null; then
      export output="locked/mesh.$extension" neuralmesh
      expect 1 within_limits unshare --map-root-user --mount bash -c \
        'mount --bind locked locked && mount -o remount,bind,ro locked &&
          "$neuralmesh" reconstruct cloud.xyz "$output" --vertices 100000000'
    elif [ "$(id -u)" -ne 0 ]; then
      chmod 555 locked
      expect 1 within_limits "$neuralmesh" reconstruct cloud.xyz "locked/mesh.$extension" \
        --vertices 100000000
      chmod 755 locked
    else
      # /proc is a folder into which root cannot write.
      expect 1 reconstruct cloud.xyz "/proc/mesh.$extension"
      continue
    fi
    is_one_line_about "locked/mesh.$extension"
    [ "$(cat "locked/mesh.$extension")" = "what was there" ] || fail "what was there is gone"
  done
}

# Promise: a run that is killed, whenever that is, leaves what was there or a whole new mesh; of the
# files that it may leave beside it, the next run removes those of this name.
test_killed()
{
  local i process begin duration new=0
  reconstruct_large() { "$neuralmesh" reconstruct cloud.xyz "$1" --vertices 3000; }
  begin=$(date +%s%N)
  expect 0 reconstruct_large whole.ply
  duration=$(($(date +%s%N) - begin))
  RANDOM=1
  for i in $(seq 50); do
    echo "what was there" > mesh.ply
    "$neuralmesh" reconstruct cloud.xyz mesh.ply --vertices 3000 > /dev/null 2>&1 &
    process=$!
    # Half of the times within the run, half of them around its end, when it writes.
    awk -v all="$duration" -v part="$RANDOM" -v late="$((i % 2))" 'BEGIN { part /= 32768;
      printf "%.4f\n", all / 1e9 * (late ? 0.9 + 0.2 * part : part) }' | xargs sleep
    kill -KILL "$process" 2> /dev/null || true
    wait "$process" 2> /dev/null || true
    if cmp -s mesh.ply whole.ply; then
      new=$((new + 1))
    else
      [ "$(cat mesh.ply)" = "what was there" ] || fail "half a mesh is left"
    fi
  done
  echo "$new of 50 runs had written their mesh before they were killed"
  # A process that no longer is has left this.
  ( : ) &
  wait $!
  echo "half a mesh" > ".mesh.$(uname -n).$!.ply"
  echo "of another mesh" > ".other.$(uname -n).$!.ply"
  echo "of a running process" > ".mesh.$(uname -n).$$.ply"
  expect 0 reconstruct_large mesh.ply
  [ "$(find . -name '.*mesh.*.ply')" = "./.mesh.$(uname -n).$$.ply" ] ||
    { find .; fail "other temporary files are left than that of a running process"; }
  [ -e ".other.$(uname -n).$!.ply" ] || fail "the file of another mesh is gone"
}

make_cloud
"test_$2"
