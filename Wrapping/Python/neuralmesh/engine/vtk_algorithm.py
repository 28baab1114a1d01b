# SPDX-License-Identifier: BSD-3-Clause
"""What the classes for pipelines have in common: how VTK's own classes are used and what they say."""

from __future__ import annotations

import inspect
import os
import re
import sys
from typing import Any, Callable

from .mesh import Mesh
from .vtk_arrays import polygons_of, table_column
from .vtk_names import (
    PACKAGE,
    VTKPythonAlgorithmBase,
    vtkAlgorithm,
    vtkDataObject,
    vtkObject,
    vtkOutputWindow,
    vtkPolyData,
)

_KINDS = {"ErrorEvent": "ERROR", "WarningEvent": "Warning"}


class vtkEngineAlgorithm(VTKPythonAlgorithmBase):
    """A filter of vtkPolyData as vtkPolyDataAlgorithm is one, whose work is done by the engine.

    Each SetX() with a GetX() is the property x, too, which the constructor takes as a keyword.
    """

    _OUTPUTS: tuple[str, ...] = ("vtkPolyData",)
    _INPUTS: tuple[tuple[str, ...], ...] = (("vtkPolyData",),)
    _OPTIONAL_INPUTS = False

    def __init_subclass__(cls, **more: Any) -> None:
        super().__init_subclass__(**more)
        for name in _values_of(cls):
            if not hasattr(cls, _snake_case(name)):
                setattr(cls, _snake_case(name), _property(f"Get{name}", f"Set{name}"))

    def __init__(self) -> None:
        VTKPythonAlgorithmBase.__init__(
            self, nInputPorts=len(self._INPUTS), nOutputPorts=len(self._OUTPUTS)
        )
        # What ParaView shows beside the bar, in place of the name of a class of VTK.
        self.SetProgressText(" ".join(re.findall("[A-Z][a-z]+", type(self).__name__)))

    def _set(self, properties: dict[str, Any]) -> None:
        for name, value in properties.items():
            if not isinstance(getattr(type(self), name, None), property):
                raise TypeError(f"{type(self).__name__}() has no property {name!r}")
            setattr(self, name, value)

    def __str__(self) -> str:
        lines = [super().__str__().rstrip()]
        lines += [f"  {name}: {getattr(self, f'Get{name}')()}" for name in _values_of(type(self))]
        return "\n".join(lines) + "\n\n"

    def GetClassName(self) -> str:
        """That of C++."""
        return type(self).__name__

    def FillInputPortInformation(self, port: int, info: Any) -> int:
        """What the port takes."""
        if self._OPTIONAL_INPUTS:
            info.Set(vtkAlgorithm.INPUT_IS_OPTIONAL(), 1)
        for kind in self._INPUTS[port]:
            info.Append(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), kind)
        return 1

    def FillOutputPortInformation(self, port: int, info: Any) -> int:
        """What the port gives."""
        info.Set(vtkDataObject.DATA_TYPE_NAME(), self._OUTPUTS[port])
        return 1

    def GetOutput(self, port: int = 0) -> Any:
        """The output of a port."""
        return self.GetOutputDataObject(port)

    def GetInput(self, port: int = 0) -> Any:
        """The first input of a port; None if there is none."""
        is_there = (
            port < self.GetNumberOfInputPorts() and self.GetNumberOfInputConnections(port) > 0
        )
        return self.GetInputDataObject(port, 0) if is_there else None

    def GetPolyDataInput(self, port: int = 0) -> Any:
        """The same, where it is a vtkPolyData."""
        data = self.GetInput(port)
        return data if data is not None and data.IsA("vtkPolyData") else None

    def SetOutput(self, output: Any) -> None:
        """Have the output of port 0 in this data object."""
        self.GetExecutive().SetOutputData(0, output)

    def SetInputData(self, *arguments: Any) -> None:
        """Set the input: SetInputData(data) or SetInputData(port, data)."""
        port, data = arguments if len(arguments) == 2 else (0, *arguments)
        self.SetInputDataObject(port, data)

    def AddInputData(self, *arguments: Any) -> None:
        """Add an input: AddInputData(data) or AddInputData(port, data)."""
        port, data = arguments if len(arguments) == 2 else (0, *arguments)
        self.AddInputDataObject(port, data)

    def _error(self, text: str) -> None:
        self._say("ErrorEvent", text)

    def _warn(self, text: str) -> None:
        self._say("WarningEvent", text)

    def _say(self, event: str, text: str) -> None:
        """As vtkErrorMacro and vtkWarningMacro: to who observes that, or else to everybody."""
        if not vtkObject.GetGlobalWarningDisplay():
            return
        caller = sys._getframe(2)
        message = (
            f"{_KINDS[event]}: In {os.path.basename(caller.f_code.co_filename)}, line "
            f"{caller.f_lineno}\n{type(self).__name__} ({id(self):#x}): {text}\n\n"
        )
        window = vtkOutputWindow.GetInstance()
        if self.HasObserver(event):
            self.InvokeEvent(event, message)
        elif event == "ErrorEvent":
            window.DisplayErrorText(message)
        else:
            window.DisplayWarningText(message)

    def _progress(self) -> Callable[[float], bool]:
        """Tells how far it is, and returns whether to go on."""

        def tell(fraction: float) -> bool:
            self.UpdateProgress(fraction)
            # Not CheckAbort(): it would have the executive throw away the mesh learnt so far.
            return not self.GetAbortExecute()

        return tell

    def _obey_abort(self) -> None:
        """Abort has been obeyed: the next execution starts clean."""
        if self.GetAbortExecute():
            self.SetAbortExecute(0)

    def _surface(self, inputs: Any, port: int) -> Mesh:
        """The triangles of an input."""
        return Mesh(*polygons_of(vtkPolyData.GetData(inputs[port])))


def fill_table(table: Any, columns: dict[str, Any]) -> None:
    """Give a vtkTable columns."""
    for name, values in columns.items():
        table.AddColumn(table_column(values, name, PACKAGE))


def _values_of(cls: type) -> list[str]:
    """What follows Get and Set, of classes of this package and not of VTK, where Get asks for nothing."""
    package = __name__.partition(".")[0]
    ours = [base for base in cls.__mro__ if base.__module__.partition(".")[0] == package]
    getters = {name for base in ours for name in vars(base) if name.startswith("Get")}
    return sorted(
        name[3:]
        for name in getters
        if hasattr(cls, "Set" + name[3:])
        and len(inspect.signature(getattr(cls, name)).parameters) == 1
    )


def _snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _property(getter: str, setter: str) -> property:
    def get(this: Any) -> Any:
        return getattr(this, getter)()

    def set_value(this: Any, value: Any) -> None:
        getattr(this, setter)(value)

    return property(get, set_value, doc=f"{getter}() and {setter}().")
