# SPDX-License-Identifier: Apache-2.0
# Headers are included by the path they are installed under: regulus/interval/interval.hpp is
# runtime/interval/interval.hpp, regulus/codegen/model/model.hpp is codegen/model/model.hpp.
set(REGULUS_INCLUDE_TREE ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${REGULUS_INCLUDE_TREE}/regulus)
foreach(layer IN ITEMS interval kernel machine regularity search embedded checkpoint certificate)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/runtime/${layer} ${REGULUS_INCLUDE_TREE}/regulus/${layer} SYMBOLIC)
endforeach()
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/codegen ${REGULUS_INCLUDE_TREE}/regulus/codegen SYMBOLIC)

# regulus_layer(NAME SOURCES... ): a static library regulus_NAME whose includes start at the tree.
function(regulus_layer name)
  add_library(regulus_${name} STATIC ${ARGN})
  target_include_directories(regulus_${name} PUBLIC $<BUILD_INTERFACE:${REGULUS_INCLUDE_TREE}>)
endfunction()
