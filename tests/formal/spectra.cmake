# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about singular values and the condition number in the 2-norm: those of platforms and of a robot on
# ropes are proved, and files that are damaged, or claim more than is true, are not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(models ${SOURCE_DIR}/models)
file(WRITE ${WORK_DIR}/way.csv
     "x,y,z,psi [deg],theta [deg],phi [deg]\n0,0,45,0,0,0\n3,0,46,3,0,0\n3,3,47,3,3,5\n")
set(pieces "Forall ( fun piece => ")

# expect_proved(STATEMENT FILE MODEL WORDS...): that of the certificate FILE of `regulus bound WORDS`, WITHIN.
function(expect_proved statement file model)
  execute_process(COMMAND ${REGULUS} bound ${models}/${model}.toml ${ARGN} --quiet WORKING_DIRECTORY ${WORK_DIR}
                  OUTPUT_VARIABLE answer ERROR_VARIABLE why)
  if(NOT answer STREQUAL "WITHIN\n")
    message(FATAL_ERROR "${ARGN}: ${answer}${why}, expected WITHIN")
  endif()
  set(way "")
  if("${ARGN}" MATCHES "way.csv")
    set(way --waypoints way.csv)
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${file} --model ${models}/${model}.toml ${way})
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
expect_proved("condition_2_below${of}" kappa.safe robot_1 table4_1 condition --norm 2 --limit 76 --certificate kappa)
expect_proved("singular_values_above${of}" least.safe robot_1 table4_1 sigma-min --limit 0.033 --certificate least)
expect_proved("singular_values_below${of}" largest.safe robot_1 table4_1 sigma-max --limit 2.5 --certificate largest)
expect_proved("${pieces}condition_2_below${of_pieces}" way.safe robot_1 table4_1 condition --norm 2 --limit 66
              --waypoints way.csv --certificate way)
expect_proved("${pieces}singular_values_above${of_pieces}" least_way.safe robot_1 table4_1 sigma-min --limit 0.037
              --waypoints way.csv --certificate least_way)
expect_proved("singular_values_above${of}" ropes.safe cable_8 work sigma-min --limit 0.3 --certificate ropes)

# A bound that is exceeded; the words of the claim have its number, too. `regulus bound` finds a condition number
# of 72.84, singular values from 0.0334 to 2.433, and along the way 64.93 and 0.0375.
# expect_no_other_bound(FILE NUMBER OTHER)
function(expect_no_other_bound file number other)
  file(READ ${WORK_DIR}/${file} text)
  string(REGEX REPLACE "([<>]) ${number} " "\\1 ${other} " changed "${text}")
  file(WRITE ${WORK_DIR}/other_bound.txt "${changed}")
  expect_no_theorem(other_bound.txt "\nbound ${number}\n" "\nbound ${other}\n")
endfunction()
expect_no_other_bound(kappa.safe 76 70)
expect_no_other_bound(kappa.safe 76 1)
expect_no_other_bound(kappa.safe 76 -76)
expect_no_other_bound(least.safe 33/1000 1/25)
expect_no_other_bound(largest.safe 5/2 2)
expect_no_other_bound(way.safe 66 60)

# Other scales, factors and matrices than those that were bounded.
expect_no_theorem(kappa.safe "factor 1\n" "factor 100\n")
expect_no_theorem(kappa.safe "factor 1\n" "factor 0\n")
expect_no_theorem(kappa.safe "\nscale 1/" "\nscale 100/")
expect_no_theorem(least.safe "a1_x = -9" "a1_x = 9") # two equal legs
expect_no_theorem(way.safe "piece 0 | 3 | 0 | 0 | 45 |" "piece 0 | 3 | 0 | 0 | 1/10 |")
file(READ ${WORK_DIR}/way.safe text)
string(REGEX MATCH "\npiece 3 [^\n]*" piece "${text}")
expect_no_theorem(way.safe "${piece}" "" --model ${models}/robot_1.toml --waypoints way.csv)

# The matrix is singular somewhere: there is no bound to prove.
file(READ ${WORK_DIR}/kappa.safe text)
string(REGEX REPLACE "parameter psi in [^\n]*" "parameter psi in -pi : pi" wide "${text}")
file(WRITE ${WORK_DIR}/wide.txt "${wide}")
expect_no_theorem(wide.txt "bound 76\n" "bound 76\n\n")

# That a bound is attained has no theorem.
execute_process(COMMAND ${REGULUS} bound ${models}/robot_1.toml table4_1 condition --norm 2 --certificate both --quiet
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
