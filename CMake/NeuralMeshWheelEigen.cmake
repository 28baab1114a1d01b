# Lets find_package() see the Eigen that pip has brought for the build, in the package cmeel-eigen.
find_package(Python 3.11 REQUIRED COMPONENTS Interpreter)
execute_process(
  COMMAND "${Python_EXECUTABLE}" -c
    "import pathlib, sys; print(*(p for p in (pathlib.Path(q, 'cmeel.prefix') for q in sys.path) if p.is_dir()), sep=';')"
  OUTPUT_VARIABLE prefixes
  OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
list(APPEND CMAKE_PREFIX_PATH ${prefixes})
