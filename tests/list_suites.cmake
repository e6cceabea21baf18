# SPDX-License-Identifier: GPL-3.0-or-later
# Run after PROGRAM is linked: writes FILE with a test for each of its suites, for a process a case costs more
# than most cases do. Suites and instantiations whose names begin with "Nightly" are left out.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=-Nightly* OUTPUT_VARIABLE list
                RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${PROGRAM} cannot list its tests: ${failed}")
endif()
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${list}")
set(text "")
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" suite "${suite}")
  string(APPEND text "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
                     "set_tests_properties([=[${suite}]=] PROPERTIES ${PROPERTIES})\n")
endforeach()
file(WRITE "${FILE}" "${text}")
