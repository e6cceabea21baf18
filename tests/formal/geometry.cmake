# SPDX-License-Identifier: GPL-3.0-or-later
# The theorem about the robot of a model file: it is proved and audited where there is one, refused if
# the certificate is about another robot, and its matrices are those of an oracle.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

# ---- Geometry.v and another kind of computation give random platforms the same matrices.
configure_file(${CMAKE_CURRENT_LIST_DIR}/geometry_oracle.ml ${WORK_DIR}/geometry_oracle.ml COPYONLY)
execute_process(COMMAND ${OCAMLOPT} geometry_oracle.ml -o geometry_oracle WORKING_DIRECTORY ${WORK_DIR}
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK_DIR}/geometry_oracle OUTPUT_FILE ${WORK_DIR}/Oracle.v COMMAND_ERROR_IS_FATAL ANY)
run_coq(code text Oracle.v)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "Geometry.v gives another matrix than the oracle\n${text}")
endif()
file(READ ${WORK_DIR}/Oracle.v text)
string(REGEX REPLACE "(near [^ ]+ [(]-?)([0-9]+)" "\\11\\2" text "${text}")
file(WRITE ${WORK_DIR}/Other.v "${text}")
run_coq(code text Other.v)
if(code EQUAL 0)
  message(FATAL_ERROR "Coq accepts other matrices than those of the oracle")
endif()
file(READ ${WORK_DIR}/Oracle.v text)
string(FIND "${text}" "Definition legs_of_" at)
string(SUBSTRING "${text}" 0 ${at} before)
string(FIND "${text}" "Definition flat_chains " at)
string(SUBSTRING "${text}" ${at} -1 after)
string(REGEX REPLACE "(are_near [[][[]-?)([0-9]+)" "\\11\\2" after "${after}")
file(WRITE ${WORK_DIR}/OtherLegs.v "${before}${after}")
run_coq(code text OtherLegs.v)
if(code EQUAL 0)
  message(FATAL_ERROR "Coq accepts other rows of legs than those of the oracle")
endif()

# write_certificate(NAME MODEL MOTION OPTIONS...)
function(write_certificate name model)
  execute_process(COMMAND ${REGULUS} check ${model} ${ARGN} --certificate ${WORK_DIR}/${name}.txt --quiet
                  OUTPUT_QUIET)
endfunction()

# expect_robot(NAME MODEL MOTION STATEMENT OPTIONS...): a theorem with the words of STATEMENT.
function(expect_robot name model motion statement)
  write_certificate(${name} ${model} ${motion} ${ARGN})
  set(options "")
  if(ARGN)
    set(options --allow-options)
  endif()
  expect_answer(PROVED 0 ${WORK_DIR} --theorem --model ${model} ${options} ${name}.txt)
  string(FIND "${why}" "${statement}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${name}: the theorem does not have '${statement}'\n${why}")
  endif()
  file(READ ${WORK_DIR}/${name}.txt.v text)
  if(NOT text MATCHES "\nTheorem the_set_is_inhabited :|Theorem the_robot : exists|No point of the set is known")
    message(FATAL_ERROR "${name}: nothing says if the set has a point")
  endif()
endfunction()

set(models ${SOURCE_DIR}/models)
set(own ${CMAKE_CURRENT_LIST_DIR})
expect_robot(wide ${models}/robot_1.toml wide_15 "gough legs ( x , y , z ) ( euler_zxz psi theta phi )")
expect_robot(circle ${models}/robot_1.toml T1 "( 8 * cos ( 2 * pi * _T ) , 8 * sin ( 2 * pi * _T ) , 55 )")
expect_robot(errors ${models}/robot_1.toml T2_errors "forall ( _T x y z psi theta phi : R ) , the_set")
expect_robot(tolerance ${models}/robot_1.toml table6_5_5 "gough [ ( a1 , b1 ) ; ( a2 , b2 )"
             --tolerance base,platform=0.05)
