# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DSOURCE_DIR=… -P namespaces.cmake
# Everything is in the namespace regulus. Inside it some names have a namespace of their own, because they
# must not be mixed up with the rest.
cmake_minimum_required(VERSION 3.25)

set(own_runtime/machine  machine)      # operations that have the names of a kernel's
set(own_runtime/verifier verifier)     # shares no code with what it checks
set(own_runtime/formal   verifier)
set(own_codegen/kernel/jit "plugin|builder")  # compiled against LLVM, and opened for a compilation

set(faults "")
file(GLOB_RECURSE sources RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/codegen/*.[ch]pp ${SOURCE_DIR}/runtime/*.[ch]pp)
list(LENGTH sources count)
if(count LESS 500)
  string(APPEND faults "only ${count} sources were found\n")
endif()
foreach(source IN LISTS sources)
  set(expected "regulus")
  string(REGEX MATCH "^(runtime/[a-z]+|codegen/[a-z]+/[a-z]+)/" _ ${source})
  set(room "${CMAKE_MATCH_1}")
  if(DEFINED own_${room} AND source MATCHES "^runtime/")
    set(expected "regulus::(${own_${room}})")
  elseif(DEFINED own_${room})
    set(expected "regulus(::(${own_${room}}))?")
  elseif(source MATCHES "^runtime/")
    set(expected "regulus(::[a-z0-9_]+)?")
  endif()
  file(STRINGS ${SOURCE_DIR}/${source} lines REGEX "^(inline )?namespace regulus[a-z0-9_: ]* {")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^namespace ${expected} {")
      string(APPEND faults "${source}: \"${line}\": expected ${expected}\n")
    endif()
  endforeach()
endforeach()
if(faults)
  message(FATAL_ERROR "Namespaces:\n${faults}")
endif()
