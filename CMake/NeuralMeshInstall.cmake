# What find_package(NeuralMesh) reads, and the documentation.
include(CMakePackageConfigHelpers)

set(cmake_destination "${CMAKE_INSTALL_LIBDIR}/cmake/NeuralMesh")
configure_file("${CMAKE_CURRENT_LIST_DIR}/NeuralMeshConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/${cmake_destination}/NeuralMeshConfig.cmake" @ONLY)
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${cmake_destination}/NeuralMeshConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
# NeuralMeshConfig.cmake includes it from beside itself, in the build folder, too.
configure_file("${CMAKE_CURRENT_LIST_DIR}/NeuralMeshDebianPython.cmake"
  "${CMAKE_BINARY_DIR}/${cmake_destination}/NeuralMeshDebianPython.cmake" COPYONLY)
install(
  FILES
    "${CMAKE_BINARY_DIR}/${cmake_destination}/NeuralMeshConfig.cmake"
    "${CMAKE_BINARY_DIR}/${cmake_destination}/NeuralMeshConfigVersion.cmake"
    "${CMAKE_BINARY_DIR}/${cmake_destination}/NeuralMeshDebianPython.cmake"
  DESTINATION "${cmake_destination}"
  COMPONENT development)

install(FILES README.md CHANGELOG.md LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY Documentation DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  PATTERN CMakeLists.txt EXCLUDE
  PATTERN Doxyfile.in EXCLUDE
  PATTERN Parameters.md EXCLUDE)
# With its tables.
install(FILES "${PROJECT_BINARY_DIR}/Documentation/Guide/Parameters.md"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}/Documentation/Guide")