expect_robot(other ${models}/robot_2.toml table5_20 "( euler_zxz psi theta phi )")
expect_robot(level ${models}/octahedral.toml level_89 "( roll_pitch_yaw 0 0 yaw )")
expect_robot(screw ${models}/octahedral.toml screw "( roll_pitch_yaw roll pitch yaw )")
expect_robot(degrees ${own}/degrees.toml box "( roll_pitch_yaw ( roll * deg ) ( pitch * deg ) ( yaw * deg ) )")
expect_robot(path ${own}/degrees.toml path "( _t ^ 2 , sqrt ( 1 + _t ) , 45 )")
expect_robot(quaternion ${own}/quaternion.toml small "( quaternion 1 q1 q2 q3 )")
expect_robot(turn ${own}/quaternion.toml turn "( quaternion ( cos ( _t / 10 ) ) 0 0 ( sin ( _t / 10 ) ) )")
expect_robot(lengths ${own}/uncertain.toml fixed "gough [ ( a1 , ( - 3 , 7 , 0 ) ) ;")
expect_robot(words ${own}/uncertain.toml words "( _R , _legs * _the_set , 45 + _S )")
expect_robot(singular ${models}/robot_1.toml wide_40 "exists ( x y z psi theta phi : R ) , the_set")
expect_robot(yaw ${models}/octahedral.toml level_91 "( roll_pitch_yaw 0 0 yaw ) ) = 0")
expect_robot(threshold ${models}/robot_1.toml table6_5_5 "1 < Rabs ( determinant 6 ( inverse_jacobian legs"
             --alpha 1)
expect_robot(small ${models}/robot_1.toml table6_5_5 "( euler_zxz psi theta phi ) ) ) <= 10" --alpha 10)
expect_robot(ring ${own}/quaternion.toml ring "the_set")
expect_robot(puma ${models}/puma_560_serial.toml dexterous
             "full_column_rank 6 6 ( jacobian ( arm _q1 _q2 _q3 _q4 _q5 _q6 ) )")
expect_robot(arm_path ${models}/puma_560_serial.toml sweep "forall ( _T _q1 _q2 _q3 _q4 _q5 _q6 : R ) , the_set")
expect_robot(scara ${models}/scara.toml right_handed "full_column_rank 6 4 ( jacobian ( arm _q1 _q2 _d3 _q4 ) )")
expect_robot(parallel ${models}/three_parallel_axes.toml table "full_column_rank 6 6 ( jacobian ( arm")
expect_robot(wide_arm ${models}/seven_joints.toml table "full_row_rank 6 7 ( jacobian ( arm")
expect_robot(matrix ${models}/planar_3rpr.toml regular "full_column_rank 3 3 ( the_matrix _x _y _phi )")
expect_robot(reach ${models}/planar_3rpr.toml reach "full_column_rank 3 3 ( the_matrix _x _y _phi )")
expect_robot(matrix_path ${models}/planar_3rpr.toml circle "forall ( _T _x _y _phi : R ) , the_set _T _x _y _phi")
expect_robot(crossing ${models}/planar_3rpr.toml crossing "determinant 3 ( the_matrix _x _y _phi ) = 0")
expect_robot(large ${models}/planar_3rpr.toml regular "< Rabs ( determinant 3 ( the_inverse_jacobian _x _y _phi ) )"
             --alpha 0.1)
expect_robot(little ${models}/planar_3rpr.toml crossing "determinant 3 ( the_inverse_jacobian _x _y _phi ) ) <= " --alpha 0.1)
expect_robot(sides ${models}/planar_3rpr.toml regular "the_matrix _a1_1 _a1_2 _a2_1 _a2_2 _a3_1 _a3_2 _side_12"
             --tolerance base,platform=0.01)
