# Finds the distribution's Python with numpy and pybind11. Sets VIETE_HAS_PYTHON, and VIETE_PYTHON_DIR, the module folder.
# Prefers /usr/bin/python3 to another python3 on the PATH: the distribution's packages are for this Python.
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.8 QUIET COMPONENTS Interpreter Development.Module)
set(PYBIND11_FINDPYTHON ON)
if(Python_Development.Module_FOUND)  # pybind11 fails without this component, for example when cross-compiling
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
