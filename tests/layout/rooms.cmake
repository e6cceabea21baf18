# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P rooms.cmake
# DEVELOPING.md says for each folder of runtime/ and codegen/, and of the groups in codegen/, which question it
# answers, and names no folder or file that is not there.
cmake_minimum_required(VERSION 3.25)
file(READ ${SOURCE_DIR}/DEVELOPING.md map)
set(faults "")
file(GLOB rooms LIST_DIRECTORIES true RELATIVE ${SOURCE_DIR}
     ${SOURCE_DIR}/runtime/* ${SOURCE_DIR}/codegen/* ${SOURCE_DIR}/codegen/*/*)
foreach(room IN LISTS rooms)
  file(GLOB content ${SOURCE_DIR}/${room}/*)
  if(IS_DIRECTORY ${SOURCE_DIR}/${room} AND content)
    string(FIND "${map}" "`${room}`" place)
    if(place EQUAL -1)
      string(APPEND faults "\n  does not name ${room}")
    endif()
  endif()
endforeach()
string(REGEX MATCHALL "`(runtime|codegen|tests|cmake|models|generated)(/[A-Za-z0-9_.-]+)*`" names "${map}")
foreach(name IN LISTS names)
  string(REPLACE "`" "" name "${name}")
  if(NOT EXISTS ${SOURCE_DIR}/${name})
    string(APPEND faults "\n  names ${name}, which is not there")
  endif()
endforeach()
if(faults)
  message(FATAL_ERROR "DEVELOPING.md:${faults}")
endif()
