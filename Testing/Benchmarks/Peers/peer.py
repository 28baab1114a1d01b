# SPDX-License-Identifier: BSD-3-Clause
"""Makes a mesh by what others offer: peer.py NAME SETTING CLOUD MESH VERTICES KIND TOOLS.

SETTING is an object in JSON, KIND noisy (outliers are removed before), clean or hard (all pieces of some size
stay). With all the stages that each needs: outlier filter, normals and their orientation, the surface, trimming,
and decimation to the number of vertices. One process a mesh, so that its time and memory can be measured from
outside.
"""

import dataclasses
import json
import subprocess
import sys

import numpy as np

SPECK = 25  # triangles; PyMeshLab's default for pieces to remove


@dataclasses.dataclass
class Job:
    """What is to be made."""

    setting: dict
    cloud: str
    mesh: str
    vertices: int
    kind: str
    tools: str

    def neighbors(self):
        return self.setting.get("neighbors", 50 if self.kind == "noisy" else 20)

    def least_piece(self, triangles):
        """Pieces with fewer triangles are removed: specks, but of one known body all but that body."""
        return SPECK if self.kind == "hard" else triangles // 5

    def limit(self, density):
        """The density of a Poisson surface, in levels of the octree, below which it is cut away."""
        return np.median(density) - self.setting["trim"]

    def triangles_of(self, points, triangles):
        """How many triangles the wanted number of vertices has if a mesh with so many is decimated: two a vertex,
        but fewer along boundaries, whose part grows."""
        excess = triangles - 2 * points
        return 2 * self.vertices + int(excess * np.sqrt(self.vertices / points) if excess < 0 else excess)


def is_inside_out(points, triangles):
    a, b, c = (points[triangles[:, corner]] - points.mean(axis=0) for corner in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) < 0


# Open3D


def open3d_mesh(points, triangles):
    import open3d

    return open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(points), open3d.utility.Vector3iVector(triangles))


def finish_by_open3d(job, mesh, density=None):
    """Without thin parts and pieces, with as many vertices as are asked for, if it has more, and outwards."""
    import open3d

    if "trim" in job.setting:
        mesh.remove_vertices_by_mask(density < job.limit(density))
    mesh.remove_duplicated_vertices()
    mesh.remove_degenerate_triangles()
    labels, sizes, _ = (np.asarray(found) for found in mesh.cluster_connected_triangles())
    mesh.remove_triangles_by_mask(sizes[labels] < job.least_piece(len(mesh.triangles)))
    mesh.remove_unreferenced_vertices()
    if len(mesh.vertices) > job.vertices:
        mesh = mesh.simplify_quadric_decimation(job.triangles_of(len(mesh.vertices), len(mesh.triangles)))
        mesh.remove_unreferenced_vertices()
    triangles = np.asarray(mesh.triangles)
    if is_inside_out(np.asarray(mesh.vertices), triangles):
        mesh.triangles = open3d.utility.Vector3iVector(triangles[:, ::-1].copy())
    open3d.io.write_triangle_mesh(job.mesh, open3d_mesh(mesh.vertices, mesh.triangles))


def open3d_cloud(job):
    import open3d

    cloud = open3d.io.read_point_cloud(job.cloud)
    if job.kind == "noisy":
        cloud, _ = cloud.remove_statistical_outlier(nb_neighbors=20, std_ratio=2.0)
    if "average" in job.setting:  # points in cells of so many spacings become their mean
        cloud = cloud.voxel_down_sample(job.setting["average"] * np.mean(cloud.compute_nearest_neighbor_distance()))
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(job.neighbors()))
    cloud.orient_normals_consistent_tangent_plane(15)
    return cloud


def open3d_poisson(job):
    import open3d

    surface, density = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(
        open3d_cloud(job), depth=job.setting["depth"], n_threads=1)
    finish_by_open3d(job, surface, np.asarray(density))


def open3d_ball_pivoting(job):
    import open3d

    points = open3d_cloud(job)
    spacing = np.mean(points.compute_nearest_neighbor_distance())
    radii = open3d.utility.DoubleVector(spacing * np.array([1.0, 2.0, 4.0]) * job.setting["radius"])
    finish_by_open3d(job, open3d.geometry.TriangleMesh.create_from_point_cloud_ball_pivoting(points, radii))


# PyMeshLab


def pymeshlab_cloud(job):
    import pymeshlab

    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(job.cloud)
    if job.kind == "noisy":
        meshes.compute_selection_point_cloud_outliers(propthreshold=0.8, knearest=32)
        meshes.meshing_remove_selected_vertices()
    meshes.current_mesh().compact()
    meshes.compute_normal_for_point_clouds(k=job.neighbors())
    return meshes


