# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about the branches of mechanisms with loops: those of the models are proved, and files that
# are damaged or forged are not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(models ${SOURCE_DIR}/models)

# certificate(MODEL MOTION): of `check`, as MODEL.txt.
function(certificate model motion)
  execute_process(COMMAND ${REGULUS} check ${models}/${model}.toml ${motion} --certificate
                          ${WORK_DIR}/${model}.txt --quiet OUTPUT_VARIABLE verdict)
  if(NOT verdict STREQUAL "NO SINGULARITY\n")
    message(FATAL_ERROR "${model} ${motion}: ${verdict}")
  endif()
endfunction()

# expect_no_theorem(WHAT BY): of the certificate of the four-bar linkage with other text.
function(expect_no_theorem what by)
  file(READ ${WORK_DIR}/four_bar.txt text)
  string(REPLACE "${what}" "${by}" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "no '${what}' in the certificate")
  endif()
  file(WRITE ${WORK_DIR}/other.txt "${other}")
  execute_process(COMMAND ${VERIFY} --theorem other.txt --library ${LIBRARY} --quiet
                  WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code OUTPUT_VARIABLE answer
                  ERROR_VARIABLE why)
  if(code EQUAL 0 OR answer STREQUAL "PROVED\n")
    message(FATAL_ERROR "${what} -> ${by}: ${answer}${why}")
  endif()
endfunction()

foreach(motion IN ITEMS "five_bar_closure work" "rrr_closure work" "delta_closure work"
                        "four_bar swing" "four_bar inside")
  separate_arguments(motion)
  certificate(${motion})
  list(GET motion 0 model)
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${model}.txt --model ${models}/${model}.toml)
  if(NOT why MATCHES "theorem    one_branch the_closure\n")
    message(FATAL_ERROR "${model}: ${why}")
  endif()
endforeach()

# At half a turn a double is beside π, and the radii at the start reach beyond the ranges.
set(models ${SOURCE_DIR}/tests/formal)
certificate(whole_turn turn)
expect_answer(PROVED 0 ${WORK_DIR} --theorem whole_turn.txt --model ${models}/whole_turn.toml)

# The audit takes the file, and no other statement or definition.
expect_answer(PROVED 0 ${WORK_DIR} --audit four_bar.txt.v)
file(READ ${WORK_DIR}/four_bar.txt.v text)
string(REPLACE "Theorem the_claim : one_branch the_closure." "Theorem the_claim : True." other "${text}")
string(REPLACE "apply (check_closure_correct the_closure the_method the_tubes)." "exact I." other "${other}")
string(REPLACE "  vm_cast_no_check (eq_refl true).\n" "" other "${other}")
expect_only_coqc_accepts(true.v "${other}")
string(REPLACE "Definition the_method" "Definition one_branch (c : closure) := true = true.\nDefinition the_method"
               other "${text}")
string(REPLACE "apply (check_closure_correct the_closure the_method the_tubes)." "reflexivity." other "${other}")
string(REPLACE "  vm_cast_no_check (eq_refl true).\n" "" other "${other}")
expect_only_coqc_accepts(claim.v "${other}")

expect_no_theorem("unknown phi = 1/4*pi" "unknown phi = -1/4*pi") # there is no such configuration
expect_no_theorem("constant rocker = 1/4" "constant rocker = 1/5") # not within the radius at the start
expect_no_theorem("11/15*pi : 11/15*pi" "3/4*pi : 3/4*pi") # beyond the ends of the branch
expect_no_theorem("crank*sin(theta)" "crank*cos(theta)")
