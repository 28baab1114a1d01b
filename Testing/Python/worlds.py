# SPDX-License-Identifier: BSD-3-Clause
"""What the classes for pipelines give, in a process that has one of the two worlds: the C++ classes, or those
in Python over the engine. worlds.py NAME... prints a JSON object: for each case what came out, hashed.
"""

import hashlib
import json
import os
import sys
import tempfile

import neuralmesh
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import (
    vtkBitArray,
    vtkIdTypeArray,
    vtkIntArray,
    vtkPoints,
    vtkStringArray,
    vtkUnsignedCharArray,
)
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet,
    vtkCellArray,
    vtkDataObject,
    vtkImageData,
    vtkMultiBlockDataSet,
    vtkPolyData,
    vtkUnstructuredGrid,
)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOPLY import vtkPLYWriter

NOT_COMPARED = {"Seconds"}


def ball(count=4000, seed=1, center=(0.0, 0.0, 0.0), noise=0.01):
    """Points on a sphere, in doubles."""
    random = np.random.default_rng(seed)
    points = random.normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    return points + random.normal(scale=noise, size=points.shape) + np.array(center)


def point_set(points, dtype=np.float32):
    data = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=dtype), deep=True))
    data.SetPoints(places)
    return data


def add(data, name, values, cls=None):
    """Point data, of the class if one is given."""
    if cls is None:
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    else:
        array = cls()
        rows = np.asarray(values)
        array.SetNumberOfComponents(rows.shape[1] if rows.ndim > 1 else 1)
        for value in rows.reshape(-1).tolist():
            array.InsertNextValue(value)
    array.SetName(name)
    data.GetPointData().AddArray(array)
    return array


def box(dtype=np.float32, count=20000):
    """Points on a cube of side 1, with heights that may be taken for creases."""
    random = np.random.default_rng(1)
    points = random.uniform(-0.5, 0.5, (count, 3))
    points[np.arange(count), random.integers(0, 3, count)] = random.choice((-0.5, 0.5), count)
    data = point_set(points, dtype)
    add(data, "Crease", points[:, 2])
    return data


def rich(count=4000):
    """A cloud with point data of all kinds."""
    points = ball(count)
    data = point_set(points)
    height = points[:, 2]
    add(data, "Height", height)
    add(data, "Slope", points.astype(np.float32))
    data.GetPointData().GetArray("Slope").SetComponentName(0, "East")
    color = np.clip(127 + 120 * points, 0, 255).astype(np.uint8)
    data.GetPointData().SetScalars(add(data, "Color", color))
    add(data, "RGBA", np.c_[color, 255 - color[:, :1]])
    add(data, "Class", (height > 0).astype(int) + 2, vtkIntArray)
    add(data, "Number", np.arange(count) // 500, vtkIdTypeArray)
    add(data, "Flag", (height > 0.3).astype(int), vtkBitArray)
    add(data, "Byte", (height > -0.3).astype(np.uint8), vtkUnsignedCharArray)
    add(data, "Pair", np.c_[height > 0, height > 0.5].astype(np.int16))
    add(data, "Activity", height)
    names = np.where(height > 0.2, "north", np.where(height < -0.2, "süd", "")).tolist()
    add(data, "Name", names, vtkStringArray)
    data.GetPointData().SetGlobalIds(add(data, "Ids", np.arange(count), vtkIdTypeArray))
    return data


def hashed(values):
    return hashlib.sha256(values).hexdigest()[:16]


def array_of(array):
    """What an array is, and a hash of what it has."""
    names = [array.GetComponentName(i) for i in range(array.GetNumberOfComponents())]
    head = [array.GetDataTypeAsString(), array.GetNumberOfComponents(), array.GetNumberOfTuples()]
    if array.IsA("vtkDataArray") and not array.IsA("vtkBitArray"):
        return [*head, names, hashed(memoryview(array).tobytes()) if head[2] else ""]
    if array.IsA("vtkBitArray"):
        return [*head, names, hashed(bytes(array.GetValue(i) for i in range(array.GetNumberOfValues())))]
    values = [array.GetVariantValue(i) for i in range(array.GetNumberOfValues())]
    texts = [[value.GetTypeAsString(), value.ToString()] for value in values]
    return [*head, names, hashed(json.dumps(texts).encode())]


def fields_of(data):
    arrays = [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]
    return [[a.GetName(), array_of(a)] for a in arrays if a.GetName() not in NOT_COMPARED]


def data_of(data):
    """Everything that is known of an output."""
    result = {"class": data.GetClassName(), "fields": fields_of(data.GetFieldData())}
    if data.IsA("vtkTable"):
        result["columns"] = fields_of(data.GetRowData())
        return result
    if data.IsA("vtkMultiBlockDataSet"):
        numbers = range(data.GetNumberOfBlocks())
        result["names"] = [data.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) for i in numbers]
        result["blocks"] = [data_of(data.GetBlock(i)) for i in numbers]
        return result
    result["points"] = fields_of(data.GetPointData())
    for kind in ("Scalars", "Normals"):
        active = getattr(data.GetPointData(), f"Get{kind}")()
        result[kind] = active.GetName() if active else None
    if data.IsA("vtkImageData"):
        result["grid"] = [data.GetDimensions(), data.GetOrigin(), data.GetSpacing()]
        return result
    result["places"] = array_of(data.GetPoints().GetData()) if data.GetPoints() else None
    result["cells"] = fields_of(data.GetCellData())
    for kind in ("Verts", "Lines", "Polys"):
        cells = getattr(data, f"Get{kind}")()
        ids = vtkIdTypeArray()
        cells.ExportLegacyFormat(ids)
        result[kind] = [cells.GetNumberOfCells(), array_of(ids)]
    return result


