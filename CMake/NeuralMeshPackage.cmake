# The Debian package: `cpack` in the folder of the build, or Utilities/make_packages.sh.
if (NEURALMESH_USE_PARAVIEW)
  set(world ParaView)
  set(python_package python3-paraview)
  set(development_packages "paraview-dev, libopenmpi-dev")
else ()
  set(world VTK)
  set(python_package python3-vtk9)
  set(development_packages libvtk9-dev)
endif ()
string(TOLOWER "neuralmesh-${world}" CPACK_PACKAGE_NAME)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR NeuralMesh)
set(CPACK_PACKAGE_CONTACT "The authors of NeuralMesh <neuralmesh@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "triangle meshes from point clouds, by learning, with ${world}")
set(CPACK_PACKAGE_DESCRIPTION
"NeuralMesh turns a raw 3D scan, a point cloud without normals, with noise
and outliers, into a triangle mesh with as many vertices as are asked for.
The package has the command neuralmesh, the library, the Python package
neuralmesh, what C++ needs, and where it goes with ParaView the plugin.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# One for each Debian: that of the next one is the newer.
cmake_host_system_information(RESULT release QUERY DISTRIB_INFO)
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~deb${release_VERSION_ID}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# What Python imports, as no program is linked with it, and the Python that the module was made for.
execute_process(
  COMMAND "${Python3_EXECUTABLE}" -c
    "import sys; print('python3 (>= {0}.{1}~), python3 (<< {0}.{2})'.format(
      *sys.version_info[:2], sys.version_info[1] + 1))"
  OUTPUT_VARIABLE python OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${python}, ${python_package}, python3-numpy")
# For the pictures of galleries where there is no display.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "xvfb, xauth, libgl1-mesa-dri")
# For C++, and for the laboratory.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "${development_packages}, g++, cmake, make, python3-matplotlib, libcgal-demo, glmark2-data")
# One for each VTK, of which Debian installs one at a time.
set(CPACK_DEBIAN_PACKAGE_PROVIDES "neuralmesh (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_PACKAGE_CONFLICTS neuralmesh)
set(CPACK_DEBIAN_PACKAGE_REPLACES neuralmesh)

set(debian "${CMAKE_CURRENT_LIST_DIR}/Debian")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${debian}/triggers")
foreach (script IN ITEMS postinst prerm)
  configure_file("${debian}/${script}.in" "${CMAKE_BINARY_DIR}/debian/${script}" @ONLY)
  list(APPEND CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_BINARY_DIR}/debian/${script}")
endforeach ()
set(CPACK_PRE_BUILD_SCRIPTS "${debian}/finish.cmake")
include(CPack)
