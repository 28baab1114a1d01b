# Usage requirements of all our own targets: warnings, and arithmetic that gives the same bits on
# every machine.
add_library(NeuralMeshCompilerFlags INTERFACE)
target_compile_options(NeuralMeshCompilerFlags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  -ffp-contract=off
  $<$<BOOL:${NEURALMESH_WARNINGS_AS_ERRORS}>:-Werror>)
