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

# expect_answer(ANSWER EXIT FOLDER WORDS...): of regulus-verify. Sets `why` to its messages.
function(expect_answer answer exit folder)
  execute_process(COMMAND ${VERIFY} ${ARGN} --library ${LIBRARY} WORKING_DIRECTORY ${folder}
                  RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE why)
  if(NOT code EQUAL exit OR NOT text STREQUAL "${answer}\n")
    message(FATAL_ERROR "${ARGN}: ${text} (exit ${code}), expected ${answer}\n${why}")
  endif()
  set(why "${why}" PARENT_SCOPE)
endfunction()

# expect_only_coqc_accepts(FILE TEXT): a file that coqc accepts, and that the audit refuses.
function(expect_only_coqc_accepts file text)
  file(WRITE ${WORK_DIR}/${file} "${text}")
  run_coq(code output ${file})
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "coqc refuses ${file}, so this tests nothing\n${output}")
  endif()
  expect_answer(REJECTED 1 ${WORK_DIR} --audit ${file})
endfunction()

# expect_no_theorem(FILE WHAT BY WORDS...): of the certificate FILE with other text; WORDS for regulus-verify.
function(expect_no_theorem file what by)
  file(READ ${WORK_DIR}/${file} text)
  string(REPLACE "${what}" "${by}" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "no '${what}' in ${file}")
  endif()
  file(WRITE ${WORK_DIR}/other.txt "${other}")
  execute_process(COMMAND ${VERIFY} --theorem other.txt --library ${LIBRARY} --quiet --time-limit 60 ${ARGN}
                  WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code OUTPUT_VARIABLE answer
                  ERROR_VARIABLE why)
  if(code EQUAL 0 OR answer STREQUAL "PROVED\n")
    message(FATAL_ERROR "${file}, ${what} -> ${by}: ${answer}${why}")
  endif()
endfunction()
