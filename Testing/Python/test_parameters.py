# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of reconstruct() are the properties of the filter, and errors name the range."""

import unittest

import neuralmesh
import numpy as np
import support
from neuralmesh import vtkNeuralMesh
from neuralmesh._parameters import parameters_of
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm


def reconstruct(**parameters):
    return neuralmesh.reconstruct(support.sphere(500), **{"vertices": 50, **parameters})


class Values(unittest.TestCase):
    # Promise: a parameter does what the property does; any kind of number will do.
    def test_same_as_properties(self):
        cases = [
            ({"winner_rate": 0.3}, lambda mesh: mesh.SetWinnerRate(0.3)),
            ({"winner_rate": 1}, lambda mesh: mesh.SetWinnerRate(1)),
            ({"winner_rate": np.float64(0.3)}, lambda mesh: mesh.SetWinnerRate(0.3)),
            ({"smoothing_iterations": 3}, lambda mesh: mesh.SetSmoothingIterations(3)),
            ({"smoothing_iterations": 3.0}, lambda mesh: mesh.SetSmoothingIterations(3)),
            ({"smoothing_iterations": np.int8(3)}, lambda mesh: mesh.SetSmoothingIterations(3)),
            ({"vertices": 6e1, "seed": np.uint8(2)}, lambda mesh: (
                mesh.SetNumberOfVertices(60), mesh.SetSeed(2))),
            ({"edge_flips": False}, lambda mesh: mesh.EdgeFlipsOff()),
            ({"edge_flips": np.False_}, lambda mesh: mesh.EdgeFlipsOff()),
            ({"variant": "basic"}, lambda mesh: (
                mesh.SetVariantToBasic(), mesh.SetPresetToDefault())),
            ({"variant": "noise_filtering"}, lambda mesh: None),
            ({"variant": "noise"}, lambda mesh: None),
            ({"order": "list", "jump_fraction": 0.1, "list_vertices": 10}, lambda mesh: (
                mesh.SetOrderToList(), mesh.SetJumpFraction(0.1), mesh.SetListVertices(10))),
            ({"order": "list", "preset": "thesis"}, lambda mesh: (
                mesh.SetOrderToList(), mesh.SetPresetToThesis())),
            # The preset does not undo what is asked for, wherever it stands.
            ({"winner_rate": 0.3, "preset": "thesis", "variant": "basic"}, lambda mesh: (
                mesh.SetVariantToBasic(), mesh.SetPresetToThesis(), mesh.SetWinnerRate(0.3))),
        ]
        for parameters, prepare in cases:
            with self.subTest(parameters):
                algorithm = vtkNeuralMesh()
                algorithm.SetInputData(support.point_set(support.sphere(500)))
                algorithm.SetNumberOfVertices(50)
                prepare(algorithm)
                algorithm.Update()
                self.assertEqual(
                    support.arrays_of(reconstruct(**parameters)),
                    support.arrays_of(algorithm.GetOutput()),
                )

    # Promise: every property of the filter with a range, a switch or a choice is a parameter.
    def test_complete(self):
        own = set(dir(vtkNeuralMesh)) - set(dir(vtkPolyDataAlgorithm))
        properties = {name[3:-8] for name in own if name.endswith("MinValue")}
        properties |= {name[:-3] for name in own if name.endswith("Off")}
        properties |= {"Preset"}
        found = {name.replace("_", "") for name in parameters_of(vtkNeuralMesh)}
        self.assertEqual(found, {name.lower() for name in properties})
        self.assertGreaterEqual(len(found), 27)

    # Promise: what a parameter is by default, by its description, it is in a new filter.
    def test_defaults(self):
        fresh, assigned = vtkNeuralMesh(), vtkNeuralMesh()
        for parameter in parameters_of(vtkNeuralMesh).values():
            parameter.assign(assigned, parameter.default)
        # Of viewpoints there may be several: what gets one takes its number.
        of_lists = {"SetViewpoint"}
        for name in set(dir(vtkNeuralMesh)) - set(dir(vtkPolyDataAlgorithm)) - of_lists:
            if hasattr(vtkNeuralMesh, "Get" + name.removeprefix("Set")):
                getter = "Get" + name.removeprefix("Set")
                self.assertEqual(getattr(assigned, getter)(), getattr(fresh, getter)(), name)

    # Promise: choices of VTK are words, too.
    def test_precision(self):
        for word, data_type in (("single", "float"), ("double", "double")):
            mesh = reconstruct(output_points_precision=word)
            self.assertEqual(mesh.GetPoints().GetData().GetDataTypeAsString(), data_type)
        with self.assertRaisesRegex(ValueError, "'single' or 'double'|'double'.*'single'"):
            reconstruct(output_points_precision=1)


