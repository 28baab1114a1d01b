#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A scanner turns around an object, and the mesh follows: turning_scanner.py [MESH.vtp]

Prints what there is after each view, and writes the mesh in the end.
"""

import math
import sys

import neuralmesh
from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSuperquadricSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

VIEWS = 12
VERTICES = 4000


def make_object():
    """A ring with flat sides."""
    ring = vtkSuperquadricSource()
    ring.ToroidalOn()
    ring.SetThickness(0.4)
    ring.SetPhiRoundness(0.5)
    ring.SetThetaResolution(128)
    ring.SetPhiResolution(128)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(ring.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def make_scanner(surface):
    scanner = neuralmesh.vtkNeuralMeshScan()
    scanner.SetInputData(surface)
    scanner.SetNumberOfPoints(20000)
    scanner.SetNoise(0.001)
    scanner.OcclusionOn()
    return scanner


def look(scanner, view):
    """The points that the scanner sees from there: it rises and sinks as it turns."""
    angle = 2 * math.pi * view / VIEWS
    height = 2 if view % 2 else -2
    scanner.SetViewpoint(2 * math.cos(angle), height, 2 * math.sin(angle))
    scanner.SetSeed(view)
    scanner.Update()
    return scanner.GetOutput()


def area(mesh):
    properties = vtkMassProperties()
    properties.SetInputData(mesh)
    return properties.GetSurfaceArea()


def value(mesh, name):
    return mesh.GetFieldData().GetArray(name).GetValue(0)


def main():
    surface = make_object()
    scanner = make_scanner(surface)
    stream = neuralmesh.stream(VERTICES, reservoir=100000)
    print("view   points  vertices  begun  area of the object")
    for view in range(VIEWS):
        stream.add_points(look(scanner, view))
        stream.learn(30 * VERTICES)
        mesh = stream.mesh(finish=False)
        print(f"{view + 1:4} {stream.points:8} {stream.vertices:9} {stream.beginnings:6} "
              f"{100 * area(mesh) / area(surface):9.1f} %")

    stream.learn()
    mesh = stream.mesh()
    print(f"finished: {mesh.GetNumberOfPoints()} vertices, {value(mesh, 'Components')} piece, "
          f"genus {value(mesh, 'Genus')}, {value(mesh, 'BoundaryLoops')} boundaries, "
          f"{100 * area(mesh) / area(surface):.1f} % of the area, residual {value(mesh, 'Residual'):.4f}")
    if len(sys.argv) > 1:
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(sys.argv[1])
        writer.SetInputData(mesh)
        writer.Write()


if __name__ == "__main__":
    main()
