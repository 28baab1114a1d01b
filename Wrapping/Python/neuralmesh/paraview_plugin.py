# SPDX-License-Identifier: BSD-3-Clause
"""The plugin for a ParaView for which nothing has been compiled: load this file in Tools > Manage Plugins.

It brings the filters of the compiled plugin, under the same names, so that states of one load with the
other. They learn by the engine in the folder of this file, in one process.
"""

import importlib.util
import os
import sys

_FOLDER = os.path.dirname(os.path.abspath(__file__))
_PROXIES = os.path.join(_FOLDER, "paraview_plugin.xml")
_COMPILED = "NeuralMesh"

paraview_plugin_name = "NeuralMeshPython"


class _Unusable(Exception):
    """Says in one sentence what to do."""


class _Proxies:
    """What ParaView looks for in the module: XML, as its own decorators leave it in classes."""

    def __init__(self, xml):
        self._pvsm_proxy_xml = xml


def _load_package():
    """The package that this file is of, whatever the path of modules says."""
    package = sys.modules.get("neuralmesh")
    if package is not None:
        if not os.path.samefile(os.path.dirname(package.__file__), _FOLDER):
            raise _Unusable(
                f"another package neuralmesh is in use, {package.__file__}: start ParaView without it "
                "in PYTHONPATH, or load the plugin that belongs to it."
            )
        return package
    spec = importlib.util.spec_from_file_location(
        "neuralmesh", os.path.join(_FOLDER, "__init__.py"), submodule_search_locations=[_FOLDER]
    )
    package = importlib.util.module_from_spec(spec)
    sys.modules["neuralmesh"] = package
    # Where ParaView brings no NumPy, that beside the package will do.
    beside = os.path.dirname(_FOLDER)
    sys.path.append(beside)
    try:
        spec.loader.exec_module(package)
        importlib.import_module("neuralmesh.engine.paraview_filters")
    except ImportError as error:
        for name in [name for name in sys.modules if name.partition(".")[0] == "neuralmesh"]:
            del sys.modules[name]
        raise _Unusable(_advice(error)) from error
    finally:
        sys.path.remove(beside)
    return package


def _advice(error):
    version = "{}.{}".format(*sys.version_info)
    if importlib.util.find_spec("numpy") is None:
        return f"the Python of this ParaView ({version}) has no NumPy ({error})."
    if error.__cause__ is None:
        return str(error)
    return (
        f"{_FOLDER} has no engine for the Python of this ParaView, {version} ({error.__cause__}): make a "
        f"virtual environment of Python {version}, pip install neuralmesh there, and load its "
        "paraview_plugin.py, whose place python -m neuralmesh paraview prints."
    )


def _is_compiled_loaded():
    try:
        from paraview.modules.vtkRemotingCore import vtkPVPluginTracker
    except ImportError:
        return False
    tracker = vtkPVPluginTracker.GetInstance()
    return any(
        tracker.GetPluginName(i) == _COMPILED and tracker.GetPluginLoaded(i)
        for i in range(tracker.GetNumberOfPlugins())
    )


def _make_proxies():
    if _is_compiled_loaded():
        raise _Unusable(
            "the compiled plugin NeuralMesh is loaded, which has the same filters: nothing is done."
        )
    if not _load_package().__dict__.get("Mesh"):
        raise _Unusable(
            f"{_FOLDER} is of a package with C++ classes: load its compiled plugin, NeuralMesh.so."
        )
    try:
        with open(_PROXIES, encoding="utf-8") as file:
            return _Proxies(file.read())
    except OSError as error:
        raise _Unusable(f"the package is incomplete ({error}): install it again.") from error


try:
    proxies = _make_proxies()
except _Unusable as unusable:
    from vtkmodules.vtkCommonCore import vtkOutputWindow

    vtkOutputWindow.GetInstance().DisplayErrorText(f"NeuralMesh for ParaView: {unusable}\n")
