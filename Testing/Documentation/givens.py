# SPDX-License-Identifier: BSD-3-Clause
"""What the pages of the documentation take as given: a scan, as files and as variables of Python.

The scan is that of a torus: small, so that all blocks run in a minute; what is asked of meshes here is
that they are made.
"""

import functools
import json

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import neuralmesh

POINTS = 3000
RADIUS, TUBE = 1.0, 0.4


def torus(count, seed=1):
    random = np.random.default_rng(seed)
    around, along = random.uniform(0, 2 * np.pi, (2, count))
    radius = RADIUS + TUBE * np.cos(along)
    return np.column_stack((radius * np.cos(around), radius * np.sin(around), TUBE * np.sin(along)))


def dataset_of(points):
    """A dataset with `Confidence` and `RGB`."""
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points.astype(np.float32), deep=True))
    dataset = vtkPolyData()
    dataset.SetPoints(vtk_points)
    for name, values in (
        ("Confidence", np.linspace(0.1, 1, len(points))),
        ("RGB", (127 * (1 + points / np.abs(points).max())).astype(np.uint8)),
    ):
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        dataset.GetPointData().AddArray(array)
    dataset.GetPointData().SetActiveScalars("RGB")
    return dataset


def write(writer, path, dataset, **options):
    for name, value in options.items():
        getattr(writer, "Set" + name)(value)
    writer.SetFileName(str(path))
    writer.SetInputData(dataset)
    writer.Write()


def coarse_mesh():
    return neuralmesh.reconstruct(torus(POINTS), vertices=300)


def make_files(folder, build, page):
    """The build and the files of the scan, in a copy of the repository."""
    (folder / "build").symlink_to(build)
    scan, coarse = dataset_of(torus(POINTS)), coarse_mesh()
    write(vtkPLYWriter(), folder / "scan.ply", scan, ArrayName="RGB")
    write(vtkXMLPolyDataWriter(), folder / "scan.vtp", scan, DataMode=1)
    (folder / "scan.raw").write_bytes(bytes(512) + torus(POINTS).astype("<f4").tobytes())
    for name in ("coarse", "reference"):
        write(vtkPLYWriter(), folder / f"{name}.ply", coarse)
    # That page has a recipe of its own.
    if page != "Documentation/Guide/CommandLine.md":
        recipe = {"scans": ["scan.ply"], "matrix": {"vertices": 500}, "gallery": False}
        (folder / "jobs.json").write_text(json.dumps(recipe), encoding="utf-8")


def variables():
    """Names that blocks of Python use without saying where they come from."""
    # A few samples will do.
    neuralmesh.compare = functools.partial(neuralmesh.compare, samples=5000)
    points = torus(POINTS)
    dataset = dataset_of(points)
    coarse = coarse_mesh()
    return {
        "neuralmesh": neuralmesh,
        "np": np,
        "vtk_to_numpy": vtk_to_numpy,
        "points": points,
        "dataset": dataset,
        "confidences": np.linspace(0.1, 1, len(points)),
        "coarse": coarse,
        "reference": coarse,
        "scanner": np.array_split(points[np.argsort(points[:, 0])], 3),
        "show": lambda mesh: None,
    }