def finish_by_pymeshlab(job, meshes):
    """As by Open3D, by filters of MeshLab."""
    import pymeshlab

    def current():
        return meshes.current_mesh()

    if "trim" in job.setting:
        meshes.compute_selection_by_condition_per_vertex(
            condselect=f"(q < {job.limit(current().vertex_scalar_array())})")
        meshes.meshing_remove_selected_vertices()
    meshes.meshing_remove_connected_component_by_face_number(
        mincomponentsize=max(1, job.least_piece(current().face_number())))
    if current().vertex_number() > job.vertices:
        meshes.meshing_decimation_quadric_edge_collapse(
            targetfacenum=job.triangles_of(current().vertex_number(), current().face_number()))
    points, triangles = current().vertex_matrix(), current().face_matrix()
    if is_inside_out(points, triangles):
        triangles = triangles[:, ::-1]
    result = pymeshlab.MeshSet()
    result.add_mesh(pymeshlab.Mesh(points, triangles))
    result.save_current_mesh(job.mesh, save_vertex_normal=False, save_vertex_quality=False, save_vertex_color=False)


def pymeshlab_poisson(job):
    meshes = pymeshlab_cloud(job)
    meshes.generate_surface_reconstruction_screened_poisson(depth=job.setting["depth"], preclean=True, threads=1)
    finish_by_pymeshlab(job, meshes)


def pymeshlab_ball_pivoting(job):
    meshes = pymeshlab_cloud(job)
    meshes.generate_surface_reconstruction_ball_pivoting()  # with the radius that MeshLab guesses
    finish_by_pymeshlab(job, meshes)


def pymeshlab_moving_least_squares(job, way):
    meshes = pymeshlab_cloud(job)
    getattr(meshes, f"generate_marching_cubes_{way}")(
        resolution=job.setting["resolution"], filterscale=job.setting["scale"])
    finish_by_pymeshlab(job, meshes)


# PoissonRecon, with PyMeshLab's normals and Open3D's decimation


def poisson_recon(job):
    """What is farther from all points than `away` mean spacings is cut away: pypoisson2 gives a density of 1
    everywhere. On one thread, as its threads wait for one another by spinning."""
    import open3d
    from poisson import ParallelType, poisson_reconstruction

    if "normals of Open3D" in job.setting:
        found = open3d_cloud(job)
        cloud, normals = np.asarray(found.points), np.asarray(found.normals)
    else:
        meshes = pymeshlab_cloud(job)
        cloud, normals = meshes.current_mesh().vertex_matrix(), meshes.current_mesh().vertex_normal_matrix()
    points, triangles = poisson_reconstruction(cloud, normals, depth=job.setting["depth"],
                                               parallel_type=ParallelType.NONE)
    mesh = open3d_mesh(points, triangles)
    if "away" in job.setting:
        cloud, found = (open3d.geometry.PointCloud(open3d.utility.Vector3dVector(rows)) for rows in (cloud, points))
        spacing = np.mean(cloud.compute_nearest_neighbor_distance())
        mesh.remove_vertices_by_mask(
            np.asarray(found.compute_point_cloud_distance(cloud)) > job.setting["away"] * spacing)
    finish_by_open3d(job, mesh)


# CGAL, with Open3D's decimation


def cgal(job, way):
    import open3d

    raw = job.mesh + ".off"
    smooth = "noisy" if job.kind == "noisy" or job.setting.get("smooth") else "clean"
    subprocess.run([f"{job.tools}/CgalSurface", way, job.cloud, raw, smooth], check=True)
    finish_by_open3d(job, open3d.io.read_triangle_mesh(raw))


MAKERS = {
    "open3d_poisson": open3d_poisson,
    "open3d_ball_pivoting": open3d_ball_pivoting,
    "pymeshlab_poisson": pymeshlab_poisson,
    "pymeshlab_ball_pivoting": pymeshlab_ball_pivoting,
    "pymeshlab_apss": lambda job: pymeshlab_moving_least_squares(job, "apss"),
    "pymeshlab_rimls": lambda job: pymeshlab_moving_least_squares(job, "rimls"),
    "poisson_recon": poisson_recon,
    "cgal_front": lambda job: cgal(job, "front"),
    "cgal_poisson": lambda job: cgal(job, "poisson"),
}


def main():
    name, setting, cloud, mesh, vertices, kind, tools = sys.argv[1:]
    MAKERS[name](Job(json.loads(setting), cloud, mesh, int(vertices), kind, tools))


if __name__ == "__main__":
    main()
