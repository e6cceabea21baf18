# SPDX-License-Identifier: GPL-3.0-or-later
# regulus-formal computes as Coq does, reads files as Coq does, and refuses what is false.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

function(expect_success what)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code
                  OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    string(SUBSTRING "${text}" 0 2000 text)
    message(FATAL_ERROR "${what} (exit ${code})\n${text}")
  endif()
endfunction()

function(expect_theorem what file)
  run_coq(code text ${file})
  if(NOT code EQUAL 0)
    string(SUBSTRING "${text}" 0 2000 text)
    message(FATAL_ERROR "${what}\n${text}")
  endif()
endfunction()

# ---- Primitive operations: the program and Coq have the same results.
file(COPY ${CMAKE_CURRENT_LIST_DIR}/Arithmetic.v ${CMAKE_CURRENT_LIST_DIR}/ArithmeticExtract.v
          ${CMAKE_CURRENT_LIST_DIR}/print_arithmetic.ml ${CMAKE_CURRENT_LIST_DIR}/damage.ml
          ${CHECKER}/uint63.ml ${CHECKER}/float64.ml DESTINATION ${WORK_DIR})
expect_theorem("The list of operations" Arithmetic.v)
expect_theorem("The program of the operations" ArithmeticExtract.v)
expect_success("The program of the operations" ${OCAMLOPT} -w -a uint63.ml float64.ml arithmetic.mli
               arithmetic.ml print_arithmetic.ml -o print_arithmetic)
execute_process(COMMAND ${WORK_DIR}/print_arithmetic OUTPUT_FILE ${WORK_DIR}/Agree.v
                COMMAND_ERROR_IS_FATAL ANY)
expect_theorem("Coq and the program compute differently" Agree.v)

# write_theorem(NAME MODEL MOTION OPTIONS...): the file NAME.v of a verdict.
function(write_theorem name model)
  execute_process(COMMAND ${REGULUS} check ${SOURCE_DIR}/models/${model}.toml ${ARGN} --certificate
                          ${WORK_DIR}/${name}.txt --quiet OUTPUT_QUIET)
  expect_success("${name}.v" ${VERIFY} --coq ${name}.v ${name}.txt)
endfunction()

file(WRITE ${WORK_DIR}/way.csv "x,y,phi\n8,4,0.3\n8.5,4.2,0.32\n8.6,4.6,0.35\n8.2,4.9,0.4\n")
write_theorem(pieces planar_3rpr regular --waypoints ${WORK_DIR}/way.csv)
write_theorem(pieces_above planar_3rpr regular --waypoints ${WORK_DIR}/way.csv --alpha 0.1)
write_theorem(names ../tests/formal/names all)
write_theorem(T1 robot_1 T1)
write_theorem(errors robot_1 T1_errors)
write_theorem(tolerance robot_1 table6_5_5 --tolerance base,platform=0.05)
write_theorem(circle planar_3rpr circle)
write_theorem(wide agile_eye wide)
write_theorem(scara scara right_handed)
write_theorem(axes three_parallel_axes table)
write_theorem(singular robot_2 table5_40)
write_theorem(above robot_1 table6_5_5 --alpha 1)
write_theorem(below robot_1 table6_5_5 --alpha 10)
write_theorem(crossing planar_3rpr crossing --alpha 0.1)

# write_force_theorem(NAME LIMIT OPTIONS...): that the force of leg 3 of a robot is within LIMIT.
function(write_force_theorem name limit)
  execute_process(COMMAND ${REGULUS} bound ${SOURCE_DIR}/models/robot_1.toml table4_5 force --load payload --leg 3
                          --limit ${limit} ${ARGN} --certificate ${WORK_DIR}/${name}.txt --quiet OUTPUT_QUIET)
  expect_success("${name}.v" ${VERIFY} --coq ${name}.v --force ${name}.txt.leg_3.safe)
endfunction()
write_force_theorem(force 700)
write_force_theorem(signed_force 2000 --signed)
write_theorem(limits cable_8 hall --load weight)
execute_process(COMMAND ${REGULUS} locate ${SOURCE_DIR}/models/cable_8.toml hall --load weight --range z=4:7.5
                        --resolution 1/8 --certificate ${WORK_DIR}/paving.txt --quiet OUTPUT_QUIET)
expect_success("paving.v" ${VERIFY} --coq paving.v paving.txt)
file(WRITE ${WORK_DIR}/platform.csv "x,y,z,roll,pitch,yaw\n0,0,9,0,0,0\n1,0,9.5,0.05,0,0\n1,1,10,0.05,0.05,0.1\n")
write_theorem(limits_pieces octahedral work --load payload --waypoints ${WORK_DIR}/platform.csv)
execute_process(COMMAND ${REGULUS} bound ${SOURCE_DIR}/models/octahedral.toml work force --load payload --leg 1
                        --limit 60 --waypoints ${WORK_DIR}/platform.csv --certificate ${WORK_DIR}/bound --quiet
                OUTPUT_QUIET)
expect_success("force_pieces.v" ${VERIFY} --coq force_pieces.v bound.leg_1.safe)

# ---- The reader: Coq reads the same questions.
foreach(name IN ITEMS pieces names T1 errors tolerance scara singular above force signed_force limits paving
                 limits_pieces force_pieces)
  expect_success("${name}.v is not read" ${FORMAL} --compare same_${name}.v ${name}.v)
  expect_theorem("Coq reads another question in ${name}.v" same_${name}.v)
endforeach()

