# SPDX-License-Identifier: GPL-3.0-or-later
# regulus-verify --theorem lets Coq prove a claim; --audit says whether a file of any origin is what it
# looks like, also where coqc alone would accept it.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(model ${SOURCE_DIR}/models/planar_3rpr.toml)
foreach(motion IN ITEMS regular crossing)
  execute_process(COMMAND ${REGULUS} check ${model} ${motion} --certificate ${WORK_DIR}/${motion}.txt --quiet
                  OUTPUT_QUIET)
  expect_answer(PROVED 0 ${WORK_DIR} --theorem --model ${model} ${motion}.txt)
  expect_answer(PROVED 0 ${WORK_DIR} --audit ${motion}.txt.v)
endforeach()
expect_answer(REJECTED 1 ${WORK_DIR} --theorem --model ${SOURCE_DIR}/models/delta.toml regular.txt)
expect_answer(REJECTED 1 ${WORK_DIR} --theorem ${SOURCE_DIR}/README.md)
expect_answer(UNFINISHED 2 ${WORK_DIR} --theorem --time-limit 0.01 regular.txt)
execute_process(COMMAND ${FORMAL} --quiet --hints ${WORK_DIR}/hinted.v ${WORK_DIR}/regular.txt.v OUTPUT_QUIET)
expect_answer(PROVED 0 ${WORK_DIR} --audit hinted.v)

# A claim that is false, in a plain file.
file(READ ${WORK_DIR}/crossing.txt.v crossing)
string(REGEX REPLACE "\n\\(\\*\\* Two points.*" "" question "${crossing}")
set(claim "Theorem the_claim : no_singularity the_question.")
set(proof "Proof.\n  apply (check_correct the_question the_method).\n  vm_cast_no_check (eq_refl true).\nQed.\n")
set(false "Definition the_method : method := Method 3 2.\n\n${claim}\n")
file(WRITE ${WORK_DIR}/false.v "${question}\n${false}${proof}")
expect_answer(REJECTED 1 ${WORK_DIR} --audit false.v)

# The same claim in files that coqc alone accepts.
function(expect_deception name more)
  expect_only_coqc_accepts(${name}.v "${question}\n${more}")
endfunction()
expect_deception(notation "Notation no_singularity := (fun _ => True).\n\
Definition check_correct (q : question) (m : method) (_ : true = true) : True := I.\n${false}${proof}")
expect_deception(admitted "${false}Proof.\nAdmitted.\n")
expect_deception(axiom "Axiom check_correct : forall q (m : method), true = true -> no_singularity q.\n${false}${proof}")
expect_deception(minus "Infix \"-\" := Add : expression_scope.\n${false}Proof.\nAdmitted.\n")
expect_deception(module "Module Deceived.\nDefinition no_singularity (_ : question) := True.\n\
Definition check_correct (q : question) (m : method) (_ : true = true) : True := I.\nEnd Deceived.\n\
Import Deceived.\n${false}${proof}")

# Libraries with our names, in the current folder and where the environment tells Coq to look.
set(hostile ${WORK_DIR}/hostile)
file(MAKE_DIRECTORY ${hostile}/coq ${hostile}/Regulus)
foreach(file IN ITEMS Questions Regulus/Questions)
  file(WRITE ${hostile}/${file}.v "Definition no_singularity {q : Type} (_ : q) := True.\n")
  execute_process(COMMAND ${COQC} -R . Regulus ${file}.v WORKING_DIRECTORY ${hostile} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(COPY ${hostile}/Regulus DESTINATION ${hostile}/coq)
foreach(variable IN ITEMS COQPATH ROCQPATH XDG_DATA_HOME XDG_DATA_DIRS)
  set(ENV{${variable}} ${hostile})
endforeach()
file(WRITE ${hostile}/coqrc "Fail Fail Check nat.\n")
set(ENV{XDG_CONFIG_HOME} ${hostile})
expect_answer(PROVED 0 ${hostile} --audit ${WORK_DIR}/regular.txt.v)
expect_answer(REJECTED 1 ${hostile} --audit ${WORK_DIR}/false.v)
