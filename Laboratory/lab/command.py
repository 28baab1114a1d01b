# SPDX-License-Identifier: BSD-3-Clause
"""The command: python3 -m neuralmesh.lab NAME...|all."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from .._command import add_processes_option, run_command
from .._parameters import hint
from ..batch.atomic_file import alone_in, write_text
from .catalogue import EXPERIMENTS
from .experiment import Experiment, Run, Scale
from .models import MODELS, ModelError, absolute, model_name, require_models
from .plots import has_matplotlib
from .progress import ProgressBar
from .report import Result, make_result, verdicts_as_markdown, write_report
from .running import do_runs
from .store import is_done, table_of

_NAMES = "\n".join(f"{name:18} {e.figures}: {e.title}" for name, e in EXPERIMENTS.items())
_EPILOG = f"""\
Experiments:

{_NAMES}

The folder gets for each experiment its values (NAME.csv) and its plots (NAME.png), and for all of
them the report, index.html, one file that can be sent as it is. Each run is stored in runs/ as soon
as it is done, and not done again while its parameters, its model and the version of NeuralMesh are
the same: a command that was ended goes on where it was. To measure anew, remove runs/.

Models are those of the Debian packages glmark2-data and libcgal-demo. Files named instead are
surfaces (.ply .vtp .vtk .obj .stl), which are scanned, or clouds, of which distances are those of
the points to the mesh.

Exit status: 0 all is done, 1 some runs failed, 2 wrong use, 130 after Ctrl-C."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command and return its exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    experiments = _named(options.names, parser)
    return run_command(lambda: _experiment(experiments, options), ModelError)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python3 -m neuralmesh.lab",
        description="Repeat the experiments of the thesis, and say what holds.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("names", nargs="+", metavar="NAME", help="experiments, see below, or all")
    parser.add_argument(
        "--output",
        type=Path,
        default=Path("laboratory"),
        metavar="FOLDER",
        help="where the results go (default: %(default)s)",
    )
    parser.add_argument(
        "--quick", action="store_true", help="small sizes, few seeds: to try it, not to judge by it"
    )
    parser.add_argument(
        "--models", nargs="+", metavar="FILE", help="models instead of those of the packages"
    )
    add_processes_option(parser, "runs")
    return parser


def _named(names: list[str], parser: argparse.ArgumentParser) -> list[Experiment]:
    """The experiments, each once, in the order of the thesis."""
    for name in names:
        if name != "all" and name not in EXPERIMENTS:
            advice = hint(name, EXPERIMENTS) or f"there are {', '.join(EXPERIMENTS)}, all"
            parser.error(f"there is no experiment {name}; {advice}")
    return [e for name, e in EXPERIMENTS.items() if name in names or "all" in names]


def _experiment(experiments: list[Experiment], options: argparse.Namespace) -> int:
    if not has_matplotlib():
        raise OSError("the laboratory draws by matplotlib, which is not there "
                      "(Debian: python3-matplotlib)")  # fmt: skip
    models = tuple(absolute(model) for model in options.models or MODELS)
    scale = Scale(options.quick, models[:2] if options.quick else models)
    cases = {experiment: experiment.cases(scale) for experiment in experiments}
    runs = [case.run for of_one in cases.values() for case in of_one]
    require_models(tuple(dict.fromkeys(run.model for run in runs)))
    folder = options.output.absolute()
    store = folder / "runs"
    store.mkdir(parents=True, exist_ok=True)
    with alone_in(store, "laboratory"):
        failed = _run({run.key: run for run in runs}, store, options.processes)
        results = []
        for experiment, of_one in cases.items():
            is_whole = not any(case.run.key in failed for case in of_one)
            table = table_of(store, of_one)
            results.append(make_result(experiment, table, is_whole, folder))
            print(f"{experiment.name:18} {results[-1].extent}")
        shown = "in its quick form, which is too small to judge by" if scale.is_quick else ""
        names = ", ".join(map(model_name, scale.models))
        write_report(results, folder / "index.html", f"models {names} {shown}".strip())
        print(f"report             {folder / 'index.html'}")
        write_text(folder / "verdicts.md", verdicts_as_markdown(results, _command_line(options)))
    return 1 if failed else 0


def _command_line(options: argparse.Namespace) -> str:
    return " ".join([*options.names, *(["--quick"] if options.quick else [])])


def _run(runs: dict[str, Run], store: Path, processes: int) -> set[str]:
    """Do those that are not done; the keys of those that failed."""
    left = {key: run for key, run in runs.items() if not is_done(store, run)}
    if len(left) < len(runs):
        print(f"{len(runs) - len(left)} of {len(runs)} runs were done before", flush=True)
    bar = ProgressBar(sum(run.cost for run in left.values()), len(left))
    failed = set()

    def on_end(run: Run, error: str) -> None:
        if error:
            failed.add(run.key)
            print(f"\nneuralmesh: {run.model}, {run.parameters}: {error}", file=sys.stderr)
        bar.add(run.cost, f"{model_name(run.model)} {run.vertices}")

    try:
        do_runs(list(left.values()), store, processes, on_end)
    finally:
        bar.end()
    return failed
