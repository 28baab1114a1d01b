# SPDX-License-Identifier: BSD-3-Clause
"""What was found: judged, and written as tables, plots and a report."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Iterator

from .. import __version__
from ..batch.atomic_file import write_text
from .experiment import (
    HOLDS,
    NOT_JUDGED,
    Claim,
    Experiment,
    Finding,
    verdict_of,
    with_count,
)
from .models import up_axis
from .plots import draw_meshes, plain
from .table import COLUMNS, Table

_STYLE = """
body { margin: 0 auto; max-width: 1100px; padding: 0 24px 48px; color: #1c2330; background: #fff;
  font: 15px/1.45 system-ui, "DejaVu Sans", sans-serif; }
h1 { margin: 28px 0 0; font-size: 26px; }
h2 { margin: 40px 0 4px; padding-top: 16px; border-top: 1px solid #d5d9e0; font-size: 20px; }
p { margin: 6px 0; }
img { display: block; max-width: 100%; margin: 14px 0; }
table { border-collapse: collapse; margin: 10px 0; font-size: 13px; }
th, td { padding: 4px 14px 4px 0; border-bottom: 1px solid #e6e9ee; text-align: left;
  vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
.verdict { white-space: nowrap; font-weight: bold; }
.holds { color: #1f7a3d; } .part { color: #9a6a00; } .not { color: #b0281a; } .none { color: #778; }
.note { color: #556; }
a { color: #22539c; }
"""
_CLASSES = {"holds": "holds", "holds in part": "part", "does not hold": "not", NOT_JUDGED: "none"}


@dataclass(frozen=True)
class Result:
    """An experiment with its table, what was found for each claim, and what was drawn."""

    experiment: Experiment
    table: Table
    findings: list[Finding | None]
    plots: list[Path]

    @property
    def verdict(self) -> str:
        return verdict_of([_verdict(finding) for finding in self.findings])

    @property
    def extent(self) -> str:
        """The verdict, and how many of the claims hold."""
        if self.verdict == NOT_JUDGED:
            return NOT_JUDGED
        return with_count(self.verdict, [_verdict(finding) == HOLDS for finding in self.findings])


def make_result(experiment: Experiment, table: Table, is_whole: bool, folder: Path) -> Result:
    """Judge the table, if all its runs are done, and write the file of values and the plots."""
    write_text(folder / f"{experiment.name}.csv", table.as_csv())
    if not is_whole:
        return Result(experiment, table, [None] * len(experiment.claims), [])
    findings: list[Finding | None] = [claim.judge(table) for claim in experiment.claims]
    plots = [folder / f"{experiment.name}.png"]
    experiment.plot(table, plots[0])
    shown = list(_shown_meshes(experiment, table))
    if shown:
        plots.append(folder / f"{experiment.name}-meshes.png")
        draw_meshes(shown, plots[1])
    return Result(experiment, table, findings, plots)


def _shown_meshes(experiment: Experiment, table: Table) -> Iterator[tuple[str, str, int]]:
    for title, factors in experiment.pictures.items():
        rows = [row for row in table.where(**factors).rows if row["mesh_file"]]
        if rows:
            yield title, rows[0]["mesh_file"], up_axis(rows[0]["model"])


def _verdict(finding: Finding | None) -> str:
    return finding.verdict if finding else NOT_JUDGED


# --- HTML ----------------------------------------------------------------------------------------


def write_report(results: list[Result], path: Path, scale: str) -> None:
    """One page that needs nothing beside it."""
    rows = "".join(
        f'<tr><td><a href="#{result.experiment.name}">{escape(result.experiment.figures)}</a></td>'
        f"<td>{escape(result.experiment.title)}</td>{_verdict_cell(result.verdict, result.extent)}</tr>"
        for result in results
    )
    body = "".join(map(_section, results))
    write_text(
        path,
        f'<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>NeuralMesh: the laboratory'
        f"</title><style>{_STYLE}</style><h1>The thesis, experiment by experiment</h1>"
        f'<p class="note">NeuralMesh {escape(__version__)}, {escape(scale)}. A claim holds in part '
        "where it holds in some cases (models, say) and not in others; an experiment, where some of "
        "its claims hold. Larger means: by more than the standard error of the difference of the means "
        "over the seeds.</p>"
        f"<table><tr><th>thesis</th><th>experiment</th><th>verdict</th></tr>{rows}</table>"
        f"{body}</html>\n",
    )


def _verdict_cell(verdict: str, shown: str = "") -> str:
    return f'<td class="verdict {_CLASSES[verdict]}">{escape(shown or verdict)}</td>'


def _section(result: Result) -> str:
    experiment = result.experiment
    claims = "".join(
        f"<tr><td>{escape(claim.says)}</td><td>{escape(_words(finding))}</td>"
        f"{_verdict_cell(_verdict(finding), finding.extent if finding else '')}</tr>"
        for claim, finding in zip(experiment.claims, result.findings)
    )
    pictures = "".join(
        f'<img alt="{escape(experiment.title)}" src="data:image/png;base64,'
        f'{base64.b64encode(path.read_bytes()).decode()}">'
        for path in result.plots
    )
    note = f'<p class="note">{escape(experiment.note)}</p>' if experiment.note else ""
    return (
        f'<h2 id="{experiment.name}">{escape(experiment.figures)}: {escape(experiment.title)}</h2>'
        f"<p>{escape(experiment.setting)}</p>"
        f"<table><tr><th>the thesis says</th><th>found</th><th>verdict</th></tr>{claims}</table>"
        f"{note}{pictures}{_summary(experiment, result.table)}"
    )


def _words(finding: Finding | None) -> str:
    return finding.words if finding else "not all runs could be done"


def _summary(experiment: Experiment, table: Table) -> str:
    """Means over the seeds, with their standard errors."""
    heads = [*(plain(name) for name in experiment.groups), "runs"]
    for name in experiment.columns:
        column = COLUMNS[name]
        heads.append(f"{column.title} [{column.unit}]" if column.unit else column.title)
    rows = ""
    for group, part in table.groups(*experiment.groups):
        cells = "".join(f"<td>{escape(plain(str(value)))}</td>" for value in group)
        figures = "".join(
            f'<td class="number">{escape(_mean(part, name))}</td>' for name in experiment.columns
        )
        rows += f'<tr>{cells}<td class="number">{len(part)}</td>{figures}</tr>'
    head = "".join(f"<th>{escape(head)}</th>" for head in heads)
    return f"<table><tr>{head}</tr>{rows}</table>"


def _mean(part: Table, name: str) -> str:
    if not len(part.figures(name)):
        return ""
    text = COLUMNS[name].text(part.mean(name), with_unit=False)
    error = part.error(name)
    return f"{text} ± {COLUMNS[name].text(error, with_unit=False)}" if error else text


# --- Markdown ------------------------------------------------------------------------------------


def verdicts_as_markdown(results: list[Result], arguments: str) -> str:
    """The verdicts alone, as tables; the arguments are those of the command."""
    parts = [
        "# The thesis, experiment by experiment\n",
        f"`python3 -m neuralmesh.lab {arguments}` has written this page. "
        "Documentation/Research/Laboratory.md explains it.\n",
        "| thesis | experiment | verdict |\n|---|---|---|\n",
    ]
    for result in results:
        experiment = result.experiment
        parts[2] += f"| {experiment.figures} | {experiment.title} | {result.extent} |\n"
        lines = [f"## {experiment.figures}: {experiment.title}\n", f"{experiment.setting}\n"]
        lines.append("| the thesis says | found | verdict |\n|---|---|---|")
        for claim, finding in zip(experiment.claims, result.findings):
            lines.append(_markdown_row(claim, finding))
        if experiment.note:
            lines.append(f"\n{experiment.note}")
        parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)


def _markdown_row(claim: Claim, finding: Finding | None) -> str:
    cells = (claim.says, _words(finding), finding.extent if finding else NOT_JUDGED)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
