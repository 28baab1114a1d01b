# SPDX-License-Identifier: BSD-3-Clause
"""stream(): the mesh follows points that arrive; the example runs."""

import json
import math
import os
import pathlib
import subprocess
import unittest

import neuralmesh
import numpy as np
import support
from neuralmesh._parameters import snake_case
from neuralmesh._stream import PARAMETERS

EXAMPLE = pathlib.Path(__file__).parents[2] / "Documentation" / "Examples" / "turning_scanner.py"


def in_parts(cloud, parts=3, **parameters):
    """A stream to which the cloud came in slices along z, lowest first."""
    stream = neuralmesh.stream(300, **parameters)
    for part in np.array_split(cloud[np.argsort(cloud[:, 2])], parts):
        stream.add_points(part)
        stream.learn(10000)
    return stream


LIST = pathlib.Path(__file__).parents[2] / "Filters" / "Parameters.json"
# What a stream is learnt with: conditions of all that has another one cannot be met.
LEARNT_WITH = {"Order is Exact", "TopologyLearning is off", "ComputeFeatureStrength is off"}


def counts(entry):
    """Whether a parameter of the list can count for a stream."""
    decided = {c for c in entry.get("when", []) if c.split()[0] in {c.split()[0] for c in LEARNT_WITH}}
    return "NoiseFiltering" in entry.get("variants", ["NoiseFiltering"]) and decided <= LEARNT_WITH


