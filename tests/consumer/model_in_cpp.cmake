# SPDX-License-Identifier: GPL-3.0-or-later
# A robot in C++ gives the kernel of the model file that says the same, and a mistake in it stops the
# build with a place in C++.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
take(model_in_cpp)
file(COPY ${SOURCE_DIR}/codegen/model/robot/examples/slider.cpp DESTINATION ${folder})
run(ignored ${CONFIGURE} -DCMAKE_BUILD_TYPE=Debug)
run(ignored ${BUILD})
run(output build/guard)
if(NOT output STREQUAL "0 the same kernel\n")
  fail("${output}")
endif()

file(READ ${folder}/slider.cpp model)
string(REPLACE "0.01" "-0.01" wrong "${model}")
file(WRITE ${folder}/slider.cpp "${wrong}")
expect_failure("slider.cpp:[0-9]+: found" ${BUILD} --target slider)
