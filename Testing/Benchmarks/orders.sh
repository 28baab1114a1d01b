#!/usr/bin/env bash
# Prints how whole runs differ by the order of activity: exact counters, and the activity list with
# jumps of n/3 and n/10. Two models of Debian packages, three seeds each. A few minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
source Utilities/build.sh

install_packages "${build_packages[@]}" libcgal-demo glmark2-data
build build neuralmesh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# VTK reads no .off.
tar -xzOf /usr/share/doc/libcgal-dev/data.tar.gz data/meshes/armadillo.off |
  awk 'NR == 2 { vertices = $1 } NR > 2 && NF == 3 { print "v", $0 }
    NR > 2 && NF > 3 { print "f", $2 + 1, $3 + 1, $4 + 1 }' > "$folder/armadillo.obj"
cp /usr/share/glmark2/models/bunny.obj "$folder/bunny.obj"

/usr/bin/python3 - build/bin/neuralmesh "$folder" << 'END'
import json, resource, subprocess, sys

command, folder = sys.argv[1:]
VERTICES, SEEDS = 10000, (1, 2, 3)


def run(*arguments):
    """Runs the command; returns its output and the processor time that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    output = subprocess.run([command, *arguments], check=True, capture_output=True, text=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return output, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


# Learning by itself is measured.
ALONE = ["--set", "Start=tetrahedron", "--set", "FitRounds=0"]


def measure(model, options):
    """Mean over the seeds: seconds, RMS and maximum in % of the diagonal, regular vertices in %."""
    scan, mesh = f"{folder}/{model}.obj", f"{folder}/mesh.ply"
    sums = [0.0] * 4
    for seed in SEEDS:
        _, seconds = run("reconstruct", scan, mesh, "--vertices", str(VERTICES), "--seed", str(seed),
                         "--quiet", *options)
        distances = json.loads(run("compare", scan, mesh, "--json", "--samples", "20000")[0])
        regular = json.loads(run("info", mesh, "--json")[0])["regular_ratio"]
        distances = distances["reference_to_result"]
        figures = (seconds, distances["rms_percent"], distances["maximum_percent"], 100 * regular)
        sums = [a + b / len(SEEDS) for a, b in zip(sums, figures)]
    return sums


print(f"{VERTICES} vertices, mean of {len(SEEDS)} seeds; distances from scan to mesh, % of diagonal\n")
print("| model | preset | method | order | CPU s | RMS | maximum | regular |")
print("|---|---|---|---|--:|--:|--:|--:|")
for model in "bunny", "armadillo":
    for preset in "default", "thesis":
        for method in ("noise",) if preset == "default" else ("noise", "basic"):
            for name, options in (("exact", ["--order", "exact"]),
                                  ("list, n/3", ["--order", "list"]),
                                  ("list, n/10", ["--order", "list", "--set", "JumpFraction=0.1"])):
                seconds, rms, maximum, regular = measure(
                    model, ["--preset", preset, "--method", method, *ALONE, *options])
                print(f"| {model} | {preset} | {method} | {name} | {seconds:.2f} | {rms:.3f} "
                      f"| {maximum:.2f} | {regular:.1f} % |", flush=True)
END
