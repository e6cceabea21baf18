# SPDX-License-Identifier: GPL-3.0-or-later
# Verdicts of the models as theorems: each row of rows.txt is checked, written for Coq and proved.
# Writes the table RESULTS.md of the work folder; `make formal` keeps it.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(most_seconds 60)
set(table "# Verdicts as theorems\n\nWritten by `make formal`: each row is a theorem that Coq has accepted. \
Seconds are those of `coqc` in all; leaves are the boxes of the search.\n\n\
| model | motion | options | verdict | leaves | seconds | bytes of the proof |\n\
|---|---|---|---|---|---|---|\n")

# count_leaves(LEAVES NAME): searches once more without the theorem, and prints the count.
function(count_leaves leaves name)
  file(READ ${WORK_DIR}/${name}.v text)
  string(REGEX REPLACE "\nTheorem.*" "\nFrom Coq Require Import NArith.\nEval vm_compute in (leaves the_question the_method).\n"
         text "${text}")
  file(WRITE ${WORK_DIR}/${name}_leaves.v "${text}")
  run_coq(code text ${name}_leaves.v)
  string(REGEX MATCH "Some ([0-9]+)" found "${text}")
  set(${leaves} ${CMAKE_MATCH_1} PARENT_SCOPE)
endfunction()

file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/rows.txt rows REGEX "^[^#]")
foreach(row IN LISTS rows)
  separate_arguments(words UNIX_COMMAND "${row}")
  list(POP_FRONT words model motion)
  set(name ${model}_${motion})
  execute_process(COMMAND ${REGULUS} check ${SOURCE_DIR}/models/${model}.toml ${motion} ${words}
                          --certificate ${WORK_DIR}/${name}.txt --quiet
                  OUTPUT_VARIABLE verdict OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_VARIABLE why)
  execute_process(COMMAND ${VERIFY} --coq ${WORK_DIR}/${name}.v ${WORK_DIR}/${name}.txt
                  RESULT_VARIABLE code ERROR_VARIABLE why)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${row}: ${verdict}\n${why}")
  endif()
  string(TIMESTAMP start %s)
  run_coq(code text ${name}.v)
  string(TIMESTAMP end %s)
  math(EXPR seconds "${end} - ${start}")
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${row}: ${verdict}, no theorem after ${seconds} s\n${text}")
  elseif(seconds GREATER most_seconds)
    message(SEND_ERROR "${row}: the theorem took ${seconds} s, the limit is ${most_seconds}")
  endif()
  set(leaves –)
  if(verdict STREQUAL "NO SINGULARITY")
    count_leaves(leaves ${name})
  endif()
  file(SIZE ${WORK_DIR}/${name}.v bytes)
  list(JOIN words " " options)
  string(APPEND table
         "| ${model} | ${motion} | ${options} | ${verdict} | ${leaves} | ${seconds} | ${bytes} |\n")
endforeach()
file(WRITE ${WORK_DIR}/RESULTS.md "${table}")
