# SPDX-License-Identifier: BSD-3-Clause
"""The rows of the battery: which clouds, and what is to be reached on them."""

import dataclasses
import functools
from typing import Callable, Optional

import made

# Figures that must be met exactly, or be at least so large; the others, at most.
EXACTLY = {"pieces", "genus", "loops", "islands", "ears"}
AT_LEAST = {"main"}

VERTICES = 20000


@dataclasses.dataclass
class Cloud:
    """A line of the table. Without `make`, the cloud is not to be had but in the folder that the user names, under
    its name or that of `file`, with the reference of this name, or under its own with `_reference`.

    With `relative`, the goals are what an earlier build reaches, as means over the seeds, times these factors; what
    is to be met exactly is to be the same with the same seeds."""

    name: str
    row: str
    make: Optional[Callable[[], dict]]
    goals: dict
    reference: Optional[str] = None
    vertices: Optional[int] = None
    options: tuple = ()
    file: str = ""
    relative: bool = False

    def __post_init__(self):
        self.file = self.file or self.name


def scans():
    yield Cloud("scan_bunny_r01", "scan_bunny", functools.partial(made.scanned, "bunny", 10, 0.1),
                {"pieces": 1, "inside": 2, "seen": 0.030, "seen99": 0.15, "crossings": 0, "torn": 0},
                "bunny_pmp_reference")
    yield Cloud("scan_armadillo_r025", "scan_armadillo", functools.partial(made.scanned, "armadillo", 14, 0.25),
                {"seen": 0.070, "seen99": 0.27, "inside": 1}, "armadillo_reference")


def openings():
    right = {"pieces": 1, "loops": 1, "inside": 1, "seen": 0.010}
    for degrees in (15, 30, 45, 60, 75, 90):
        yield Cloud(f"open_sphere_{degrees}", "open_spheres", functools.partial(made.open_sphere, degrees), right)
    for percent, tilt in ((8, 0), (15, 0), (25, 0), (8, 15), (15, -15), (25, 25)):
        yield Cloud(f"open_bunny_{percent}" + (f"_tilted_{tilt}" if tilt else ""), "open_bunnies",
                    functools.partial(made.open_bunny, percent, tilt), right, "bunny_pmp_reference")
    for percent in (1, 2, 4):
        yield Cloud(f"open_bunny_{percent}", "bitten_bunnies", functools.partial(made.open_bunny, percent),
                    {"main": 90, "inside": 1, "far": 0}, "bunny_pmp_reference")


def thin():
    for percent in (0.3, 0.6, 1.2, 2.4, 4.8):
        for noise, mean in ((0, 0.006), (0.05, 0.03)):
            yield Cloud(f"box_{percent}" + ("_noise" if noise else ""), "boxes",
                        lambda percent=percent, noise=noise: made.sampled(made.shapes.box(percent), noise=noise),
                        {"pieces": 1, "genus": 0, "loops": 0, "crossings": 0, "mean": mean})
    for name, shape, genus, mean in (("plate", made.shapes.plate, 2, 0.05), ("chair", made.shapes.chair, 10, 0.03)):
        yield Cloud(f"{name}_n01", name, lambda shape=shape: made.sampled(shape(), noise=0.1),
                    {"genus": genus, "crossings": 0, "mean": mean, "hausdorff": 0.5}, f"{name}_reference")
    for name, cgal, genus, mean, most in (("fandisk", "fandisk", 0, 0.0014, 0.35),
                                          ("coupling", "couplingdown", 9, 0.0032, 0.30)):
        yield Cloud(name, "sharp", lambda cgal=cgal: made.sampled(made.model(cgal)),
                    {"pieces": 1, "genus": genus, "loops": 0, "mean": mean, "hausdorff": most})


def uneven():
    for ratio in (1, 10, 30, 100, 300):
        yield Cloud(f"density_{ratio}", "density", functools.partial(made.density, ratio), {"tenth": 0.5})
    yield Cloud("islands", "density", made.islands, {"islands": 4})


def real():
    def goals(missed):
        return {"missed": missed, "invented": 2, "crossings": 0, "slivers": 0.2}

    yield Cloud("kinect", "real", None, goals(0.2))
    yield Cloud("room", "real", None, goals(0.5))
    yield Cloud("building", "real", functools.partial(made.from_cgal, "building.ply"), goals(0.4))
    for file, missed in (("b9_training.ply", 1), ("spheres.ply", 0), ("oni.ply", 0.3), ("point_set_3.xyz", 2),
                         ("hippo1.ply", 1), ("hippo2.ply", 1)):
        yield Cloud(file.split(".")[0], "real", functools.partial(made.from_cgal, file), goals(missed))


def coarse():
    for vertices in (200, 800):
        yield Cloud(f"bunny_{vertices}", "coarse", made.small_bunny, {"ears": 2, "missed": 3}, vertices=vertices)


def fit():
    """The rows of Documentation/Research/Fit.md."""
    close = ("--boundaries", "close")
    for file, make, reference, options in (
            ("bunny_200k", lambda: made.sampled(made.model("bunny")), "bunny_pmp", ()),
            ("armadillo_200k", lambda: made.sampled(made.model("armadillo")), "armadillo", ()),
            ("knot_200k", lambda: made.sampled(made.model("knot1")), "knot", ()),
            ("duckhandle_200k", None, "duckhandle", ()),
            ("bunny_200k_noise", lambda: made.spoilt("bunny", 0.5), "bunny_pmp", ()),
            ("bunny_200k_noise_outl", lambda: made.spoilt("bunny", 0.5, 4000), "bunny_pmp", ()),
            ("bunny_200k_holes", lambda: made.spoilt("bunny", holes=8, radius=3), "bunny_pmp", ()),
            ("bunny_200k_holes", lambda: made.spoilt("bunny", holes=8, radius=3), "bunny_pmp", close),
            ("bunny_rawscan", None, "bunny_pmp", close),
            ("terrain_200k", made.terrain, "terrain", ()),
            ("bunny_view_200k", made.one_view, "bunny_view", ())):
        yield Cloud(file + ("_close" if options else ""), "fit", make,
                    {"pieces": 1, "genus": 1, "loops": 1,
                     "mean": 1.02, "rms": 1.02, "normals": 1.02, "hausdorff": 1.15},
                    f"{reference}_reference", options=options, file=file, relative=True)


def small():
    """For a test: some thousand points, and goals that leave room."""
    yield Cloud("small_sphere", "small", lambda: made.open_sphere(45, 20000),
                {"pieces": 1, "loops": 1, "seen": 0.05})
    yield Cloud("small_islands", "small", lambda: made.islands(100000),
                {"missed": 5, "invented": 2, "far": 0.1, "main": 75, "crossings": 0})
    yield Cloud("small_box", "small", lambda: made.sampled(made.shapes.box(4.8), 20000),
                {"pieces": 1, "genus": 0, "loops": 0, "mean": 0.02, "hausdorff": 2, "crossings": 0})


CLOUDS = {cloud.name: cloud for row in (scans, openings, thin, uneven, real, coarse, fit, small) for cloud in row()}
