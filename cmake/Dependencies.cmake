# SPDX-License-Identifier: Apache-2.0
# Finds what the front end needs and names the Debian package of what is missing.

# regulus_pkg(TARGET MODULE PACKAGE): an imported target from a pkg-config module.
function(regulus_pkg target module package)
  find_package(PkgConfig QUIET)
  if(NOT PkgConfig_FOUND)
    regulus_missing("pkg-config" pkg-config)
  endif()
  pkg_check_modules(${target} QUIET IMPORTED_TARGET GLOBAL ${module})
  if(NOT ${target}_FOUND)
    regulus_missing("${module}" ${package})
  endif()
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(${target} INTERFACE PkgConfig::${target})
endfunction()

regulus_pkg(regulus_ginac ginac libginac-dev)
regulus_pkg(regulus_cln cln libcln-dev)
regulus_pkg(regulus_mpfr mpfr libmpfr-dev)
regulus_pkg(regulus_tomlplusplus tomlplusplus libtomlplusplus-dev)

find_package(CLI11 QUIET)
if(NOT CLI11_FOUND)
  regulus_missing(CLI11 libcli11-dev)
endif()
find_package(fmt QUIET)
if(NOT fmt_FOUND)
  regulus_missing(fmt libfmt-dev)
endif()
find_package(nlohmann_json QUIET)
if(NOT nlohmann_json_FOUND)
  regulus_missing("nlohmann-json" nlohmann-json3-dev)
endif()

find_package(Eigen3 QUIET NO_MODULE)
if(NOT Eigen3_FOUND)
  regulus_missing(Eigen libeigen3-dev)
endif()

if(NOT TARGET regulus_arb)
  regulus_missing("Arb (arb.h) or FLINT" "libflint-arb-dev libflint-dev")
endif()
