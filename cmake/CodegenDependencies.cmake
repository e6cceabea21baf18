# SPDX-License-Identifier: Apache-2.0
# Dependencies of programs that link the front end: those of this build, and those of users of the
# package.
regulus_pkg(regulus_ginac ginac libginac-dev)
regulus_pkg(regulus_cln cln libcln-dev)
regulus_pkg(regulus_tomlplusplus tomlplusplus libtomlplusplus-dev)
regulus_pkg(regulus_tinyxml2 tinyxml2 libtinyxml2-dev)

find_package(fmt QUIET)
if(NOT fmt_FOUND)
  regulus_missing(fmt libfmt-dev)
endif()

include(${CMAKE_CURRENT_LIST_DIR}/Arb.cmake)
if(NOT TARGET regulus_arb)
  regulus_missing("Arb (arb.h) or FLINT" "libflint-arb-dev libflint-dev")
endif()
