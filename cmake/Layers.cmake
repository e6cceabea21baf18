# SPDX-License-Identifier: Apache-2.0
# Headers are included by their paths in the repository: "runtime/interval/interval.hpp". They are
# installed with the same paths below include/regulus. Configured headers are in the build folder:
# "regulus/version.hpp".
set(REGULUS_CONFIGURED_HEADERS ${PROJECT_BINARY_DIR}/include)
set(REGULUS_INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR} ${REGULUS_CONFIGURED_HEADERS})

# regulus_layer(NAME SOURCES... ): a static library regulus_NAME.
function(regulus_layer name)
  add_library(regulus_${name} STATIC ${ARGN})
  target_include_directories(regulus_${name} PUBLIC "$<BUILD_INTERFACE:${REGULUS_INCLUDE_DIRECTORIES}>")
endfunction()
