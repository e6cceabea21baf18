# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P licences.cmake
# Every source file names its licence: Apache-2.0 under runtime/, models/ and generated/, GPL under
# codegen/ and tests/.
cmake_minimum_required(VERSION 3.25)
set(faults "")
foreach(pair IN ITEMS "runtime:Apache-2.0" "models:Apache-2.0" "generated:Apache-2.0" "cmake:(Apache-2.0|GPL-3.0-or-later)" "codegen:GPL-3.0-or-later" "tests:GPL-3.0-or-later")
  string(REGEX MATCH "^([^:]*):(.*)$" _ ${pair})
  set(folder ${CMAKE_MATCH_1})
  set(licence ${CMAKE_MATCH_2})
  file(GLOB_RECURSE sources ${SOURCE_DIR}/${folder}/*.[ch]pp ${SOURCE_DIR}/${folder}/CMakeLists.txt
       ${SOURCE_DIR}/${folder}/*.cmake ${SOURCE_DIR}/${folder}/*.toml
       ${SOURCE_DIR}/${folder}/*.h ${SOURCE_DIR}/${folder}/*.inc)
  foreach(source IN LISTS sources)
    file(STRINGS ${source} head LIMIT_COUNT 3)
    if(NOT head MATCHES "SPDX-License-Identifier: ${licence}")
      string(APPEND faults "${source}: expected 'SPDX-License-Identifier: ${licence}' in the first lines\n")
    endif()
  endforeach()
endforeach()
if(faults)
  message(FATAL_ERROR "${faults}")
endif()
