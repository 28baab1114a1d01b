# SPDX-License-Identifier: BSD-3-Clause
"""How Sphinx makes the site of the files that make_site.py gathers."""

import pathlib
import sys

import pyvista
from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx import addnodes

SITE = pathlib.Path(__file__).resolve().parent
REPOSITORY = SITE.parent.parent
sys.path.insert(0, str(SITE))  # for pictures.py

project = "NeuralMesh"
html_title = "NeuralMesh"
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["extra"]
suppress_warnings = ["misc.highlighting_failure"]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6  # as GitHub makes them

default_role = "literal"
autodoc_typehints = "none"
autodoc_member_order = "bysource"

html_theme = "furo"
html_static_path = [str(SITE / "static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_copyright = False
html_show_sphinx = False
html_math_renderer = "mathml"

pyvista.OFF_SCREEN = True
pyvista.BUILDING_GALLERY = True  # plots stay open, to be saved
sphinx_gallery_conf = {
    "examples_dirs": str(REPOSITORY / "Documentation" / "Gallery"),
    "gallery_dirs": "Gallery",
    "within_subsection_order": "ExampleTitleSortKey",
    "filename_pattern": r"\.py$",
    "image_scrapers": ("pictures.save_plots",),
    "reset_modules": (),
    "abort_on_example_error": True,
    "download_all_examples": False,
    "notebook_extensions": set(),
    "min_reported_time": 3600,
    "write_computation_times": False,
    "show_memory": False,
    "show_signature": False,
    "remove_config_comments": True,
}


def mend_links(app, doctree):
    """Links to the first page lead to it; to other files that are no part of the site, they are text."""
    page = REPOSITORY / app.env.docname
    for link in list(doctree.findall(addnodes.pending_xref)):
        if link["reftype"] != "myst" or link["refdomain"]:
            continue
        path, _, anchor = link["reftarget"].partition("#")
        target = (page.parent / path).resolve()
        if target == REPOSITORY / "README.md":
            link.update_all_atts({"refdomain": "doc", "reftarget": "index", "reftargetid": anchor}, replace=True)
        elif target.exists():
            link.replace_self(link.children)


def keep_tables(app, what, name, obj, options, lines):
    """A table in a docstring, which is indented behind a colon, keeps its lines; a | stays a |."""
    for number, line in enumerate(lines):
        lines[number] = line.replace("|", r"\|")
        following = lines[number + 2 : number + 3]
        if line.endswith(":") and following and not lines[number + 1] and indent(following[0]) > indent(line):
            lines[number] += ":"


def indent(line):
    return len(line) - len(line.lstrip())


def draw_math(translator, node):
    """What browsers draw by themselves: no script, no fonts."""
    translator.body.append(tex2mathml(node.astext(), as_block=isinstance(node, nodes.math_block)))
    raise nodes.SkipNode


def setup(app):
    app.connect("doctree-read", mend_links)
    app.connect("autodoc-process-docstring", keep_tables, priority=0)  # before napoleon
    app.add_html_math_renderer("mathml", (draw_math, None), (draw_math, None))
