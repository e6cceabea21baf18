# SPDX-License-Identifier: Apache-2.0
# The only list of flags that decide how compiled code rounds. Ahead-of-time code gets it as compile
# options: our code from CompileFlags.cmake, programs with a kernel from the installed package. Code
# compiled in process gets it from the generated header floating_point_flags.hpp. No other file may
# set a floating-point flag.
#
#   -frounding-math    expressions must not be folded or moved as if rounding were to nearest
#   -ffp-contract=off  a*b + c must stay two roundings unless written as fma
set(REGULUS_FLOATING_POINT_FLAGS -frounding-math -ffp-contract=off)

# regulus_refuse_unsound_flags(FLAGS...): a fatal error if one of them breaks directed rounding.
function(regulus_refuse_unsound_flags)
  foreach(flags IN LISTS ARGV)
    if(flags MATCHES "-ffast-math|-Ofast|-funsafe-math-optimizations|-fassociative-math|-ffinite-math-only|-fno-rounding-math|-mfpmath=387")
      message(FATAL_ERROR "The compiler flags '${flags}' break directed rounding: every bound of Regulus "
                          "would be unproved. Remove ${CMAKE_MATCH_0}.")
    endif()
  endforeach()
endfunction()
