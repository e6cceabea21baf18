# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the newest Clang and LLVM libraries, 22 down to 19, and makes two targets from their shared
# libraries: regulus_llvm, and regulus_clang, which has both. Set LLVM_DIR to choose another
# installation. Two programs compile the operations of packs when the project is built: REGULUS_OPT of
# the same LLVM, and REGULUS_CLANGXX of that version or an earlier one, whose bitcode this LLVM reads.
#
# Clang is found beside LLVM by file name. ClangConfig.cmake would import every static library and
# tool of the installation, but only one shared library is linked.
find_package(LLVM CONFIG QUIET
             HINTS /usr/lib/llvm-22/lib/cmake/llvm /usr/lib/llvm-21/lib/cmake/llvm
                   /usr/lib/llvm-20/lib/cmake/llvm /usr/lib/llvm-19/lib/cmake/llvm)
if(NOT LLVM_FOUND OR LLVM_VERSION_MAJOR LESS 19)
  regulus_missing("LLVM 19 or newer" llvm-22-dev)
endif()

find_library(REGULUS_CLANG_LIBRARY
             NAMES clang-cpp libclang-cpp.so.${LLVM_VERSION_MAJOR}.${LLVM_VERSION_MINOR}
             HINTS ${LLVM_LIBRARY_DIRS} NO_DEFAULT_PATH)
find_path(REGULUS_CLANG_INCLUDE_DIR clang/Frontend/CompilerInstance.h HINTS ${LLVM_INCLUDE_DIRS}
          NO_DEFAULT_PATH)
if(NOT REGULUS_CLANG_LIBRARY OR NOT REGULUS_CLANG_INCLUDE_DIR)
  regulus_missing("Clang ${LLVM_VERSION_MAJOR} as a library" libclang-${LLVM_VERSION_MAJOR}-dev)
endif()

find_program(REGULUS_OPT NAMES opt HINTS ${LLVM_TOOLS_BINARY_DIR} NO_DEFAULT_PATH)
if(NOT REGULUS_OPT)
  regulus_missing("opt of LLVM ${LLVM_VERSION_MAJOR}" llvm-${LLVM_VERSION_MAJOR})
endif()
# A validator of find_program: false for a version that writes what this LLVM may not read.
function(regulus_is_readable_clang result program)
  execute_process(COMMAND ${program} --version OUTPUT_VARIABLE version ERROR_QUIET)
  if(NOT version MATCHES "clang version ([0-9]+)" OR CMAKE_MATCH_1 GREATER LLVM_VERSION_MAJOR OR CMAKE_MATCH_1 LESS 14)
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()
find_program(REGULUS_CLANGXX NAMES clang++ clang++-${LLVM_VERSION_MAJOR} HINTS ${LLVM_TOOLS_BINARY_DIR}
             VALIDATOR regulus_is_readable_clang)
if(NOT REGULUS_CLANGXX)
  regulus_missing("clang++ 14 to ${LLVM_VERSION_MAJOR}" clang-${LLVM_VERSION_MAJOR})
endif()

add_library(regulus_llvm INTERFACE IMPORTED)
target_include_directories(regulus_llvm SYSTEM INTERFACE ${LLVM_INCLUDE_DIRS})
target_link_libraries(regulus_llvm INTERFACE LLVM)
add_library(regulus_clang INTERFACE IMPORTED)
target_include_directories(regulus_clang SYSTEM INTERFACE ${REGULUS_CLANG_INCLUDE_DIR})
target_link_libraries(regulus_clang INTERFACE ${REGULUS_CLANG_LIBRARY} regulus_llvm)
message(STATUS "In-process compiler: Clang ${LLVM_PACKAGE_VERSION}")
