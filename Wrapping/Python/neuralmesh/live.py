# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of ParaView that are shown while they learn, in pvpython and in the GUI's Python shell.

>>> from neuralmesh.live import watch
>>> watch(NeuralMesh(Input=scan, NumberOfVertices=20000))
"""

from __future__ import annotations

from typing import Any, Callable

from paraview import simple
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import VTK_OBJECT
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import vtkNeuralMesh


def watch(
    mesh: Any, view: Any = None, after_each: Callable[[vtkPolyData], None] | None = None
) -> None:
    """Bring a mesh up to date, and show each snapshot of its growth in a view meanwhile.

    At the end the view shows the finished mesh, the same as without watch(). It has
    NumberOfSnapshots snapshots. If it is up to date already there is nothing to be seen.

    Args:
        mesh: A source made by paraview.simple.NeuralMesh() or NeuralMeshEnsemble().
        view: A render view; the active one if there is none, or a new one. Where nothing is to be
            seen in it, the camera turns to the points.
        after_each: Called with each snapshot once it is shown, for example to save a picture. What
            it raises ends the run and is raised again.

    Raises:
        RuntimeError: The filter runs on a server, which does not show its snapshots: play its growth
            afterwards (GrowthAsTime).
        TypeError: It is no such filter.
    """
    algorithm = mesh.GetClientSideObject()
    if algorithm is None:
        raise RuntimeError("a filter on a server cannot be watched; GrowthAsTime can be played")
    if not isinstance(algorithm, vtkNeuralMesh):
        raise TypeError(f"a NeuralMesh can be watched, not {type(algorithm).__name__}")
    view = view or simple.GetActiveViewOrCreate("RenderView")
    # What the mesh needs, before anything is drawn by the way.
    mesh.Input.UpdatePipeline()
    simple.Hide(mesh, view)
    if not any(shown.Visibility for shown in view.Representations):
        view.SMProxy.ResetCamera(mesh.Input.GetDataInformation().GetBounds())
    stage = _Stage(view, after_each)
    observer = algorithm.AddObserver(vtkNeuralMesh.SnapshotEvent, stage.show)
    try:
        mesh.UpdatePipeline()
    finally:
        algorithm.RemoveObserver(observer)
        stage.clear()
    if stage.raised is not None:
        raise stage.raised
    simple.Show(mesh, view)
    simple.SetActiveSource(mesh)
    view.StillRender()


class _Stage:
    """Where snapshots are shown. No exception may pass through VTK."""

    def __init__(self, view: Any, after_each: Callable[[vtkPolyData], None] | None):
        self.raised: BaseException | None = None
        self._view = view
        self._after_each = after_each
        self._source = simple.TrivialProducer(registrationName="Growing mesh")
        self._is_shown = False

    @calldata_type(VTK_OBJECT)
    def show(self, algorithm: vtkNeuralMesh, _event: str, snapshot: vtkPolyData) -> None:
        if self.raised is not None:
            return
        try:
            self._draw(snapshot)
            if self._after_each is not None:
                self._after_each(snapshot)
        except BaseException as error:
            self.raised = error
            algorithm.SetAbortExecute(1)

    def _draw(self, snapshot: vtkPolyData) -> None:
        self._source.GetClientSideObject().SetOutput(snapshot)
        self._source.MarkModified(self._source.SMProxy)
        if not self._is_shown:
            self._is_shown = True
            simple.Show(self._source, self._view)
        # Not simple.Render(): the first one of a script would turn the camera to the first snapshot.
        self._view.StillRender()

    def clear(self) -> None:
        simple.Delete(self._source)
