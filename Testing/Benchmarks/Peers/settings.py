# SPDX-License-Identifier: BSD-3-Clause
"""Who competes, the settings that each may try for each kind of cloud, and the clouds."""

import functools

import made
import rows

VERTICES = 20000  # no more than a fifth of the points


def depths(*levels, trims=(None,)):
    return [{"depth": depth, **({} if trim is None else {"trim": trim})} for depth in levels for trim in trims]


# Poisson surfaces as they are and cut where points are sparse; depths as the resolution of the cloud allows.
POISSON = {"clean": depths(8, 9), "noisy": depths(7, 8), "thin": depths(8, 9), "open": depths(8, 9, trims=(1,)),
           "small": depths(6, 7, 8, trims=(None, 1, 2))}
# Name in the table: name for peer.py, and settings for kinds of clouds.
PEERS = {
    "Open3D Poisson": ("open3d_poisson", POISSON),
    "Open3D ball pivoting": ("open3d_ball_pivoting", {
        "clean": [{"radius": 1.5}], "noisy": [{"radius": 1.5}, {"radius": 1.0, "average": 3}],
        "thin": [{"radius": 1.5}, {"radius": 1.0, "average": 2}], "open": [{"radius": 1.5}],
        "small": [{"radius": 1.0}, {"radius": 1.5}, {"radius": 2.5}]}),
    "PyMeshLab screened Poisson": ("pymeshlab_poisson", POISSON),
    "PyMeshLab ball pivoting": ("pymeshlab_ball_pivoting", {
        "clean": [{}], "noisy": [], "thin": [], "open": [], "small": [{}]}),
    "PyMeshLab APSS": ("pymeshlab_apss", {
        "clean": [{"resolution": 250, "scale": 4}], "noisy": [{"resolution": 200, "scale": 10}],
        "thin": [{"resolution": 250, "scale": 5}], "open": [{"resolution": 250, "scale": 4}],
        "small": [{"resolution": 100, "scale": 4}, {"resolution": 100, "scale": 8}]}),
    "PyMeshLab RIMLS": ("pymeshlab_rimls", {
        "clean": [{"resolution": 250, "scale": 4}], "noisy": [{"resolution": 200, "scale": 10}],
        "thin": [{"resolution": 250, "scale": 5}], "open": [{"resolution": 250, "scale": 4}],
        "small": [{"resolution": 100, "scale": 4}, {"resolution": 100, "scale": 8}]}),
    "PoissonRecon": ("poisson_recon", POISSON),
    "CGAL advancing front": ("cgal_front", {"clean": [{}], "noisy": [{}], "thin": [{}, {"smooth": 1}],
                                            "open": [{}], "small": [{}]}),
    "CGAL Poisson": ("cgal_poisson", {"clean": [{}], "noisy": [{}], "thin": [{}], "open": [],
                                      "small": [{}]}),
}
OURS = "NeuralMesh"


def armadillo(noisy):
    """200,000 points of the surface; or with noise of 0.5 % and 2 % of outliers."""
    return made.spoilt("armadillo", 0.5, 4000) if noisy else made.sampled(made.model("armadillo"))


# Name: kind of the settings, how it is made.
CLOUDS = {
    "armadillo": ("clean", functools.partial(armadillo, False)),
    "armadillo_noise_outliers": ("noisy", functools.partial(armadillo, True)),
    **{name: (kind, rows.CLOUDS[name].make) for name, kind in (
        ("plate_n01", "thin"), ("open_bunny_15", "open"), ("b9_training", "small"), ("spheres", "small"),
        ("hippo2", "small"), ("oni", "small"))},
}
