# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about forces within limits, and about bounds along way-points: those of models are proved, and
# files that are damaged are not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(models ${SOURCE_DIR}/models)
file(WRITE ${WORK_DIR}/way.csv "x,y,z,roll,pitch,yaw\n0,0,9,0,0,0\n1,0,9.5,0.05,0,0\n1,1,10,0.05,0.05,0.1\n")
set(pieces "Forall ( fun piece => ")

# expect_proved(STATEMENT FILE VERDICT MODEL WORDS...): that of the certificate FILE of `regulus WORDS`.
function(expect_proved statement file verdict model)
  execute_process(COMMAND ${REGULUS} ${ARGN} --quiet WORKING_DIRECTORY ${WORK_DIR} OUTPUT_VARIABLE answer
                  ERROR_VARIABLE why)
  if(NOT answer STREQUAL "${verdict}\n")
    message(FATAL_ERROR "${ARGN}: ${answer}${why}, expected ${verdict}")
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
endfunction()

set(within "forces_within_limits the_question the_scales the_load the_limits")
expect_proved("${within}" cable.txt FEASIBLE cable_8 check ${models}/cable_8.toml hall --load weight
              --certificate cable.txt)
# Each row has limits here: there is no theorem about forces without limits.
file(READ ${models}/delta.toml text)
string(REGEX REPLACE "\nmotors = 3[^\n]*" "" text "${text}")
file(WRITE ${WORK_DIR}/delta.toml "${text}")
set(library ${models})
set(models ${WORK_DIR})
expect_proved("${within}" delta.txt FEASIBLE delta check ${models}/delta.toml work --load payload
              --certificate delta.txt)
set(models ${library})
expect_proved("${pieces}forces_within_limits ( the_question piece ) the_scales the_load the_limits ) pieces"
              way.txt FEASIBLE octahedral check ${models}/octahedral.toml work --load payload --waypoints way.csv
              --certificate way.txt)
expect_proved("${pieces}force_within ( the_question piece ) the_row the_load the_limit ) pieces"
              bound.leg_1.safe WITHIN octahedral bound ${models}/octahedral.toml work force --load payload --leg 1
              --limit 60 --waypoints way.csv --certificate bound)

expect_no_theorem(cable.txt "limits 100 : 5000" "limits 100 : 2000")
expect_no_theorem(cable.txt "limits 100 : 5000" "limits 2000 : 5000")
expect_no_theorem(cable.txt "verdict FEASIBLE" "verdict PAVING")
expect_no_theorem(delta.txt "-1200 : -900" "-1200 : -9") # beyond what the arms reach
expect_no_theorem(way.txt "limits -60 : 60" "limits -2 : 60")
expect_no_theorem(way.txt "piece 0 | 1 | 0 | 9 |" "piece 0 | 1 | 0 | 1/10 |") # far below
expect_no_theorem(bound.leg_1.safe "bound 60" "bound 20")
expect_no_theorem(bound.leg_1.safe "piece 0 | 1 | 0 | 9 |" "piece 0 | 1 | 0 | 1/10 |")

# A theorem about fewer pieces, or about other limits, is true of what it shows; it is not that of the model.
file(READ ${WORK_DIR}/bound.leg_1.safe text)
string(REGEX MATCH "\npiece 1 [^\n]*" piece "${text}")
foreach(file IN ITEMS way.txt bound.leg_1.safe)
  expect_no_theorem(${file} "${piece}" "" --model ${models}/octahedral.toml --waypoints way.csv)
endforeach()
expect_no_theorem(way.txt "limits -60 : 60" "limits -70 : 70" --model ${models}/octahedral.toml --waypoints
                  way.csv)
expect_no_theorem(bound.leg_1.safe "bound 60" "bound 20" --model ${models}/octahedral.toml --waypoints way.csv)

# Another statement in a plain file: the same text, and an empty load.
file(READ ${WORK_DIR}/delta.txt.v text)
string(REPLACE "forces_within_limits the_question the_scales the_load" "forces_within_limits the_question the_load the_load"
               other "${text}")
file(WRITE ${WORK_DIR}/other.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)

# A load that no forces within limits hold, at some pose.
set(none "no_forces_within_limits the_question the_scales the_load the_limits")
# expect_unheld(NAME MODEL FROM TO MOTION LOAD): of the model with other limits.
function(expect_unheld name model from to motion load)
  file(READ ${models}/${model}.toml text)
  string(REPLACE "${from}" "${to}" text "${text}")
  file(WRITE ${WORK_DIR}/${name}.toml "${text}")
  execute_process(COMMAND ${REGULUS} check ${name}.toml ${motion} --load ${load} --certificate ${name}.txt --quiet
                  WORKING_DIRECTORY ${WORK_DIR} OUTPUT_VARIABLE answer ERROR_VARIABLE why)
  if(NOT answer STREQUAL "INFEASIBLE\n")
    message(FATAL_ERROR "${name}: ${answer}${why}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${name}.txt --model ${name}.toml)
  if(NOT why MATCHES "theorem    ${none}\n")
    message(FATAL_ERROR "${name}: expected ${none}\n${why}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --audit ${name}.txt.v)
endfunction()
expect_unheld(weak cable_8 "force = [100, 5000]" "force = [100, 1000]" hall weight)
expect_unheld(pulled octahedral "force = [-60, 60]" "force = [-4, 60]" work payload)
expect_no_theorem(weak.txt "limits 100 : 1000" "limits 100 : 5000")
expect_no_theorem(weak.txt "limits 100 : 1000" "limits 3000 : 1000")
expect_no_theorem(pulled.txt "limits -4 : 60" "limits -60 : 60")
file(READ ${WORK_DIR}/weak.txt text)
string(REGEX MATCH "\ndirection [^\n]*" direction "${text}")
string(REGEX MATCH "\npoint [^\n]*" point "${text}")
expect_no_theorem(weak.txt "${direction}" "\ndirection 0 0 0 0 0 0")
expect_no_theorem(weak.txt "${direction}" "\ndirection 1 0 0 0 0 0")
expect_no_theorem(weak.txt "${direction}" "\ndirection 0 0 1 0 0")
expect_no_theorem(weak.txt "${point}" "\npoint 0 0")
expect_no_theorem(weak.txt "${point}" "")
file(READ ${WORK_DIR}/weak.txt.v text)
string(REPLACE "no_forces_within_limits the_question" "forces_within_limits the_question" other "${text}")
file(WRITE ${WORK_DIR}/other.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
