# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})

# run_coq(RESULT OUTPUT FILE): compiles a file of WORK_DIR; RESULT is the exit code.
function(run_coq result output file)
  execute_process(COMMAND ${COQC} -w -ambiguous-paths -Q ${LIBRARY} Regulus ${file} TIMEOUT 600
                  WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code OUTPUT_VARIABLE text
                  ERROR_VARIABLE text)
  set(${result} ${code} PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()
