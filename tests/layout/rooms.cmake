# SPDX-License-Identifier: GPL-3.0-or-later
# README.md says for each folder of runtime/ and codegen/, and of the groups in codegen/, which question it
# answers; DEVELOPING.md may say it instead.
cmake_minimum_required(VERSION 3.25)
file(READ ${SOURCE_DIR}/README.md map)
if(EXISTS ${SOURCE_DIR}/DEVELOPING.md)
  file(READ ${SOURCE_DIR}/DEVELOPING.md more)
  string(APPEND map "${more}")
endif()
file(GLOB rooms LIST_DIRECTORIES true RELATIVE ${SOURCE_DIR}
     ${SOURCE_DIR}/runtime/* ${SOURCE_DIR}/codegen/* ${SOURCE_DIR}/codegen/*/*)
set(missing "")
foreach(room IN LISTS rooms)
  file(GLOB content ${SOURCE_DIR}/${room}/*)
  if(IS_DIRECTORY ${SOURCE_DIR}/${room} AND content)
    string(FIND "${map}" "`${room}`" place)
    if(place EQUAL -1)
      string(APPEND missing "\n  ${room}")
    endif()
  endif()
endforeach()
if(missing)
  message(FATAL_ERROR "README.md, \"Where things are\", does not name:${missing}")
endif()
