# SPDX-License-Identifier: Apache-2.0
# The only list of flags that choose an instruction set. Kernels compiled ahead of time get it from
# here; kernels compiled in process get it from the generated header instruction_set_flags.hpp.
#
#   -mprefer-vector-width=512  Clang up to 19 crashes on 8-wide strict arithmetic without it
#   -fno-math-errno            a square root is the instruction, never a call of libm
set(REGULUS_ISA_NAMES avx512 avx2 portable)
set(REGULUS_ISA_FLAGS_avx512 -DREGULUS_ISA_AVX512 -mavx512f -mavx512dq -mprefer-vector-width=512)
set(REGULUS_ISA_FLAGS_avx2 -DREGULUS_ISA_AVX2 -mavx2 -mfma)
set(REGULUS_ISA_FLAGS_portable -DREGULUS_ISA_PORTABLE -fno-math-errno)

# The instruction sets of the target processor family.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64")
  set(REGULUS_ISA_BUILT avx512 avx2 portable)
else()
  set(REGULUS_ISA_BUILT portable)
endif()

# Compiles each file named …_ISA.cpp in a list for that instruction set, and removes from the list
# those that the processor family does not have. WITHOUT: flags that are left out. Only
# FloatingPoint.cmake decides how the code rounds.
function(regulus_compile_for_isas regulus_list)
  cmake_parse_arguments(PARSE_ARGV 1 regulus "" "" "WITHOUT")
  set(regulus_kept ${${regulus_list}})
  foreach(isa IN LISTS REGULUS_ISA_NAMES)
    set(files ${regulus_kept})
    list(FILTER files INCLUDE REGEX "_${isa}\\.cpp$")
    if(NOT isa IN_LIST REGULUS_ISA_BUILT)
      list(REMOVE_ITEM regulus_kept ${files})
      continue()
    endif()
    set(flags ${REGULUS_ISA_FLAGS_${isa}})
    list(REMOVE_ITEM flags ${regulus_WITHOUT})
    set_source_files_properties(${files} PROPERTIES COMPILE_OPTIONS "${flags}")
  endforeach()
  set(${regulus_list} ${regulus_kept} PARENT_SCOPE)
endfunction()
