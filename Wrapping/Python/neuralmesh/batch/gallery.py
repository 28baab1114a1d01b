# SPDX-License-Identifier: BSD-3-Clause
"""The gallery: a page with a picture, figures and a 3D view of each result; it needs no server."""

from __future__ import annotations

import json
import string
from html import escape
from pathlib import Path
from typing import Any, Iterable, Iterator
from urllib.parse import quote

from .._sides import sides_text
from .meshes import read_points
from .page_mesh import page_mesh
from .pictures import draw_pictures
from .recipe import Job, Recipe
from .report import read_report, result_path
from .atomic_file import atomic_file, write_text
from .words import heading_of, tag_of, without_tag

_PAGE = Path(__file__).with_name("page")
_VIEWER = ("vtk.js", "vtk.js.LICENSE")
_CURES = (
    "<p>Warnings stand behind their headings in <em>Failures and cures</em> of the guide "
    "(Documentation/Guide/Failures.md).</p>\n"
)
# What is said of a mesh at once, and what to those who ask, by the names in its report.
_FIGURES = {
    "residual": "residual",
    "noise": "noise",
    "components": "pieces",
    "genus": "genus",
    "boundary_loops": "boundaries",
}
_MORE_FIGURES = {
    "triangle_quality": "triangle quality",
    "regular_ratio": "regular vertices",
    "folded_edges": "folded edges",
    "intersecting_triangles": "intersecting triangles",
    "outlier_share": "too far off to count",
    "dropped_points": "dropped points",
    "stop_reason": "ended by",
}


def write_gallery(folder: Path, recipe: Recipe, title: str) -> list[str]:
    """Write index.html and what it shows; what is not as it should be, if anything."""
    parts = folder / "gallery"
    parts.mkdir(exist_ok=True)
    has_viewer = (_PAGE / "vtk.js").is_file()
    for name in ("gallery.css", "viewer.js", *(_VIEWER if has_viewer else ())):
        with atomic_file(parts / name) as temporary:
            temporary.write_bytes((_PAGE / name).read_bytes())
    reports = {job: read_report(folder, job.name) for job in recipe.jobs}
    done = [job for job in recipe.jobs if reports[job].get("status") == "done"]
    problems = [] if has_viewer else ["no 3D views: this package was built without vtk.js"]

    meshes = {}
    for job in done:
        meshes[job.name] = result_path(folder, job.name, recipe.format)
        for level in job.smaller_levels:
            name = job.level_name(level)
            meshes[name] = result_path(folder, name, recipe.format)
    if has_viewer:
        for name, mesh in meshes.items():
            path = parts / f"{name}.js"
            if _is_older(path, mesh):
                write_text(path, page_mesh(name, read_points(mesh)))
    problem = _draw(meshes, parts, recipe.view)
    if problem:
        problems.append(problem)

    failed = len(recipe.jobs) - len(done)
    warned = sum(bool(reports[job].get("warnings")) for job in done)
    with_warnings = f", {warned} with warnings" if warned else ""
    template = string.Template((_PAGE / "index.html").read_text(encoding="utf-8"))
    page = template.substitute(
        title=escape(title),
        jobs=f"{len(recipe.jobs)} jobs: {len(done)} done, {failed} failed{with_warnings}",
        cures=_CURES if warned else "",
        problems="".join(f'<p class="problem">{escape(problem)}</p>\n' for problem in problems),
        sections="".join(_sections(reports, parts, recipe, has_viewer)),
        scripts='<script src="gallery/viewer.js"></script>' if has_viewer else "",
        view=escape(json.dumps(recipe.view)),
    )
    write_text(folder / "index.html", page)
    return problems


def _draw(meshes: dict[str, Path], parts: Path, view: dict[str, Any]) -> str:
    """Draw the pictures that are missing, are older than their meshes or show another view."""
    view_path = parts / "view.json"
    view_text = json.dumps(view)
    is_same = view_path.exists() and view_path.read_text(encoding="utf-8") == view_text
    pictures = [(mesh, parts / f"{name}.png") for name, mesh in meshes.items()]
    problem = draw_pictures(
        [(mesh, path) for mesh, path in pictures if not is_same or _is_older(path, mesh)], view
    )
    if not problem:
        write_text(view_path, view_text)
    return problem


def _is_older(path: Path, source: Path) -> bool:
    return not path.exists() or path.stat().st_mtime_ns < source.stat().st_mtime_ns


