# SPDX-License-Identifier: Apache-2.0
# `make deb`, or `cpack` in the build folder: the packages
#
#   regulus         the commands, the compiler plugins, models and documentation
#   regulus-mpi     searches by many processes, if REGULUS_MPI is on
#   python3-regulus the module for Python, if REGULUS_PYTHON is on
#   libregulus-dev  files to build programs with a kernel; needs the command to generate one
#
# Files without a component of cmake/Install.cmake (man pages, completions) are packed with the
# commands.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME regulus)
set(CPACK_PACKAGE_VENDOR Regulus)
set(CPACK_PACKAGE_CONTACT "Regulus <regulus@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_STRIP_FILES ON)

get_cmake_property(components COMPONENTS)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
foreach(component IN LISTS components)
  string(TOUPPER ${component} upper)
  set(CPACK_COMPONENT_${upper}_GROUP command)
endforeach()
set(CPACK_COMPONENT_MPI_GROUP cluster)
set(CPACK_COMPONENT_PYTHON_GROUP python)
set(CPACK_COMPONENT_RUNTIME_GROUP library)
set(CPACK_COMPONENT_DEVELOPMENT_GROUP library)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME regulus)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
# dpkg-shlibdeps finds no package for libLLVM by its path in LLVM's own folder.
if("${LLVM_DIR}" MATCHES "llvm-([0-9]+)")
  set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "libllvm${CMAKE_MATCH_1}")
endif()
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "libregulus-dev, gnuplot-nox | gnuplot")
set(CPACK_COMPONENT_GROUP_COMMAND_DESCRIPTION "proves that a parallel robot has no singular pose, or shows one
 Certifies a workspace or a trajectory in spite of rounding, manufacturing
 tolerances and control errors, by interval analysis; compiles the robot's
 functions in process.")

# The plugins and the models are those of the package regulus.
set(CPACK_DEBIAN_CLUSTER_PACKAGE_NAME regulus-mpi)
set(CPACK_DEBIAN_CLUSTER_PACKAGE_SECTION science)
set(CPACK_DEBIAN_CLUSTER_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_CLUSTER_PACKAGE_DEPENDS "regulus (= ${PROJECT_VERSION}), openmpi-bin | mpich")
set(CPACK_COMPONENT_GROUP_CLUSTER_DESCRIPTION "searches for singular poses of parallel robots by many processes
 Runs the searches of regulus on the processes that MPI starts, on one machine
 or on a cluster. The results are the same to the byte.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-regulus)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
# A compiled module is for one version of Python.
if(REGULUS_PYTHON)
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "regulus (= ${PROJECT_VERSION}), python3-numpy, \
python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python})")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-sympy, python3-matplotlib")
set(CPACK_COMPONENT_GROUP_PYTHON_DESCRIPTION "proves in Python that a robot has no singular pose, or shows one
 Asks the questions of regulus from Python: exact numbers, pavings as arrays of
 NumPy, robots made of matrices of SymPy.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libregulus-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "regulus (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS
    "cmake, pkg-config, libtbb-dev, libginac-dev, libcln-dev, libflint-dev, libtomlplusplus-dev, libtinyxml2-dev, libfmt-dev")
set(CPACK_COMPONENT_GROUP_LIBRARY_DESCRIPTION "checks of parallel robots for singular poses, to be built into programs
 Static libraries, headers, and the CMake function regulus_add_kernel, which
 makes of a model file a library that checks pieces of a motion in a control
 loop.")
include(CPack)
cpack_add_component_group(command)
cpack_add_component_group(library)
if(REGULUS_MPI)
  cpack_add_component_group(cluster)
endif()
if(REGULUS_PYTHON)
  cpack_add_component_group(python)
endif()
