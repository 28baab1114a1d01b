# SPDX-License-Identifier: BSD-3-Clause
"""What PyVista draws on a page of the gallery: a picture, and a page with the scene in 3D."""

import io
import pathlib

import pyvista
from sphinx_gallery.scrapers import figure_rst
from trame_vtk.tools.vtksz2html import write_html

ICONS = "https://kitware.github.io/vtk-js/icon/"
VIEW = """
.. raw:: html

   <details class="view"><summary>Turn it in 3D</summary>
   <iframe src="../{path}" title="The scene of the picture above in 3D: drag to turn it" loading="lazy"></iframe>
   </details>

"""


def save_plots(block, block_vars, gallery_conf):
    """Saves the plots of a block of a script, as Sphinx-Gallery asks for; the text for its page."""
    sources = pathlib.Path(gallery_conf["src_dir"])
    views = sources / "extra" / "views"
    views.mkdir(parents=True, exist_ok=True)
    text = ""
    for plotter in pyvista.plotting.plotter._ALL_PLOTTERS.values():
        picture = pathlib.Path(next(block_vars["image_path_iterator"]))
        plotter.screenshot(picture)
        view = views / f"{picture.stem}.html"
        page = io.StringIO()
        write_html(plotter.last_vtksz, page)
        # Its icons would come from the network.
        view.write_text(page.getvalue().replace(ICONS, "data:,"), encoding="utf-8")
        text += figure_rst([str(picture)], str(sources)) + VIEW.format(path=view.relative_to(views.parent))
    pyvista.close_all()
    return text
