# vtk.js, with which galleries show meshes in 3D: from the npm registry, once for a build folder.
# Without it galleries have pictures only.
set(viewer_version 37.3.1)
set(viewer_sha256 e1dff3a8a3ebe078c259c496357766e086871267089bbf61f8c262d878308ba7)
set(viewer "${package}/batch/page/vtk.js")

option(NEURALMESH_BUNDLE_VIEWER "Fetch vtk.js by npm, for the 3D views of galleries" ON)
find_program(NEURALMESH_NPM npm)
mark_as_advanced(NEURALMESH_NPM)

# Whether the file is vtk.js, of the version above.
function(neuralmesh_is_viewer file result)
  set(found "")
  if (EXISTS "${file}")
    file(SHA256 "${file}" found)
  endif ()
  if (found STREQUAL viewer_sha256)
    set("${result}" ON PARENT_SCOPE)
  else ()
    set("${result}" OFF PARENT_SCOPE)
  endif ()
endfunction ()

# Fetches it and its licence to where the package has it, if all goes well. By itself npm tries for more
# than a minute where there is no way out, at each configuration.
function(neuralmesh_fetch_viewer)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/vtk.js")
  file(REMOVE_RECURSE "${folder}")
  file(MAKE_DIRECTORY "${folder}")
  execute_process(
    COMMAND "${NEURALMESH_NPM}" pack --silent "vtk.js@${viewer_version}"
      --fetch-retries=1 --fetch-retry-mintimeout=1000 --fetch-timeout=20000
    WORKING_DIRECTORY "${folder}" TIMEOUT 120
    OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  set(archive "${folder}/vtk.js-${viewer_version}.tgz")
  if (EXISTS "${archive}")
    file(ARCHIVE_EXTRACT INPUT "${archive}" DESTINATION "${folder}"
      PATTERNS package/vtk.js package/LICENSE)
    neuralmesh_is_viewer("${folder}/package/vtk.js" is_viewer)
    if (is_viewer)
      file(COPY_FILE "${folder}/package/LICENSE" "${viewer}.LICENSE")
      file(COPY_FILE "${folder}/package/vtk.js" "${viewer}")
    endif ()
  else ()
    message(STATUS "npm pack: ${status} ${output}")
  endif ()
  file(REMOVE_RECURSE "${folder}")
endfunction ()

neuralmesh_is_viewer("${viewer}" is_viewer)
if (NEURALMESH_BUNDLE_VIEWER AND NEURALMESH_NPM AND NOT is_viewer)
  neuralmesh_fetch_viewer()
  neuralmesh_is_viewer("${viewer}" is_viewer)
endif ()
if (NEURALMESH_BUNDLE_VIEWER AND is_viewer)
  set(NEURALMESH_HAS_VIEWER ON CACHE INTERNAL "")
  install(FILES "${viewer}" "${viewer}.LICENSE"
    DESTINATION "${viewer_destination}" COMPONENT python)
else ()
  set(NEURALMESH_HAS_VIEWER OFF CACHE INTERNAL "")
  file(REMOVE "${viewer}" "${viewer}.LICENSE")
  message(STATUS "Galleries have pictures only, no 3D views: NEURALMESH_BUNDLE_VIEWER is off, there "
    "is no npm, or it could not fetch vtk.js ${viewer_version}")
endif ()
