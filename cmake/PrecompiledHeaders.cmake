# SPDX-License-Identifier: Apache-2.0
# regulus_precompile(TARGET GROUP HEADER...): reads large headers of other projects once for all targets
# of a group. They must have the same options, and the definitions of the first one. A compiler cache would compile them again, so with one
# there is no group. Every source still includes what it needs: builds with a cache show it.
function(regulus_precompile target group)
  if(CMAKE_CXX_COMPILER_LAUNCHER)
    return()
  endif()
  get_property(first GLOBAL PROPERTY REGULUS_PRECOMPILED_${group})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
    set_property(GLOBAL PROPERTY REGULUS_PRECOMPILED_${group} ${target})
  endif()
endfunction()
