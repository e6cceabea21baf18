# SPDX-License-Identifier: GPL-3.0-or-later
# REGULUS_PYTHON: build the Python module regulus. Without a choice: if pybind11 and Python's headers
# are there.
#
# Debian's pybind11, NumPy and pytest are those of /usr/bin/python3, which need not be the first in
# PATH. A virtual environment, or Python_EXECUTABLE, is another choice.
if(NOT DEFINED Python_EXECUTABLE AND NOT DEFINED ENV{VIRTUAL_ENV} AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
if(NOT DEFINED REGULUS_PYTHON)
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 QUIET CONFIG)
elseif(REGULUS_PYTHON)
  find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 REQUIRED CONFIG)
endif()
set(REGULUS_PYTHON_FOUND OFF)
if(Python_Development.Module_FOUND AND pybind11_FOUND)
  set(REGULUS_PYTHON_FOUND ON)
endif()
option(REGULUS_PYTHON "Build the Python module regulus" ${REGULUS_PYTHON_FOUND})
if(REGULUS_PYTHON)
  message(STATUS "Python module: for ${Python_EXECUTABLE} ${Python_VERSION}")
endif()
