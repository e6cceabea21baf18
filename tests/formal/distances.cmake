# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about finite errors over a branch: those of linkages and of a platform in the plane are proved, and
# files that are damaged are not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(WRITE ${WORK_DIR}/driven.toml "regulus = 1
name = \"driven\"
[pose]
theta = \"rad\"
[geometry]
r = { value = 0.1, tolerance = 0.0001, group = \"links\" }
l = 0.3
[closure]
unknowns = { s = \"m\", phi = \"rad\" }
equations = [\"r*cos(theta) + l*cos(phi) - s\", \"r*sin(theta) + l*sin(phi)\"]
start = { theta = 0.5, s = 0.383917, phi = -0.160497 }
[actuators]
error = 0.001
[motion.work]
theta = [0.4, 0.6]
[motion.way]
waypoints = \"way.csv\"
")
file(WRITE ${WORK_DIR}/way.csv "theta\n0.5\n0.6\n0.4\n")
file(WRITE ${WORK_DIR}/tripod.toml "regulus = 1
name = \"tripod\"
[legs]
unit = \"cm\"
[[legs.leg]]
type = \"RPR\"
base = [0, 0]
platform = [0, 0]
[[legs.leg]]
type = \"RPR\"
base = [10, 0]
platform = [4, 0]
[[legs.leg]]
type = \"RPR\"
base = [3, 10]
platform = [2, 2]
[actuators]
error = [0.01, 0.02, 0.01]
[motion.work]
x = 5
y = 5
phi = \"1/10\"
")

# expect_proved(CLAIM MODEL MOTION FREEDOM LIMIT): that of the certificate MODEL.FREEDOM.safe.
function(expect_proved claim model motion freedom limit)
  execute_process(COMMAND ${REGULUS} bound ${model}.toml ${motion} error --finite --freedom ${freedom} --limit ${limit}
                          --certificate ${motion}_${model} --quiet WORKING_DIRECTORY ${WORK_DIR}
                  OUTPUT_VARIABLE answer ERROR_VARIABLE why)
  if(NOT answer STREQUAL "WITHIN\n")
    message(FATAL_ERROR "${model}: ${answer}${why}, expected WITHIN")
  endif()
  set(file ${motion}_${model}.${freedom}.safe)
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${file} --model ${model}.toml)
  if(NOT why MATCHES "theorem    ${claim} the_errors the_unknown the_limit\n")
    message(FATAL_ERROR "${model}: expected ${claim}\n${why}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --audit ${file}.v)
endfunction()

expect_proved("finite_error_within the_closure" driven work s 0.0002)
expect_proved("finite_error_within_along the_closure pieces" driven way phi 0.0005)
expect_proved("finite_error_within the_closure" tripod work y_deviation 0.1)

# The radius alone moves s by 0.00009 where theta = 0.4.
set(file work_driven.s.safe)
file(READ ${WORK_DIR}/${file} text)
string(REPLACE "< 1/5000 " "< 1/12000 " other "${text}")
if(other STREQUAL text)
  message(FATAL_ERROR "the claim has another limit: ${text}")
endif()
file(WRITE ${WORK_DIR}/smaller.txt "${other}")
expect_no_theorem(smaller.txt "\nbound 1/5000\n" "\nbound 1/12000\n")
expect_no_theorem(${file} "uncertain r = 1/10 +- 1/10000" "uncertain r = 1/10 +- 1/1000")

# A part of the set has no tube.
string(REGEX MATCH "\nl [0-9]+ tube [^\n]*" tube "${text}")
expect_no_theorem(${file} "${tube}" "")
string(REGEX REPLACE " tube .*" " outside" outside "${tube}")
expect_no_theorem(${file} "${tube}" "${outside}")

# Another unknown, and what has no error: Coq is asked, with another file.
file(READ ${WORK_DIR}/${file}.v text)
string(REPLACE "the_unknown : nat := 0" "the_unknown : nat := 2" other "${text}")
file(WRITE ${WORK_DIR}/other.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
string(REPLACE "finite_error_within the_closure" "one_branch the_closure" other "${text}")
file(WRITE ${WORK_DIR}/other.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
