# SPDX-License-Identifier: GPL-3.0-or-later
# The kernel of a robot whose controller has another processor, by the lines of codegen/EMBEDDING.md,
# run in an emulator: the same answers as here.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
take(embedding)
set(folder ${WORK_DIR}/cross)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder})
file(RENAME ${WORK_DIR}/embedding ${folder}/guard)
file(CREATE_LINK ${SOURCE_DIR} ${folder}/regulus SYMBOLIC)
file(WRITE ${folder}/aarch64.cmake "
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CXX_COMPILER_LAUNCHER ${LAUNCHER})
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
")
set(ENV{PATH} "${PREFIX}/bin:$ENV{PATH}")

file(READ ${PAGE} page)
string(REGEX MATCH "```sh\n(options=.*)```\n\nThe self-test" lines "${page}")
if(NOT CMAKE_MATCH_1)
  fail("${PAGE} does not say how to compile for another processor")
endif()
run(ignored sh -ec "${CMAKE_MATCH_1}")
run(output ${EMULATOR} -L /usr/aarch64-linux-gnu build/guard)
expect_text_on_page("$ build/guard\n${output}" "what guard prints on the other processor")
