# What follows from the list of parameters, Filters/Parameters.json: headers, XML of the ParaView plugin
# and the page Documentation/Guide/Parameters.md, each from a template, in the build tree where that lies in
# the sources. They are written anew where the list, a template or a script has changed.
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)

set(scripts "${CMAKE_CURRENT_LIST_DIR}/Parameters")
execute_process(
  COMMAND "${Python3_EXECUTABLE}" -B "${scripts}/generate.py" "${PROJECT_SOURCE_DIR}"
    "${PROJECT_BINARY_DIR}"
  OUTPUT_VARIABLE inputs
  ERROR_VARIABLE errors
  RESULT_VARIABLE status)
if (NOT status EQUAL 0)
  message(FATAL_ERROR "The list of parameters cannot be used:\n${errors}")
endif ()
string(REGEX MATCHALL "[^\n]+" inputs "${inputs}")
file(GLOB scripts CONFIGURE_DEPENDS "${scripts}/*.py")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${inputs} ${scripts})
