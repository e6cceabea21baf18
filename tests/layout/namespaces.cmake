# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P namespaces.cmake
# What an installed header declares is in the namespace regulus, all else in regulus::detail. A source is in the
# namespace of the header that it includes first. Below the two, some names have a namespace of their own, because
# they must not be mixed up with the rest.
cmake_minimum_required(VERSION 3.25)
include(${SOURCE_DIR}/cmake/PublicHeaders.cmake)
regulus_with_includes(installed ${SOURCE_DIR}
  ${REGULUS_RUNTIME_HEADERS} ${REGULUS_SEARCH_HEADERS} ${REGULUS_DEVELOPMENT_HEADERS})

set(own_runtime/machine  "detail::machine")  # operations that have the names of a kernel's
set(own_runtime/verifier verifier)           # shares no code with what it checks
set(own_runtime/formal   verifier)
set(own_codegen/kernel/jit "detail(::(plugin|builder))?")  # compiled against LLVM, and opened for a compilation
set(printed_by_tests tests/property/interval/interval_printing.hpp)  # is found by the namespace of Interval
set(words_of_proofs runtime/proof/format.hpp)  # the only words that the verifier shares with what it checks

# regulus_expected(RESULT SOURCE PUBLIC): the namespace, without regulus::, as a regular expression.
function(regulus_expected result source public)
  string(REGEX MATCH "^(runtime/[a-z]+|codegen/[a-z]+/[a-z]+)/" _ ${source})
  set(room "${CMAKE_MATCH_1}")
  if(source STREQUAL words_of_proofs)
    set(expected "::format")
  elseif(source STREQUAL printed_by_tests)
    set(expected "")
  elseif(public AND source MATCHES "^runtime/")
    set(expected "(::[a-ce-z][a-z0-9_]*)?")
  elseif(public)
    set(expected "(::literals)?")
  elseif(DEFINED own_${room})
    set(expected "::${own_${room}}")
  elseif(source MATCHES "^codegen/")
    set(expected "::detail")
  elseif(source MATCHES "^tests/")
    set(expected "::(verifier|detail(::[a-z0-9_]+)*)")
  else()
    set(expected "::detail(::[a-z0-9_]+)?")
  endif()
  set(${result} "${expected}" PARENT_SCOPE)
endfunction()

# regulus_without_declarations(RESULT TEXT NAMESPACE): the text without blocks of the namespace that
# only say which classes there are.
function(regulus_without_declarations result text namespace)
  string(REGEX REPLACE "namespace ${namespace} {\n((class|struct) [A-Za-z]+\n)+}" "" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(faults "")
file(GLOB_RECURSE sources RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/codegen/*.[ch]pp ${SOURCE_DIR}/runtime/*.[ch]pp
     ${SOURCE_DIR}/tests/*.[ch]pp)
list(LENGTH sources count)
if(count LESS 1500)
  string(APPEND faults "only ${count} sources were found\n")
endif()
foreach(source IN LISTS sources)
  file(READ ${SOURCE_DIR}/${source} text)
  string(REGEX REPLACE "[][;]" "" text "${text}")
  string(REGEX MATCH "#include \"([^\"]*)\"" _ "${text}")
  set(first "${CMAKE_MATCH_1}")
  set(public FALSE)
  if(source IN_LIST installed OR (first IN_LIST installed AND source MATCHES "^(codegen|runtime)/.*cpp$"))
    set(public TRUE)
  endif()
  regulus_expected(expected ${source} ${public})
  if(public)
    regulus_without_declarations(text "${text}" "detail(::[a-z]+)?")
    string(REGEX MATCHALL "\n(inline )?namespace (regulus|detail)[a-z0-9_: ]* {" blocks "${text}")
  else()
    regulus_without_declarations(text "${text}" regulus)
    string(REGEX MATCHALL "\n(inline )?namespace regulus[a-z0-9_: ]* {" blocks "${text}")
  endif()
  foreach(block IN LISTS blocks)
    string(STRIP "${block}" block)
    if(NOT block MATCHES "^namespace regulus${expected} {")
      string(APPEND faults "${source}: \"${block}\": expected regulus${expected}\n")
    endif()
  endforeach()
endforeach()
if(faults)
  message(FATAL_ERROR "Namespaces:\n${faults}")
endif()
