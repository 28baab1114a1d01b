# SPDX-License-Identifier: BSD-3-Clause
"""The properties of the proxies beside those of the C++ classes: none may drift."""

import re
import unittest

import support
from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import reference

CLASSES = {
    "NeuralMesh": support.class_of("vtkPNeuralMesh"),
    "NeuralMeshComparison": support.class_of("vtkNeuralMeshComparison"),
    "NeuralMeshEnsemble": support.class_of("vtkPNeuralMeshEnsemble"),
    "NeuralMeshFileSampler": support.class_of("vtkNeuralMeshFileSampler"),
    "NeuralMeshScan": support.class_of("vtkNeuralMeshScan"),
}
SOURCES = {"NeuralMeshFileSampler"}
# Setters without a property of their own name, and why.
OTHERWISE = {
    "Controller": "that of ParaView",
    "PointFileName": "the source Neural Mesh File Sampler, whose output any filter takes",
    "Preset": "sets other properties at once, which the panel would go on to show as they were",
    "FirstMeshConnection": "the input FirstMesh",
    "FirstMeshData": "the input FirstMesh",
    "ReferenceConnection": "the input Reference",
    "ReferenceData": "the input Reference",
    "NormalArrayName": "the property NormalArray, a choice among the arrays of the input",
    "ViewArrayName": "the property ViewArray, a choice among the arrays of the input",
    "WeightArrayName": "the property WeightArray, a choice among the arrays of the input",
}
# Properties without a setter of their own name: lists, by the setter of one that is all there is.
LISTS = {"Viewpoints": "Viewpoint", "Levels": "Level"}
ARRAYS = {"NormalArray", "ViewArray", "WeightArray"}
# Up to here a maximum gives a slider; with larger ones nobody could aim: the proxy has none then.
LARGEST_SLIDER = 1000
LARGEST_INT = 2**31 - 1
KINDS = {
    "int": "vtkSMIntVectorProperty",
    "vtkTypeBool": "vtkSMIntVectorProperty",
    # The panel of ParaView 5.11 has no field for a vtkSMIdTypeVectorProperty with a range.
    "vtkIdType": "vtkSMIntVectorProperty",
    "double": "vtkSMDoubleVectorProperty",
    "char": "vtkSMStringVectorProperty",
}
FIRST = {
    "NeuralMesh": "NumberOfVertices",
    "NeuralMeshComparison": "NumberOfSamples",
    "NeuralMeshEnsemble": "NumberOfVertices",
    "NeuralMeshFileSampler": "NumberOfPoints",
    "NeuralMeshScan": "NumberOfPoints",
}
GROUPS = ["Tolerance", "Learning", "Growth", "Topology", "Noise", "Finish", "Outer Side", "Output"]


def setUpModule():
    support.load_plugin()


def group_of(name):
    return "sources" if name in SOURCES else "filters"


def prototype(name):
    return servermanager.ProxyManager().GetPrototypeProxy(group_of(name), name)


def everything_of(proxy):
    """Names and properties, in the order of the XML."""
    iterator = servermanager.vtkSMOrderedPropertyIterator()
    iterator.SetProxy(proxy)
    while not iterator.IsAtEnd():
        yield iterator.GetKey(), iterator.GetProperty()
        iterator.Next()


def is_input(sm_property):
    return sm_property.IsA("vtkSMInputProperty")


def properties_of(proxy):
    """Those that can be set."""
    return [
        (key, found)
        for key, found in everything_of(proxy)
        if not is_input(found) and not found.GetInformationOnly()
    ]


def inputs_of(proxy):
    return [(key, found) for key, found in everything_of(proxy) if is_input(found)]


def all_properties():
    """Each property of each proxy: its name, itself, and an object of the class."""
    for name, cls in CLASSES.items():
        for key, sm_property in properties_of(prototype(name)):
            yield f"{name}.{key}", key, sm_property, cls()


def setters_of(cls):
    """What follows Set, of the classes that are ours."""
    ours = [base for base in cls.__mro__ if "NeuralMesh" in base.__name__]
    names = {method[3:] for base in ours for method in vars(base) if method.startswith("Set")}
    return {name for name in names if not any(name.startswith(f"{other}To") for other in names)}


def elements_of(sm_property):
    return [sm_property.GetElement(i) for i in range(sm_property.GetNumberOfElements())]


def value_of(vtk_object, setter):
    """As a list of elements."""
    value = getattr(vtk_object, "Get" + setter)()
    return list(value) if isinstance(value, tuple) else [value]


