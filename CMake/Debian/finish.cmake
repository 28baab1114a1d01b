# What Debian wants of the files of a package, beyond what `cmake --install` gives.
set(root "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr")
set(documents "${root}/share/doc/${CPACK_PACKAGE_NAME}")

# Its licence and the changes where Debian has them, manual pages packed. The package is as old as the
# version that was released last.
file(MAKE_DIRECTORY "${documents}")
file(COPY_FILE "${root}/share/doc/NeuralMesh/LICENSE" "${documents}/copyright")
file(COPY_FILE "${root}/share/doc/NeuralMesh/CHANGELOG.md" "${documents}/changelog")
file(GLOB manual_pages "${root}/share/man/man1/*.1")
file(STRINGS "${documents}/changelog" releases REGEX "^## \\[[0-9.]+\\] - ")
list(GET releases 0 newest)
string(REGEX REPLACE ".* - " "" day "${newest}")
execute_process(
  COMMAND date --utc --rfc-email --date "${day}"
  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
configure_file("${CMAKE_CURRENT_LIST_DIR}/changelog.in" "${documents}/changelog.Debian" @ONLY)
execute_process(
  COMMAND gzip -9n "${documents}/changelog" "${documents}/changelog.Debian" ${manual_pages}
  COMMAND_ERROR_IS_FATAL ANY)

# The one folder in which Debian's ParaView and its Python and servers look for plugins unasked.
if (EXISTS "${root}/lib/neuralmesh/NeuralMesh/NeuralMesh.so")
  file(MAKE_DIRECTORY "${root}/bin/plugins")
  file(CREATE_LINK ../../lib/neuralmesh/NeuralMesh/NeuralMesh.so
    "${root}/bin/plugins/NeuralMesh.so" SYMBOLIC)
endif ()

# What lintian is not to find fault with, and why.
configure_file("${CMAKE_CURRENT_LIST_DIR}/lintian-overrides"
  "${root}/share/lintian/overrides/${CPACK_PACKAGE_NAME}" COPYONLY)
