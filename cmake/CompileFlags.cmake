# SPDX-License-Identifier: Apache-2.0
# Applies the lists of FloatingPoint.cmake and InstructionSets.cmake: options for all code of this
# build, and headers for code that is compiled in process.
include(${CMAKE_CURRENT_LIST_DIR}/FloatingPoint.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/InstructionSets.cmake)

regulus_refuse_unsound_flags("${CMAKE_CXX_FLAGS}" "${CMAKE_CXX_FLAGS_RELEASE}" "${CMAKE_CXX_FLAGS_DEBUG}"
                             "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}" "$ENV{CXXFLAGS}")
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:${REGULUS_FLOATING_POINT_FLAGS}>")

list(JOIN REGULUS_FLOATING_POINT_FLAGS "\", \"" REGULUS_FLOATING_POINT_FLAGS_CXX)
configure_file(${CMAKE_CURRENT_LIST_DIR}/floating_point_flags.hpp.in
               ${PROJECT_BINARY_DIR}/include/regulus/floating_point_flags.hpp @ONLY)
foreach(isa IN LISTS REGULUS_ISA_NAMES)
  list(JOIN REGULUS_ISA_FLAGS_${isa} "\", \"" REGULUS_ISA_FLAGS_CXX_${isa})
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/instruction_set_flags.hpp.in
               ${PROJECT_BINARY_DIR}/include/regulus/instruction_set_flags.hpp @ONLY)

# regulus_compile_quickly(TARGET): -O1 in a release, for code that takes little time. All other
# flags, those of rounding included, stay the same; no result depends on it.
function(regulus_compile_quickly target)
  target_compile_options(${target} PRIVATE "$<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:Release,RelWithDebInfo>>:-O1>")
endfunction()
