# SPDX-License-Identifier: GPL-3.0-or-later
# The same kernel without CMake: the command, pkg-config, a compiler, and a program in C.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
take(plain_c)
expect_on_page(${folder}/guard.c)
expect_on_page(${folder}/build.sh)
find_program(PKG_CONFIG pkg-config REQUIRED)
set(ENV{PKG_CONFIG_PATH} ${PREFIX}/lib/pkgconfig)
set(ENV{PATH} ${PREFIX}/bin:$ENV{PATH})
run(ignored sh -e build.sh)
run(output ./guard)
expect_text_on_page("$ ./guard\n${output}" "what guard.c prints")