expect_robot(cranks ${models}/planar_3rrr.toml regular "full_column_rank 3 3 ( the_matrix _x _y _phi )")
expect_robot(delta ${models}/delta.toml work "full_column_rank 6 6 ( the_matrix _x _y _z )")
expect_robot(wrist ${models}/puma_560.toml wrist "exists ( _q4 _q5 : R ) , the_set _q4 _q5")
expect_robot(seven_legs ${own}/seven_legs.toml work "full_column_rank 7 6 ( gough legs ( x , y , z )")
expect_robot(quotient ${own}/quotient.toml work "forall ( _x _phi'commanded _phi : R )")
expect_robot(words_of_coq ${own}/names.toml all "( the_matrix _check_correct _eq_refl _tree _Forall")
expect_robot(rails ${models}/active_wrist.toml work "full_column_rank 6 6 ( in_space legs ( _x , _y , _z )")
expect_robot(rails_turn ${models}/active_wrist.toml turn "exists ( _yaw : R ) , the_set _yaw")
expect_robot(hinges ${models}/hunt_3rps.toml work "( euler_zxz _A _B ( - _A ) )")
expect_robot(hinges_large ${models}/hunt_3rps.toml work "Rabs ( determinant 6 ( rates_in_space legs" --alpha 0.01)
expect_robot(level_legs ${models}/snu_3upu.toml away "( in_space legs ( _x , _y , _z ) fixed )")
expect_robot(level_circle ${models}/snu_3upu.toml circle "forall ( _T _x _y _z : R ) , the_set")
expect_robot(rotary ${own}/rotary.toml work "full_column_rank 6 6 ( in_space legs")
expect_robot(rotary_turn ${models}/hexapod_6rus.toml turn "determinant 6 ( the_matrix")
expect_robot(stage ${own}/stage.toml work "RRR ( 0 , 0 ) ( - 30 , - 20 ) 120 _rod_1 1 ;")
expect_robot(parallelograms ${own}/parallelograms.toml work "( in_space legs ( _x , _y , _z ) fixed )")
file(READ ${WORK_DIR}/ring.txt.v text)
if(NOT text MATCHES "No point of the set is known")
  message(FATAL_ERROR "The middle of the ranges does not satisfy the constraints\n${text}")
endif()

