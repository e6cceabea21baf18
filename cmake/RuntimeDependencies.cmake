# SPDX-License-Identifier: Apache-2.0
# Finds the dependencies of the runtime, and names the Debian package of a missing one.
macro(regulus_missing what package)
  message(FATAL_ERROR "${what} was not found. On Debian: apt-get install ${package}. "
                      "(`make dependencies` installs everything in cmake/packages-debian.txt.)")
endmacro()

if(REGULUS_SEARCH)
  include(cmake/Arb.cmake)
  find_package(TBB QUIET) # threads of a search
  if(NOT TARGET TBB::tbb)
    regulus_missing(oneTBB libtbb-dev)
  endif()
endif()
