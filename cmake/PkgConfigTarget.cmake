# SPDX-License-Identifier: Apache-2.0
# regulus_pkg(TARGET MODULE PACKAGE): an imported target from a pkg-config module. The caller's
# regulus_missing(WHAT PACKAGE) reports a missing module.
function(regulus_pkg target module package)
  if(TARGET ${target})
    return()
  endif()
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
