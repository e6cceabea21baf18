# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about the branches of mechanisms with loops along way-points: those of the models are proved, and
# files that are damaged or forged are not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

# model(NAME FROM TOLERANCE MORE): the model FROM, its links with a tolerance.
function(model name from tolerance more)
  file(READ ${SOURCE_DIR}/models/${from}.toml text)
  string(REPLACE "tolerance = 0, group = \"links\"" "tolerance = ${tolerance}, group = \"links\"" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "${from} has no links")
  endif()
  file(WRITE ${WORK_DIR}/${name}.toml "${other}${more}")
endfunction()

# expect_proved(CLAIM FILE VERDICT WORDS...): that of the certificate FILE of `regulus WORDS`. The audit takes the
# first file of each claim.
function(expect_proved claim file verdict command model motion way)
  execute_process(COMMAND ${REGULUS} ${command} ${model}.toml ${motion} ${ARGN} --waypoints ${way}.csv --quiet
                  WORKING_DIRECTORY ${WORK_DIR} OUTPUT_VARIABLE answer ERROR_VARIABLE why)
  if(NOT answer STREQUAL "${verdict}\n")
    message(FATAL_ERROR "${model} ${ARGN}: ${answer}${why}, expected ${verdict}")
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${file} --model ${model}.toml --waypoints ${way}.csv
                --allow-options)
  if(NOT why MATCHES "theorem    ${claim} the_closure pieces[a-z_ ]*\n")
    message(FATAL_ERROR "${ARGN}: expected ${claim}\n${why}")
  endif()
  get_property(audited GLOBAL PROPERTY audited)
  if(NOT claim IN_LIST audited)
    expect_answer(PROVED 0 ${WORK_DIR} --audit ${file}.v)
    set_property(GLOBAL APPEND PROPERTY audited ${claim})
  endif()
endfunction()

# expect_text(FILE TEXT): the file of the theorem has this text.
function(expect_text file expected)
  file(READ ${WORK_DIR}/${file}.v text)
  string(FIND "${text}" "${expected}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${file}.v has no '${expected}'")
  endif()
endfunction()

