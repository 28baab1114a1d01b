# SPDX-License-Identifier: BSD-3-Clause
"""Views of ParaView beside each other in one picture."""

from paraview import simple


def save_beside(views, size, path):
    """A picture of so many pixels, in which all views are as wide."""
    layout = simple.CreateLayout("panels")
    place = 0
    for number, view in enumerate(views):
        if number + 1 < len(views):
            place = layout.SplitHorizontal(place, 1.0 / (len(views) - number))
        layout.AssignView(place, view)
        place += 1
    layout.SetSize(*size)
    simple.SaveScreenshot(path, layout, ImageResolution=size, CompressionLevel=9, SeparatorWidth=0,
                          OverrideColorPalette="WhiteBackground")


def delete_views():
    """Views that are left to the end of the process end it with an error of X."""
    for view in simple.GetViews():
        simple.Delete(view)
