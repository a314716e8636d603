# Finds the distribution's Python with numpy and pybind11. Sets VIETE_HAS_PYTHON, and VIETE_PYTHON_DIR, the module folder.
# Uses /usr/bin/python3, which packages serve, instead of the first python3 on the PATH.
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.8 QUIET COMPONENTS Interpreter Development.Module)
set(PYBIND11_FINDPYTHON ON)
if(Python_Development.Module_FOUND)  # without it, as when cross-compiling, pybind11 fails
  find_package(pybind11 2.9 QUIET CONFIG)
endif()

set(VIETE_HAS_PYTHON OFF)
if(Python_Interpreter_FOUND AND Python_Development.Module_FOUND AND pybind11_FOUND)
  execute_process(
    COMMAND ${Python_EXECUTABLE} -c "import numpy, sysconfig; print(sysconfig.get_path('purelib').rsplit('/')[-1])"
    OUTPUT_VARIABLE packages OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(VIETE_HAS_PYTHON ON)
    set(VIETE_PYTHON_DIR lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/${packages} CACHE STRING
      "Where the Python module is installed, below the prefix")
  endif()
endif()
