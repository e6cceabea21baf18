# SPDX-License-Identifier: GPL-3.0-or-later
# Kernels do not get in each other's way, in a program or in a build.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
take(two_kernels)
file(COPY_FILE ${folder}/arm.toml ${folder}/other.toml)
file(COPY ${SOURCE_DIR}/tests/consumer/plain_c/guard.c DESTINATION ${folder})
run(ignored ${CONFIGURE} -DCMAKE_BUILD_TYPE=Debug) # nothing rests on optimisation
run(ignored ${BUILD})
run(output build/both)
if(NOT output STREQUAL "0 failures, portable\n")
  fail("${output}")
endif()
run(output build/guard)
if(NOT output STREQUAL "go\n")
  fail("${output}")
endif()

file(TIMESTAMP ${folder}/build/arm.kernel/arm.h made "%s")
run(ignored ${CMAKE_COMMAND} -E sleep 1)
file(APPEND ${folder}/other.toml "# changed\n")
run(ignored ${BUILD} --target other_kernel)
file(TIMESTAMP ${folder}/build/arm.kernel/arm.h now "%s")
file(TIMESTAMP ${folder}/build/other_kernel.kernel/other.h other "%s")
if(NOT now STREQUAL made OR other STREQUAL made)
  fail("a changed model rebuilds its kernel and no other: ${made}, ${now}, ${other}")
endif()

# A mistake in the call is said at once.
function(expect_refusal message)
  string(JOIN " " arguments ${ARGN})
  file(WRITE ${WORK_DIR}/refused/CMakeLists.txt
       "cmake_minimum_required(VERSION 3.25)\nproject(refused LANGUAGES CXX)\n"
       "find_package(Regulus REQUIRED)\nregulus_add_kernel(${arguments})\n")
  file(COPY ${folder}/arm.toml DESTINATION ${WORK_DIR}/refused)
  set(folder ${WORK_DIR}/refused)
  expect_failure("${message}" ${CONFIGURE})
endfunction()
expect_refusal("MODEL is missing" arm MOTION crossing)
expect_refusal("there is no model file" arm MODEL leg.toml)
expect_refusal("expected some of: avx512" arm MODEL arm.toml ISA avx1024)
expect_refusal("found 'MOTOIN;crossing'" arm MODEL arm.toml MOTOIN crossing)

# find_package says what it cannot give.
file(WRITE ${WORK_DIR}/refused/CMakeLists.txt
     "cmake_minimum_required(VERSION 3.25)\nproject(refused LANGUAGES CXX)\n"
     "find_package(Regulus 0.1 REQUIRED COMPONENTS runtime solver)\n")
set(folder ${WORK_DIR}/refused)
expect_failure("component solver: there is no such component" ${CONFIGURE})