# expect_refused(FROM TO): names.v with TO in the place of FROM is no file of regulus-verify, and Coq
# refuses it as well.
function(expect_refused from to)
  file(READ ${WORK_DIR}/names.v whole)
  string(REPLACE "${from}" "${to}" text "${whole}")
  if(text STREQUAL whole)
    message(FATAL_ERROR "names.v does not contain '${from}'")
  endif()
  file(WRITE ${WORK_DIR}/changed.v "${text}")
  execute_process(COMMAND ${FORMAL} --quiet changed.v WORKING_DIRECTORY ${WORK_DIR}
                  RESULT_VARIABLE code OUTPUT_VARIABLE answer)
  run_coq(coq_code text changed.v)
  if(NOT code EQUAL 1 OR NOT answer STREQUAL "REJECTED\n" OR coq_code EQUAL 0)
    message(FATAL_ERROR "'${to}': ${answer} (exit ${code}); Coq: ${coq_code}")
  endif()
endfunction()
expect_refused("From Coq Require Import List.\n" "")
expect_refused("From Regulus Require Import Notations.\n" "")
expect_refused("Search Singularity" "Singularity")
expect_refused("Import ListNotations" "Import MoreNotations")
expect_refused("(* _no_singularity *) 2" "nth 0 piece no_entry")
expect_refused("_forall" "forall")
expect_refused("Definition _tree" "Definition eq_refl")
expect_refused("_match'error" "match")

# ---- Verdicts.
foreach(name IN ITEMS pieces pieces_above names T1 errors tolerance circle wide scara axes singular above below crossing force
                 signed_force limits paving limits_pieces force_pieces)
  expect_success("${name}.v is not proved" ${FORMAL} --hints hinted_${name}.v ${name}.v)
  expect_success("hinted_${name}.v is not proved" ${FORMAL} hinted_${name}.v)
endforeach()
foreach(name IN ITEMS pieces pieces_above names circle above force signed_force limits paving limits_pieces force_pieces)
  expect_theorem("Coq refuses hinted_${name}.v" hinted_${name}.v)
endforeach()
expect_theorem("Coq refuses below.v" below.v)
expect_theorem("Coq refuses crossing.v" crossing.v)

# The claim of a singular question: no search ends.
file(READ ${WORK_DIR}/singular.v text)
string(REGEX REPLACE "\n\\(\\*\\* Two points.*" "" text "${text}")
set(theorem "no_singularity the_question.\nProof.\n  apply (check_correct the_question the_method).\n\
  vm_cast_no_check (eq_refl true).\nQed.\n")
file(WRITE ${WORK_DIR}/false.v
     "${text}\nDefinition the_method : method := Method 6 60.\n\nTheorem the_claim : ${theorem}")
execute_process(COMMAND ${FORMAL} --quiet --max-leaves 300 false.v WORKING_DIRECTORY ${WORK_DIR}
                RESULT_VARIABLE code OUTPUT_VARIABLE answer)
if(NOT code EQUAL 2 OR NOT answer STREQUAL "NOT PROVED\n")
  message(FATAL_ERROR "A singular robot: ${answer} (exit ${code})")
endif()

# A paving that keeps parts in which no forces within the limits hold the load; and hints for fewer parts.
file(READ ${WORK_DIR}/paving.v text)
string(REGEX REPLACE "the_parts : parts := \\([^%]*\\)%float" "the_parts : parts := (Parted 2 6 LeftOut Kept)%float" other
                     "${text}")
file(WRITE ${WORK_DIR}/more.v "${other}")
execute_process(COMMAND ${FORMAL} --quiet --max-leaves 300 more.v WORKING_DIRECTORY ${WORK_DIR}
                RESULT_VARIABLE code OUTPUT_VARIABLE answer)
if(other STREQUAL text OR NOT code EQUAL 2 OR NOT answer STREQUAL "NOT PROVED\n")
  message(FATAL_ERROR "A paving that keeps too much: ${answer} (exit ${code})")
endif()
file(READ ${WORK_DIR}/hinted_paving.v text)
string(REGEX REPLACE "list tree :=\n  \\[[^;]*;" "list tree :=\n  [" other "${text}")
file(WRITE ${WORK_DIR}/fewer.v "${other}")
execute_process(COMMAND ${FORMAL} --quiet fewer.v WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code OUTPUT_VARIABLE answer)
if(other STREQUAL text OR NOT code EQUAL 1 OR NOT answer STREQUAL "REJECTED\n")
  message(FATAL_ERROR "Hints for fewer parts: ${answer} (exit ${code})")
endif()

# A limit that is exceeded.
file(READ ${WORK_DIR}/force.v text)
string(REPLACE "the_limit : expression := 700." "the_limit : expression := 520." text "${text}")
file(WRITE ${WORK_DIR}/exceeded.v "${text}")
execute_process(COMMAND ${FORMAL} --quiet --max-leaves 300 exceeded.v WORKING_DIRECTORY ${WORK_DIR}
                RESULT_VARIABLE code OUTPUT_VARIABLE answer)
if(NOT code EQUAL 2 OR NOT text MATCHES "expression := 520" OR NOT answer STREQUAL "NOT PROVED\n")
  message(FATAL_ERROR "A force beyond its limit: ${answer} (exit ${code})")
endif()

# ---- Damaged hints and files.
set(objects uint63 float64 checker files tokens reader search print prove)
list(TRANSFORM objects REPLACE "(.+)" "${OBJECTS}/\\1.cmx")
expect_success("The program of damages" ${OCAMLOPT} -I +unix -I ${OBJECTS} unix.cmxa ${objects} damage.ml
               -o damage)
expect_success("Damaged hints" ${WORK_DIR}/damage singular.v hinted_pieces.v hinted_circle.v hinted_scara.v hinted_axes.v
               hinted_T1.v)
