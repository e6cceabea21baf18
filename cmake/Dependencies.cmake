# SPDX-License-Identifier: Apache-2.0
# Finds the dependencies of the front end, and names the Debian package of a missing one.

include(${CMAKE_CURRENT_LIST_DIR}/PkgConfigTarget.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/CodegenDependencies.cmake)
regulus_pkg(regulus_mpfr mpfr libmpfr-dev)

find_package(CLI11 QUIET)
if(NOT CLI11_FOUND)
  regulus_missing(CLI11 libcli11-dev)
endif()
find_package(nlohmann_json QUIET)
if(NOT nlohmann_json_FOUND)
  regulus_missing("nlohmann-json" nlohmann-json3-dev)
endif()

find_package(Eigen3 QUIET NO_MODULE)
if(NOT Eigen3_FOUND)
  regulus_missing(Eigen libeigen3-dev)
endif()
