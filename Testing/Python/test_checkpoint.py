# SPDX-License-Identifier: BSD-3-Clause
"""Runs that go on from a checkpoint."""

import pathlib
import tempfile
import unittest

import neuralmesh
import support
from neuralmesh._parameters import Choice, Number, parameters_of
from neuralmesh import vtkNeuralMesh

# On which the mesh does not depend, or only by the points; the others are refused before they would
# count.
# Of `automatic` the values that are chosen are compared.
FREE = {"automatic", "compute_uncertainty", "use_normals", "time_limit", "carry_point_data", "output_points_precision",
        "checkpoint_interval", "feature_angle", "keep_checkpoint", "number_of_threads", "maximum_points",
        "tolerance_is_percent", "tolerance_measure"}
REFUSED_BEFORE = {"compute_feature_lines", "explain_points", "growth_as_time", "number_of_snapshots", "preset", "jump",
                  "input_is", "tolerance"}


def reconstruct(**parameters):
    return neuralmesh.reconstruct(support.sphere(2000), **{"vertices": 300, **parameters})


class Checkpoints(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "run.checkpoint"

    # Promise: a call that was ended by an exception goes on to the same bytes, and removes the file.
    def test_goes_on(self):
        def interrupt(fraction):
            if fraction > 0.25:
                raise KeyboardInterrupt

        unbroken = support.arrays_of(reconstruct())
        with self.assertRaises(KeyboardInterrupt):
            reconstruct(checkpoint=self.path, checkpoint_interval=0, progress=interrupt)
        self.assertTrue(self.path.is_file())
        mesh = reconstruct(checkpoint=str(self.path))
        self.assertEqual(support.arrays_of(mesh), unbroken)
        self.assertFalse(self.path.exists())

    # Promise: every property on which the mesh depends is compared, and named if it differs.
    def test_other_parameters(self):
        reconstruct(checkpoint=self.path, keep_checkpoint=True)
        compared = set(parameters_of(vtkNeuralMesh)) - FREE - REFUSED_BEFORE
        self.assertGreater(len(compared), 45)
        for name in sorted(compared):
            parameter = parameters_of(vtkNeuralMesh)[name]
            if isinstance(parameter, Choice):
                value = next(value for value in parameter.setters if value != parameter.default)
                shown = name.title().replace("_", "")
            elif isinstance(parameter, Number):
                values = (5, 6) if parameter.integral else (parameter.minimum, parameter.maximum)
                value = next(value for value in values if value != parameter.default)
                shown = parameter.setter[3:]
            else:
                value = not parameter.default
                shown = parameter.setter[3:]
            with self.subTest(name):
                with self.assertRaisesRegex(ValueError, rf"run.checkpoint: .*\b{shown} \("):
                    reconstruct(
                        checkpoint=self.path,
                        keep_checkpoint=True,
                        **{{"number_of_vertices": "vertices"}.get(name, name): value},
                    )
        reconstruct(checkpoint=self.path, carry_point_data=False, time_limit=1000)
        self.assertFalse(self.path.exists())

    # Promise: what is no checkpoint, or cannot be one, is a ValueError that names the file.
    def test_bad_files(self):
        self.path.write_text("a text that is no checkpoint", encoding="utf-8")
        for path in (self.path, self.path.parent, self.path.parent / "none" / "run.checkpoint"):
            with self.assertRaisesRegex(ValueError, str(path)):
                reconstruct(checkpoint=path)
        self.assertEqual(self.path.read_text(encoding="utf-8"), "a text that is no checkpoint")


if __name__ == "__main__":
    unittest.main()