class Said:
    """Errors and warnings, without the place from which they come."""

    def __init__(self, *objects):
        from vtkmodules.util.misc import calldata_type
        from vtkmodules.vtkCommonCore import VTK_STRING

        self.texts = []

        @calldata_type(VTK_STRING)
        def hear(_caller, event, text):
            self.texts.append([event, text.partition("): ")[2].strip()])

        for one in objects:
            one.AddObserver("ErrorEvent", hear)
            one.AddObserver("WarningEvent", hear)


def outcome(algorithm, update=None):
    """All outputs of a filter, and what it said; the executive says that it has failed, too."""
    said = Said(algorithm)
    Said(algorithm.GetExecutive())
    (update or algorithm.Update)()
    outputs = [data_of(algorithm.GetOutputDataObject(i))
               for i in range(algorithm.GetNumberOfOutputPorts())]
    result = {"said": said.texts, "outputs": outputs}
    if hasattr(algorithm, "GetStopReason"):
        result["stop"] = [algorithm.GetStopReason(), algorithm.GetResumedIterations()]
    return result


def learn(data=None, cls="vtkNeuralMesh", first=None, prepare=None, **properties):
    """A run of the filter with properties."""
    mesh = getattr(neuralmesh, cls)()
    said = Said(mesh)
    mesh.SetNumberOfVertices(300)
    for name, value in properties.items():
        getattr(mesh, "Set" + name)(*value if isinstance(value, tuple) else (value,))
    if data is not None:
        mesh.SetInputData(data)
    if first is not None:
        mesh.SetFirstMeshData(first)
    if prepare:
        prepare(mesh)
    result = outcome(mesh)
    result["before"] = said.texts
    return result


def blocks():
    """Several blocks, of which some are no point sets, and data that not all have."""
    result = vtkMultiBlockDataSet()
    first, second = point_set(ball(2500)), point_set(ball(2500, 2), np.float64)
    third = vtkUnstructuredGrid()
    third.SetPoints(point_set(ball(1000, 3)).GetPoints())
    for i, data in enumerate((first, second, third)):
        add(data, "Height", np.arange(data.GetNumberOfPoints(), dtype=float))
        add(data, "Block", np.full(data.GetNumberOfPoints(), i), vtkIntArray)
    add(first, "Only", np.zeros(2500))
    second.GetPointData().SetNormals(add(second, "Outward", ball(2500, 2).astype(np.float32)))
    inner = vtkMultiBlockDataSet()
    inner.SetBlock(0, second)
    inner.SetBlock(1, vtkImageData())
    for i, block in enumerate((first, inner, third, vtkPolyData())):
        result.SetBlock(i, block)
    return result


