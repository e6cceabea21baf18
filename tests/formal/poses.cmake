# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about the poses of platforms on six legs in space: those whose complex poses are counted are all, those
# of an INCOMPLETE list are some; files that are damaged or forged are not proved.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(models ${SOURCE_DIR}/models)

# expect_proved(CLAIM ANSWER ROOTS FILE MODEL WORDS...): of `solve`, a list of poses, and of so many roots that are not
# real.
function(expect_proved claim verdict roots file model)
  execute_process(COMMAND ${REGULUS} solve ${models}/${model}.toml ${ARGN} --certificate ${WORK_DIR}/${file} --quiet
                  OUTPUT_VARIABLE answer ERROR_VARIABLE messages)
  if(NOT answer STREQUAL "${verdict} poses\n")
    message(FATAL_ERROR "${model} ${ARGN}: ${answer}${messages}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${file} --model ${models}/${model}.toml --allow-options)
  file(READ ${WORK_DIR}/${file}.v text)
  string(REGEX REPLACE ".* " "" poses "${verdict}")
  expect_lines(${poses} the_solutions "\\[\\(")
  if(NOT claim STREQUAL "some_poses")
    expect_lines(${roots} the_roots "\\(\\[")
  endif()
  if(NOT why MATCHES "theorem    ${claim} the_question the_legs the_solutions\n")
    message(FATAL_ERROR "${file}: expected ${claim}\n${why}")
  endif()
endfunction()

# expect_lines(COUNT LIST BEGIN): a list of `text` has so many lines.
function(expect_lines count list begin)
  string(REGEX REPLACE ".*Definition ${list}[^=]*=" "" lines "${text}")
  string(REGEX REPLACE "\\.\n\n.*" "" lines "${lines}")
  string(REGEX REPLACE "${begin}" "@" lines "${lines}")
  string(REGEX MATCHALL "@" found "${lines}")
  list(LENGTH found have)
  if(NOT have EQUAL count)
    message(FATAL_ERROR "${list}: expected ${count} lines, found ${have}")
  endif()
endfunction()

# expect_forgery(NAME WHAT BY): the audit does not take the file `text` with other text.
function(expect_forgery name what by)
  string(REPLACE "${what}" "${by}" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "${name}: nothing was replaced")
  endif()
  file(WRITE ${WORK_DIR}/${name}.v "${other}")
  expect_answer(REJECTED 1 ${WORK_DIR} --audit ${name}.v)
endfunction()

set(near --at x=0.5 --at y=0.2 --at z=0.4 --at psi=0.1 --at theta=0.12 --at phi=0.05)
expect_proved("forty_poses -> all_poses" "COMPLETE: 2" 19 two.txt dietmaier ${near})
expect_proved("sixteen_poses -> all_poses" "COMPLETE: 8" 4 pairs.txt octahedral --at x=0.1 --at y=0.2 --at z=3 --at roll=0.1
              --at pitch=0.12 --at yaw=0.05)
set(near_of_1 --at x=1 --at y=1 --at z=47 --at psi=0.1 --at theta=0.1 --at phi=0)
expect_proved(some_poses "INCOMPLETE: at least 12" 0 some.txt robot_1 ${near_of_1} --max-boxes 3000)

# A list that was searched is complete, which Coq does not show: it has no weaker theorem.
execute_process(COMMAND ${REGULUS} solve ${models}/robot_1.toml ${near_of_1} --certificate ${WORK_DIR}/searched.txt --quiet
                OUTPUT_VARIABLE answer)
if(NOT answer STREQUAL "COMPLETE: 12 poses\n")
  message(FATAL_ERROR "robot_1: ${answer}")
endif()
expect_answer(UNFINISHED 2 ${WORK_DIR} --theorem searched.txt --model ${models}/robot_1.toml --allow-options)

# Another length, another anchor, a pose that is missing, and the same root once more.
expect_no_theorem(two.txt "| 9/20\n" "| 11/20\n")
expect_no_theorem(two.txt "\nleg 221583/200000 | " "\nleg 221584/200000 | ")
file(READ ${WORK_DIR}/two.txt certificate)
string(REGEX MATCH "\nsolution [^\n]*" first "${certificate}")
expect_no_theorem(two.txt "${first}" "")
string(REGEX MATCH "\nroot [^\n]*\nroot [^\n]*\n" roots "${certificate}")
string(REGEX MATCH "\nroot [^\n]*" root "${roots}")
expect_no_theorem(two.txt "${roots}" "${root}${root}\n")
expect_no_theorem(pairs.txt "\nleg 0 | 10 | 0 | 3*sqrt(3) | 3 | 0 " "\nleg 0 | 10 | 0 | 4*sqrt(3) | 3 | 0 ")

# The audit takes the file, and no other list, hypothesis, statement or definition.
expect_answer(PROVED 0 ${WORK_DIR} --audit two.txt.v)
file(READ ${WORK_DIR}/two.txt.v text)
string(REGEX MATCH "Definition the_roots : list root :=\n  .\\(.0x[^\n]*\n[^\n]*;\n" first "${text}")
string(REGEX REPLACE "Definition the_roots : list root :=\n  ." "" root "${first}")
expect_forgery(twice "${first}" "${first}   ${root}")
expect_forgery(fewer "${first}" "Definition the_roots : list root :=\n  [")
expect_forgery(number "9/20);" "8/20);")
expect_forgery(hypothesis "forty_poses -> all_poses" "sixteen_poses -> all_poses")
expect_forgery(no_hypothesis "the_claim : forty_poses -> all_poses" "the_claim : all_poses")
expect_forgery(other_hypothesis "the_claim : forty_poses -> all_poses" "the_claim : False -> all_poses")
string(REPLACE "Definition the_method" "Definition forty_poses := True = False.\nDefinition the_method" other "${text}")
string(REGEX REPLACE "apply \\(check_forty[^\n]*\n[^\n]*" "intros H. exfalso. rewrite <- H. exact I." other "${other}")
expect_only_coqc_accepts(claim.v "${other}")
string(REPLACE "Definition the_method" "Definition all_poses (q : question) (l : list (leg written)) (s : list line) := True.\nDefinition the_method"
               other "${text}")
string(REGEX REPLACE "apply \\(check_forty[^\n]*\n[^\n]*" "intros H. exact I." other "${other}")
expect_only_coqc_accepts(all.v "${other}")
# With less in the statement it is another theorem, which is true.
string(REPLACE "forty_poses -> all_poses" "some_poses" other "${text}")
string(REPLACE "check_forty_poses_correct" "check_some_poses_correct" other "${other}")
string(REPLACE " the_solutions the_roots)" " the_solutions)" other "${other}")
file(WRITE ${WORK_DIR}/some.v "${other}")
expect_answer(PROVED 0 ${WORK_DIR} --audit some.v)
