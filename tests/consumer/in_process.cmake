# SPDX-License-Identifier: GPL-3.0-or-later
# A program that reads the model and compiles its kernel itself. It is not installed
# beside the compiler plugins, and finds them.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
take(in_process)
expect_on_page(${folder}/CMakeLists.txt)
expect_on_page(${folder}/workshop.cpp)
set(ENV{XDG_CACHE_HOME} ${folder}/empty-cache)
run(ignored ${CONFIGURE})
run(ignored ${BUILD})
run(output build/workshop)
expect_text_on_page("$ build/workshop\n${output}" "what workshop prints")
