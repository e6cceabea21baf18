# SPDX-License-Identifier: Apache-2.0
# The target regulus_arb, if the library is there: the verifier of certificates needs it, and the
# front end. Arb became part of FLINT with FLINT 3; before, it is a library of its own (named
# flint-arb on Debian).
find_path(ARB_INCLUDE_DIR arb.h PATH_SUFFIXES flint)
find_path(FLINT_INCLUDE_DIR fmpq.h PATH_SUFFIXES flint)
find_library(FLINT_LIBRARY flint)
find_library(ARB_LIBRARY NAMES flint-arb arb)
find_library(GMP_LIBRARY gmp) # which FLINT's inline functions call, and its package depends on
if(NOT TARGET regulus_arb AND ARB_INCLUDE_DIR AND FLINT_INCLUDE_DIR AND FLINT_LIBRARY AND GMP_LIBRARY)
  add_library(regulus_arb INTERFACE IMPORTED GLOBAL)
  target_include_directories(regulus_arb SYSTEM INTERFACE ${ARB_INCLUDE_DIR} ${FLINT_INCLUDE_DIR})
  if(ARB_LIBRARY)
    target_link_libraries(regulus_arb INTERFACE ${ARB_LIBRARY})
  endif()
  target_link_libraries(regulus_arb INTERFACE ${FLINT_LIBRARY} ${GMP_LIBRARY})
endif()
