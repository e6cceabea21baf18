# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed is complete in itself: it is moved, and knows neither this build nor where it was
# installed first.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR}/moved)
set(folder ${WORK_DIR})
run(ignored ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/staged)
file(RENAME ${WORK_DIR}/staged ${PREFIX})

file(GLOB_RECURSE files LIST_DIRECTORIES false ${PREFIX}/*)
list(LENGTH files count)
if(count LESS 100)
  fail("only ${count} files were installed")
endif()
# A compiler cache may have made the names of folders relative.
foreach(file IN LISTS files)
  if(IS_SYMLINK ${file})
    fail("${file} is a link")
  endif()
  file(STRINGS ${file} lines REGEX "${BUILD_DIR}|${WORK_DIR}|${SOURCE_DIR}/|(^|[^/])[.][.]/(codegen|runtime)/[a-z_/]*[.]cpp")
  if(lines)
    fail("${file} names a folder of this build:\n" "${lines}")
  endif()
endforeach()

# The manual lies in one folder, with single pages elsewhere; links lead to what is installed.
set(manual ${PREFIX}/share/doc/regulus/manual)
file(GLOB pages ${manual}/*.md ${manual}/*.html ${PREFIX}/share/doc/*/*.md)
list(LENGTH pages count)
if(count LESS 18)
  fail("only ${count} pages of the manual were installed")
endif()
foreach(page IN LISTS pages)
  get_filename_component(folder_of_page ${page} DIRECTORY)
  file(STRINGS ${page} lines REGEX "[.](md|html|svg|webp)[)\"#]")
  string(REPLACE "](" "@(" lines "${lines}") # a bracket would join elements of the list
  string(REGEX MATCHALL "(@\\(|href=\"|src=\")[^])\":#]*[.](md|html|svg|webp)" links "${lines}")
  foreach(link IN LISTS links)
    string(REGEX REPLACE "^(.\\(|href=\"|src=\")" "" link "${link}")
    if(NOT EXISTS ${folder_of_page}/${link})
      fail("${page} refers to ${link}, which is not installed")
    endif()
  endforeach()
endforeach()

# The headers that are installed are those of the interfaces and what they include; they are enough.
include(${SOURCE_DIR}/cmake/PublicHeaders.cmake)
regulus_with_includes(expected ${SOURCE_DIR} ${REGULUS_RUNTIME_HEADERS} ${REGULUS_SEARCH_HEADERS}
                      ${REGULUS_DEVELOPMENT_HEADERS})
list(APPEND expected regulus.hpp filter.h version.hpp floating_point_flags.hpp instruction_set_flags.hpp)
file(GLOB_RECURSE headers LIST_DIRECTORIES false RELATIVE ${PREFIX}/include/regulus ${PREFIX}/include/*)
list(SORT expected)
list(SORT headers)
if(NOT headers STREQUAL expected)
  fail("installed are the headers\n${headers}\nexpected\n${expected}")
endif()
set(source "#include <regulus/regulus.hpp>\n")
list(FILTER headers EXCLUDE REGEX "self_test_program.hpp|kernel/pack|kernel/simd.hpp|plugin_folder.h") # not for users to include
foreach(header IN LISTS headers)
  string(APPEND source "#include <regulus/${header}>\n")
endforeach()
file(WRITE ${WORK_DIR}/everything.cpp "${source}int main() {}\n")
run(ignored ${CXX_COMPILER} -std=c++20 -Wall -Wextra -Werror -frounding-math -fsyntax-only
    -I${PREFIX}/include -I${PREFIX}/include/regulus everything.cpp)

# Of what a kernel needs nothing refers to the symbolic front end, the compiler or TBB.
run(symbols nm --undefined-only --demangle ${PREFIX}/lib/libregulus-runtime.a)
string(REGEX MATCHALL "[^\n]*(GiNaC|cln::|llvm|tbb::|fmpq_|arb_)[^\n]*" foreign "${symbols}")
if(foreign)
  fail("libregulus-runtime.a needs more than the C++ library:\n" "${foreign}")
endif()

# Whatever of ours an object in the libraries needs, one of the libraries has.
file(GLOB libraries ${PREFIX}/lib/libregulus-*.a)
run(symbols nm --undefined-only --no-demangle ${libraries})
string(REGEX MATCHALL "_Z[A-Za-z0-9_]*7regulus[A-Za-z0-9_.]*" missing "${symbols}")
run(symbols nm --defined-only --no-demangle ${libraries})
string(REGEX MATCHALL "_Z[A-Za-z0-9_]*7regulus[A-Za-z0-9_.]*" there "${symbols}")
list(REMOVE_DUPLICATES missing)
list(REMOVE_ITEM missing ${there})
if(missing)
  fail("the libraries do not define what they use:\n" "${missing}")
endif()

# The command finds its compiler where it is now.
set(ENV{XDG_CACHE_HOME} ${WORK_DIR}/cache)
run(verdict ${PREFIX}/bin/regulus check ${PREFIX}/share/regulus/models/planar_3rpr.toml regular
    --engine jit --no-cache)
if(NOT verdict STREQUAL "NO SINGULARITY\n")
  fail("the moved command said: ${verdict}")
endif()
