# SPDX-License-Identifier: Apache-2.0
# Defines the target regulus_arb if the library is found. The verifier of certificates and the front
# end need it. Arb is a part of FLINT from FLINT 3 on; before, it is a separate library (flint-arb
# on Debian).
find_path(ARB_INCLUDE_DIR arb.h PATH_SUFFIXES flint)
find_path(FLINT_INCLUDE_DIR fmpq.h PATH_SUFFIXES flint)
find_library(FLINT_LIBRARY flint)
find_library(ARB_LIBRARY NAMES flint-arb arb)
find_library(GMP_LIBRARY gmp) # FLINT's inline functions call it, and its package depends on it
if(NOT TARGET regulus_arb AND ARB_INCLUDE_DIR AND FLINT_INCLUDE_DIR AND FLINT_LIBRARY AND GMP_LIBRARY)
  add_library(regulus_arb INTERFACE IMPORTED GLOBAL)
  target_include_directories(regulus_arb SYSTEM INTERFACE ${ARB_INCLUDE_DIR} ${FLINT_INCLUDE_DIR})
  if(ARB_LIBRARY)
    target_link_libraries(regulus_arb INTERFACE ${ARB_LIBRARY})
  endif()
  target_link_libraries(regulus_arb INTERFACE ${FLINT_LIBRARY} ${GMP_LIBRARY})
endif()