# ---- The model file is another one than that of the certificate.
# expect_difference(MODEL CERTIFICATE NAME CHANGED TO REASON): of a line of a model file of the library.
function(expect_difference model certificate name changed to reason)
  file(READ ${models}/${model}.toml text)
  string(REPLACE "${changed}" "${to}" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "the model file has no '${changed}'")
  endif()
  file(WRITE ${WORK_DIR}/${name}.toml "${other}")
  execute_process(COMMAND ${VERIFY} --coq ${WORK_DIR}/${name}.v --model ${WORK_DIR}/${name}.toml ${certificate}
                  WORKING_DIRECTORY ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
  expect_answer(REJECTED 1 ${WORK_DIR} --audit ${name}.v)
  if(NOT why MATCHES "${reason}")
    message(FATAL_ERROR "${name}: expected '${reason}'\n${why}")
  endif()
endfunction()
expect_difference(robot_1 wide.txt anchor "[-3, 7, 0], [3, 7, 0]" "[-3, 7.001, 0], [3, 7, 0]"
                  "no proof that an entry of the certificate is that of the model file")
expect_difference(robot_1 wide.txt order "[-9, 9, 0], [9, 9, 0]" "[9, 9, 0], [-9, 9, 0]"
                  "no proof that an entry of the certificate is that of the model file")
expect_difference(robot_1 wide.txt range "[motion.wide_15]  # §V-C1a\nx = [-15, 15]" "[motion.wide_15]\nx = [-15, 16]"
                  "no proof that a range of the model file is in that of the certificate")

# Another arm, and a larger range of a joint.
# expect_other_arm(NAME CHANGED TO REASON): in the file of the theorem.
function(expect_other_arm name changed to reason)
  file(READ ${WORK_DIR}/scara.txt.v text)
  string(REPLACE "${changed}" "${to}" other "${text}")
  if(other STREQUAL text)
    message(FATAL_ERROR "the theorem has no '${changed}'")
  endif()
  file(WRITE ${WORK_DIR}/${name}.v "${other}")
  expect_answer(REJECTED 1 ${WORK_DIR} --audit ${name}.v)
  if(NOT why MATCHES "${reason}")
    message(FATAL_ERROR "${name}: expected '${reason}'\n${why}")
  endif()
endfunction()
expect_other_arm(longer "along_x 0.225 pi" "along_x 0.226 pi" "no proof that the matrix of the certificate")
expect_other_arm(skew "prismatic 3 z_axis" "prismatic 3 x_axis" "no proof that|Coq refuses")
expect_other_arm(joint "5*deg <= _q2" "-5*deg <= _q2" "no proof that a range")

expect_difference(planar_3rpr matrix.txt side "value = 17.04" "value = 17.05" "no proof that")
expect_difference(planar_3rpr matrix.txt sign "- r2_y*(x - a2_1)" "+ r2_y*(x - a2_1)" "no proof that an entry of the certificate")
expect_difference(planar_3rpr matrix.txt part "\"side_12*c\"" "\"side_12*s\"" "no proof that")
expect_difference(planar_3rpr matrix.txt larger "x = [-2, 4]\ny = [13, 18]\nphi = [\"-15*deg\", \"5*deg\"]\n\n[motion.crossing]"
                    "x = [-2, 5]\ny = [13, 18]\nphi = [\"-15*deg\", \"5*deg\"]\n\n[motion.crossing]"
                    "no proof that a range of the model file")

# Another entry of the certificate: its claim is true, and not about this model.
file(READ ${WORK_DIR}/matrix.txt text)
string(REPLACE "entry x - a1_1\n" "entry x - a1_1 + 1\n" other "${text}")
file(WRITE ${WORK_DIR}/entry.txt "${other}")
execute_process(COMMAND ${VERIFY} --coq ${WORK_DIR}/entry.v --model ${models}/planar_3rpr.toml entry.txt
                WORKING_DIRECTORY ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
expect_answer(REJECTED 1 ${WORK_DIR} --audit entry.v)
if(NOT why MATCHES "no proof that an entry of the certificate is that of the model file")
  message(FATAL_ERROR "Another entry\n${why}")
endif()

# A pose of the motion is singular, and none of a smaller range.
file(READ ${models}/robot_1.toml robot)
string(REPLACE "psi = [\"-40*deg\", \"40*deg\"]" "psi = [\"-1*deg\", \"1*deg\"]" other "${robot}")
file(WRITE ${WORK_DIR}/regular.toml "${other}")
execute_process(COMMAND ${VERIFY} --coq ${WORK_DIR}/regular.v --model ${WORK_DIR}/regular.toml singular.txt
                WORKING_DIRECTORY ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
expect_answer(REJECTED 1 ${WORK_DIR} --audit regular.v)
if(NOT why MATCHES "no proof that a range of the certificate is in that of the model file")
  message(FATAL_ERROR "A singular pose beyond the range\n${why}")
endif()

# A motion in a smaller range follows.
string(REPLACE "[motion.wide_15]  # §V-C1a\nx = [-15, 15]" "[motion.wide_15]\nx = [-15, 14]" smaller "${robot}")
file(WRITE ${WORK_DIR}/smaller.toml "${smaller}")
execute_process(COMMAND ${VERIFY} --coq ${WORK_DIR}/smaller.v --model ${WORK_DIR}/smaller.toml wide.txt
                WORKING_DIRECTORY ${WORK_DIR} COMMAND_ERROR_IS_FATAL ANY)
expect_answer(PROVED 0 ${WORK_DIR} --audit smaller.v)

expect_difference(hunt_3rps hinges.txt hinge "hinge = [0, 1, 0]" "hinge = [0, 1, 1]" "no proof that")

# ---- What has no such theorem says why.
file(READ ${own}/stage.toml text)
string(REPLACE "range = [80, 220]" "actuated = 1" text "${text}")
file(WRITE ${WORK_DIR}/none.toml "${text}")
write_certificate(none ${WORK_DIR}/none.toml work)
execute_process(COMMAND ${VERIFY} --coq none.v --model none.toml none.txt
                WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code ERROR_VARIABLE why)
if(NOT code EQUAL 2 OR NOT why MATCHES "a motor in joint 1 of a leg RPR" OR EXISTS ${WORK_DIR}/none.v)
  message(FATAL_ERROR "A motor in another joint: exit ${code}\n${why}")
endif()
expect_answer(PROVED 0 ${WORK_DIR} --theorem --model none.toml none.txt)
if(NOT why MATCHES "geometry   there is no theorem")
  message(FATAL_ERROR "A motor in another joint\n${why}")
endif()

# ---- regulus-formal proves the claim, and leaves the last theorem as it is.
execute_process(COMMAND ${FORMAL} --hints ${WORK_DIR}/hinted.v wide.txt.v WORKING_DIRECTORY ${WORK_DIR}
                RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE why)
if(NOT code EQUAL 0 OR NOT text STREQUAL "PROVED the_claim; the theorem about the robot is for coqc\n")
  message(FATAL_ERROR "regulus-formal: ${text}\n${why}")
endif()
expect_answer(PROVED 0 ${WORK_DIR} --audit hinted.v)

execute_process(COMMAND ${FORMAL} matrix.txt.v WORKING_DIRECTORY ${WORK_DIR}
                RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE why)
if(NOT code EQUAL 0 OR NOT text STREQUAL "PROVED the_claim; the theorem about the robot is for coqc\n")
  message(FATAL_ERROR "regulus-formal: ${text}\n${why}")
endif()

# ---- Files that look like a theorem about a robot. coqc alone accepts them.
file(READ ${WORK_DIR}/wide.txt.v text)
string(FIND "${text}" "\nDefinition legs" at)
string(SUBSTRING "${text}" 0 ${at} before)
string(SUBSTRING "${text}" ${at} -1 after)
string(REGEX REPLACE "\n  intros x[^S]*S\\.\n[^.]*\\.\nQed\\." "\n  intros. exact (fun _ _ _ _ => I).\nQed." trivial "${after}")
set(definition "\nDefinition full_column_rank (m n : nat) (a : nat -> nat -> R) :=\n  nat -> nat -> nat -> nat -> True.\n")
expect_only_coqc_accepts(rank.v "${before}${definition}${trivial}")
string(REPLACE "Theorem the_robot" "Definition gough (l : list leg) (p : point) (t : point -> point) : nat -> nat -> R :=\n\
  matrix_of (map (row_of_leg (0, 0, 50) (euler_zxz 0 0 0)) l).\n\nTheorem the_robot" other "${after}")
string(REPLACE "by_geometry the_claim\n    [x; y; z; psi; theta; phi]" "by_geometry the_claim\n    [0; 0; 50; 0; 0; 0]" other "${other}")
string(REPLACE "  by_geometry" "  clear S; assert (S : the_set 0 0 50 0 0 0) by by_point.\n  by_geometry" other "${other}")
expect_only_coqc_accepts(robot.v "${before}${other}")
string(REPLACE "Theorem the_robot" "Notation \"x <= y <= z\" := (x = y /\\ y = x) : R_scope.\nTheorem the_robot" other "${after}")
expect_only_coqc_accepts(notation.v "${before}${other}")
string(REPLACE "Qed.\n\nTheorem the_set" "Admitted.\n\nTheorem the_set" other "${after}")
expect_only_coqc_accepts(admitted.v "${before}${other}")
string(REPLACE "\nFrom Regulus Require Import Geometry" "\nDefinition _more := Name 0.\nFrom Regulus Require Import Geometry" other "${text}")
expect_only_coqc_accepts(more.v "${other}")

# A matrix that is not that of the statement.
file(READ ${WORK_DIR}/matrix.txt.v text)
string(FIND "${text}" "\n(** The matrix of the model file" at)
string(SUBSTRING "${text}" 0 ${at} before)
string(SUBSTRING "${text}" ${at} -1 after)
string(REGEX REPLACE "\n  intros _x[^S]*S\\.\n.*\nQed\\.\n\nTheorem the_set_is" "\n  intros. exact (fun _ _ _ _ => I).\nQed.\n\nTheorem the_set_is" trivial "${after}")
expect_only_coqc_accepts(matrix_rank.v "${before}${definition}${trivial}")
string(REPLACE "Qed.\n\nTheorem the_set" "Admitted.\n\nTheorem the_set" other "${after}")
expect_only_coqc_accepts(matrix_admitted.v "${before}${other}")