def _sections(
    reports: dict[Job, dict], parts: Path, recipe: Recipe, has_viewer: bool
) -> Iterator[str]:
    """A section for each scan, a card for each of its jobs."""
    for scan in dict.fromkeys(job.scan for job in reports):
        yield f'<section>\n<h2 title="{escape(str(scan))}">{escape(scan.name)}</h2>\n'
        for job, report in reports.items():
            if job.scan == scan:
                yield from _cards(job, report, parts, recipe, has_viewer)
        yield "</section>\n"


def _cards(
    job: Job, report: dict, parts: Path, recipe: Recipe, has_viewer: bool
) -> Iterator[str]:
    """A card for the job, and one for each of its smaller levels."""
    parameters = ", ".join(f"{name} {_plain(job.parameters[name])}" for name in job.parameters)
    title = escape(parameters or "defaults")
    report_link = f'<a href="{escape(quote(job.name))}.json">report</a>'
    if report.get("status") != "done":
        error = escape(report.get("error", "there is no report"))
        text = f"<h3>{title}</h3>\n<pre>{error}</pre>\n<p>{report_link}</p>"
        yield f'<article class="failed">\n{text}\n</article>\n'
        return
    shown = [(job.name, title, report, [*_figures(report)], _warnings(report["warnings"]))]
    for level, told in zip(job.smaller_levels, report.get("levels", [])):
        figures = [*_figures_of_mesh(told), ("made with", job.name)]
        shown.append((job.level_name(level), f"level of {level}", told, figures, ""))
    for name, heading, told, figures, warnings in shown:
        picture = _picture(name, parts, has_viewer)
        result = escape(quote(told["result"]["file"]))
        links = f'<a href="{result}">{recipe.format}</a> {report_link}'
        yield (
            f'<article id="card-{escape(name)}" data-name="{escape(name)}">\n{picture}\n'
            f"<h3>{heading}</h3>\n{_table(figures)}{warnings}<details><summary>more</summary>\n"
            f'{_table(_chosen(told["quality"], _MORE_FIGURES))}</details>\n'
            f"<p>{links}</p>\n</article>\n"
        )


def _picture(name: str, parts: Path, has_viewer: bool) -> str:
    """The picture of a mesh, behind which is its 3D view."""
    address = escape(quote(name))
    picture = (
        f'<img src="gallery/{address}.png" alt="{escape(name)}" loading="lazy">'
        if (parts / f"{name}.png").exists()
        else "<span>no picture</span>"
    )
    return (
        f'<a class="view" href="#{address}" title="3D view">{picture}</a>' if has_viewer else picture
    )


def _figures(report: dict[str, Any]) -> Iterator[tuple[str, str]]:
    yield "points", f"{report['result']['points']:,}"
    yield from _figures_of_mesh(report)
    yield "time", f"{sum(report['seconds'].values()):.2f} s"


def _figures_of_mesh(told: dict[str, Any]) -> Iterator[tuple[str, str]]:
    yield "vertices", f"{told['result']['vertices']:,}"
    yield "triangles", f"{told['result']['triangles']:,}"
    quality = told["quality"]
    yield from _chosen(quality, _FIGURES)
    if "oriented_by" in quality:
        yield "sides", sides_text(
            quality["oriented_by"], quality["unoriented_share"], quality["guessed_share"]
        )


def _chosen(quality: dict[str, Any], labels: dict[str, str]) -> Iterator[tuple[str, str]]:
    return ((label, _plain(quality[name])) for name, label in labels.items() if name in quality)


def _table(rows: Iterable[tuple[str, str]]) -> str:
    lines = (f"<tr><th>{escape(label)}</th><td>{escape(text)}</td></tr>\n" for label, text in rows)
    return f"<table>\n{''.join(lines)}</table>\n"


def _warnings(texts: list[str]) -> str:
    """The warnings, each behind the heading under which its causes and cures are."""
    lines = (
        f"<li><strong>{escape(heading_of(tag_of(text)))}</strong>: {escape(without_tag(text))}</li>\n"
        for text in texts
    )
    return f'<ul class="warnings">\n{"".join(lines)}</ul>\n' if texts else ""


def _plain(value: Any) -> str:
    if value is None:
        return "unknown"
    return f"{value:.4g}" if isinstance(value, float) else str(value)
