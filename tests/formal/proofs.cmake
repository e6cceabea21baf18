# SPDX-License-Identifier: GPL-3.0-or-later
# Verdicts of the models as theorems: each row of rows.txt is checked, written for Coq, and proved both
# by regulus-formal and by Coq. Writes the table RESULTS.md of the work folder; `make formal` keeps it.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(most_seconds 60)
set(table "# Verdicts as theorems\n\nWritten by `make formal`: each row is a theorem that Coq has accepted, \
and that `regulus-formal` has proved alone. Leaves are the boxes of the proof; `regulus-formal` finds them, \
and Coq has them as hints. Seconds are those of the processor: of `coqc` in all, of which loading its \
libraries takes about one, and of `regulus-formal` with its search, also for each leaf. Bytes are those of the file with its hints.\n\n\
| model | motion | options | verdict | leaves | coqc s | regulus-formal s | ms a leaf | bytes of the proof |\n\
|---|---|---|---|---|---|---|---|---|\n")

# milliseconds(RESULT SECONDS LEAVES): SECONDS has two decimals; the result has one.
function(milliseconds result seconds leaves)
  string(REPLACE "." "" hundredths ${seconds})
  string(REGEX REPLACE "^0+([0-9])" "\\1" hundredths ${hundredths})
  math(EXPR tenths "${hundredths} * 100 / ${leaves}")
  math(EXPR whole "${tenths} / 10")
  math(EXPR rest "${tenths} % 10")
  set(${result} ${whole}.${rest} PARENT_SCOPE)
endfunction()

# processor_seconds(SECONDS NAME): lets Coq read NAME.v, and counts what the processor did for it.
function(processor_seconds seconds name)
  execute_process(COMMAND sh -c "\"$@\" && times" sh ${COQC} -w -ambiguous-paths -Q ${LIBRARY} Regulus ${name}.v
                  TIMEOUT 600 WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code OUTPUT_VARIABLE text
                  ERROR_VARIABLE text)
  if(NOT code EQUAL 0 OR NOT text MATCHES "\n([0-9]+)m([0-9]+)\\.[0-9]+s [^\n]*\n$")
    message(FATAL_ERROR "${name}: no theorem\n${text}")
  endif()
  math(EXPR sum "60 * ${CMAKE_MATCH_1} + ${CMAKE_MATCH_2} + 1")
  set(${seconds} ${sum} PARENT_SCOPE)
endfunction()

file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/rows.txt rows REGEX "^[^#]")
foreach(row IN LISTS rows)
  separate_arguments(words UNIX_COMMAND "${row}")
  list(POP_FRONT words model motion)
  set(name proof)
  set(command check)
  set(certificate ${name}.txt)
  set(statement "")
  if(row MATCHES " force .*--leg ([0-9]+)")
    set(command bound)
    set(certificate ${name}.txt.leg_${CMAKE_MATCH_1}.safe)
    set(statement --force)
  endif()
  execute_process(COMMAND ${REGULUS} ${command} ${SOURCE_DIR}/models/${model}.toml ${motion} ${words}
                          --certificate ${WORK_DIR}/${name}.txt --quiet
                  OUTPUT_VARIABLE verdict OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_VARIABLE why)
  execute_process(COMMAND ${VERIFY} --coq ${WORK_DIR}/plain.v ${statement} ${WORK_DIR}/${certificate}
                  RESULT_VARIABLE code ERROR_VARIABLE why)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${row}: ${verdict}\n${why}")
  endif()
  execute_process(COMMAND ${FORMAL} --hints ${WORK_DIR}/${name}.v ${WORK_DIR}/plain.v
                  RESULT_VARIABLE code OUTPUT_VARIABLE answer ERROR_VARIABLE how)
  if(NOT code EQUAL 0 OR NOT how MATCHES ": ([^:]*), ([0-9.]+) s\n$")
    message(FATAL_ERROR "${row}: ${verdict}, regulus-formal: ${answer}\n${how}")
  endif()
  set(program_seconds ${CMAKE_MATCH_2})
  set(leaves –)
  set(each –)
  if(how MATCHES ": ([0-9]+) leaves")
    set(leaves ${CMAKE_MATCH_1})
    milliseconds(each ${program_seconds} ${leaves})
  endif()
  processor_seconds(seconds ${name})
  if(seconds GREATER most_seconds)
    message(SEND_ERROR "${row}: the theorem took ${seconds} s, the limit is ${most_seconds}")
  endif()
  file(SIZE ${WORK_DIR}/${name}.v bytes)
  list(JOIN words " " options)
  string(APPEND table "| ${model} | ${motion} | ${options} | ${verdict} | ${leaves} | ${seconds} | \
${program_seconds} | ${each} | ${bytes} |\n")
endforeach()
file(WRITE ${WORK_DIR}/RESULTS.md "${table}")
