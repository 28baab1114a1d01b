# SPDX-License-Identifier: BSD-3-Clause
"""compare(): the figures of vtkNeuralMeshComparison in a dict."""

import unittest

import neuralmesh
import support
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkSphereSource

DISTANCES = ("mean", "rms", "percentile_99", "maximum")


def ball(radius=1.0):
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(60)
    source.SetPhiResolution(61)
    source.Update()
    return source.GetOutput()


class Compare(unittest.TestCase):
    # Promise: two spheres are as far from each other as their radii, both ways and in percent, and
    # parallel; the sphere is that far only where the mesh is.
    def test_spheres(self):
        figures = neuralmesh.compare(ball(1.0), ball(1.1), samples=1000)
        self.assertEqual(list(figures), ["reference_to_result", "result_to_reference"])
        for direction in figures.values():
            for name in DISTANCES:
                self.assertAlmostEqual(direction[name], 0.1, delta=1e-3)
                # The diagonal of the box is 2 sqrt(3).
                self.assertAlmostEqual(direction[name + "_percent"], 10 / 12**0.5, delta=0.03)
            self.assertLess(direction["normal_angle"], 5.0)
            self.assertEqual(len(direction), 9)

    # Promise: the dict has the table of the filter, and the arguments are not exchanged.
    def test_same_as_filter(self):
        reference = ball()
        mesh = neuralmesh.reconstruct(support.sphere(5000), 200)
        figures = neuralmesh.compare(reference, mesh, 1000, 3)
        comparison = neuralmesh.vtkNeuralMeshComparison()
        comparison.SetReferenceData(reference)
        comparison.SetInputData(mesh)
        comparison.SetNumberOfSamples(1000)
        comparison.SetSeed(3)
        comparison.Update()
        for direction, row in figures.items():
            which = getattr(comparison, direction.upper())
            self.assertEqual(row["mean"], comparison.GetMean(which))
            self.assertEqual(row["rms"], comparison.GetRMS(which))
            self.assertEqual(row["percentile_99"], comparison.GetPercentile99(which))
            self.assertEqual(row["maximum"], comparison.GetMaximum(which))
            self.assertEqual(row["normal_angle"], comparison.GetNormalAngle(which))
        self.assertNotEqual(*(row["mean"] for row in figures.values()))
        self.assertNotEqual(figures, neuralmesh.compare(reference, mesh, 1000, 4))

    # Promise: what is wrong is a ValueError that says so, and VTK prints nothing.
    def test_errors(self):
        cases = {
            "samples must be an integer from 1000 to 100000000, not 10": {"samples": 10},
            "seed must be an integer from 0 to 2147483647, not -1": {"seed": -1},
            f"reference must be a vtkPolyData, not {vtkUnstructuredGrid().__class__.__name__}": {
                "reference": vtkUnstructuredGrid()
            },
            "result must be a vtkPolyData, not NoneType": {"result": None},
        }
        for message, arguments in cases.items():
            with self.assertRaises(ValueError) as caught:
                neuralmesh.compare(**{"reference": ball(), "result": ball(), **arguments})
            self.assertEqual(str(caught.exception), message)
        for reference, result in (
            (ball(), vtkPolyData()),
            (vtkPolyData(), ball()),
            (vtkPolyData(), vtkPolyData()),
            (ball(), support.point_set(support.sphere())),
        ):
            with self.assertRaises(ValueError):
                neuralmesh.compare(reference, result)
        output, errors, status = support.run_script(
            """
            import neuralmesh, support, test_compare
            try:
                neuralmesh.compare(test_compare.ball(), support.point_set(support.sphere()))
            except ValueError as error:
                print(error)
            """
        )
        self.assertIn("triangle", output)
        self.assertEqual((errors, status), ("", 0))


if __name__ == "__main__":
    unittest.main()