class Errors(unittest.TestCase):
    # Promise: each parameter with a range takes its ends, and nothing beyond; the ValueError names
    # the parameter and the range.
    def test_ranges(self):
        for name, parameter in parameters_of(vtkNeuralMesh).items():
            # The number of snapshots is for pipelines alone.
            if not hasattr(parameter, "minimum") or name == "number_of_snapshots":
                continue
            with self.subTest(name):
                self.assertTrue(parameter.accepts(parameter.minimum))
                self.assertTrue(parameter.accepts(parameter.maximum))
                shown = {"number_of_vertices": "vertices"}.get(name, name)
                other = ', or "auto"' if shown == "vertices" else ""
                below = -1 if parameter.takes_zero else parameter.minimum - 1
                beyond = parameter.maximum + (1 if parameter.integral else 1e-3)
                for value in (below, beyond, float("nan"), float("inf"), "1", None, True, [1]):
                    with self.assertRaises(ValueError) as caught:
                        reconstruct(**{shown: value})
                    self.assertEqual(
                        str(caught.exception), f"{shown} must be {parameter}{other}, not {value!r}"
                    )

    # Promise: the message is plain, and numbers in it are those of the documentation.
    def test_messages(self):
        messages = {
            "winner_rate must be a number from 0 to 1, not 2": {"winner_rate": 2},
            'vertices must be an integer from 4 to 1000000000, or 0, or "auto", not 3': {"vertices": 3},
            'vertices must be an integer from 4 to 1000000000, or 0, or "auto", not 50.5': {"vertices": 50.5},
            "seed must be an integer from 0 to 2147483647, not -1": {"seed": -1},
            "edge_flips must be True or False, not 2": {"edge_flips": 2},
            "variant must be 'basic' or 'noise_filtering' or 'normal_based', not 'noisy'": {"variant": "noisy"},
            "variant must be 'basic' or 'noise_filtering' or 'normal_based', not ''": {"variant": ""},
            "preset must be 'default' or 'thesis', not 1": {"preset": 1},
        }
        for message, parameters in messages.items():
            with self.subTest(message):
                with self.assertRaises(ValueError) as caught:
                    reconstruct(**parameters)
                self.assertEqual(str(caught.exception), message)

    # Promise: an unknown name is a TypeError, as in any call; a short one, which tells the names that
    # are near and where all of them are told.
    def test_unknown_names(self):
        near = {
            "winer_rate": "did you mean winner_rate? ",
            "WinnerRate": "did you mean winner_rate? ",
            "edge_flip": "did you mean edge_flips? ",
            "ensmble": "did you mean ensemble? ",
            "n_points": "did you mean vertices? ",
            "target_number_of_triangles": "did you mean vertices? They are about half as many as triangles. ",
            "random_state": "did you mean seed? ",
            "n_threads": "did you mean number_of_threads? ",
            "parameter": "",
            "xyzzy": "",
        }
        for wrong, hint in near.items():
            with self.subTest(wrong):
                with self.assertRaises(TypeError) as caught:
                    reconstruct(**{wrong: 1})
                self.assertEqual(
                    str(caught.exception),
                    f"reconstruct() got an unexpected keyword argument '{wrong}'; "
                    f"{hint}help(neuralmesh.reconstruct) lists them all",
                )
        with self.assertRaisesRegex(TypeError, "'vertice'; did you mean vertices or .*[?] help"):
            reconstruct(vertice=1)
        with self.assertRaisesRegex(TypeError, r"'xyzzy'; help\(neuralmesh.stream\) lists them all$"):
            neuralmesh.stream(xyzzy=1)
        # Properties of VTK's own classes are none of ours.
        with self.assertRaises(TypeError):
            reconstruct(abort_execute=1)


if __name__ == "__main__":
    unittest.main()
