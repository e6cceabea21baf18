# SPDX-License-Identifier: Apache-2.0
# The libraries that other programs link, one for each component of the package: the layers' objects
# in one archive. Here and in the package they are
#
#   Regulus::runtime   checks boxes with compiled kernels; the C++ library alone
#   Regulus::search    runs whole searches, by several threads; oneTBB
#   Regulus::codegen   model files, symbolic forms, C++ text; GiNaC, CLN, FLINT, toml++, tinyxml2, fmt
#   Regulus::jit       compiles and checks in process; LLVM is opened only for a compilation
#   Regulus::regulus   the command

# regulus_layers_below(RESULT LAYERS...): these layers, and all that they are linked with.
function(regulus_layers_below result)
  list(TRANSFORM ARGN PREPEND regulus_ OUTPUT_VARIABLE waiting)
  set(known "")
  while(waiting)
    list(POP_FRONT waiting target)
    if(target IN_LIST known OR NOT target MATCHES "^regulus_" OR NOT TARGET ${target})
      continue()
    endif()
    get_target_property(type ${target} TYPE)
    if(NOT type STREQUAL "STATIC_LIBRARY") # a library of others
      continue()
    endif()
    list(APPEND known ${target})
    get_target_property(linked ${target} LINK_LIBRARIES)
    if(linked)
      list(APPEND waiting ${linked})
    endif()
  endwhile()
  set(${result} ${known} PARENT_SCOPE)
endfunction()

# regulus_component(NAME LAYERS... [BESIDE COMPONENTS...]): the library regulus-NAME of these layers
# and of all that they need, but for what the other components have.
function(regulus_component name)
  cmake_parse_arguments(PARSE_ARGV 1 asked "" "" BESIDE)
  regulus_layers_below(layers ${asked_UNPARSED_ARGUMENTS})
  foreach(other IN LISTS asked_BESIDE)
    get_target_property(others regulus_component_${other} REGULUS_LAYERS)
    list(REMOVE_ITEM layers ${others})
  endforeach()
  list(TRANSFORM layers REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
  add_library(regulus_component_${name} STATIC ${objects})
  add_library(Regulus::${name} ALIAS regulus_component_${name})
  set_target_properties(regulus_component_${name} PROPERTIES
    OUTPUT_NAME regulus-${name} EXPORT_NAME ${name} LINKER_LANGUAGE CXX REGULUS_LAYERS "${layers}")
  target_include_directories(regulus_component_${name} INTERFACE
    "$<BUILD_INTERFACE:${REGULUS_INCLUDE_DIRECTORIES}>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR};${CMAKE_INSTALL_INCLUDEDIR}/regulus>")
endfunction()

# Search and codegen both need files, codegen and jit both need machine.
regulus_component(runtime embedded files machine)
target_compile_features(regulus_component_runtime INTERFACE cxx_std_20)
# The headers contain interval arithmetic that is compiled in the user's code.
target_compile_options(regulus_component_runtime INTERFACE
  "$<$<COMPILE_LANGUAGE:CXX>:${REGULUS_FLOATING_POINT_FLAGS}>")

if(REGULUS_SEARCH)
  regulus_component(search search checkpoint certificate BESIDE runtime)
  target_link_libraries(regulus_component_search INTERFACE Regulus::runtime TBB::tbb)
endif()

if(REGULUS_CODEGEN)
  regulus_component(codegen robot cpp BESIDE runtime)
  target_link_libraries(regulus_component_codegen INTERFACE
    Regulus::runtime regulus_tomlplusplus regulus_ginac regulus_cln regulus_arb fmt::fmt)

  regulus_component(jit api BESIDE runtime search codegen)
  target_link_libraries(regulus_component_jit INTERFACE
    Regulus::codegen Regulus::search regulus_tinyxml2 ${CMAKE_DL_LIBS})

  add_executable(Regulus::regulus ALIAS regulus)
endif()
