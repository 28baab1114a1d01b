# SPDX-License-Identifier: BSD-3-Clause
"""Makes a mesh by what others offer: peer.py NAME CLOUD MESH VERTICES noisy|clean TOOLS.

With all the stages that each needs: outlier filter (noisy clouds), normals and their orientation,
the surface, and decimation to the number of vertices. One process a mesh, so that its time and
memory can be measured from outside.
"""

import subprocess
import sys


def read_cloud(path, noisy):
    import open3d

    cloud = open3d.io.read_point_cloud(path)
    if noisy:
        cloud, _ = cloud.remove_statistical_outlier(nb_neighbors=20, std_ratio=2.0)
    return cloud


def with_normals(cloud):
    cloud.estimate_normals()
    cloud.orient_normals_consistent_tangent_plane(30)
    return cloud


def decimated(mesh, vertices):
    """The largest piece, with as many vertices as are asked for, if it has more."""
    import numpy as np

    mesh.remove_duplicated_vertices()
    mesh.remove_degenerate_triangles()
    labels, sizes, _ = mesh.cluster_connected_triangles()
    mesh.remove_triangles_by_mask(np.asarray(sizes)[np.asarray(labels)] < max(sizes))
    mesh.remove_unreferenced_vertices()
    if len(mesh.vertices) > vertices:
        excess = len(mesh.triangles) - 2 * len(mesh.vertices)
        mesh = mesh.simplify_quadric_decimation(2 * vertices + excess)
        mesh.remove_unreferenced_vertices()
    return mesh


def poisson(cloud, mesh, vertices, noisy, depth):
    import open3d

    points = with_normals(read_cloud(cloud, noisy))
    surface, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(points, depth=depth)
    open3d.io.write_triangle_mesh(mesh, decimated(surface, vertices))


def ball_pivoting(cloud, mesh, vertices, noisy):
    import numpy as np
    import open3d

    points = with_normals(read_cloud(cloud, noisy))
    spacing = np.mean(points.compute_nearest_neighbor_distance())
    radii = open3d.utility.DoubleVector(spacing * np.array([1.5, 3.0, 6.0]))
    surface = open3d.geometry.TriangleMesh.create_from_point_cloud_ball_pivoting(points, radii)
    open3d.io.write_triangle_mesh(mesh, decimated(surface, vertices))


def cgal(cloud, mesh, vertices, noisy, tools, kind):
    import open3d

    raw = mesh + ".off"
    subprocess.run([f"{tools}/CgalSurface", kind, cloud, raw, "noisy" if noisy else "clean"], check=True)
    open3d.io.write_triangle_mesh(mesh, decimated(open3d.io.read_triangle_mesh(raw), vertices))


def plain_vtk(cloud, mesh, vertices, noisy):
    """Normals by principal components, signed distance, its zero surface, quadric decimation."""
    from vtkmodules.vtkFiltersCore import vtkPolyDataConnectivityFilter, vtkQuadricDecimation
    from vtkmodules.vtkFiltersPoints import (
        vtkExtractSurface,
        vtkPCANormalEstimation,
        vtkSignedDistance,
        vtkStatisticalOutlierRemoval,
    )
    from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter

    reader = vtkPLYReader()
    reader.SetFileName(cloud)
    reader.Update()
    points = reader
    if noisy:
        points = vtkStatisticalOutlierRemoval()
        points.SetInputConnection(reader.GetOutputPort())
        points.SetStandardDeviationFactor(2.0)
        points.Update()
    bounds = points.GetOutput().GetBounds()
    resolution = 256
    longest = max(bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3))
    radius = longest / resolution * (6 if noisy else 3)
    normals = vtkPCANormalEstimation()
    normals.SetInputConnection(points.GetOutputPort())
    normals.SetSampleSize(30)
    normals.SetNormalOrientationToGraphTraversal()
    normals.FlipNormalsOn()
    distance = vtkSignedDistance()
    distance.SetInputConnection(normals.GetOutputPort())
    distance.SetRadius(radius)
    distance.SetBounds(*(bounds[i] + (2 * radius if i % 2 else -2 * radius) for i in range(6)))
    distance.SetDimensions(*(
        int((bounds[2 * axis + 1] - bounds[2 * axis] + 4 * radius) / longest * resolution) + 1
        for axis in range(3)))
    surface = vtkExtractSurface()
    surface.SetInputConnection(distance.GetOutputPort())
    surface.SetRadius(0.99 * radius)
    largest = vtkPolyDataConnectivityFilter()
    largest.SetInputConnection(surface.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    largest.Update()
    decimation = vtkQuadricDecimation()
    decimation.SetInputConnection(largest.GetOutputPort())
    triangles = largest.GetOutput().GetNumberOfPolys()
    decimation.SetTargetReduction(max(0.0, 1.0 - 2.0 * vertices / max(1, triangles)))
    writer = vtkPLYWriter()
    writer.SetInputConnection(decimation.GetOutputPort())
    writer.SetFileName(mesh)
    writer.Write()


def main():
    name, cloud, mesh, vertices, kind, tools = sys.argv[1:]
    vertices, noisy = int(vertices), kind == "noisy"
    if name.startswith("poisson"):
        poisson(cloud, mesh, vertices, noisy, int(name[len("poisson"):]))
    elif name == "ball_pivoting":
        ball_pivoting(cloud, mesh, vertices, noisy)
    elif name == "vtk":
        plain_vtk(cloud, mesh, vertices, noisy)
    else:
        cgal(cloud, mesh, vertices, noisy, tools, {"cgal_front": "front", "cgal_poisson": "poisson"}[name])


if __name__ == "__main__":
    main()
