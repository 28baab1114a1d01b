# SPDX-License-Identifier: BSD-3-Clause
"""Looks after it that the classes meet their own VTK: with another one they would crash."""


def require_vtk(version: str) -> None:
    """Raise ImportError unless the package vtkmodules of this process has the version."""
    try:
        from vtkmodules.vtkCommonCore import vtkVersion
    except ImportError as error:
        raise ImportError(
            f"neuralmesh needs VTK {version}, but the package vtkmodules cannot be imported "
            f"({error}). Install it (on Debian: python3-paraview or python3-vtk9), or add its "
            "folder to PYTHONPATH."
        ) from error
    found = vtkVersion.GetVTKVersion()
    if found != version:
        import vtkmodules

        raise ImportError(
            f"neuralmesh was built with VTK {version}, but the VTK of this process is {found}, "
            f"from {vtkmodules.__file__}. Put the vtkmodules of VTK {version} first on "
            f"PYTHONPATH, or build neuralmesh with VTK {found}."
        )
