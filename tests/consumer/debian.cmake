# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian packages, installed by dpkg itself in a root that holds nothing else. What they depend on
# is compared with what their programs need, and is this machine's when they run: the root is no
# chroot.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(folder ${WORK_DIR}-debian)
set(root ${folder}/root)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${root}/var/lib/dpkg/info ${root}/var/lib/dpkg/updates)
file(WRITE ${root}/var/lib/dpkg/status "")
run(ignored ${CMAKE_CPACK_COMMAND} --config ${BUILD_DIR}/CPackConfig.cmake -G DEB -B ${folder})
file(GLOB packages ${folder}/*.deb)
list(LENGTH packages count)
set(expected 2)
if(EXISTS ${BUILD_DIR}/bin/regulus-mpi)
  math(EXPR expected "${expected} + 1")
endif()
if(EXISTS ${BUILD_DIR}/python)
  math(EXPR expected "${expected} + 1")
endif()
if(NOT count EQUAL expected)
  fail("expected ${expected} packages, found: ${packages}")
endif()
run(ignored dpkg --root=${root} --log=${folder}/log --force-not-root --force-bad-path --force-depends
    --install ${packages})

# Each names the libraries it was linked with, its version, and its licences.
run(depends dpkg-query --admindir=${root}/var/lib/dpkg -W -f "\${Depends}" regulus)
foreach(library IN ITEMS libginac libtbb libc6 libstdc LLVM|libllvm libclang-cpp)
  if(NOT depends MATCHES "${library}")
    fail("regulus does not depend on ${library}: ${depends}")
  endif()
endforeach()
run(version dpkg-query --admindir=${root}/var/lib/dpkg -W -f "\${Version}" regulus)
run(depends dpkg-query --admindir=${root}/var/lib/dpkg -W -f "\${Depends}" libregulus-dev)
if(NOT depends STREQUAL "regulus (= ${version})")
  fail("libregulus-dev depends on: ${depends}")
endif()
if(EXISTS ${BUILD_DIR}/bin/regulus-mpi)
  run(depends dpkg-query --admindir=${root}/var/lib/dpkg -W -f "\${Depends}" regulus-mpi)
  if(NOT depends MATCHES "lib(openmpi|mpich)" OR NOT depends MATCHES "regulus \\(= ${version}\\)")
    fail("regulus-mpi depends on: ${depends}")
  endif()
  if(NOT EXISTS ${root}/usr/bin/regulus-mpi OR NOT EXISTS ${root}/usr/share/doc/regulus-mpi/CLUSTER.md)
    fail("the package regulus-mpi lacks the program or its page of the manual")
  endif()
endif()
if(EXISTS ${BUILD_DIR}/python)
  run(depends dpkg-query --admindir=${root}/var/lib/dpkg -W -f "\${Depends}" python3-regulus)
  if(NOT depends MATCHES "python3 \\(>= 3" OR NOT depends MATCHES "regulus \\(= ${version}\\)")
    fail("python3-regulus depends on: ${depends}")
  endif()
  file(GLOB modules ${root}/usr/lib/python3/dist-packages/regulus/_regulus.*.so)
  if(NOT modules OR NOT EXISTS ${root}/usr/share/doc/python3-regulus/PYTHON.md)
    fail("the package python3-regulus lacks the module or its page of the manual")
  endif()
endif()
foreach(file IN ITEMS bin/regulus bin/regulus-verify lib/regulus/plugins/libregulus-pack.so
                      share/doc/regulus/copyright share/doc/libregulus-dev/copyright
                      lib/cmake/Regulus/RegulusConfig.cmake
                      include/regulus/runtime/embedded/checker.h lib/libregulus-runtime.a)
  if(NOT EXISTS ${root}/usr/${file})
    fail("no package has /usr/${file}")
  endif()
endforeach()

# The program works there, from model to machine code to a certificate that the other one accepts.
set(ENV{XDG_CACHE_HOME} ${folder}/cache)
run(verdict ${root}/usr/bin/regulus check ${root}/usr/share/regulus/models/robot_1.toml wide_15
    --engine jit --certificate ${folder}/proof.txt)
run(answer ${root}/usr/bin/regulus-verify ${folder}/proof.txt)
if(NOT verdict STREQUAL "NO SINGULARITY\n" OR NOT answer MATCHES "VERIFIED")
  fail("${verdict}${answer}")
endif()

# CMake finds the package in that root.
set(PREFIX ${root}/usr)
file(WRITE ${folder}/found/CMakeLists.txt
     "cmake_minimum_required(VERSION 3.25)\nproject(found LANGUAGES CXX)\n"
     "find_package(Regulus ${version} EXACT REQUIRED COMPONENTS runtime search codegen jit)\n")
set(CONFIGURE ${CMAKE_COMMAND} -S ${folder}/found -B ${folder}/found/build -G ${GENERATOR}
    -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_CXX_COMPILER=${CXX_COMPILER})
run(ignored ${CONFIGURE})
