# To be included before find_package(ParaView) or find_package(VTK).
#
# On Debian 13 the Python modules of ParaView's VTK carry the version of Python in their names, as
# vtkCommonCore.cpython-313-*.so. The CMake files of paraview-dev name them without it, and stop because there
# are no such files. Nothing here links a Python module: the check is left out for those that have the longer
# name alone. CMake, from 3.28, leaves it out for a target of which this variable names a folder.
function(neuralmesh_accept_python_modules)
  set(packages /usr/lib/python3/dist-packages)
  foreach (of_targets IN ITEMS "VTK:vtkmodules" "ParaView:paraview/modules" "ParaView:paraview/incubator")
    string(REPLACE ":" ";" of_targets "${of_targets}")
    list(POP_FRONT of_targets namespace folder)
    file(GLOB modules "${packages}/${folder}/*.cpython-*.so")
    foreach (module IN LISTS modules)
      cmake_path(GET module STEM name)
      if (NOT EXISTS "${packages}/${folder}/${name}.so")
        set("_cmake_import_check_xcframework_for_${namespace}::${name}Python"
          "${packages}/${folder}" PARENT_SCOPE)
      endif ()
    endforeach ()
  endforeach ()
endfunction ()
neuralmesh_accept_python_modules()
