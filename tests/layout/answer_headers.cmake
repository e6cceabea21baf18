# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -DBINARY_DIR=… -DCOMPILER=… -P answer_headers.cmake
# Who asks a question sees no algebra and no compiler: no header of codegen/answer brings in GiNaC, CLN,
# LLVM or the formats of object files.
cmake_minimum_required(VERSION 3.25)
file(GLOB headers RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/codegen/answer/*.hpp)
set(includes "")
foreach(header IN LISTS headers)
  string(APPEND includes "#include \"${header}\"\n")
endforeach()
set(probe ${BINARY_DIR}/answer_headers.cpp)
file(WRITE ${probe} "${includes}")
execute_process(COMMAND ${COMPILER} -std=c++20 -I${SOURCE_DIR} -I${BINARY_DIR}/include -M ${probe}
                OUTPUT_VARIABLE seen ERROR_VARIABLE errors RESULT_VARIABLE result)
if(result)
  message(FATAL_ERROR "The headers of codegen/answer do not compile alone:\n${errors}")
endif()
string(REGEX MATCHALL "[^ \n]*(/ginac/|/cln/|/llvm|/clang-c/|/elf\\.h)[^ \n]*" foreign "${seen}")
if(foreign)
  message(FATAL_ERROR "The headers of codegen/answer bring in: ${foreign}")
endif()
