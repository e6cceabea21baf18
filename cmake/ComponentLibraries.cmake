# SPDX-License-Identifier: Apache-2.0
# The libraries that other programs link, one for each component of the package: the layers' objects
# in one archive. Here and in the package they are
#
#   Regulus::runtime   checks boxes with compiled kernels; the C++ library alone
#   Regulus::search    runs whole searches, by several threads; oneTBB
#   Regulus::codegen   model files, symbolic forms, C++ text; GiNaC, CLN, FLINT, toml++, tinyxml2, fmt
#   Regulus::jit       compiles and checks in process; LLVM is opened only for a compilation
#   Regulus::regulus   the command

# regulus_component(NAME LAYERS...): the library regulus-NAME of these layers.
function(regulus_component name)
  list(TRANSFORM ARGN REPLACE "(.+)" "$<TARGET_OBJECTS:regulus_\\1>" OUTPUT_VARIABLE objects)
  add_library(regulus_component_${name} STATIC ${objects})
  add_library(Regulus::${name} ALIAS regulus_component_${name})
  set_target_properties(regulus_component_${name} PROPERTIES
    OUTPUT_NAME regulus-${name} EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_include_directories(regulus_component_${name} INTERFACE
    "$<BUILD_INTERFACE:${REGULUS_INCLUDE_DIRECTORIES}>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR};${CMAKE_INSTALL_INCLUDEDIR}/regulus>")
endfunction()

regulus_component(runtime files interval kernel machine regularity problem evaluation witness decider embedded)
target_compile_features(regulus_component_runtime INTERFACE cxx_std_20)
# The headers contain interval arithmetic that is compiled in the user's code.
target_compile_options(regulus_component_runtime INTERFACE
  "$<$<COMPILE_LANGUAGE:CXX>:${REGULUS_FLOATING_POINT_FLAGS}>")

if(REGULUS_SEARCH)
  regulus_component(search cluster search checkpoint certificate)
  target_link_libraries(regulus_component_search INTERFACE Regulus::runtime TBB::tbb)
endif()

if(REGULUS_CODEGEN)
  regulus_component(codegen support model robot program symbolic columns formulation pack cpp)
  target_link_libraries(regulus_component_codegen INTERFACE
    Regulus::runtime regulus_tomlplusplus regulus_ginac regulus_cln regulus_arb fmt::fmt)

  regulus_component(jit object_loader kernel_compilation jit verifier engine analysis proof report margin
                    quantity bound trajectory import api)
  target_link_libraries(regulus_component_jit INTERFACE
    Regulus::codegen Regulus::search regulus_tinyxml2 ${CMAKE_DL_LIBS})

  add_executable(Regulus::regulus ALIAS regulus)
endif()
