# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P trusted_core.cmake
# The manual says how many lines must be right for VERIFIED to be true: within a twentieth, the lines of
# runtime/verifier, and those of its folder model.
cmake_minimum_required(VERSION 3.25)
file(READ ${SOURCE_DIR}/runtime/proof/PROOF.md page)

# check_lines(FOLDER): the number in the page beside the folder is that of its sources.
function(check_lines folder)
  string(REGEX REPLACE "([0-9]) ([0-9])" "\\1\\2" text "${page}")
  if(NOT text MATCHES "`${folder}`, ([0-9]+)[ \n]+lines")
    message(FATAL_ERROR "runtime/proof/PROOF.md: expected \"`${folder}`, N lines\"")
  endif()
  set(said ${CMAKE_MATCH_1})
  file(GLOB sources ${SOURCE_DIR}/${folder}/*.[ch]pp)
  set(counted 0)
  foreach(source IN LISTS sources)
    file(READ ${source} code)
    string(REGEX MATCHALL "\n" lines "${code}")
    list(LENGTH lines count)
    math(EXPR counted "${counted} + ${count}")
  endforeach()
  math(EXPR least "${counted} * 19 / 20")
  math(EXPR most "${counted} * 21 / 20")
  if(said LESS least OR said GREATER most)
    message(FATAL_ERROR "runtime/proof/PROOF.md says that ${folder} has ${said} lines: it has ${counted}")
  endif()
endfunction()

check_lines(runtime/verifier)
check_lines(runtime/verifier/model)
