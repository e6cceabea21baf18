# SPDX-License-Identifier: Apache-2.0
# The installed headers: those that a program names, and all headers that they include.
#
#   runtime      headers for generated kernels and filters, and for searches with such kernels
#   development  the interface of codegen/use/api, by its one header regulus/regulus.hpp
set(REGULUS_RUNTIME_HEADERS
  runtime/embedded/checker.h runtime/embedded/checker.hpp runtime/embedded/tracker.h
  runtime/kernel/abi.hpp runtime/kernel/pack.hpp runtime/kernel/isa.hpp
  runtime/kernel/self_test.hpp runtime/kernel/self_test_program.hpp
  runtime/problem/filter.h)
set(REGULUS_SEARCH_HEADERS runtime/search/solver.hpp runtime/checkpoint/checkpoint.hpp runtime/proof/writer.hpp)
set(REGULUS_DEVELOPMENT_HEADERS codegen/use/api/regulus.hpp codegen/kernel/jit/plugin_folder.h)

# regulus_with_includes(RESULT ROOT HEADERS...): the headers and all headers of the repository at
# ROOT that they include, sorted. Configured headers, below regulus/, are left out.
function(regulus_with_includes result root)
  set(waiting ${ARGN})
  set(known "")
  while(waiting)
    list(POP_FRONT waiting header)
    if(header IN_LIST known)
      continue()
    endif()
    list(APPEND known ${header})
    file(STRINGS ${root}/${header} lines REGEX "^ *#include \"(runtime|codegen)/[^\"]*\"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^ *#include \"([^\"]*)\".*" "\\1" included "${line}")
      list(APPEND waiting ${included})
    endforeach()
  endwhile()
  list(SORT known)
  set(${result} ${known} PARENT_SCOPE)
endfunction()
