# Finds the VTK to build against: ParaView's, if there is a ParaView to develop with, else VTK.
set(NEURALMESH_VTK_COMPONENTS
  CommonCore
  CommonDataModel
  CommonExecutionModel
  CommonMisc
  CommonSystem
  FiltersCore
  FiltersModeling
  FiltersSources
  IOCore
  IOGeometry
  IOLegacy
  IOPLY
  IOXML
  ParallelCore)

# VTK's Python is the system's; another may come first on the PATH.
find_program(Python3_EXECUTABLE NAMES python3 HINTS /usr/bin)
set(NEURALMESH_VTK_PYTHON_COMPONENTS Python WrappingPythonCore)

include(NeuralMeshDebianPython)
# Not looked for where it is not wanted: on Debian 13 a paraview-dev without python3-paraview is an error.
if (NEURALMESH_USE_PARAVIEW OR NOT DEFINED NEURALMESH_USE_PARAVIEW)
  find_package(ParaView 5.10 QUIET COMPONENTS RemotingCore WrapClientServer ProcessXML)
endif ()
option(NEURALMESH_USE_PARAVIEW "Build against ParaView's VTK" "${ParaView_FOUND}")
if (NEURALMESH_USE_PARAVIEW)
  find_package(ParaView 5.10 REQUIRED COMPONENTS RemotingCore WrapClientServer ProcessXML)
  find_package(VTK REQUIRED COMPONENTS ${NEURALMESH_VTK_COMPONENTS}
    OPTIONAL_COMPONENTS ${NEURALMESH_VTK_PYTHON_COMPONENTS}
    PATHS "${ParaView_DIR}/vtk" NO_DEFAULT_PATH)
else ()
  find_package(VTK 9.1 REQUIRED COMPONENTS ${NEURALMESH_VTK_COMPONENTS}
    OPTIONAL_COMPONENTS ${NEURALMESH_VTK_PYTHON_COMPONENTS})
endif ()

if (VTK_Python_FOUND AND VTK_WrappingPythonCore_FOUND)
  set(NEURALMESH_PYTHON_FOUND ON)
else ()
  set(NEURALMESH_PYTHON_FOUND OFF)
endif ()
# Python and ParaView load shared libraries alone.
set(NEURALMESH_WRAPS_PYTHON OFF)
set(NEURALMESH_HAS_PLUGIN OFF)
if (BUILD_SHARED_LIBS)
  set(NEURALMESH_WRAPS_PYTHON "${NEURALMESH_PYTHON_FOUND}")
  set(NEURALMESH_HAS_PLUGIN "${NEURALMESH_USE_PARAVIEW}")
endif ()
option(NEURALMESH_WRAP_PYTHON "Build the Python package" "${NEURALMESH_WRAPS_PYTHON}")
if (NEURALMESH_WRAP_PYTHON AND NOT NEURALMESH_PYTHON_FOUND)
  message(FATAL_ERROR "NEURALMESH_WRAP_PYTHON: this VTK was built without Python, or Python's "
    "headers are missing.")
endif ()

option(NEURALMESH_BUILD_PARAVIEW_PLUGIN "Build the ParaView plugin" "${NEURALMESH_HAS_PLUGIN}")
if (NEURALMESH_BUILD_PARAVIEW_PLUGIN AND NOT NEURALMESH_USE_PARAVIEW)
  message(FATAL_ERROR "NEURALMESH_BUILD_PARAVIEW_PLUGIN: the plugin needs NEURALMESH_USE_PARAVIEW.")
endif ()
if (NOT BUILD_SHARED_LIBS AND (NEURALMESH_WRAP_PYTHON OR NEURALMESH_BUILD_PARAVIEW_PLUGIN))
  message(FATAL_ERROR "NEURALMESH_WRAP_PYTHON and NEURALMESH_BUILD_PARAVIEW_PLUGIN need BUILD_SHARED_LIBS: "
    "switch them off, or that on.")
endif ()
