# SPDX-License-Identifier: GPL-3.0-or-later
# Coq reads the questions that regulus-verify writes, and their claims mean something. This needs only
# the files that define what is claimed: nothing is proved here.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(LIBRARY .)

foreach(name IN ITEMS Expressions LinearAlgebra Questions Closures Notations)
  file(COPY ${SOURCE_DIR}/runtime/formal/${name}.v DESTINATION ${WORK_DIR})
  run_coq(code text ${name}.v)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${name}.v\n${text}")
  endif()
endforeach()

# expect_statement(CLAIM MODEL MOTION OPTIONS...), for `check`; MOTION force OPTIONS...: for `bound`; --at PLACE: for
# `solve`
function(expect_statement claim model)
  set(command check)
  set(certificate claim.txt)
  if("${ARGN}" MATCHES ";force;.*--leg;([0-9]+)")
    set(command bound)
    set(certificate claim.txt.leg_${CMAKE_MATCH_1}.safe)
  elseif("${ARGN}" MATCHES "^--at")
    set(command solve)
  endif()
  execute_process(COMMAND ${REGULUS} ${command} ${SOURCE_DIR}/models/${model}.toml ${ARGN} --certificate
                          ${WORK_DIR}/claim.txt --quiet OUTPUT_QUIET)
  execute_process(COMMAND ${VERIFY} --coq ${WORK_DIR}/claim.v ${WORK_DIR}/${certificate}
                  COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${WORK_DIR}/claim.v text)
  string(REPLACE "Questions Search Singularity Threshold Forces." "LinearAlgebra Questions." text "${text}")
  string(REGEX REPLACE "Questions Search Closures Tubes Branches (Solutions|Ways)\\." "LinearAlgebra Questions Closures."
         text "${text}")
  string(REGEX REPLACE "\n\\(\\*\\* Where the set is cut.*\n\n\\(\\*\\* The variables of second order" "\n(** The variables" text
         "${text}")
  string(REGEX REPLACE "\nDefinition the_method[^\n]*\n" "\n" text "${text}")
  if(NOT text MATCHES "\nTheorem the_claim : ([^\n]*)\\.\nProof\\.")
    message(FATAL_ERROR "${model} ${ARGN}: no theorem\n${text}")
  elseif(NOT CMAKE_MATCH_1 STREQUAL claim)
    message(FATAL_ERROR "${model} ${ARGN}: the theorem is ${CMAKE_MATCH_1}, expected ${claim}")
  endif()
  string(REGEX REPLACE "\nProof\\..*" "\nProof. Abort.\n" text "${text}")
  file(WRITE ${WORK_DIR}/claim.v "${text}")
  run_coq(code text claim.v)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${model} ${ARGN}\n${text}")
  endif()
endfunction()

expect_statement("no_singularity the_question" robot_1 T1_errors)
expect_statement("no_singularity the_question" ../tests/formal/names all)
file(WRITE ${WORK_DIR}/way.csv "x,y,phi\n8,4,0.3\n8.5,4.2,0.32\n8.6,4.6,0.35\n")
expect_statement("Forall (fun piece => no_singularity (the_question piece)) pieces" planar_3rpr regular
                 --waypoints ${WORK_DIR}/way.csv)
expect_statement("determinant_above the_question the_scales the_threshold" robot_1 table6_5_5 --alpha 1)
expect_statement("all_solutions the_closure the_solutions" four_bar --at theta=45*deg)
file(WRITE ${WORK_DIR}/way.csv "theta [deg]\n0\n50\n-57.5\n")
expect_statement("one_branch_along the_closure pieces" four_bar swing --waypoints ${WORK_DIR}/way.csv)
expect_statement("force_within the_question the_row the_load the_limit" robot_1 table4_5 force --load payload
                 --leg 3 --limit 2000)
expect_statement("force_below the_question the_row the_load the_limit" robot_1 table4_5 force --load payload
                 --leg 3 --signed --limit 2000)
file(WRITE ${WORK_DIR}/way.csv "x,y,z,roll,pitch,yaw\n0,0,9,0,0,0\n1,0,9.5,0.05,0,0\n1,1,10,0.05,0.05,0.1\n")
expect_statement("Forall (fun piece => force_within (the_question piece) the_row the_load the_limit) pieces" octahedral
                 work force --load payload --leg 1 --limit 60 --waypoints ${WORK_DIR}/way.csv)