class Streams(unittest.TestCase):
    # Promise: stream() takes, of the parameters of all classes, those that can count for it, and names
    # the others.
    def test_parameters(self):
        groups = json.loads(LIST.read_text(encoding="utf-8"))["groups"]
        entries = [e for group in groups for e in group["parameters"] if "class" not in e]
        fixed = {"Variant", "Order", "TopologyLearning", "ComputeFeatureStrength", "CurvatureDensity"}
        wanted = {snake_case(e["name"]) for e in entries if counts(e) and e["name"] not in fixed}
        self.assertEqual(set(PARAMETERS), wanted)
        for name in ("topology_patience", "jump", "list_vertices", "curvature_density"):
            with self.assertRaisesRegex(TypeError, name):
                neuralmesh.stream(**{name: 1})

    # Promise: numbers of samples are integers above 0, however they are written, seconds above 0; None
    # is the default.
    def test_samples(self):
        stream = neuralmesh.stream(300)
        stream.add_points(support.sphere(2000))
        for samples in (1.5, 0, -1, float("nan"), "5", True, [5]):
            with self.assertRaisesRegex(ValueError, "samples must be an integer above 0"):
                stream.learn(samples)
        for seconds in (0, -1, float("nan"), "5", True):
            with self.assertRaisesRegex(ValueError, "seconds must be a number above 0"):
                stream.learn(seconds=seconds)
        self.assertEqual(stream.learn(5000.0), 5000)
        self.assertEqual(stream.learn(None), 60 * 300 + 150000)

    # Promise: a finished mesh is measured, also if it is not fitted; then the noise is not known.
    def test_unfitted(self):
        stream = neuralmesh.stream(300, fit_rounds=0)
        stream.add_points(support.sphere(2000))
        stream.learn()
        fields = stream.mesh().GetFieldData()
        for name in ("Residual", "OutlierShare", "Components", "Genus", "BoundaryLoops"):
            self.assertTrue(math.isfinite(fields.GetArray(name).GetValue(0)), name)
        self.assertTrue(math.isnan(fields.GetArray("Noise").GetValue(0)))
        self.assertIsNone(stream.mesh(finish=False).GetFieldData().GetArray("Residual"))

    # Promise: points are added as arrays or datasets, samples are learnt, and the mesh has all that
    # came; the same calls give the same bytes, whether somebody looks on or not.
    def test_mesh_follows(self):
        cloud = support.sphere(6000)
        stream = in_parts(cloud)
        self.assertEqual((stream.points, stream.samples > 0), (6000, True))
        stream.add_points(support.point_set(cloud))
        stream.learn()
        self.assertEqual(stream.points, 12000)
        mesh = stream.mesh()
        self.assertEqual((mesh.GetNumberOfPoints(), stream.vertices), (300, 300))
        self.assertTrue(support.is_closed_manifold(mesh))
        heights = support.coordinates(mesh)[:, 2]
        self.assertLess(heights.min(), -0.9)
        self.assertGreater(heights.max(), 0.9)

        again = in_parts(cloud)
        again.mesh()
        again.mesh(finish=False)
        again.add_points(cloud)
        again.learn()
        self.assertEqual(support.arrays_of(again.mesh()), support.arrays_of(mesh))
        other = in_parts(cloud, seed=2)
        other.add_points(cloud)
        other.learn()
        self.assertNotEqual(support.arrays_of(other.mesh()), support.arrays_of(mesh))

    # Promise: a part that comes later has the mesh begun anew, as the first ones do not reach it.
    def test_begins_anew(self):
        cloud = support.sphere(20000)
        stream = neuralmesh.stream(300)
        stream.add_points(cloud[cloud[:, 2] < 0.3])
        stream.learn()
        self.assertEqual(stream.beginnings, 1)
        stream.add_points(cloud[cloud[:, 2] >= 0.3])
        stream.learn()
        self.assertEqual(stream.beginnings, 2)
        stream.learn()
        self.assertEqual(stream.beginnings, 2)

    # Promise: as long as there is too little for a mesh, none comes and nothing is learnt.
    def test_too_few_points(self):
        stream = neuralmesh.stream(300)
        self.assertEqual(stream.mesh().GetNumberOfPoints(), 0)
        stream.add_points(support.sphere(50))
        self.assertEqual(stream.learn(1000), 0)
        stream.add_points(np.full((200, 3), np.nan))
        self.assertEqual(stream.learn(1000), 0)
        self.assertEqual((stream.points, stream.mesh().GetNumberOfPoints()), (50, 0))

    # Promise: learning can be ended by time and by progress.
    def test_ends(self):
        stream = in_parts(support.sphere(6000))
        self.assertGreater(stream.learn(seconds=0.05), 0)
        self.assertLess(stream.learn(10**9, progress=lambda fraction: False), 10**9)

    # Promise: what is wrong is an error that tells what would be right.
    def test_errors(self):
        for parameters, message in (
            ({"vertices": 3}, "vertices must be an integer from 4"),
            ({"reservoir": 10}, "reservoir must be an integer from 100"),
            ({"winner_rate": 2}, "winner_rate must be a number from 0 to 1"),
        ):
            with self.assertRaisesRegex(ValueError, message):
                neuralmesh.stream(**parameters)
        with self.assertRaisesRegex(TypeError, "winner_rate"):
            neuralmesh.stream(winer_rate=1)
        stream = neuralmesh.stream()
        with self.assertRaisesRegex(ValueError, "points must be"):
            stream.add_points([1, 2, 3])
        with self.assertRaisesRegex(ValueError, "above 0"):
            stream.learn(0)
        with self.assertRaisesRegex(ValueError, "exclude"):
            stream.learn(5, seconds=1)

    # Promise: the example of the documentation runs, and its mesh becomes whole.
    def test_example(self):
        result = subprocess.run(
            [os.environ["NEURALMESH_TEST_PYTHON"], str(EXAMPLE)],
            capture_output=True, text=True, timeout=support.HANGING, check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        areas = [float(line.split()[-2]) for line in result.stdout.splitlines()[1:-1]]
        self.assertEqual(len(areas), 12)
        self.assertLess(areas[0], 50)
        self.assertGreater(areas[-1], 95)
        self.assertRegex(result.stdout, "finished: 4000 vertices, 1 piece, genus 1, 0 boundaries")


if __name__ == "__main__":
    unittest.main()
