# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about singular values and the condition number in the 2-norm: those of platforms and of a robot on
# ropes are proved, and files that are damaged, or claim more than is true, are not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(models ${SOURCE_DIR}/models)
file(WRITE ${WORK_DIR}/way.csv
     "x,y,z,psi [deg],theta [deg],phi [deg]\n0,0,45,0,0,0\n3,0,46,3,0,0\n3,3,47,3,3,5\n")
set(pieces "Forall ( fun piece => ")
set(robot ${models}/robot_1.toml)
file(READ ${models}/cable_8.toml ropes)
set(ropes_model ${WORK_DIR}/ropes.toml)
file(WRITE ${ropes_model} "characteristic_length = 1 # m\n${ropes}")

# expect_proved(STATEMENT FILE MODEL WORDS...): that of the certificate FILE of `regulus bound WORDS`, WITHIN.
function(expect_proved statement file model)
  execute_process(COMMAND ${REGULUS} bound ${model} ${ARGN} --quiet WORKING_DIRECTORY ${WORK_DIR}
                  OUTPUT_VARIABLE answer ERROR_VARIABLE why)
  if(NOT answer STREQUAL "WITHIN\n")
    message(FATAL_ERROR "${ARGN}: ${answer}${why}, expected WITHIN")
  endif()
  set(way "")
  if("${ARGN}" MATCHES "way.csv")
    set(way --waypoints way.csv)
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${file} --model ${model} ${way})
  string(FIND "${why}" "theorem    ${statement}\n" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${ARGN}: expected ${statement}\n${why}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --audit ${file}.v)
  execute_process(COMMAND ${FORMAL} ${file}.v --hints hinted.v WORKING_DIRECTORY ${WORK_DIR} OUTPUT_VARIABLE answer
                  ERROR_VARIABLE why)
  if(NOT answer MATCHES "^PROVED")
    message(FATAL_ERROR "regulus-formal ${file}.v: ${answer}${why}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --audit hinted.v)
endfunction()

set(of " the_question the_scales the_factors the_limit")
set(of_pieces " ( the_question piece ) the_scales the_factors the_limit ) pieces")
expect_proved("condition_2_below${of}" kappa.safe ${robot} table4_1 condition --norm 2 --limit 76 --certificate kappa)
expect_proved("singular_values_above${of}" least.safe ${robot} table4_1 sigma-min --limit 0.033 --certificate least)
expect_proved("singular_values_below${of}" largest.safe ${robot} table4_1 sigma-max --limit 2.5 --certificate largest)
expect_proved("${pieces}condition_2_below${of_pieces}" way.safe ${robot} table4_1 condition --norm 2 --limit 66
              --waypoints way.csv --certificate way)
expect_proved("${pieces}singular_values_above${of_pieces}" least_way.safe ${robot} table4_1 sigma-min --limit 0.037
              --waypoints way.csv --certificate least_way)
expect_proved("condition_2_below${of}" ropes.safe ${ropes_model} work condition --norm 2 --limit 40 --certificate ropes)

# expect_refused(FILE WHAT BY): Coq refuses the certificate FILE with other text. Along the way one variable varies,
# so its search ends.
function(expect_refused file what by)
  file(READ ${WORK_DIR}/${file} text)
  string(REPLACE "${what}" "${by}" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "no '${what}' in ${file}")
  endif()
  file(WRITE ${WORK_DIR}/other.txt "${other}")
  expect_answer(REJECTED 1 ${WORK_DIR} --theorem other.txt)
  if(NOT why MATCHES "Coq refuses")
    message(FATAL_ERROR "${file}, ${what} -> ${by}: ${why}")
  endif()
endfunction()

# with_other_bound(FILE NUMBER OTHER): writes other_bound.txt. The words of the claim have the number, too.
function(with_other_bound file number other)
  file(READ ${WORK_DIR}/${file} text)
  string(REGEX REPLACE "([<>]) ${number} " "\\1 ${other} " text "${text}")
  string(REPLACE "\nbound ${number}\n" "\nbound ${other}\n" text "${text}")
  file(WRITE ${WORK_DIR}/other_bound.txt "${text}")
endfunction()

# A bound that is exceeded. `regulus bound` finds a condition number of 72.84, and along the way 64.93 and a least
# singular value of 0.0375.
foreach(bound IN ITEMS 64 1 0 -66)
  with_other_bound(way.safe 66 ${bound})
  expect_refused(other_bound.txt "motion table4_1" "motion other")
endforeach()
with_other_bound(least_way.safe 37/1000 39/1000)
expect_refused(other_bound.txt "motion table4_1" "motion other")
with_other_bound(kappa.safe 76 70)
expect_no_theorem(other_bound.txt "motion table4_1" "motion other" --time-limit 5)
expect_answer(REJECTED 1 ${WORK_DIR} --theorem other_bound.txt --model ${robot})

# Other scales, factors and matrices than those that were bounded; the last ones are singular.
expect_refused(way.safe "factor 1\n" "factor 100\n")
expect_refused(way.safe "factor 1\n" "factor 0\n")
file(READ ${WORK_DIR}/way.safe text)
string(REGEX MATCH "\nscale 1/[^\n]*" scale "${text}")
string(REPLACE "scale 1/" "scale 100/" scaled "${scale}")
expect_refused(way.safe "${scale}" "${scaled}")
expect_refused(way.safe "a1_x = -9" "a1_x = 9")
expect_refused(way.safe "piece 0 | 3 | 0 | 45 |" "piece 0 | 3 | 0 | 0 |")
expect_refused(least_way.safe "piece 0 | 3 | 0 | 45 |" "piece 0 | 3 | 0 | 0 |")
string(REGEX MATCH "\npiece 3 [^\n]*" piece "${text}")
expect_no_theorem(way.safe "${piece}" "" --model ${robot} --waypoints way.csv)
expect_no_theorem(way.safe "factor 1\n" "factor 2\n" --model ${robot} --waypoints way.csv)

# That a bound is attained has no theorem.
execute_process(COMMAND ${REGULUS} bound ${robot} table4_1 condition --norm 2 --certificate both --quiet
                WORKING_DIRECTORY ${WORK_DIR} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
expect_answer(UNFINISHED 2 ${WORK_DIR} --theorem both.singular)

# The audit takes no other statement, nor other words.
file(READ ${WORK_DIR}/kappa.safe.v text)
foreach(pair IN ITEMS "condition_2_below the_question|singular_values_above the_question"
                      "condition_2_below the_question|singular_values_below the_question"
                      "the_scales the_factors|the_factors the_scales"
                      "Definition the_method|Definition condition_2_below (q : question) := true = true.\nDefinition the_method"
                      "Definition the_method|Definition Values_below := Ratio_below.\nDefinition the_method"
                      "Forces SingularValues|Forces SingularValues Limits")
  string(REPLACE "|" ";" pair "${pair}")
  list(GET pair 0 what)
  list(GET pair 1 by)
  string(REPLACE "${what}" "${by}" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "no '${what}' in kappa.safe.v")
  endif()
  file(WRITE ${WORK_DIR}/other.v "${other}")
  expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
endforeach()
