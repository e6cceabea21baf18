# SPDX-License-Identifier: GPL-3.0-or-later
# Run after PROGRAM is linked: writes FILE with a test for each of its suites, for a process a case costs more
# than most cases do. The cases of LONG suites, a regular expression, are tests of their own. Suites and
# instantiations whose names begin with "Nightly" are left out.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=-Nightly* OUTPUT_VARIABLE list
                RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${PROGRAM} cannot list its tests: ${failed}")
endif()
set(text "")
function(add name filter)
  set(text "${text}add_test([=[${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${filter}]=])
set_tests_properties([=[${name}]=] PROPERTIES ${PROPERTIES})\n" PARENT_SCOPE)
endfunction()

string(REGEX MATCHALL "[^\n]+" lines "${list}")
set(suite "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.")
    set(suite "${CMAKE_MATCH_1}")
    if(NOT suite MATCHES "^(${LONG})$")
      add("${suite}" "${suite}.*")
    endif()
  elseif(suite MATCHES "^(${LONG})$" AND line MATCHES "^  ([A-Za-z0-9_/]+)")
    add("${suite}.${CMAKE_MATCH_1}" "${suite}.${CMAKE_MATCH_1}")
  endif()
endforeach()
file(WRITE "${FILE}" "${text}")
