# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and clouds as numpy arrays, from files and into them."""

import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOPLY import vtkPLYReader

TYPES = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2",
         "ushort": "u2", "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
         "float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}


def read_points(path):
    """The points of a .ply, in the precision of the file, or those of a text file or .obj."""
    if path.endswith(".obj"):
        with open(path, encoding="ascii") as file:
            return np.array([line.split()[1:4] for line in file if line.startswith("v ")], float)
    if not path.endswith(".ply"):
        return np.loadtxt(path, usecols=(0, 1, 2), ndmin=2)
    with open(path, "rb") as file:
        header = []
        while header[-1:] != [["end_header"]]:
            line = file.readline()
            if not line:
                raise ValueError(f"{path}: no header of a .ply")
            header.append(line.decode("latin-1").split())
        start = next(i for i, words in enumerate(header) if words[:2] == ["element", "vertex"])
        fields = []
        for words in header[start + 1:]:
            if words[:1] != ["property"]:
                break
            fields.append((words[2], TYPES[words[1]]))
        count = int(header[start][2])
        names = [name for name, _ in fields]
        form = next(words[1] for words in header if words[:1] == ["format"])
        if form == "ascii":
            return np.loadtxt(file, usecols=[names.index(axis) for axis in "xyz"], max_rows=count, ndmin=2)
        row = np.dtype(fields).newbyteorder("<" if form == "binary_little_endian" else ">")
        rows = np.frombuffer(file.read(count * row.itemsize), row)
    return np.column_stack([rows[axis] for axis in "xyz"]).astype(float)


def poly_data(points, triangles):
    """Both as data of VTK, in double precision."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    cells = vtkCellArray()
    offsets = np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64)
    cells.SetData(numpy_to_vtk(offsets, deep=True),
                  numpy_to_vtk(np.ascontiguousarray(triangles, np.int64).ravel(), deep=True))
    data.SetPolys(cells)
    return data


def read_mesh(path):
    """The points and triangles of a .ply or .obj."""
    if not os.path.exists(path):
        raise FileNotFoundError(path)
    reader = vtkPLYReader() if path.endswith(".ply") else vtkOBJReader()
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())
    if len(triangles) != 3 * mesh.GetNumberOfPolys():
        raise ValueError(f"{path}: not only triangles")
    # VTK makes floats of doubles.
    points = read_points(path) if path.endswith(".ply") else vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    return points, triangles.reshape(-1, 3).astype(int)


def write_mesh(path, points, triangles):
    """Writes a binary .ply of floats."""
    rows = np.empty(len(triangles), [("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, triangles
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\n" % len(points))
        file.write(b"property float x\nproperty float y\nproperty float z\n")
        file.write(b"element face %d\nproperty list uchar int vertex_indices\nend_header\n" % len(triangles))
        file.write(points.astype("<f4").tobytes() + rows.tobytes())
