# SPDX-License-Identifier: GPL-3.0-or-later
# What the scripts of this folder share.
set(PREFIX ${WORK_DIR}/moved/here) # where the package is, which was installed elsewhere
set(PAGE ${SOURCE_DIR}/codegen/EMBEDDING.md)

function(fail)
  string(JOIN "" text ${ARGN})
  message(FATAL_ERROR "${text}")
endfunction()

# run(OUTPUT COMMAND...): standard output in OUTPUT; a command that fails ends the test.
function(run output)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE out ERROR_VARIABLE err
                  RESULT_VARIABLE failed)
  if(failed)
    list(JOIN ARGN " " command)
    fail("${command} (exit ${failed}):\n" "${out}${err}")
  endif()
  set(${output} "${out}" PARENT_SCOPE)
endfunction()

# expect_failure(MESSAGE COMMAND...): the command fails, and says so in words that match.
function(expect_failure message)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE out ERROR_VARIABLE err
                  RESULT_VARIABLE failed)
  string(REGEX REPLACE "[ \n]+" " " said "${out}${err}")
  if(NOT failed OR NOT said MATCHES "${message}")
    fail("expected a failure that says '${message}', exit ${failed}:\n" "${out}${err}")
  endif()
endfunction()

# take(PROJECT FILES...): a folder to work in, with these files of the project and the model.
macro(take project)
  set(folder ${WORK_DIR}/${project})
  file(REMOVE_RECURSE ${folder})
  file(COPY ${SOURCE_DIR}/tests/consumer/${project} DESTINATION ${WORK_DIR})
  file(COPY_FILE ${PREFIX}/share/regulus/models/planar_3rpr.toml ${folder}/arm.toml)
endmacro()

set(CONFIGURE ${CMAKE_COMMAND} -S . -B build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${PREFIX}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
    -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
set(BUILD ${CMAKE_COMMAND} --build build --parallel 2)

# expect_on_page(FILE): the page shows the file, but for its licence line.
function(expect_on_page file)
  file(READ ${file} text)
  string(REGEX REPLACE "^[^\n]*SPDX[^\n]*\n" "" text "${text}")
  expect_text_on_page("${text}" ${file})
endfunction()

# The page has the text, as lines of their own.
function(expect_text_on_page text what)
  file(READ ${PAGE} page)
  string(FIND "${page}" "\n${text}" found)
  if(found EQUAL -1)
    fail("${PAGE} does not show ${what}:\n" "${text}")
  endif()
endfunction()
