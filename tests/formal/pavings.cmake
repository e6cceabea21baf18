# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about pavings of loads and of branches: those of models are proved, and files that claim more are
# not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(models ${SOURCE_DIR}/models)
file(COPY ${models}/cable_8.toml ${models}/octahedral.toml ${models}/four_bar.toml ${models}/five_bar_closure.toml
     DESTINATION ${WORK_DIR})

# A four-bar linkage whose motor keeps its limits in a part of its motions; one way ends at a toggle.
file(WRITE ${WORK_DIR}/linkage.toml "regulus = 1
name = \"linkage\"
[pose]
theta = \"rad\"
[geometry]
crank = { value = \"0.2\", tolerance = \"0.004\", group = \"base\" }
rod = { value = \"0.35355\", tolerance = \"0.004\", group = \"base\" }
[closure]
unknowns = { phi = \"rad\", psi = \"rad\" }
equations = [
  \"crank*cos(theta) + rod*cos(phi) - 0.45 - 0.25*cos(psi)\",
  \"crank*sin(theta) + rod*sin(phi) - 0.25*sin(psi)\",
]
start = { theta = 0, phi = 0.7854, psi = 1.5708 }
[actuators]
force = [-2, 2]
[load.push]
wrench = [[-1, 3], 2]
[motion.swings]
theta = [-2, 2]
[motion.turns]
waypoints = \"turns.csv\"
error = { theta = 0.02 }
[motion.reaches]
waypoints = \"reaches.csv\"
error = { theta = 0.02 }
")
file(WRITE ${WORK_DIR}/turns.csv "theta\n0\n1.5\n-0.5\n")
file(WRITE ${WORK_DIR}/reaches.csv "theta\n0\n-2.5\n0\n")
file(WRITE ${WORK_DIR}/way.csv "x,y,z,roll,pitch,yaw\n0,0,9,0,0,0\n1,0,9.5,0.05,0,0\n1,1,10,0.05,0.05,0.1\n")

# expect_proved(STATEMENT NAME MODEL WORDS...): that of the certificate NAME.txt of `regulus locate MODEL.toml WORDS`.
function(expect_proved statement name model)
  execute_process(COMMAND ${REGULUS} locate ${model}.toml ${ARGN} --certificate ${name}.txt --quiet
                  WORKING_DIRECTORY ${WORK_DIR} OUTPUT_VARIABLE answer ERROR_VARIABLE why)
  set(way "")
  if("${ARGN}" MATCHES "--waypoints;([a-z.]+)")
    set(way --waypoints ${CMAKE_MATCH_1})
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${name}.txt --model ${model}.toml --allow-options ${way})
  string(FIND "${why}" "theorem    ${statement}\n" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${name}: expected ${statement}\n${why}")
  endif()
endfunction()

# expect_text(NAME TEXT): the file of the theorem has this text.
function(expect_text name expected)
  file(READ ${WORK_DIR}/${name}.txt.v text)
  string(FIND "${text}" "${expected}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${name}.txt.v has no '${expected}'\n${text}")
  endif()
endfunction()

# expect_less(NAME WORD BY): the first leaf WORD of the certificate does not have the claim BY. A tube is that of
# the first leaf with a tube.
function(expect_less name word by)
  file(READ ${WORK_DIR}/${name}.txt text)
  string(REGEX MATCH "\nl [0-9]+ ${word}" leaf "${text}")
  string(REGEX MATCH "\nl [0-9]+ tube ([^\n]*)" first "${text}")
  set(tube " ${CMAKE_MATCH_1}")
  if(NOT word STREQUAL undecided OR NOT by MATCHES tube)
    set(tube "")
  endif()
  string(REPLACE " ${word}" " ${by}${tube}" other "${leaf}")
  expect_no_theorem(${name}.txt "${leaf}" "${other}")
endfunction()

expect_proved("forces_within_limits_in the_question the_parts the_scales the_load the_limits" cable cable_8
              hall --load weight --range z=4:7.5 --resolution 1/8)
expect_text(cable "Parted 2 5.75 Kept") # the cables hold the weight below
expect_answer(PROVED 0 ${WORK_DIR} --audit cable.txt.v)
expect_less(cable infeasible feasible)
expect_less(cable undecided feasible)
expect_no_theorem(cable.txt "limits 100 : 5000" "limits 100 : 3000")
# Along way-points the answer is about the whole way.
expect_proved("Forall ( fun piece => forces_within_limits ( the_question piece ) the_scales the_load the_limits ) pieces"
              platform octahedral work --load payload --waypoints way.csv)

expect_proved("one_branch_in the_closure the_parts" toggle four_bar turn)
expect_text(toggle "Kept LeftOut")
expect_text(toggle "LeftOut Kept")
expect_less(toggle undecided tube)
expect_proved("one_branch_in the_closure the_parts" wide five_bar_closure wide --resolution 1/32)
expect_less(wide undecided tube)
expect_proved("one_branch_along_in the_closure pieces the_parts" reaches linkage reaches)
expect_text(reaches "[(* piece 1 *) Parted 0 ")
expect_text(reaches " Kept LeftOut;\n   (* piece 2 *) LeftOut]")
expect_less(reaches undecided tube)

set(feasible "the_parts the_feasible_parts the_motors the_vectors the_limits")
expect_proved("branch_within_limits_in the_closure ${feasible}" swings linkage swings --load push)
expect_proved("branch_within_limits_along_in the_closure pieces ${feasible}" turns linkage turns --load push)
foreach(name IN ITEMS swings turns)
  expect_answer(PROVED 0 ${WORK_DIR} --audit ${name}.txt.v)
  expect_less(${name} infeasible feasible)
  expect_no_theorem(${name}.txt "limits -2 : 2" "limits -1 : 1")
endforeach()

# Other parts in a file of regulus-verify: more than the certificate proves, and other words.
file(READ ${WORK_DIR}/toggle.txt.v text)
foreach(parts IN ITEMS "Kept" "Parted 0 0 LeftOut Kept" "Parted 0 1 LeftOut Kept" "the_tubes")
  string(REGEX REPLACE "the_parts : parts := \\([^%]*\\)%float" "the_parts : parts := (${parts})%float" other "${text}")
  file(WRITE ${WORK_DIR}/other.v "${other}")
  expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
endforeach()

# The boxes are in other files.
execute_process(COMMAND ${REGULUS} locate five_bar_closure.toml wide --resolution 1/32 --certificate shards.txt
                        --shard-size 4096 --quiet WORKING_DIRECTORY ${WORK_DIR} OUTPUT_QUIET)
expect_answer(UNFINISHED 2 ${WORK_DIR} --theorem shards.txt)
