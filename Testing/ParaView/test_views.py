# SPDX-License-Identifier: BSD-3-Clause
"""What outputs look like: each opens in the view that suits it."""

import unittest

import support
from paraview import simple


def setUpModule():
    support.load_plugin()


tearDownModule = support.delete_views


def shown(source, port=0):
    """The view that ParaView chooses by itself for an output."""
    source.UpdatePipeline()
    controller = simple.servermanager.ParaViewPipelineController()
    return controller.ShowInPreferredView(source.SMProxy, port, None)


class Views(unittest.TestCase):
    # Promise: meshes and scans are seen in a render view, without any more clicks.
    def test_surfaces(self):
        scan = support.scan(20000)
        mesh = simple.NeuralMesh(Input=scan, NumberOfVertices=1000)
        for source in (scan, mesh):
            view = simple.CreateView("RenderView")
            simple.Show(source, view)
            simple.ResetCamera(view)
            self.assertGreater(support.covered(view), 0.05)

    # Promise: the figures of a comparison open in a table; the learning curve, which would take half of
    # the window, and what would lie on top of the mesh do not open by themselves.
    def test_preferred_views(self):
        scan = support.scan(5000)
        mesh = simple.NeuralMesh(Input=scan, NumberOfVertices=300)
        ensemble = simple.NeuralMeshEnsemble(
            Input=scan, NumberOfVertices=300, NumberOfMembers=1, VerticesPerMember=100,
            GridResolution=16,
        )
        comparison = simple.NeuralMeshComparison(
            Input=mesh, Reference=scan.Input, NumberOfSamples=2000
        )
        self.assertEqual(shown(comparison, 2).GetXMLName(), "SpreadSheetView")
        by_choice = ((mesh, 1), (ensemble, 1), (ensemble, 2), (ensemble, 3), (comparison, 1))
        for source, port in by_choice:
            self.assertIsNone(shown(source, port))

    # Promise: a line chart that the learning curve is shown in shows the distances over the number of
    # vertices, and offers all other columns.
    def test_learning_curve(self):
        scan = support.scan(5000)
        filters = (
            simple.NeuralMesh(Input=scan, NumberOfVertices=300),
            simple.NeuralMeshEnsemble(
                Input=scan, NumberOfVertices=300, NumberOfMembers=1, VerticesPerMember=100,
                GridResolution=16,
            ),
        )  # fmt: skip
        for mesh in filters:
            view = simple.CreateView("XYChartView")
            chart = simple.Show(simple.OutputPort(mesh, 1), view)
            self.assertEqual(chart.GetXMLName(), "NeuralMeshLearningCurve")
            self.assertEqual((chart.UseIndexForXAxis, chart.XArrayName), (0, "Vertices"))
            visible = ["SampleDistanceMean", "SampleDistanceDeviation"]
            self.assertEqual(list(chart.SeriesVisibility), visible)
            offered = chart.GetProperty("SeriesVisibility").SMProperty
            names = [offered.GetElement(i) for i in range(0, offered.GetNumberOfElements(), 2)]
            curve = support.fetch(mesh, 1)
            columns = [curve.GetColumnName(i) for i in range(curve.GetNumberOfColumns())]
            self.assertEqual(sorted(names), sorted(columns))
            self.assertGreater(support.covered(view), 0.005)
            chart.SeriesVisibility = ["NormalChangeMean"]
            self.assertEqual(list(chart.SeriesVisibility), ["NormalChangeMean"])


if __name__ == "__main__":
    unittest.main()