def ghosts():
    data = rich()
    marks = (np.arange(4000) % 5 == 0).astype(np.uint8) * np.where(np.arange(4000) % 2, 1, 2)
    add(data, "vtkGhostType", marks.astype(np.uint8), vtkUnsignedCharArray)
    add(data, "Trust", np.linspace(0, 1, 4000))
    return data


def weighted(mesh):
    mesh.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, 0)


def with_levels(mesh, *levels):
    for level in levels or (100, 300):
        mesh.AddLevel(level)


def scan_of_views():
    data = point_set(np.r_[ball(2000), ball(2000, 4, (3, 0, 0))])
    add(data, "View", np.repeat([0.0, 1.0], 2000))
    add(data, "Seen", np.repeat([1.0, 0.0], 2000))
    places = numpy_to_vtk(np.array([[9.0, 0, 0], [-9.0, 0, 0]]), deep=True)
    places.SetName("Viewpoints")
    data.GetFieldData().AddArray(places)
    return data


def sphere_mesh(resolution=8):
    sphere = vtkSphereSource()
    sphere.SetRadius(1.0)
    sphere.SetThetaResolution(resolution)
    sphere.SetPhiResolution(resolution)
    sphere.Update()
    return sphere.GetOutput()


def polygons(*cells):
    data = point_set(ball(20, 5))
    polys = vtkCellArray()
    for cell in cells:
        polys.InsertNextCell(len(cell), cell)
    data.SetPolys(polys)
    return data


def stale():
    """Field data that a mesh before has left."""
    data = rich()
    for name in ("Noise", "Warnings", "Seed", "Genus", "Volume", "Kept"):
        array = numpy_to_vtk(np.array([7.0]), deep=True)
        array.SetName(name)
        data.GetFieldData().AddArray(array)
    return data


def stepped():
    """Time steps of growth."""
    mesh = neuralmesh.vtkNeuralMesh()
    mesh.SetInputData(stale())
    mesh.SetNumberOfVertices(300)
    mesh.GrowthAsTimeOn()
    mesh.SetNumberOfSnapshots(4)
    mesh.UpdateInformation()
    steps = mesh.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    found = [list(steps)]
    for step in (3, 0, 1, 2.7, -1, 9):
        found.append(outcome(mesh, lambda step=step: mesh.UpdateTimeStep(step)))
        information = mesh.GetOutput().GetInformation()
        found.append(information.Get(vtkDataObject.DATA_TIME_STEP()))
    return found


def watched():
    """Snapshots without growth as time."""
    from vtkmodules.util.misc import calldata_type
    from vtkmodules.vtkCommonCore import VTK_OBJECT

    found = []

    @calldata_type(VTK_OBJECT)
    def see(_mesh, _event, snapshot):
        found.append(data_of(snapshot))

    mesh = neuralmesh.vtkNeuralMesh()
    mesh.SetInputData(point_set(ball()))
    mesh.SetNumberOfVertices(200)
    mesh.SetNumberOfSnapshots(3)
    mesh.AddObserver(mesh.SnapshotEvent, see)
    mesh.Update()
    return found + [data_of(mesh.GetOutput())]


def streamed():
    stream = neuralmesh.vtkNeuralMeshStream()
    said = Said(stream)
    stream.SetNumberOfVertices(200)
    stream.SetViewpoint(0, 0, 9)
    stream.AddPoints(point_set(ball(2000)))
    stream.Learn(3000)
    stream.AddPoints(rich().GetPoints())
    learnt = stream.Learn(3000)
    counts = [stream.GetNumberOfAddedPoints(), stream.GetNumberOfDroppedPoints(),
              stream.GetNumberOfLearntSamples(), stream.GetNumberOfLearntVertices(),
              stream.GetNumberOfBeginnings(), learnt]
    found = [counts, outcome(stream)]
    stream.FinishOutputOff()
    found.append(outcome(stream))
    stream.Reset()
    stream.SetMaximumIterations(5) if hasattr(stream, "SetMaximumIterations") else None
    found.append(outcome(stream))
    stream.SetJumpToLinear() if hasattr(stream, "SetJumpToLinear") else stream.SetJump(1)
    stream.SetOrderToExact() if hasattr(stream, "SetOrderToExact") else stream.SetOrder(0)
    stream.AddPoints(point_set(ball(2000)))
    return found + [said.texts]


