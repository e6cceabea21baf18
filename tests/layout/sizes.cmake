# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P sizes.cmake
# No source has more than 400 lines, and no function more than 50, except tables.
cmake_minimum_required(VERSION 3.25)
set(faults "")
file(GLOB_RECURSE sources RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/codegen/*.[ch]pp ${SOURCE_DIR}/runtime/*.[ch]pp
     ${SOURCE_DIR}/tests/*.[ch]pp)
foreach(source IN LISTS sources)
  file(READ ${SOURCE_DIR}/${source} text)
  string(REGEX MATCHALL "\n" lines "${text}")
  list(LENGTH lines count)
  if(count GREATER 400)
    string(APPEND faults "${source} has ${count} lines\n")
  endif()
endforeach()
execute_process(COMMAND awk -f ${CMAKE_CURRENT_LIST_DIR}/functions.awk ${sources} WORKING_DIRECTORY ${SOURCE_DIR}
                OUTPUT_VARIABLE functions COMMAND_ERROR_IS_FATAL ANY)
string(APPEND faults "${functions}")
if(faults)
  message(FATAL_ERROR "Files of more than 400 lines, functions of more than 50:\n${faults}")
endif()
