# SPDX-License-Identifier: BSD-3-Clause
"""The command: python3 -m neuralmesh batch jobs.json, or neuralmesh batch jobs.json."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Any, Sequence

from .. import __version__
from .._command import add_processes_option, run_command
from .gallery import write_gallery
from .meshes import DEFAULT_FORMAT
from .recipe import NOT_IN_RECIPES, Job, Recipe, RecipeError, read_recipe
from .report import is_done, require_distinct, summary_path, warnings_of, write_summary
from .running import run_jobs
from .atomic_file import alone_in
from .words import tags_of

_EPILOG = f"""\
A recipe is JSON. Only its key `scans` is required:

  {{
    "scans": ["scans/*.ply", "bunny.obj"],
    "matrix": {{"vertices": [5000, 20000], "seed": [1, 2], "variant": "noise"}},
    "format": "{DEFAULT_FORMAT}",
    "time_limit": 3600,
    "gallery": true,
    "view": {{"up": "y", "azimuth": 30, "elevation": 15}}
  }}

scans    files of points, relative to the recipe, with wildcards or without:
         .ply .obj .stl .off .pcd .ptx .pwn .xyz .pts .txt .csv .asc, with VTK .vtp .vtk .vtu
matrix   parameters of neuralmesh.reconstruct(), except
         {", ".join(NOT_IN_RECIPES)}.
         A list holds the values to try, and all lists are crossed. first_mesh is a path, relative
         to the recipe. levels is a list of numbers, or a list of such lists to try
format   of the meshes: vtp (default with VTK), ply (default without), obj, stl, glb, off or vtk
shift    vector that is subtracted from their coordinates and stored in them: [X, Y, Z], or "auto"
         for a round vector if they are too large for floats (default: none)
time_limit
         seconds after which a job is ended and has failed (default: none). In the matrix it ends
         learning, and the mesh is kept
gallery  whether there is a gallery (default: true)
strict   whether the command ends with status 3 if a mesh has warnings (default: false), as with
         --strict. Meshes are written in any case
view     of the pictures: the axis that points upwards, and the direction of view in degrees

The folder gets a mesh and a report (.json) for each job, and summary.csv and the gallery,
index.html, for all. The mesh is the largest level; the others are beside it (JOB_1000.vtp). A job
does not run again if its result exists and nothing has changed: its scan (size and time of
modification), its parameters, the format, and the version of NeuralMesh. Results of jobs that are
no longer in the recipe stay.
Each warning has a tag: a heading of Documentation/Guide/Failures.md. summary.csv has the tags.

Exit status: 0 all jobs are done, 1 some failed, 2 wrong use or a bad recipe, 3 all are done, some
with warnings, and the recipe or the command is strict, 130 after Ctrl-C, 143 after SIGTERM.
Finished results stay, and the same command does the rest."""
_SUMMARY = "reconstruct many scans by one recipe"
_TEXTS: dict[str, Any] = {
    "description": "Reconstruct many scans by one recipe: each with each set of parameters, each in "
    "its own process.",
    "epilog": _EPILOG,
    "formatter_class": argparse.RawDescriptionHelpFormatter,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run python3 -m neuralmesh, whose only command is batch; the exit status."""
    parser = argparse.ArgumentParser(
        prog="python3 -m neuralmesh", description="The commands of NeuralMesh that are Python."
    )
    parser.add_argument("--version", action="version", version=__version__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    batch = commands.add_parser("batch", help=_SUMMARY, **_TEXTS)
    _add_arguments(batch)
    options, unknown = parser.parse_known_args(arguments)
    if unknown:
        # The error of parse_args() would show the usage without the options.
        batch.error(f"unrecognized arguments: {' '.join(unknown)}")
    return _run_parsed(options)


def run(arguments: Sequence[str]) -> int:
    """Run the subcommand batch; the exit status."""
    parser = argparse.ArgumentParser(prog="neuralmesh batch", **_TEXTS)
    _add_arguments(parser)
    return _run_parsed(parser.parse_args(arguments))


def _add_arguments(batch: argparse.ArgumentParser) -> None:
    batch.add_argument("recipe", type=Path, metavar="RECIPE", help="the .json file, see below")
    batch.add_argument(
        "--output",
        type=Path,
        metavar="FOLDER",
        help="folder of the results (default: jobs-results beside jobs.json)",
    )
    add_processes_option(batch, "jobs")
    batch.add_argument(
        "--strict", action="store_true", help="end with status 3 if a mesh has warnings"
    )


def _run_parsed(options: argparse.Namespace) -> int:
    return run_command(
        lambda: _batch(options.recipe, options.output, options.processes, options.strict),
        RecipeError,
    )


def _batch(recipe_path: Path, output: Path | None, processes: int, is_strict: bool) -> int:
    recipe = read_recipe(recipe_path)
    folder = (output or recipe_path.parent / f"{recipe_path.stem}-results").absolute()
    require_distinct(recipe_path, recipe, folder)
    folder.mkdir(parents=True, exist_ok=True)
    with alone_in(folder, "batch"):
        failed = _run(recipe, folder, processes)
        warned = sum(bool(warnings_of(folder, job)) for job in recipe.jobs)
        with_warnings = f", {warned} with warnings" if warned else ""
        # First, as a full disk may take no summary and no gallery.
        done = len(recipe.jobs) - failed
        print(f"jobs       {done} done, {failed} failed{with_warnings}", flush=True)
        write_summary(folder, recipe)
        print(f"summary    {summary_path(folder)}", flush=True)
        if recipe.gallery:
            for problem in write_gallery(folder, recipe, recipe_path.stem):
                print(f"neuralmesh: {problem}", file=sys.stderr)
            print(f"gallery    {folder / 'index.html'}")
    if failed:
        return 1
    return 3 if (is_strict or recipe.is_strict) and warned else 0


def _run(recipe: Recipe, folder: Path, processes: int) -> int:
    """Run the jobs that are not done; how many of them failed."""
    jobs = [job for job in recipe.jobs if not is_done(folder, job, recipe.format)]
    ended = len(recipe.jobs) - len(jobs)
    if ended:
        print(f"{ended} of {len(recipe.jobs)} jobs were done before", flush=True)
    failed = 0
    # On a terminal, or in one file, nothing is to be read twice.
    is_seen_once = _is_one_file()

    def on_end(job: Job, error: str) -> None:
        nonlocal ended, failed
        ended += 1
        failed += bool(error)
        line = f"[{ended}/{len(recipe.jobs)}] {job.name}: {error or _done(folder, job)}"
        print(line, flush=True)
        if error and not is_seen_once:
            print(f"neuralmesh: {job.name}: {error}", file=sys.stderr, flush=True)

    run_jobs(jobs, folder, recipe.format, processes, recipe.time_limit, on_end)
    return failed


def _done(folder: Path, job: Job) -> str:
    warnings = warnings_of(folder, job)
    if not warnings:
        return "done"
    count = len(warnings)
    return f"done, {count} warning{'s' * (count > 1)}: {tags_of(warnings)}"


def _is_one_file() -> bool:
    """Whether the output and the errors go to the same place."""
    try:
        return os.path.sameopenfile(sys.stdout.fileno(), sys.stderr.fileno())
    except (OSError, ValueError):  # no files at all, or closed
        return False