def measured(cls, properties=None, ports=()):
    algorithm = getattr(neuralmesh, cls)()
    for name, value in (properties or {}).items():
        getattr(algorithm, "Set" + name)(*value if isinstance(value, tuple) else (value,))
    for port, data in enumerate(ports):
        algorithm.SetInputData(port, data)
    found = outcome(algorithm)
    if cls == "vtkNeuralMeshFileSampler":
        found["count"] = algorithm.GetNumberOfFilePoints()
    if cls == "vtkNeuralMeshComparison":
        found["figures"] = [
            repr(getattr(algorithm, f"Get{name}")(direction))
            for name in ("Mean", "RMS", "Percentile99", "Maximum", "NormalAngle", "NormalConsistency",
                         "EdgeMean", "EdgeToSurface", "EdgeLength", "Precision", "Recall", "FScore")
            for direction in (0, 1, 2, -1)
        ] + [
            repr(getattr(algorithm, f"Get{name}")())
            for name in ("ReferenceDiagonal", "ChamferDistance", "SquaredChamferDistance",
                         "HausdorffDistance", "NormalAngle", "NormalConsistency", "EdgeChamferDistance")
        ]
    return found


def write_cloud(path):
    """A .ply with colours."""
    writer = vtkPLYWriter()
    data = rich()
    vertices = vtkCellArray()
    for i in range(data.GetNumberOfPoints()):
        vertices.InsertNextCell(1, [i])
    data.SetVerts(vertices)
    writer.SetInputData(data)
    writer.SetArrayName("Color")
    writer.SetFileName(path)
    writer.Write()


def of_file(**properties):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "points.ply")
        write_cloud(path)
        return learn(PointFileName=path, **properties)


def sampled():
    """Points of files, by themselves."""
    with tempfile.TemporaryDirectory() as folder:
        ply, raw = (os.path.join(folder, name) for name in ("points.ply", "points.bin"))
        write_cloud(ply)
        with open(raw, "wb") as file:
            file.write(b"head" + ball().tobytes())
        found = [
            measured("vtkNeuralMeshFileSampler", properties)
            for properties in (
                {"FileName": ply, "NumberOfPoints": 1000},
                {"FileName": ply, "Seed": 3, "NumberOfPoints": 0},
                {"FileName": raw, "Format": 2, "HeaderBytes": 4},
                {"FileName": raw, "Format": 1},
                {"FileName": ply + "x"},
                {},
            )
        ]
        return json.loads(json.dumps(found).replace(folder, ""))


def aborted():
    """Ended at half of the run."""
    mesh = neuralmesh.vtkNeuralMesh()
    mesh.SetInputData(point_set(ball()))
    mesh.SetNumberOfVertices(300)

    def end(*_):
        # Not at the end of all, which VTK tells itself.
        if mesh.GetProgress() < 1.0:
            mesh.SetAbortExecute(1)

    observer = mesh.AddObserver("ProgressEvent", end)
    found = outcome(mesh)
    is_whole = mesh.GetOutput().GetNumberOfPolys() > 0
    mesh.RemoveObserver(observer)
    flag = mesh.GetAbortExecute()
    mesh.Modified()
    mesh.Update()
    return [found["stop"], is_whole, flag, data_of(mesh.GetOutput())]


def checkpointed():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "state")
        found = [learn(rich(), CheckpointFileName=path, MaximumIterations=2000, KeepCheckpoint=1)]
        found.append(os.path.exists(path))
        found.append(learn(rich(), CheckpointFileName=path, MaximumIterations=2000))
        found.append(os.path.exists(path))
        with open(path, "wb") as file:
            file.write(b"nonsense")
        text = json.dumps([found, learn(rich(), CheckpointFileName=path)])
        return json.loads(text.replace(folder, ""))


def methods():
    """What the classes can be asked, VTK's own methods of all filters aside."""
    found = {}
    for name in ("", "Comparison", "Ensemble", "Explanation", "FileSampler", "Information", "Scan", "Stream"):
        cls = getattr(neuralmesh, "vtkNeuralMesh" + name)
        bases = [
            base for base in cls.__mro__
            if not base.__module__.startswith("vtkmodules.vtkCommon") or "PolyData" in base.__name__
        ]
        found[name] = sorted(
            {key for base in bases for key, value in vars(base).items()
             if not key.startswith("_") and not isinstance(value, type)}
        )
    return found


