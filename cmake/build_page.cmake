# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DFOLDER=… -DWORK=… -DNODE=… -DPAGE=… -DTYPES=… -P build_page.cmake: builds the page from the sources in
# FOLDER and the TYPES of the reports, with the packages in WORK; none if they are not there.
cmake_minimum_required(VERSION 3.25)
if(NOT EXISTS ${WORK}/installed-lock)
  file(REMOVE ${PAGE})
  return()
endif()
file(REMOVE_RECURSE ${WORK}/src)
file(COPY ${FOLDER}/src ${FOLDER}/build.mjs ${FOLDER}/tsconfig.json DESTINATION ${WORK})
file(COPY ${TYPES} DESTINATION ${WORK}/src)
execute_process(COMMAND ${NODE} build.mjs ${PAGE} WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
