# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DFOLDER=… -DWORK=… -DNPM=… -P get_npm_packages.cmake: gets the packages of FOLDER/package-lock.json into
# WORK. WORK/installed-lock then has the hash of that file. Warns if npm cannot: the build goes on without them.
cmake_minimum_required(VERSION 3.25)
file(SHA256 ${FOLDER}/package-lock.json wanted)

function(read_hash name result)
  set(${result} "" PARENT_SCOPE)
  if(EXISTS ${WORK}/${name})
    file(READ ${WORK}/${name} text)
    set(${result} "${text}" PARENT_SCOPE)
  endif()
endfunction()

read_hash(installed-lock installed)
read_hash(refused-lock refused)
if(installed STREQUAL wanted OR refused STREQUAL wanted)
  file(TOUCH ${WORK}/tried)
  return()
endif()
file(REMOVE ${WORK}/installed-lock)
file(MAKE_DIRECTORY ${WORK})
file(COPY ${FOLDER}/package.json ${FOLDER}/package-lock.json ${FOLDER}/.npmrc DESTINATION ${WORK})
execute_process(COMMAND ${NPM} ci --ignore-scripts --fetch-retries=1 --fetch-timeout=60000
                WORKING_DIRECTORY ${WORK} TIMEOUT 300
                RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
file(TOUCH ${WORK}/tried)
if(NOT failed)
  file(WRITE ${WORK}/installed-lock ${wanted})
  return()
endif()
file(WRITE ${WORK}/refused-lock ${wanted})
string(REGEX MATCHALL "[^\n]+" lines "${output}")
if(lines)
  list(SUBLIST lines 0 6 lines)
endif()
list(JOIN lines "\n  " output)
message(WARNING "npm could not get the packages of ${FOLDER} (${failed}). Everything that does not need them is "
                "built. Run cmake again with a network.\n  ${output}")
