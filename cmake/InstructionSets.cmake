# SPDX-License-Identifier: Apache-2.0
# The one list of flags that choose an instruction set. Kernels compiled ahead of time get it from
# here; kernels compiled in process get it from the generated header instruction_set_flags.hpp.
#
#   -mprefer-vector-width=512  Clang up to 19 crashes on 8-wide strict arithmetic without it
#   -fno-math-errno            a square root is the instruction, never a call of libm
set(REGULUS_ISA_NAMES avx512 avx2 portable)
set(REGULUS_ISA_FLAGS_avx512 -DREGULUS_ISA_AVX512 -mavx512f -mavx512dq -mprefer-vector-width=512)
set(REGULUS_ISA_FLAGS_avx2 -DREGULUS_ISA_AVX2 -mavx2 -mfma)
set(REGULUS_ISA_FLAGS_portable -DREGULUS_ISA_PORTABLE -fno-math-errno)

# Those the target processor family has at all.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64")
  set(REGULUS_ISA_BUILT avx512 avx2 portable)
else()
  set(REGULUS_ISA_BUILT portable)
endif()