CASES = {
    "methods": methods,
    "floats": lambda: learn(point_set(ball())),
    "doubles": lambda: learn(point_set(ball(), np.float64)),
    "far": lambda: learn(point_set(ball(center=(5e5, 5e6, 100)), np.float64)),
    "far_floats": lambda: learn(point_set(ball(center=(5e3, 5e4, 100)))),
    "integers": lambda: learn(point_set(np.round(1000 * ball()), np.int32)),
    "double_output": lambda: learn(point_set(ball()), OutputPointsPrecision=1),
    "not_finite": lambda: learn(point_set(np.where(ball() > 0.999, np.nan, ball()))),
    "rich": lambda: learn(rich()),
    "not_carried": lambda: learn(rich(), CarryPointData=0),
    "explained": lambda: learn(rich(), ExplainPoints=1, ComputeFeatureStrength=1),
    "uncertain": lambda: learn(rich(), ComputeUncertainty=1),
    "uncertain_without_fit": lambda: learn(rich(), ComputeUncertainty=1, FitRounds=0),
    "lines": lambda: learn(box(), ComputeFeatureLines=1, NumberOfVertices=1000),
    "lines_of_doubles": lambda: learn(box(np.float64), "vtkNeuralMeshEnsemble", NumberOfMembers=3,
                                      VerticesPerMember=200, ComputeFeatureLines=1, FeatureAngle=60,
                                      NumberOfVertices=1000),
    "levels": lambda: learn(rich(), prepare=with_levels),
    "levels_that_fall": lambda: learn(rich(), prepare=lambda mesh: with_levels(mesh, 300, 100)),
    "levels_in_no_time": lambda: learn(rich(), prepare=with_levels, TimeLimit=1),
    "level_out_of_range": lambda: learn(rich(), prepare=lambda mesh: with_levels(mesh, 3)),
    "no_lines": lambda: learn(rich(), ComputeFeatureLines=1, ExplainPoints=1),
    "ghosts": lambda: learn(ghosts(), ExplainPoints=1, WeightArrayName="Trust"),
    "stale": lambda: learn(stale()),
    "blocks": lambda: learn(blocks(), ExplainPoints=1),
    "weights": lambda: learn(rich(), WeightArrayName="Byte"),
    "weight_attribute": lambda: learn(
        point_set(ball()), prepare=weighted),
    "no_weights": lambda: learn(rich(), WeightArrayName="Slope"),
    "views": lambda: learn(scan_of_views()),
    "views_named": lambda: learn(scan_of_views(), ViewArrayName="Seen"),
    "no_views": lambda: learn(scan_of_views(), ViewArrayName="Nothing"),
    "normals_named": lambda: learn(rich(), NormalArrayName="Slope"),
    "normals_off": lambda: learn(rich(), UseNormals=0, NormalArrayName="Slope"),
    "normals_out_of_range": lambda: learn(rich(), UseNormals=7, NormalArrayName="Slope"),
    "normals_of_blocks": lambda: [learn(blocks(), NormalArrayName=name) for name in ("Height", "Slope")],
    "no_normals": lambda: [learn(rich(), NormalArrayName=name) for name in ("Nothing", "RGBA", "Name")],
    "no_vectors": lambda: learn(point_set(ball()), NormalArrayName="Nothing"),
    "viewpoint": lambda: learn(rich(), Viewpoint=(0, 0, 0)),
    "up": lambda: learn(rich(), UpDirection=(0, 0, -1)),
    "first": lambda: learn(rich(), first=sphere_mesh()),
    "first_bad": lambda: learn(rich(), first=polygons([0, 1, 2], [0, 1, 3], [0, 1, 4])),
    "first_beyond": lambda: learn(rich(), first=polygons([0, 1, 99])),
    "first_large": lambda: learn(rich(), first=sphere_mesh(32)),
    "number_to_be_found": lambda: learn(rich(), NumberOfVertices=0),
    "tolerance": lambda: learn(rich(), Tolerance=0.5, ToleranceIsPercent=1, ToleranceMeasure=1),
    "tolerance_beyond_the_cloud": lambda: learn(rich(), Tolerance=1e9),
    "tolerance_in_no_time": lambda: learn(rich(), Tolerance=0.1, TimeLimit=1),
    "automatic": lambda: learn(rich(30000), Automatic=1, NumberOfVertices=1000),
    "topology": lambda: learn(rich(), TopologyLearning=1),
    "basic": lambda: learn(rich(), Variant=0, Seed=7),
    "normal_based": lambda: learn(rich(), Variant=2, Order=1),
    "thesis": lambda: learn(rich(), Preset=1),
    "jump": lambda: learn(rich(), Order=0, Jump=1),
    "exclusive": lambda: learn(rich(), Variant=2, TopologyLearning=1, Order=0, Jump=1),
    "clamped": lambda: learn(rich(), NumberOfVertices=1, WinnerRate=9.0, TimeLimit=float("nan"),
                             Seed=-5, Preset=9, Automatic=4, EdgeFlips=-1, Variant=11),
    "ensemble": lambda: learn(
        rich(), "vtkNeuralMeshEnsemble", NumberOfMembers=3, VerticesPerMember=100,
        GridResolution=16),
    "ensemble_of_nothing": lambda: learn(vtkPolyData(), "vtkNeuralMeshEnsemble"),
    "empty": lambda: learn(vtkPolyData()),
    "empty_blocks": lambda: learn(vtkMultiBlockDataSet()),
    "nothing": lambda: learn(),
    "both": lambda: learn(rich(), PointFileName="none.ply"),
    "file": lambda: of_file(MaximumPoints=2000),
    "sampled": sampled,
    "one_place": lambda: learn(point_set(np.ones((100, 3)))),
    "steps": stepped,
    "watched": watched,
    "stream": streamed,
    "aborted": aborted,
    "checkpoint": checkpointed,
    "growth_and_checkpoint": lambda: learn(rich(), GrowthAsTime=1, CheckpointFileName="x"),
    "comparison": lambda: measured("vtkNeuralMeshComparison", {"NumberOfSamples": 2000},
                                   (sphere_mesh(), sphere_mesh(16))),
    "comparison_smooth": lambda: measured("vtkNeuralMeshComparison", {"NumberOfSamples": 2000},
                                          (sphere_mesh(40), sphere_mesh(50))),
    "comparison_empty": lambda: measured("vtkNeuralMeshComparison", {},
                                         (vtkPolyData(), vtkPolyData())),
    "comparison_bad": lambda: measured("vtkNeuralMeshComparison", {},
                                       (sphere_mesh(), polygons([0, 1, 99]))),
    "explanation": lambda: measured("vtkNeuralMeshExplanation", {"SmallestPiece": 0.01},
                                    (blocks(), sphere_mesh())),
    "explanation_bad": lambda: measured("vtkNeuralMeshExplanation", {},
                                        (rich(), polygons([0, 1, 99]))),
    "information": lambda: measured("vtkNeuralMeshInformation", {}, (sphere_mesh(),)),
    "information_stale": lambda: measured("vtkNeuralMeshInformation", {}, (stale(),)),
    "information_unsound": lambda: measured("vtkNeuralMeshInformation", {},
                                            (polygons([0, 1, 2], [1, 0, 3], [0, 1, 4]),)),
    "information_empty": lambda: measured("vtkNeuralMeshInformation", {}, (vtkPolyData(),)),
    "information_bad": lambda: measured("vtkNeuralMeshInformation", {}, (polygons([0, 1, 99]),)),
    "information_open": lambda: measured("vtkNeuralMeshInformation", {},
                                         (polygons([0, 1, 2], [0, 1, 3], [0, 1, 4], [5, 6, 7, 8]),)),
    "scan": lambda: measured("vtkNeuralMeshScan", {
        "NumberOfPoints": 3000, "Noise": 0.01, "Outliers": 0.1, "Holes": 2, "Occlusion": 1,
        "Viewpoint": (0, 0, 9)}, (sphere_mesh(),)),
    "scan_bad": lambda: measured("vtkNeuralMeshScan", {}, (polygons([0, 0, 1]),)),
    "scan_empty": lambda: measured("vtkNeuralMeshScan", {}, (vtkPolyData(),)),
}


def main():
    names = sys.argv[1:] or list(CASES)
    json.dump({name: CASES[name]() for name in names}, sys.stdout)


if __name__ == "__main__":
    main()
