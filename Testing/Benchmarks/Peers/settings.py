# SPDX-License-Identifier: BSD-3-Clause
"""Who competes, the settings that each may try for each kind of cloud, and the clouds."""

import functools

import made
import rows

VERTICES = 20000  # no more than a fifth of the points


def depths(*levels, trims=(None,)):
    return [{"depth": depth, **({} if trim is None else {"trim": trim})} for depth in levels for trim in trims]


# Where layers are close to each other, fewer neighbours may tell more.
THIN = [{"depth": 9}, {"depth": 9, "trim": 1}, {"depth": 9, "neighbors": 8}]
# Poisson surfaces as they are, and cut where points are sparse; depths as the resolution of the cloud allows.
POISSON = {"clean": depths(8, 9), "dense": depths(8, 9), "rough": depths(7, 8), "noisy": depths(7), "thin": THIN,
           "open": depths(8, trims=(None, 1)),
           "small": depths(7, 8, trims=(None, 1))}
# Of moving least squares. Cells must be small beside the spacing, or the surface falls apart; a wider neighbourhood
# smooths more. Rough is with noise that is less than the spacing, and without outliers; dense has 200,000 points.
LEAST_SQUARES = [{"resolution": 250, "scale": 4}, {"resolution": 300, "scale": 6}]
ROUGH_LEAST_SQUARES = [{"resolution": 200, "scale": 3}, {"resolution": 200, "scale": 4},
                       {"resolution": 200, "scale": 6}]
# Name in the table: name for peer.py, and settings for kinds of clouds.
PEERS = {
    "Open3D Poisson": ("open3d_poisson", POISSON),
    "Open3D ball pivoting": ("open3d_ball_pivoting", {
        "clean": [{"radius": 1.5}], "dense": [{"radius": 1.5}],
        "rough": [{"radius": 1.5}, {"radius": 1.0, "average": 2}],
        "noisy": [{"radius": 1.0, "average": 3}, {"radius": 1.0, "average": 8}],
        "thin": [{"radius": 1.5}, {"radius": 1.5, "neighbors": 8}], "open": [{"radius": 1.5}],
        "small": [{"radius": 1.5}, {"radius": 2.5}]}),
    "PyMeshLab screened Poisson": ("pymeshlab_poisson", POISSON),
    "PyMeshLab ball pivoting": ("pymeshlab_ball_pivoting", {
        # For 200,000 points it takes more than two minutes.
        "clean": [{}], "dense": [], "rough": [{}], "noisy": [], "thin": [{}], "open": [{}], "small": [{}]}),
    "PyMeshLab APSS": ("pymeshlab_apss", {
        "clean": LEAST_SQUARES, "dense": [*LEAST_SQUARES, {"resolution": 450, "scale": 6}],
        "rough": ROUGH_LEAST_SQUARES, "noisy": [{"resolution": 200, "scale": 5}],
        "thin": [{"resolution": 250, "scale": 4, "neighbors": 8}], "open": [{"resolution": 200, "scale": 4}],
        "small": [{"resolution": 100, "scale": 4}, {"resolution": 100, "scale": 8}]}),
    "PyMeshLab RIMLS": ("pymeshlab_rimls", {
        "clean": LEAST_SQUARES, "dense": [*LEAST_SQUARES, {"resolution": 450, "scale": 6}],
        "rough": ROUGH_LEAST_SQUARES, "noisy": [{"resolution": 200, "scale": 5}],
        "thin": [{"resolution": 250, "scale": 4, "neighbors": 8}], "open": [{"resolution": 200, "scale": 4}],
        "small": [{"resolution": 100, "scale": 4}, {"resolution": 100, "scale": 8}]}),
    "PoissonRecon": ("poisson_recon", {
        "clean": depths(8, 9), "dense": depths(8, 9), "rough": depths(7, 8),
        "noisy": [*depths(7, 8), {"depth": 7, "normals of Open3D": True}],
        "thin": [{"depth": 9}, {"depth": 9, "away": 4}, {"depth": 9, "neighbors": 8}],
        "open": [{"depth": 8}, {"depth": 8, "away": 4}],
        "small": [*depths(7, 8), {"depth": 7, "away": 4}, {"depth": 8, "away": 4}]}),
    "CGAL advancing front": ("cgal_front", {
        "clean": [{}], "dense": [{}], "rough": [{}, {"smooth": True}], "noisy": [{}],
        "thin": [{}, {"smooth": True}], "open": [{}], "small": [{}]}),
    "CGAL Poisson": ("cgal_poisson", {
        "clean": [{}], "dense": [{}], "rough": [{}, {"smooth": True}], "noisy": [{}], "thin": [{}],
        "open": [], "small": []}),
}
OURS = "NeuralMesh"


def armadillo(noisy):
    """200,000 points of the surface; or with noise of 0.5 % and 2 % of outliers."""
    return made.spoilt("armadillo", 0.5, 4000) if noisy else made.sampled(made.model("armadillo"))


def quarter(name):
    """Every fourth point of a cloud of the battery, whose points are in no order."""
    return quarter_of(rows.CLOUDS[name].make())


def rough_fandisk():
    """With noise of 0.1 %, as in Documentation/Research/Fit.md; every fourth point."""
    return quarter_of(made.sampled(made.model("fandisk"), noise=0.1))


def quarter_of(made_whole):
    return {**made_whole, "points": made_whole["points"][::4]}


# Name: kind of the settings, how it is made.
CLOUDS = {
    "armadillo": ("dense", functools.partial(armadillo, False)),
    "armadillo_noise_outliers": ("noisy", functools.partial(armadillo, True)),
    "plate_n01_quarter": ("thin", functools.partial(quarter, "plate_n01")),
    "coupling_quarter": ("clean", functools.partial(quarter, "coupling")),
    "fandisk_quarter": ("clean", functools.partial(quarter, "fandisk")),
    "fandisk_n01_quarter": ("rough", rough_fandisk),
    "open_bunny_15_quarter": ("open", functools.partial(quarter, "open_bunny_15")),
    **{name: ("small", rows.CLOUDS[name].make) for name in ("b9_training", "spheres", "hippo2", "oni")},
}
