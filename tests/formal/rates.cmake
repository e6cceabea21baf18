# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about forces, errors, speeds, deflections, determinants and condition numbers over the branch of
# a closure: those of a five-bar linkage are proved, and files that are damaged are not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(READ ${SOURCE_DIR}/models/five_bar_closure.toml model)
file(WRITE ${WORK_DIR}/five_bar.toml "${model}
[load.pull] # at P
wrench = [[-1, 1], -10]

[load.ball]
wrench = { value = [0, -10], radius = 2 }

[actuators]
force = [-40, 40]
speed = 1
error = \"1/100\"
stiffness = [100, 200]
")

# expect_proved(CLAIM FILE VERDICT WORDS...): that of the certificate FILE of `regulus WORDS`.
function(expect_proved claim file verdict command)
  execute_process(COMMAND ${REGULUS} ${command} five_bar.toml work ${ARGN} --quiet WORKING_DIRECTORY ${WORK_DIR}
                  OUTPUT_VARIABLE answer ERROR_VARIABLE why)
  if(NOT answer STREQUAL "${verdict}\n")
    message(FATAL_ERROR "${ARGN}: ${answer}${why}, expected ${verdict}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${file} --model five_bar.toml)
  if(NOT why MATCHES "theorem    ${claim} the_closure [a-z_ ]*\n")
    message(FATAL_ERROR "${ARGN}: expected ${claim}\n${why}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --audit ${file}.v)
endfunction()

expect_proved(branch_within force.theta1.safe WITHIN bound force --load pull --leg 1 --limit 14 --certificate force)
expect_proved(branch_within ball.theta2.safe WITHIN bound force --load ball --leg 2 --limit 16 --certificate ball)
expect_proved(branch_below signed.theta1.safe WITHIN bound force --load pull --leg 1 --signed --limit 14 --certificate
              signed)
expect_proved(branch_within error.x.safe WITHIN bound error --limit 1/35 --certificate error)
expect_proved(branch_within speed.y.safe WITHIN bound speed --limit 3 --certificate speed)
expect_proved(branch_within_limits limits.txt FEASIBLE check --load pull --certificate limits.txt)
expect_proved(branch_within deflection.y.safe WITHIN bound deflection --load pull --freedom y --limit 1/4 --certificate
              deflection)
expect_proved(branch_determinant det.safe WITHIN bound determinant --limit 4 --certificate det)
execute_process(COMMAND ${REGULUS} check five_bar.toml work --alpha 4 --certificate alpha --quiet
                WORKING_DIRECTORY ${WORK_DIR} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
expect_answer(PROVED 0 ${WORK_DIR} --theorem alpha --model five_bar.toml --allow-options)
expect_answer(PROVED 0 ${WORK_DIR} --audit alpha.v)
expect_proved(branch_determinant det_max.safe WITHIN bound determinant-max --limit 8 --certificate det_max)
expect_proved(branch_condition condition.safe WITHIN bound condition --limit 4 --certificate condition)
expect_proved(branch_condition_2 kappa.safe "BETWEEN 2.28899 AND 2.30605" bound condition --norm 2 --threads 1 --certificate
              kappa)
expect_proved(branch_singular_values_above least.safe WITHIN bound sigma-min --limit 1.4 --certificate least)
expect_proved(branch_singular_values_below largest.safe WITHIN bound sigma-max --limit 3.3 --certificate largest)

# `regulus bound` finds a force of 12.369, a speed of 2.368, a deflection of 0.2158, a determinant between
# 4.545 and 6.25, a condition number of 3.318, singular values from 1.41 to 3.25, and 2.2913 as their ratio.
expect_no_theorem(force.theta1.safe "wrench 0 +- 1" "wrench 0 +- 5")
expect_no_theorem(force.theta1.safe "wrench -10 +- 0" "wrench -20 +- 0")
expect_no_theorem(ball.theta2.safe "wrench-ball 2 in 1 2" "wrench-ball 20 in 1 2")
expect_no_theorem(speed.y.safe "motor-speed 1" "motor-speed 2")
expect_no_theorem(error.x.safe "motor-error 1/100" "motor-error 1/5")
expect_no_theorem(limits.txt "limits -40 : 40" "limits -10 : 40")
expect_no_theorem(limits.txt "limits -40 : 40" "limits -40 : 10")
expect_no_theorem(force.theta1.safe "crank_1 = 1" "crank_1 = 3/2")
expect_no_theorem(force.theta1.safe "wrench 0 +- 1" "wrench 0 +- -1") # no load at all
expect_no_theorem(limits.txt "wrench 0 +- 1" "wrench 0 +- -1")

# A bound that is exceeded; the words of the claim have its number, too.
# expect_no_other_bound(FILE NUMBER OTHER)
function(expect_no_other_bound file number other)
  file(READ ${WORK_DIR}/${file} text)
  string(REGEX REPLACE "([<>]) ${number} " "\\1 ${other} " changed "${text}")
  file(WRITE ${WORK_DIR}/other_bound.txt "${changed}")
  expect_no_theorem(other_bound.txt "\nbound ${number}\n" "\nbound ${other}\n")
endfunction()
expect_no_other_bound(force.theta1.safe 14 12.3)
expect_no_other_bound(deflection.y.safe 1/4 1/5)
expect_no_other_bound(det.safe 4 5)
expect_no_other_bound(det_max.safe 8 6)
expect_no_other_bound(condition.safe 4 3)
expect_no_other_bound(kappa.safe 1153021/500000 2.29)
expect_no_other_bound(kappa.safe 1153021/500000 1)
expect_no_other_bound(kappa.safe 1153021/500000 -3)
expect_no_other_bound(least.safe 7/5 1.42)
expect_no_other_bound(largest.safe 33/10 3.2)
expect_no_theorem(alpha "\nalpha 4\n" "\nalpha 5\n")
expect_no_theorem(deflection.y.safe "stiffness 200" "stiffness 100")
expect_no_theorem(deflection.y.safe "stiffness 200" "stiffness -200")
expect_no_theorem(deflection.y.safe "wrench -10 +- 0" "wrench -20 +- 0")
expect_no_theorem(condition.safe "factor 1\nfactor 1\n" "factor 1\nfactor 9\n")
expect_no_theorem(kappa.safe "factor 1\nfactor 1\n" "factor 1\nfactor 9\n")
expect_no_theorem(kappa.safe "factor 1\nfactor 1\n" "factor 1\nfactor 0\n")
expect_no_theorem(least.safe "factor 1\nfactor 1\n" "factor 1\nfactor 1/9\n")
expect_no_theorem(largest.safe "factor 1\nfactor 1\n" "factor 1\nfactor 2\n")
expect_no_theorem(kappa.safe "coupler_1 = 5/4" "coupler_1 = 11/10")
expect_no_theorem(det.safe "coupler_1 = 5/4" "coupler_1 = 11/10")

# A part of the set has no tube.
file(READ ${WORK_DIR}/force.theta1.safe text)
string(REGEX MATCH "\nl [0-9]+ tube [^\n]*" tube "${text}")
expect_no_theorem(force.theta1.safe "${tube}" "")
string(REGEX REPLACE " tube .*" " outside" outside "${tube}")
expect_no_theorem(force.theta1.safe "${tube}" "${outside}")

# Another load is that of no model file.
expect_no_theorem(force.theta1.safe "wrench 0 +- 1" "wrench 0 +- 1/2" --model five_bar.toml)
expect_no_theorem(limits.txt "limits -40 : 40" "limits -50 : 50" --model five_bar.toml)

# The audit takes no other statement, nor other words.
file(READ ${WORK_DIR}/det.safe.v text)
foreach(changed IN ITEMS "side := Below" "side := Within" "side := true" "side := Beyond.\nDefinition Beyond : side := Above")
  string(REPLACE "side := Beyond" "${changed}" other "${text}")
  file(WRITE ${WORK_DIR}/other.v "${other}")
  expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
endforeach()
file(READ ${WORK_DIR}/least.safe.v text)
string(REPLACE "branch_singular_values_above the_closure" "branch_singular_values_below the_closure" other "${text}")
file(WRITE ${WORK_DIR}/other.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
file(READ ${WORK_DIR}/force.theta1.safe.v text)
string(REPLACE "branch_within the_closure" "branch_below the_closure" other "${text}")
file(WRITE ${WORK_DIR}/other.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
string(REPLACE "Definition the_method" "Definition branch_within (c : closure) := true = true.\nDefinition the_method"
               other "${text}")
file(WRITE ${WORK_DIR}/other.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
