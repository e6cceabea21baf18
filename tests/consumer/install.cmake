# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed is complete in itself: it is moved, and knows neither this build nor where it was
# installed first.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR}/moved)
set(folder ${WORK_DIR})
run(ignored ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/staged)
file(RENAME ${WORK_DIR}/staged ${PREFIX})

file(GLOB_RECURSE files LIST_DIRECTORIES false ${PREFIX}/*)
list(LENGTH files count)
if(count LESS 200)
  fail("only ${count} files were installed")
endif()
foreach(file IN LISTS files)
  if(IS_SYMLINK ${file})
    fail("${file} is a link")
  endif()
  file(STRINGS ${file} lines REGEX "${BUILD_DIR}|${WORK_DIR}|${SOURCE_DIR}/")
  if(lines)
    fail("${file} names a folder of this build:\n" "${lines}")
  endif()
endforeach()

# Of what a kernel needs nothing refers to the symbolic front end, the compiler or TBB.
run(symbols nm --undefined-only --demangle ${PREFIX}/lib/libregulus-runtime.a)
string(REGEX MATCHALL "[^\n]*(GiNaC|cln::|llvm|tbb::|fmpq_|arb_)[^\n]*" foreign "${symbols}")
if(foreign)
  fail("libregulus-runtime.a needs more than the C++ library:\n" "${foreign}")
endif()

# The command finds its compiler where it is now.
set(ENV{XDG_CACHE_HOME} ${WORK_DIR}/cache)
run(verdict ${PREFIX}/bin/regulus check ${PREFIX}/share/regulus/models/planar_3rpr.toml regular
    --engine jit --no-cache)
if(NOT verdict STREQUAL "NO SINGULARITY\n")
  fail("the moved command said: ${verdict}")
endif()