def range_of(sm_property):
    """Minimum and maximum, None where there is none."""
    domain = sm_property.FindDomain("vtkSMDoubleRangeDomain") or sm_property.FindDomain(
        "vtkSMIntRangeDomain"
    )
    exists = reference(0)
    low, high = domain.GetMinimum(0, exists), domain.GetMaximum(0, exists)
    return (
        low if domain.GetMinimumExists(0) else None,
        high if domain.GetMaximumExists(0) else None,
    )


def choices_of(sm_property):
    """The values of an enumeration by their texts."""
    domain = sm_property.FindDomain("vtkSMEnumerationDomain")
    return domain and {
        domain.GetEntryText(i): domain.GetEntryValue(i) for i in range(domain.GetNumberOfEntries())
    }


def elements_with_name(element, name):
    """Those below an element of XML, at any depth."""
    for i in range(element.GetNumberOfNestedElements() if element else 0):
        nested = element.GetNestedElement(i)
        if nested.GetName() == name:
            yield nested
        yield from elements_with_name(nested, name)


class Properties(unittest.TestCase):
    # Promise: a proxy stands for the class that its name says.
    def test_classes(self):
        for name, cls in CLASSES.items():
            named = prototype(name).GetVTKClassName()
            self.assertEqual(named.rpartition(".")[2], cls.__name__)

    # Promise: every public setter has its property, with its name, or a reason not to; no reason is
    # out of date.
    def test_setters(self):
        used = set()
        for name, cls in CLASSES.items():
            keys = {key for key, _ in properties_of(prototype(name))}
            setters = setters_of(cls)
            with self.subTest(name):
                of_one = {LISTS[key] for key in keys & set(LISTS)}
                self.assertEqual(setters - set(OTHERWISE) - of_one, keys - set(LISTS) - ARRAYS)
            used |= setters & set(OTHERWISE)
        self.assertEqual(used, set(OTHERWISE) - ({"Controller"} if support.IS_PYTHON else set()))
        for name in ARRAYS:
            command = prototype("NeuralMesh").GetProperty(name).GetCommand()
            self.assertEqual(command, f"Set{name}Name")

    # Promise: the property has the type of the setter, and calls it.
    @unittest.skipIf(support.IS_PYTHON, "what is written in Python has no types of C++")
    def test_types(self):
        for name, _, sm_property, vtk_object in all_properties():
            signature = getattr(vtk_object, sm_property.GetCommand()).__doc__
            wanted = re.search(r"C\+\+: .*?\((?:const )?(\w+)", signature, re.DOTALL)[1]
            is_switch = sm_property.FindDomain("vtkSMBooleanDomain") is not None
            with self.subTest(name):
                self.assertEqual(sm_property.GetClassName(), KINDS[wanted])
                self.assertEqual(is_switch, wanted == "vtkTypeBool")

    # Promise: defaults are those of the class.
    def test_defaults(self):
        for name, key, sm_property, vtk_object in all_properties():
            with self.subTest(name):
                if key in LISTS:
                    self.assertEqual(elements_of(sm_property), [])
                    continue
                expected = value_of(vtk_object, sm_property.GetCommand()[3:])
                self.assertEqual(elements_of(sm_property), expected)

    # Promise: ranges are those of the class, but for maxima that no slider could show.
    def test_ranges(self):
        checked = 0
        for name, key, sm_property, vtk_object in all_properties():
            if not hasattr(vtk_object, f"Get{key}MinValue"):
                continue
            low = getattr(vtk_object, f"Get{key}MinValue")()
            high = getattr(vtk_object, f"Get{key}MaxValue")()
            choices = choices_of(sm_property)
            with self.subTest(name):
                if choices:
                    self.assertEqual(sorted(choices.values()), list(range(low, high + 1)))
                elif sm_property.FindDomain("vtkSMBooleanDomain"):
                    self.assertEqual((low, high), (False, True))
                else:
                    shown = high if high <= LARGEST_SLIDER else None
                    low = 0 if hasattr(vtk_object, f"Get{key}TakesZero") else low
                    self.assertEqual(range_of(sm_property), (low, shown))
            checked += 1
        self.assertGreater(checked, 100)

    # Promise: the texts of enumerations are the names of the values in C++.
    def test_enumerations(self):
        checked = set()
        for name, key, sm_property, vtk_object in all_properties():
            choices = choices_of(sm_property)
            methods = [name for name in dir(vtk_object) if name.startswith(f"Set{key}To")]
            if not methods or hasattr(vtk_object, f"{key}On"):
                continue
            values = {}
            for method in methods:
                getattr(vtk_object, method)()
                values[method[len(f"Set{key}To") :]] = value_of(vtk_object, key)[0]
            with self.subTest(name):
                self.assertEqual({text.replace(" ", ""): v for text, v in choices.items()}, values)
            checked.add(key)
        self.assertLessEqual({"Variant", "Order", "Start", "Boundaries", "Jump"}, checked)
        precision = choices_of(prototype("NeuralMesh").GetProperty("OutputPointsPrecision"))
        self.assertEqual(precision, {"Single": 0, "Double": 1, "Default": 2})

    # Promise: what is set in ParaView arrives in the object, and before that it has its defaults.
    def test_values_arrive(self):
        for name, cls in CLASSES.items():
            proxy = servermanager.ProxyManager().NewProxy(group_of(name), name)
            proxy.UpdateVTKObjects()
            made = proxy.GetClientSideObject()
            self.assertIsInstance(made, cls)
            for key, sm_property in properties_of(proxy):
                if key in LISTS:
                    continue
                setter = sm_property.GetCommand()[3:]
                with self.subTest(proxy=name, property=key):
                    before = value_of(cls(), setter)
                    self.assertEqual(value_of(made, setter), before)
                    for i, element in enumerate(before):
                        sm_property.SetElement(i, self.another(cls(), key, sm_property, element))
                    proxy.UpdateVTKObjects()
                    self.assertEqual(value_of(made, setter), elements_of(sm_property))
                    self.assertNotEqual(value_of(made, setter), before)

    # Promise: places arrive, as many as there are, and go again.
    def test_viewpoints_arrive(self):
        for name in ("NeuralMesh", "NeuralMeshEnsemble"):
            proxy = servermanager.ProxyManager().NewProxy("filters", name)
            made = proxy.GetClientSideObject()
            for places in ([(1, 2, 3), (4, 5, 6)], [(7, 8, 9)], []):
                numbers = [number for place in places for number in place]
                proxy.GetProperty("Viewpoints").SetNumberOfElements(len(numbers))
                for i, number in enumerate(numbers):
                    proxy.GetProperty("Viewpoints").SetElement(i, number)
                proxy.UpdateVTKObjects()
                self.assertEqual(made.GetNumberOfViewpoints(), len(places))
                for i, place in enumerate(places):
                    found = [0.0, 0.0, 0.0]
                    made.GetViewpoint(i, found)
                    self.assertEqual(tuple(found), place)

    # Promise: levels arrive, as many as there are, and go again.
    def test_levels_arrive(self):
        proxy = servermanager.ProxyManager().NewProxy("filters", "NeuralMesh")
        made = proxy.GetClientSideObject()
        for levels in ([100, 200, 300], [400], []):
            proxy.GetProperty("Levels").SetNumberOfElements(len(levels))
            for i, vertices in enumerate(levels):
                proxy.GetProperty("Levels").SetElement(i, vertices)
            proxy.UpdateVTKObjects()
            found = [made.GetLevel(i) for i in range(made.GetNumberOfLevels())]
            self.assertEqual(found, levels)

    def another(self, vtk_object, key, sm_property, value):
        """A value within the range that is not this one."""
        if isinstance(value, str):
            return "Weights"
        if choices_of(sm_property):
            return next(other for other in choices_of(sm_property).values() if other != value)
        if hasattr(vtk_object, f"Get{key}MaxValue"):
            high = min(getattr(vtk_object, f"Get{key}MaxValue")(), LARGEST_INT)
            return high if value != high else getattr(vtk_object, f"Get{key}MinValue")()
        return 1 - value