# A four-bar linkage, a planar robot with two loops, and a five-bar linkage.
model(four_bar four_bar 0.0005 "")
model(rrr rrr_closure 0.02 "")
model(five_bar five_bar_closure 0.001 "
[motion.smooth]
waypoints = \"five_bar.csv\"
interpolation = \"cubic\"

[load.pull] # at P
wrench = [[-1, 1], -10]

[actuators]
force = [-40, 40]
speed = 1
error = \"1/100\"
")
file(WRITE ${WORK_DIR}/four_bar.csv "theta [deg]\n0\n50\n-57.5\n")
file(WRITE ${WORK_DIR}/rrr.csv "theta1 [deg],theta2 [deg],theta3 [deg]\n91,211,-30\n94,208,-32.5\n94,210,-27\n")
file(WRITE ${WORK_DIR}/five_bar.csv "theta1 [deg],theta2 [deg]\n120,60\n110,65\n100,62.5\n")
expect_proved(one_branch_along four_bar.txt "NO SINGULARITY" check four_bar swing four_bar --certificate four_bar.txt)
expect_text(four_bar.txt "pieces : list (list expression) := segments\n  [[0];\n   [50 * deg];\n   [- 57.5 * deg]].")
expect_proved(one_branch_along rrr.txt "NO SINGULARITY" check rrr work rrr --certificate rrr.txt)
expect_text(rrr.txt "segments\n  [[91 * deg; 211 * deg; - 30 * deg];\n   [94 * deg; 208 * deg; - 32.5 * deg];\n   [94 *")
expect_proved(branch_within_along force.theta1.safe WITHIN bound five_bar work five_bar force --load pull --leg 1
              --limit 14 --certificate force)
expect_proved(branch_below_along signed.theta1.safe WITHIN bound five_bar work five_bar force --load pull --leg 1
              --signed --limit 14 --certificate signed)
expect_proved(branch_within_along error.x.safe WITHIN bound five_bar work five_bar error --limit 1/35 --certificate
              error)
expect_proved(branch_within_along speed.y.safe WITHIN bound five_bar work five_bar speed --limit 3 --certificate speed)
expect_proved(branch_determinant_along det.safe WITHIN bound five_bar work five_bar determinant --limit 4 --certificate
              det)
expect_proved(branch_condition_along condition.safe WITHIN bound five_bar work five_bar condition --limit 4 --certificate
              condition)
expect_no_theorem(condition.safe "factor 1\nfactor 1\n" "factor 1\nfactor 9\n")
expect_proved(branch_condition_2_along kappa.safe WITHIN bound five_bar work five_bar condition --norm 2 --limit 1.4
              --certificate kappa)
expect_proved(branch_singular_values_above_along least.safe WITHIN bound five_bar work five_bar sigma-min --limit 2
              --certificate least)
expect_proved(branch_singular_values_below_along largest.safe WITHIN bound five_bar work five_bar sigma-max --limit 3
              --certificate largest)
expect_no_theorem(kappa.safe "factor 1\nfactor 1\n" "factor 1\nfactor 9\n")
expect_no_theorem(least.safe "factor 1\nfactor 1\n" "factor 1\nfactor 1/9\n")
expect_no_theorem(largest.safe "factor 1\nfactor 1\n" "factor 1\nfactor 9\n")
expect_proved(branch_within_limits_along limits.txt FEASIBLE check five_bar work five_bar --load pull --certificate
              limits.txt)

# The cubic pieces of a smooth way.
execute_process(COMMAND ${REGULUS} check five_bar.toml smooth --certificate smooth.txt --quiet
                WORKING_DIRECTORY ${WORK_DIR} OUTPUT_QUIET)
expect_answer(PROVED 0 ${WORK_DIR} --theorem smooth.txt --model five_bar.toml)
expect_text(smooth.txt "The pieces of the way, each with its values of theta1_c0, theta1_c1, theta1_c2")

# Along other ways, of other mechanisms, and where the pieces are not one way.
expect_no_theorem(four_bar.txt "unknown phi = 1/4*pi" "unknown phi = -1/4*pi")
expect_no_theorem(four_bar.txt "\nstart 0\n" "\nstart 3/2\n")
expect_no_theorem(four_bar.txt "| -43/72*pi" "| -19/18*pi") # to -140 degrees, beyond the end of the branch
expect_no_theorem(four_bar.txt "piece 5/18*pi |" "piece 1/4*pi |") # it begins elsewhere
expect_no_theorem(four_bar.txt "uncertain rocker = 1/4" "uncertain rocker = 1/5")
expect_no_theorem(four_bar.txt "crank*sin(theta)" "crank*sin(theta)*(1 + 0*s)")
expect_no_theorem(four_bar.txt "theta_c0 + s*theta_c1" "theta_c0 + sin(1/2*pi*s)*theta_c1")
expect_no_theorem(four_bar.txt "in 0 : 1" "in 0 : 2")
expect_no_theorem(rrr.txt "uncertain crank_1 = 25 +- 1/50" "uncertain crank_1 = 25 +- 20")
expect_no_theorem(force.theta1.safe "wrench -10 +- 0" "wrench -20 +- 0")
expect_no_theorem(speed.y.safe "motor-speed 1" "motor-speed 2")
expect_no_theorem(error.x.safe "motor-error 1/100" "motor-error 1/5")
expect_no_theorem(limits.txt "limits -40 : 40" "limits -10 : 7")
file(READ ${WORK_DIR}/four_bar.txt text)
string(REGEX MATCH "\ntree\n[^t]*tube[^t]*" tree "${text}")
string(REGEX REPLACE "(l [0-9]+) tube [^\n]*" "\\1 outside" outside "${tree}")
expect_no_theorem(four_bar.txt "${tree}" "${outside}")
expect_no_theorem(four_bar.txt "${tree}" "\n")
# Another file of way-points, and fewer of them.
file(WRITE ${WORK_DIR}/four_bar.csv "theta [deg]\n0\n50\n-57\n")
expect_answer(REJECTED 1 ${WORK_DIR} --theorem four_bar.txt --model four_bar.toml --waypoints four_bar.csv)
file(WRITE ${WORK_DIR}/four_bar.csv "theta [deg]\n0\n50\n-57.5\n0\n")
expect_answer(REJECTED 1 ${WORK_DIR} --theorem four_bar.txt --model four_bar.toml --waypoints four_bar.csv)

# The audit takes no other statement, nor other words.
file(READ ${WORK_DIR}/four_bar.txt.v text)
string(REPLACE "Theorem the_claim : one_branch_along the_closure pieces." "Theorem the_claim : True." other "${text}")
string(REGEX REPLACE "apply \\(check[^\n]*\n[^\n]*\n" "exact I.\n" other "${other}")
expect_only_coqc_accepts(true.v "${other}")
foreach(forged IN ITEMS "one_branch_along (c : list expression -> closure) (l : list (list expression)) := true = true"
                        "segments (l : list (list expression)) : list (list expression) := [[0; 0]]")
  string(REPLACE "\n\n(** The way-points" "\nDefinition ${forged}.\n\n(** The way-points" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "nothing was forged")
  endif()
  file(WRITE ${WORK_DIR}/other.v "${other}")
  expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
endforeach()
# There are more trees than segments.
string(REGEX REPLACE "50 \\* deg\\];[^]]*\\]\\]" "50 * deg]]" other "${text}")
file(WRITE ${WORK_DIR}/other.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit other.v)
