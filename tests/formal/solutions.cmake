# SPDX-License-Identifier: GPL-3.0-or-later
# Theorems about all configurations at one place: those of linkages are proved, also with tolerances, and files
# that are damaged or forged are not.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(models ${SOURCE_DIR}/models)

# certificate(FILE VERDICT MODEL WORDS...): of `solve`.
function(certificate file verdict model)
  execute_process(COMMAND ${REGULUS} solve ${models}/${model}.toml ${ARGN} --certificate ${WORK_DIR}/${file} --quiet
                  OUTPUT_VARIABLE answer ERROR_VARIABLE why)
  if(NOT answer STREQUAL "${verdict}\n")
    message(FATAL_ERROR "${model} ${ARGN}: ${answer}${why}, expected ${verdict}")
  endif()
endfunction()

# expect_proved(CLAIM FILE LINES WORDS...): a list of so many lines; WORDS for regulus-verify.
function(expect_proved claim file lines)
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${file} ${ARGN})
  file(READ ${WORK_DIR}/${file}.v text)
  string(REGEX REPLACE ".*Definition the_solutions[^[]*" "" list "${text}")
  string(REGEX REPLACE "\\.\n.*" "" list "${list}")
  string(REPLACE "[(" "@" list "${list}") # cmake pairs brackets
  string(REGEX MATCHALL "@" found "${list}")
  list(LENGTH found count)
  if(NOT why MATCHES "theorem    ${claim} the_closure the_solutions\n" OR NOT count EQUAL lines)
    message(FATAL_ERROR "${file}: expected ${claim} of ${lines} lines, found ${count}\n${why}")
  endif()
endfunction()

certificate(two.txt "COMPLETE: 2 configurations" four_bar --at theta=45*deg)
expect_proved(all_solutions two.txt 2 --model ${models}/four_bar.toml --allow-options)
certificate(none.txt NONE four_bar --at theta=135*deg)
expect_proved(all_solutions none.txt 0 --model ${models}/four_bar.toml --allow-options)
certificate(six.txt "COMPLETE: 6 configurations" double_butterfly --at theta=67.38)
expect_proved(all_solutions six.txt 6)
certificate(tolerance.txt "COMPLETE: 2 configurations" five_bar_closure --at theta1=120*deg --at theta2=60*deg
            --tolerance links=0.001)
expect_proved(all_solutions tolerance.txt 2 --model ${models}/five_bar_closure.toml --allow-options)

# Fewer solutions: as all of them no theorem, as some of them one.
file(READ ${WORK_DIR}/two.txt two)
string(REGEX MATCH "\nsolution [^\n]*" first "${two}")
string(REPLACE "${first}" "" one "${two}")
string(REPLACE "exactly 2 configurations, one within each" "exactly 1 configuration, within the" one "${one}")
file(WRITE ${WORK_DIR}/one.txt "${one}")
execute_process(COMMAND ${VERIFY} --theorem one.txt --library ${LIBRARY} WORKING_DIRECTORY ${WORK_DIR}
                OUTPUT_VARIABLE answer ERROR_VARIABLE why RESULT_VARIABLE code)
if(NOT code EQUAL 1 OR NOT answer STREQUAL "REJECTED\n" OR NOT why MATCHES "Coq|coqc")
  message(FATAL_ERROR "one of two: ${answer}${why}")
endif()
string(REPLACE "verdict COMPLETE" "verdict INCOMPLETE" some "${one}")
string(REPLACE "has exactly 1 configuration, within the" "has at least 1 configuration, within the" some
               "${some}")
file(WRITE ${WORK_DIR}/some.txt "${some}")
expect_proved(some_solutions some.txt 1)
# The question is another one, but for its words.
expect_no_theorem(two.txt "crank = 1/5" "crank = 1/4")
expect_no_theorem(two.txt "unknown phi = 1/4*pi" "unknown phi = 3*pi")
expect_no_theorem(none.txt "pose theta = 3/4*pi" "pose theta = 1/2*pi")
expect_no_theorem(tolerance.txt "crank_1 = 1 +- 1/1000" "crank_1 = 1 +- 1/100")

# The audit takes the files, and no other list, statement or definition.
expect_answer(PROVED 0 ${WORK_DIR} --audit two.txt.v)
expect_answer(PROVED 0 ${WORK_DIR} --audit some.txt.v)
file(READ ${WORK_DIR}/two.txt.v text)
set(apply "apply (check_all_solutions_correct the_closure the_method the_solutions).\n  vm_cast_no_check (eq_refl true).")
# expect_forgery(NAME WHAT BY): the audit does not take the file with other text.
function(expect_forgery name what by)
  string(REPLACE "${what}" "${by}" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "${name}: nothing was replaced")
  endif()
  file(WRITE ${WORK_DIR}/${name}.v "${other}")
  expect_answer(REJECTED 1 ${WORK_DIR} --audit ${name}.v)
