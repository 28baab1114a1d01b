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
"NeuralMesh turns a raw 3D scan, a point cloud without normals, with noise and
outliers, into a triangle mesh with as many vertices as are asked for.
The package has the command neuralmesh, the library, the Python package
neuralmesh, what C++ needs, and the ParaView plugin where it goes with ParaView.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
# What Python imports, as no program is linked with it.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${python_package}, python3-numpy")
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
