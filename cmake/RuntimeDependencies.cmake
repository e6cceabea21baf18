# SPDX-License-Identifier: Apache-2.0
# Finds what the runtime needs and names the Debian package of what is missing.
include(cmake/Arb.cmake)

macro(regulus_missing what package)
  message(FATAL_ERROR "${what} was not found. On Debian: apt-get install ${package}. "
                      "(`make dependencies` installs everything in cmake/packages-debian.txt.)")
endmacro()

# Threads of a search.
find_package(TBB QUIET)
if(NOT TARGET TBB::tbb)
  regulus_missing(oneTBB libtbb-dev)
endif()