class Panel(unittest.TestCase):
    # Promise: every filter, input and property tells what it is, and leaves defaults to the panel,
    # which cannot be out of date.
    def test_documentation(self):
        for name in CLASSES:
            proxy = prototype(name)
            texts = [(name, proxy.GetDocumentation())]
            texts += [(key, p.GetDocumentation()) for key, p in inputs_of(proxy)]
            texts += [(key, p.GetDocumentation()) for key, p in properties_of(proxy)]
            for key, documentation in texts:
                with self.subTest(proxy=name, text=key):
                    text = " ".join(documentation.GetDescription().split())
                    self.assertGreater(len(text), 10)
                    self.assertTrue(text.endswith("."), text)
                    self.assertNotRegex(text, r"[Dd]efault (is|[0-9])|[Rr]ange [0-9]")
            self.assertTrue(proxy.GetDocumentation().GetShortHelp())

    # Promise: the number comes first, and everything else stands in one of the groups, which are in
    # the order of a run.
    def test_groups(self):
        for name in CLASSES:
            proxy = prototype(name)
            keys = [key for key, _ in properties_of(proxy)]
            self.assertEqual(keys[0], FIRST[name])
            groups = [proxy.GetPropertyGroup(i) for i in range(proxy.GetNumberOfPropertyGroups())]
            grouped = [
                group.GetPropertyName(i)
                for group in groups
                for i in range(group.GetNumberOfProperties())
            ]
            if name in ("NeuralMesh", "NeuralMeshEnsemble"):
                self.assertEqual(grouped, keys[1:])
                labels = [group.GetXMLLabel() for group in groups]
                more = ["Ensemble" if name == "NeuralMeshEnsemble" else "Levels of Detail"]
                self.assertEqual(labels, GROUPS + more)

    # Promise: few properties are shown at first, and those are the ones that most people need.
    def test_advanced(self):
        most = {"NumberOfVertices", "Tolerance", "ToleranceIsPercent", "ToleranceMeasure", "Variant", "Seed", "TimeLimit", "Boundaries", "Fidelity",
                "TopologyLearning", "CarryPointData", "GrowthAsTime", "Automatic", "ComputeUncertainty"}
        for name, wanted in (
            ("NeuralMesh", most),
            ("NeuralMeshEnsemble", most | {"NumberOfMembers"}),
        ):
            properties = properties_of(prototype(name))
            shown = {key for key, p in properties if p.GetPanelVisibility() == "default"}
            self.assertEqual(shown, wanted)

    # Promise: what decides whether a property is shown is there, and can have that value.
    def test_decorators(self):
        found = set()
        for name in CLASSES:
            proxy = prototype(name)
            for key, sm_property in properties_of(proxy):
                hints = sm_property.GetHints()
                for element in elements_with_name(hints, "PropertyWidgetDecorator"):
                    with self.subTest(proxy=name, property=key):
                        self.assertEqual(element.GetAttribute("type"), "GenericDecorator")
                        self.assertEqual(element.GetAttribute("mode"), "visibility")
                        decider = proxy.GetProperty(element.GetAttribute("property"))
                        value = int(element.GetAttribute("value"))
                        choices = choices_of(decider)
                        self.assertIn(value, choices.values() if choices else (0, 1))
                        found.add((key, element.GetAttribute("property")))
        hidden = {key for key, _ in found}
        only_with_list = {"Jump", "JumpFraction", "ListVertices", "NormalWeight"}
        self.assertLessEqual({(key, "Order") for key in only_with_list}, found)
        only_with_topology = {"TopologyRules", "TopologyPatience", "TriangleRemovalFactor",
                              "BoundaryMergingFactor"}
        self.assertLessEqual({(key, "TopologyLearning") for key in only_with_topology}, found)
        self.assertNotIn("NumberOfVertices", hidden)

    # Promise: the filters are in the menu, and the outputs have names and views. The learning curve has
    # none until it is asked for, and then a representation of its own; its icon tells of the chart.
    def test_hints(self):
        for name in CLASSES:
            hints = prototype(name).GetHints()
            (menu,) = elements_with_name(hints, "ShowInMenu")
            self.assertEqual(menu.GetAttribute("category"), "Neural Mesh")
        views = {
            (name, view.GetAttribute("port")): view.GetAttribute("type")
            for name in CLASSES
            for view in elements_with_name(prototype(name).GetHints(), "View")
        }
        for name in ("NeuralMesh", "NeuralMeshEnsemble"):
            self.assertEqual(views[name, "1"], "None")
            (chart,) = elements_with_name(prototype(name).GetHints(), "Representation")
            self.assertEqual((chart.GetAttribute("view"), chart.GetAttribute("port")),
                             ("XYChartView", "1"))
            self.assertEqual(chart.GetAttribute("type"), "NeuralMeshLearningCurve")
            (icon,) = elements_with_name(prototype(name).GetHints(), "PipelineIcon")
            self.assertEqual((icon.GetAttribute("name"), icon.GetAttribute("port")),
                             ("XYChartView", "1"))
        self.assertEqual(views["NeuralMeshComparison", "2"], "SpreadSheetView")
        for name, cls in CLASSES.items():
            proxy = servermanager.ProxyManager().NewProxy(group_of(name), name)
            ports = cls().GetNumberOfOutputPorts()
            self.assertEqual(proxy.GetNumberOfOutputPorts(), ports)
            self.assertNotIn("Output-0", [proxy.GetOutputPortName(i) for i in range(ports)])


if __name__ == "__main__":
    unittest.main()
