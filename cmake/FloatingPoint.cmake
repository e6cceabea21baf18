# SPDX-License-Identifier: Apache-2.0
# The one list of flags that decide how compiled code rounds. Ahead-of-time code gets it from the
# compile options below; code compiled in process gets it from the generated header
# floating_point_flags.hpp. Nothing else may set a floating-point flag.
#
#   -frounding-math    expressions must not be folded or moved as if rounding were to nearest
#   -ffp-contract=off  a*b + c must stay two roundings unless written as fma
set(REGULUS_FLOATING_POINT_FLAGS -frounding-math -ffp-contract=off)

foreach(flags IN ITEMS "${CMAKE_CXX_FLAGS}" "${CMAKE_CXX_FLAGS_RELEASE}" "${CMAKE_CXX_FLAGS_DEBUG}"
                       "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}" "$ENV{CXXFLAGS}")
  if(flags MATCHES "-ffast-math|-Ofast|-funsafe-math-optimizations|-fassociative-math|-ffinite-math-only|-fno-rounding-math|-mfpmath=387")
    message(FATAL_ERROR "The compiler flags '${flags}' break directed rounding: every bound of Regulus "
                        "would be unproved. Remove ${CMAKE_MATCH_0}.")
  endif()
endforeach()

add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:${REGULUS_FLOATING_POINT_FLAGS}>")

list(JOIN REGULUS_FLOATING_POINT_FLAGS "\", \"" REGULUS_FLOATING_POINT_FLAGS_CXX)
configure_file(${CMAKE_CURRENT_LIST_DIR}/floating_point_flags.hpp.in
               ${PROJECT_BINARY_DIR}/include/regulus/floating_point_flags.hpp @ONLY)
