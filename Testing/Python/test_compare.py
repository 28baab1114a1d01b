# SPDX-License-Identifier: BSD-3-Clause
"""compare(): the figures of vtkNeuralMeshComparison in a dict."""

import math
import unittest

import neuralmesh
import support
import surface_measures
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkSphereSource

DISTANCES = ("mean", "rms", "percentile_99", "maximum")


def ball(radius=1.0):
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(60)
    source.SetPhiResolution(61)
    source.Update()
    return source.GetOutput()


def surface(mesh):
    """Points and triangles as a vtkPolyData."""
    points, triangles = mesh
    data = support.point_set(points)
    cells = vtkCellArray()
    for triangle in triangles:
        cells.InsertNextCell(3, [int(corner) for corner in triangle])
    data.SetPolys(cells)
    return data


class Measures(unittest.TestCase):
    # Promise: the measures are those that another program finds, triangle by triangle: on a cube beside itself,
    # on one with rounded edges, on spheres one in the other; each face of the cubes has points of its own.
    def test_against_numpy(self):
        cube = surface_measures.lattice_cube([-0.5, -0.4, -0.1, 0.3, 0.5])
        shifted = (cube[0] + [0.003, 0.002, -0.001], cube[1])
        for reference, result in (
            (cube, shifted),
            (cube, surface_measures.rounded_cube(0.1)),
            (surface_measures.rounded_cube(0.2), cube),
            (surface_measures.ball(1.0), surface_measures.ball(1.02)),
        ):
            wanted = surface_measures.measures(reference, result)
            figures = neuralmesh.compare(surface(reference), surface(result), samples=50000)
            for way, named in wanted.items():
                for name, figure in named.items():
                    with self.subTest(way=way, name=name):
                        found = figures[way][name]
                        self.assertEqual(math.isnan(found), math.isnan(figure))
                        if not math.isnan(figure):
                            # Parts of all samples have an error of their own.
                            is_part = figure <= 1.0 and "_0_" in name
                            delta = 0.03 if is_part else 0.05 * figure
                            self.assertAlmostEqual(found, figure, delta=delta)

    # Promise: a smooth surface has no sharp edges, and says so; what has is told all the same.
    def test_nothing_sharp(self):
        cube, round_cube = (
            surface(surface_measures.lattice_cube([-0.5, 0.5])),
            surface(surface_measures.rounded_cube(0.1)),
        )
        figures = neuralmesh.compare(cube, round_cube, samples=1000)
        self.assertAlmostEqual(figures["reference_to_result"]["edge_length"], 12.0)
        self.assertGreater(figures["reference_to_result"]["edge_to_surface"], 0.04)
        self.assertEqual(figures["result_to_reference"]["edge_length"], 0.0)
        for way, name in (
            ("reference_to_result", "edge_mean"),
            ("result_to_reference", "edge_mean"),
            ("result_to_reference", "edge_to_surface"),
            ("both_ways", "edge_chamfer"),
            ("both_ways", "edge_chamfer_percent"),
        ):
            self.assertTrue(math.isnan(figures[way][name]), name)


class Compare(unittest.TestCase):
    # Promise: two spheres are as far from each other as their radii, both ways and in percent, and
    # parallel; the sphere is that far only where the mesh is.
    def test_spheres(self):
        figures = neuralmesh.compare(ball(1.0), ball(1.1), samples=1000)
        self.assertEqual(list(figures), ["reference_to_result", "result_to_reference", "both_ways"])
        both_ways = figures.pop("both_ways")
        self.assertEqual(len(both_ways), 15)
        self.assertAlmostEqual(both_ways["chamfer"], 0.1, delta=1e-3)
        self.assertEqual(both_ways["f_score_0_5"], 0.0)
        for direction in figures.values():
            for name in DISTANCES:
                self.assertAlmostEqual(direction[name], 0.1, delta=1e-3)
                # The diagonal of the box is 2 sqrt(3).
                self.assertAlmostEqual(direction[name + "_percent"], 10 / 12**0.5, delta=0.03)
            self.assertLess(direction["normal_angle"], 5.0)
            self.assertGreater(direction["normal_consistency"], 0.995)
            self.assertEqual(len(direction), 15)

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
        others = neuralmesh.compare(reference, mesh, 1000, 4)
        for direction in ("reference_to_result", "result_to_reference"):
            self.assertNotEqual(figures[direction]["mean"], others[direction]["mean"])
        both_ways = figures.pop("both_ways")
        self.assertEqual(both_ways["chamfer"], comparison.GetChamferDistance())
        self.assertEqual(both_ways["chamfer_squared"], comparison.GetSquaredChamferDistance())
        self.assertEqual(both_ways["hausdorff"], comparison.GetHausdorffDistance())
        self.assertEqual(both_ways["normal_angle"], comparison.GetNormalAngle())
        self.assertEqual(both_ways["normal_consistency"], comparison.GetNormalConsistency())
        for at, threshold in (("0_1", comparison.TENTH_PERCENT), ("0_5", comparison.HALF_PERCENT)):
            self.assertEqual(both_ways["precision_" + at], comparison.GetPrecision(threshold))
            self.assertEqual(both_ways["recall_" + at], comparison.GetRecall(threshold))
            self.assertEqual(both_ways["f_score_" + at], comparison.GetFScore(threshold))
        self.assertGreater(both_ways["f_score_0_5"], 0.0)
        for direction, row in figures.items():
            which = getattr(comparison, direction.upper())
            self.assertEqual(row["edge_length"], comparison.GetEdgeLength(which))
            self.assertEqual(row["normal_consistency"], comparison.GetNormalConsistency(which))
            self.assertEqual(row["mean"], comparison.GetMean(which))
            self.assertEqual(row["rms"], comparison.GetRMS(which))
            self.assertEqual(row["percentile_99"], comparison.GetPercentile99(which))
            self.assertEqual(row["maximum"], comparison.GetMaximum(which))
            self.assertEqual(row["normal_angle"], comparison.GetNormalAngle(which))
        self.assertNotEqual(*(row["mean"] for row in figures.values()))

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