endfunction()
expect_forgery(shorter "\n   [(0.3" "\n   [(0.4")
expect_forgery(statement "all_solutions the_closure the_solutions." "some_solutions the_closure the_solutions.")
string(REPLACE "Definition the_method" "Definition all_solutions (c : closure) (l : list line) := true = true.\nDefinition the_method"
               other "${text}")
string(REPLACE "${apply}" "reflexivity." other "${other}")
expect_only_coqc_accepts(claim.v "${other}")
string(REPLACE "Definition the_solutions" "Definition line := nat.\nDefinition the_solutions" other "${text}")
file(WRITE ${WORK_DIR}/line.v "${other}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit line.v)

# Poses in the plane are configurations of the equations of the legs.
certificate(poses.txt "COMPLETE: 6 poses" rpr_6)
expect_proved(all_solutions poses.txt 6 --model ${models}/rpr_6.toml)
expect_no_theorem(poses.txt "\nleg 0 | 0 | 0 | 0 | 561001/2500" "\nleg 0 | 0 | 0 | 0 | 561002/2500")
expect_no_theorem(poses.txt "\nleg 0 | 0 | 0 | 0 | " "\nleg 0 | 1 | 0 | 0 | ")
certificate(moved.txt "COMPLETE: 6 poses" rpr_6 --tolerance base=0.002)
expect_proved(all_solutions moved.txt 6)

# Lists at the places of a table, of configurations and of poses in the plane.
# expect_places(FILE LINES): the theorem about a table, of so many lines at all its places.
function(expect_places file lines)
  expect_answer(PROVED 0 ${WORK_DIR} --theorem ${file} ${ARGN})
  file(READ ${WORK_DIR}/${file}.v text)
  string(REGEX REPLACE ".*Definition the_places[^[]*" "" list "${text}")
  string(REGEX REPLACE "\\.\n.*" "" list "${list}")
  string(REPLACE "[(" "@" list "${list}")
  string(REGEX MATCHALL "@" found "${list}")
  list(LENGTH found count)
  math(EXPR lines "${lines} + 1") # the list of places
  if(NOT why MATCHES "theorem    solutions_at the_closure the_places\n" OR NOT count EQUAL lines)
    message(FATAL_ERROR "${file}: expected ${lines} lines, found ${count}\n${why}")
  endif()
endfunction()

file(WRITE ${WORK_DIR}/angles.csv "theta\n0.7\n0.9\n2.4\n")
certificate(angles.txt "NONE at 1, COMPLETE at 2 of 3 places: 4 configurations" four_bar --waypoints ${WORK_DIR}/angles.csv)
expect_places(angles.txt 4 --model ${models}/four_bar.toml --waypoints angles.csv)
expect_answer(PROVED 0 ${WORK_DIR} --audit angles.txt.v)
file(READ ${WORK_DIR}/angles.txt.v text)
expect_forgery(place "([9/10]" "([8/10]")
expect_forgery(place_without "All_of []" "All_of [[(0, 1); (0, 1)]]")
expect_forgery(places "solutions_at the_closure the_places." "solutions_at the_closure [].")
# Another angle, a list that is shorter, and a place without a proof.
expect_no_theorem(angles.txt "pose theta = 9/10" "pose theta = 8/10")
file(READ ${WORK_DIR}/angles.txt text)
string(REGEX MATCH "\nsolution [^\n]*" first "${text}")
expect_no_theorem(angles.txt "${first}" "")
string(REGEX MATCH "\nregulus-certificate 1\nverdict NONE.*\nplaces 3\n" third "${text}")
expect_no_theorem(angles.txt "${third}" "\nplaces 3\n")
expect_no_theorem(angles.txt "\nplaces 3" "\nplaces 4")
# An incomplete list at one of the places.
string(REGEX REPLACE "\nsolution [^\n]*\nproof\nend\nplace 2" "\nproof\nend\nplace 2" text "${text}")
string(REGEX REPLACE "^(.*\nplace 1\nregulus-certificate 1\n)verdict COMPLETE(.*)exactly 2 configurations, one within each(.*\nplace 2\n)"
                     "\\1verdict INCOMPLETE\\2at least 1 configuration, within the\\3" text "${text}")
file(WRITE ${WORK_DIR}/some_angles.txt "${text}")
expect_places(some_angles.txt 3)
file(STRINGS ${WORK_DIR}/some_angles.txt.v incomplete REGEX "Some_of")
list(LENGTH incomplete count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "expected one place with some configurations, found ${count}")
endif()

file(WRITE ${WORK_DIR}/lengths.csv "rho_1,rho_2,rho_3\n14.98,15.38,12.00\n1,1,1\n")
certificate(lengths.txt "NONE at 1, COMPLETE at 1 of 2 places: 6 poses" rpr_6 --waypoints ${WORK_DIR}/lengths.csv)
expect_places(lengths.txt 6 --model ${models}/rpr_6.toml --waypoints lengths.csv)
expect_no_theorem(lengths.txt "| 144\n" "| 145\n")
