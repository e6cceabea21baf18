# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -DCLANG_FORMAT=… -P format.cmake
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE sources ${SOURCE_DIR}/runtime/*.[ch]pp ${SOURCE_DIR}/codegen/*.[ch]pp ${SOURCE_DIR}/tests/*.[ch]pp)
execute_process(COMMAND ${CLANG_FORMAT} --dry-run --Werror ${sources} RESULT_VARIABLE failed ERROR_VARIABLE diagnostics)
if(failed)
  string(SUBSTRING "${diagnostics}" 0 4000 diagnostics)
  message(FATAL_ERROR "Not formatted (`make format` does it):\n${diagnostics}")
endif()
